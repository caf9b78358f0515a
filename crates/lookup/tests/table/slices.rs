//! Between slices: exactness, ends, slices that serve themselves alone, batches, partial loading.

use crate::stand_in::{CELLS, content};
use lookup::{
    Between, Content, LookupError, Role, Smoothness, Table, TableFile, TraceInfo, Verification,
    cell_scale, ratio_coordinate, write,
};

const COUNT: usize = 11;

fn ratio(i: usize) -> f64 {
    0.04 * i as f64
}

/// How the stand-in grows with the ratio: a polynomial that eight slices interpolate exactly.
fn growth(nu: f64) -> f64 {
    let x = ratio_coordinate(nu).unwrap();
    1.0 + x + 0.5 * x.powi(3) - 0.2 * x.powi(7)
}

/// Slices at 0, 0.04 .. 0.4 that interpolate, and at 0.21 one of another size that does not.
pub(crate) fn sliced() -> Content {
    let mut content = content();
    let original = content.slices.remove(0);
    let slice = |nu: f64, factor: f64, role: Role| {
        let mut slice = original.clone();
        (slice.poisson_ratio, slice.role) = (nu, role);
        for values in [&mut slice.remainder, &mut slice.tail] {
            for value in values {
                *value = (f64::from(*value) * factor) as f32;
            }
        }
        slice
    };
    for i in 0..COUNT {
        content
            .slices
            .push(slice(ratio(i), growth(ratio(i)), Role::Grid));
        if i == 5 {
            content.slices.push(slice(0.21, 7.0, Role::Exact));
        }
    }
    (content.between_r, content.between_z) = (vec![0.5, 1.0], vec![0.3, 0.6]);
    content.between = (0..COUNT - 1)
        .map(|i| Between {
            poisson_ratio: 0.5 * (ratio(i) + ratio(i + 1)),
            verification: Verification {
                direct: vec![1.0; 24],
                looked_up: vec![1.0; 24],
                error: vec![1e-4; 24],
            },
        })
        .collect();
    content
}

fn cells(table: &Table, nu: f64) -> Vec<[f64; 6]> {
    let mut cells = vec![[0.0; 6]; CELLS];
    table.trace(nu, 0.4, 0.3, 0, &mut cells).unwrap();
    cells
}

#[test]
fn polynomials_in_the_coordinate_are_exact_and_fronts_keep_their_cells() {
    let table = Table::new(sliced()).unwrap();
    let base = cells(&table, 0.0);
    for nu in [0.001, 0.13, 0.205, 0.211, 0.37, 0.399] {
        let scale = growth(nu) / growth(0.0);
        for (found, base) in cells(&table, nu).iter().zip(&base) {
            for f in 0..6 {
                let error = (found[f] - scale * base[f]).abs();
                assert!(error < 2e-6 * (1.0 + base[f].abs()), "nu = {nu}: {error}");
            }
        }
        let width = 0.25 * cell_scale(nu).unwrap();
        assert_eq!(table.cell_width(nu).unwrap(), width);
    }
}

#[test]
fn a_slice_serves_its_own_ratio_exactly_and_one_ulp_beside_it() {
    let table = Table::new(sliced()).unwrap();
    let own = cells(&table, 0.21);
    let neighbours = cells(&table, 0.2);
    assert!((own[3][1] / neighbours[3][1] * growth(0.2) - 7.0).abs() < 1e-4);
    for i in 0..COUNT {
        let exact = cells(&table, ratio(i));
        let up = ratio(i).next_up().min(ratio(COUNT - 1));
        let down = ratio(i).next_down().max(0.0);
        for (nu, exact) in [up, down].into_iter().zip([&exact, &exact]) {
            assert_eq!(&cells(&table, nu), exact);
        }
    }
    let mut memory = vec![[0.0; 6]; 1];
    for nu in [-1e-9, 0.4 + 1e-9, f64::NAN, 0.6] {
        let error = table.trace(nu, 0.4, 0.3, 0, &mut memory).unwrap_err();
        assert!(matches!(
            error,
            LookupError::Outside {
                axis: "poisson_ratio",
                ..
            }
        ));
    }
}

#[test]
fn the_estimate_between_slices_holds_what_was_measured_there() {
    let table = Table::new(sliced()).unwrap();
    let at = |nu| table.error(nu, 0.4, 0.4, 10.0).unwrap()[0];
    let own = lookup::SAFETY * 1e-5;
    assert!((at(0.2) / own - 1.0).abs() < 1e-6);
    let middle = own + lookup::SAFETY_BETWEEN * 1e-4;
    assert!((at(0.14) / middle - 1.0).abs() < 1e-4);
    assert!(at(0.1599) < 0.1 * middle + own);
}

#[test]
fn a_part_of_a_file_gives_the_same_answers() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    write(&path, &sliced()).unwrap();
    let whole = Table::open(&path).unwrap();
    let file = TableFile::open(&path).unwrap();
    let (r_max, z_max) = (whole.r_max(), whole.z_max());
    let nodes = |table: &Table| [table.content().r.len(), table.content().z.len()];
    for (nu, tabulated) in [
        (0.08, true),
        (0.21, true),
        (0.19, false),
        (0.01, false),
        (0.39, false),
    ] {
        for farthest in [
            [0.0, 0.0],
            [whole.content().r[1], z_max],
            [0.3 * r_max, 0.4 * z_max],
            [r_max, 0.1 * z_max],
            [r_max, z_max],
        ] {
            let part = file.part(nu, farthest).unwrap();
            assert_eq!(part.poisson_ratios(), [nu]);
            assert!(part.r_max() >= farthest[0] && part.z_max() >= farthest[1]);
            assert!(farthest[0] > 0.0 || nodes(&part)[0] < nodes(&whole)[0]);
            for x in [0.0, 0.31, 0.77, 1.0] {
                for y in [0.0, 0.12, 0.9, 1.0] {
                    let (r, z) = (x * farthest[0], y * farthest[1]);
                    let answer = |table: &Table| {
                        let mut cells = vec![[0.0; 6]; CELLS];
                        let info = table.trace(nu, r, z, 0, &mut cells).unwrap();
                        (cells, info, table.error(nu, r, z, 10.0).unwrap())
                    };
                    let (found, exact) = (answer(&part), answer(&whole));
                    if tabulated {
                        assert_eq!(found, exact, "{nu} {farthest:?}: {r} {z}");
                        continue;
                    }
                    for field in 0..6 {
                        let peak = exact.0.iter().fold(0.0, |a: f64, c| a.max(c[field].abs()));
                        for (a, b) in found.0.iter().zip(&exact.0) {
                            assert!((a[field] - b[field]).abs() <= 2e-7 * peak);
                        }
                        let ratio = found.2[field] / exact.2[field];
                        assert!((0.9999..2.0).contains(&ratio), "{nu} {r} {z}: {ratio}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_part_of_what_is_not_served_has_the_ranges_of_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    write(&path, &sliced()).unwrap();
    let whole = Table::open(&path).unwrap();
    let file = TableFile::open(&path).unwrap();
    let part = file.part(0.08, [whole.r_max() + 1e-9, 0.0]).unwrap();
    assert_eq!((part.r_max(), part.z_max()), (whole.r_max(), whole.z_max()));
    let part = file.part(0.45, [0.1, 0.1]).unwrap();
    assert_eq!(part.poisson_ratios(), whole.poisson_ratios());
}

#[test]
fn a_batch_fills_the_memory_given_as_single_traces_do() {
    let table = Table::new(sliced()).unwrap();
    let points = [[0.1, 0.2], [0.0, 0.0], [1.7, 0.9]];
    let blank = TraceInfo {
        static_part: [0.0; 6],
        cell_width: 0.0,
        error: [0.0; 6],
    };
    let (mut memory, mut infos) = (vec![[9.0; 6]; 3 * 50], vec![blank; 3]);
    let smooth = Smoothness::Smooth;
    table
        .traces(smooth, 0.3, &points, 1, &mut memory, &mut infos)
        .unwrap();
    for (i, [r, z]) in points.into_iter().enumerate() {
        let mut single = vec![[0.0; 6]; 50];
        let info = table.trace_for(smooth, 0.3, r, z, 1, &mut single).unwrap();
        assert_eq!(single, memory[50 * i..50 * (i + 1)]);
        assert_eq!(info, infos[i]);
    }
    let error = table.traces(smooth, 0.3, &points, 1, &mut memory[1..], &mut infos);
    assert!(matches!(error, Err(LookupError::Lengths { points: 3, .. })));
}
