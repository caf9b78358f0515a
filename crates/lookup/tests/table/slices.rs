//! Between slices: exactness, ends, slices that serve themselves alone, batches.

use crate::stand_in::{CELLS, content};
use lookup::{
    Between, Content, LookupError, Role, Smoothness, Table, TraceInfo, Verification, cell_scale,
    ratio_coordinate,
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
    table
        .trace(Smoothness::Linear, nu, 0.4, 0.3, 0, &mut cells)
        .unwrap();
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
        let error = table
            .trace(Smoothness::Linear, nu, 0.4, 0.3, 0, &mut memory)
            .unwrap_err();
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
        let info = table.trace(smooth, 0.3, r, z, 1, &mut single).unwrap();
        assert_eq!(single, memory[50 * i..50 * (i + 1)]);
        assert_eq!(info, infos[i]);
    }
    let error = table.traces(smooth, 0.3, &points, 1, &mut memory[1..], &mut infos);
    assert!(matches!(error, Err(LookupError::Lengths { points: 3, .. })));
}
