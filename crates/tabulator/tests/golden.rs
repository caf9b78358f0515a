//! Looked-up fields against an independent Laplace-Hankel inversion (tests/golden/fields.csv).

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::FIELDS;
use lookup::{Smoothness, Table};
use tabulator::{Axis, Grid, Silent, build};

struct Golden {
    r: f64,
    z: f64,
    length: f64,
    t: f64,
    /// In the order of `FIELDS`.
    values: [f64; 6],
}

/// Rows at nu = 0.3.
fn golden() -> Vec<Golden> {
    include_str!("../../../tests/golden/fields.csv")
        .lines()
        .skip(1)
        .map(|line| {
            line.split(',')
                .map(|x| x.parse().unwrap())
                .collect::<Vec<f64>>()
        })
        .filter(|row| row[0] == 0.3)
        .map(|row| {
            let [w, u, szz, srz, srr, stt] = [row[5], row[6], row[7], row[8], row[9], row[10]];
            Golden {
                r: row[1],
                z: row[2],
                length: row[3],
                t: row[4],
                values: [u, w, srr, stt, szz, srz],
            }
        })
        .collect()
}

/// Response at time t to sin^4(pi t/T), sampled backwards from t.
fn response(table: &Table, row: &Golden) -> [f64; 6] {
    let width = table.cell_width(0.3).unwrap();
    let count = (row.t / width).ceil() as usize + 1;
    let mut cells = vec![[0.0; 6]; count];
    let info = table
        .trace(Smoothness::Smooth, 0.3, row.r, row.z, 0, &mut cells)
        .unwrap();
    let force = |t: f64| {
        if t > 0.0 && t < row.length {
            (std::f64::consts::PI * t / row.length).sin().powi(4)
        } else {
            0.0
        }
    };
    std::array::from_fn(|f| {
        let sum: f64 = cells
            .iter()
            .enumerate()
            .map(|(j, cell)| {
                (force(row.t - j as f64 * width) - force(row.t - (j + 1) as f64 * width)) * cell[f]
            })
            .sum();
        force(row.t) * info.static_part[f] + sum
    })
}

#[test]
fn looked_up_fields_agree_with_the_reference_to_1e_5_of_their_peaks() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("golden.h5");
    let grid = Grid {
        r: Axis::uniform(3.25, 0.125),
        z: Axis::uniform(1.75, 0.125),
        ..Grid::demo()
    };
    build(&grid, &path, &Silent).unwrap();
    let table = Table::open(&path).unwrap();
    let rows = golden();
    assert_eq!(rows.len(), 64);
    for group in rows.chunks(16) {
        for (f, field) in FIELDS.into_iter().enumerate() {
            let peak = group
                .iter()
                .fold(0.0_f64, |most, row| most.max(row.values[f].abs()));
            for row in group {
                let error = (response(&table, row)[f] - row.values[f]).abs();
                // The surface rows are themselves known to 1e-7 absolute only.
                let known = if row.z == 0.0 { 2e-7 } else { 0.0 };
                assert!(
                    error < 1e-5 * peak + known,
                    "{field:?} at r = {}, z = {}, T = {}, t = {}: error {error:.1e}, peak {peak:.1e}",
                    row.r,
                    row.z,
                    row.length,
                    row.t
                );
            }
        }
    }
}
