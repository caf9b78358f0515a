//! A small table filled from a smooth analytic stand-in for the kernels.

use halfspace::{FIELDS, Six};
use lookup::{Content, Origin, Role, Slice, Table, Verification};

/// Width of a cell.
pub(crate) const WIDTH: f64 = 0.25;
/// Number of cells.
pub(crate) const CELLS: usize = 40;

/// g(r,z) with the parity of the field, times an amplitude for its index.
pub(crate) fn shape(r: f64, z: f64, field: usize) -> f64 {
    let odd = if FIELDS[field].is_odd_in_r() { r } else { 1.0 };
    (1.0 + field as f64) * odd * (0.3 * r * r + 0.2 * z).cos() * (-0.4 * z).exp()
}

/// Integral of the stand-in remainder g(r,z) h(t): h = 1/(1 + t/10)^2 throughout.
pub(crate) fn average(r: f64, z: f64, field: usize, from: f64, to: f64) -> f64 {
    let primitive = |t: f64| -10.0 / (1.0 + t / 10.0);
    shape(r, z, field) * (primitive(to) - primitive(from)) / (to - from)
}

/// The content of the stand-in table.
pub(crate) fn content() -> Content {
    let r: Vec<f64> = (0..15).map(|i| 0.15 * f64::from(i)).collect();
    let z: Vec<f64> = (0..12)
        .map(|i| 0.1 * f64::from(i) + 0.005 * f64::from(i * i))
        .collect();
    let (mut remainder, mut moment) = (Vec::new(), Vec::new());
    let (mut curvature, mut tail) = (Vec::new(), Vec::new());
    for &r in &r {
        for &z in &z {
            for field in 0..6 {
                for j in 0..CELLS {
                    let (from, to) = (j as f64 * WIDTH, (j + 1) as f64 * WIDTH);
                    let middle = 0.5 * (from + to);
                    let halves =
                        average(r, z, field, middle, to) - average(r, z, field, from, middle);
                    remainder.push(average(r, z, field, from, to) as f32);
                    moment.push((halves / 6.0) as f32);
                    let third = |i: f64| {
                        let edge = |k: f64| from + (to - from) * k / 3.0;
                        average(r, z, field, edge(i), edge(i + 1.0))
                    };
                    curvature.push(((third(0.0) - 2.0 * third(1.0) + third(2.0)) / 40.0) as f32);
                }
                // With t_end = 10: R = u^2/(1 + u)^2, g = 1/(1 + u)^2, fitted at Chebyshev points.
                tail.extend(chebyshev_fit(|u| shape(r, z, field) / (1.0 + u).powi(2)));
            }
        }
    }
    let probes = (r.len() - 1) * (z.len() - 1) * 6;
    let slice = Slice {
        poisson_ratio: 0.3,
        role: Role::Grid,
        cells: CELLS,
        remainder,
        moment,
        curvature,
        tail,
        verification: Verification {
            direct: vec![1.0; probes],
            looked_up: vec![1.0; probes],
            error: (0..probes).map(|i| 1e-5 * (1 + i % 6) as f32).collect(),
        },
    };
    Content {
        origin: Origin {
            grid: "stand_in = true\n".to_owned(),
            format_version: lookup::schema::FORMAT_VERSION_VALUE.to_owned(),
            software_version: "0".to_owned(),
            numbers_revision: 1,
            git_revision: "unknown".to_owned(),
            created_unix_s: 0,
            accuracy_asked: 1e-9,
            accuracy_reached: vec![1e-5],
        },
        r_max: r[r.len() - 1],
        z_max: z[z.len() - 1],
        r,
        z,
        cell_width: WIDTH,
        stencil_points: 6,
        pulse_lengths: vec![10.0],
        slices: vec![slice],
        between_r: Vec::new(),
        between_z: Vec::new(),
        between: Vec::new(),
    }
}

/// The stand-in as a table.
pub(crate) fn table() -> Table {
    Table::new(content()).expect("the stand-in is a valid table")
}

/// Cells of one trace.
pub(crate) fn cells(table: &Table, r: f64, z: f64, coarsening: u32, count: usize) -> Vec<Six> {
    let mut cells = vec![[0.0; 6]; count];
    table
        .trace(
            lookup::Smoothness::Linear,
            0.3,
            r,
            z,
            coarsening,
            &mut cells,
        )
        .expect("inside the table");
    cells
}

fn chebyshev_fit(g: impl Fn(f64) -> f64) -> Vec<f32> {
    const N: usize = 14;
    let angle = |i: usize| std::f64::consts::PI * (i as f64 + 0.5) / N as f64;
    (0..N)
        .map(|k| {
            let sum: f64 = (0..N)
                .map(|i| g(0.5 * (1.0 + angle(i).cos())) * (k as f64 * angle(i)).cos())
                .sum();
            (sum * if k == 0 { 1.0 } else { 2.0 } / N as f64) as f32
        })
        .collect()
}
