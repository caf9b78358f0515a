//! A table of the size of one slice of `standard`, filled with made-up numbers: what is timed is the lookup.

use halfspace::random;
use lookup::{Content, Origin, Role, Slice, Table, Verification};

/// Cells of a trace.
pub const CELLS: usize = 300;
/// Cells in the table, as many as `standard` has; the tail continues them.
pub const STORED: usize = 230;
/// Nodes along each axis.
pub const NODES: usize = 72;
/// Interpolation points along each axis.
pub const POINTS: usize = 8;
const SPACING: f64 = 0.0875;
const TERMS: usize = 12;

/// A table with one slice at nu = 0.3.
pub fn table() -> Table {
    let axis: Vec<f64> = (0..NODES).map(|i| SPACING * i as f64).collect();
    let max = axis[NODES - POINTS / 2];
    let wave = |scale: f64, count: usize| -> Vec<f32> {
        (0..count)
            .map(|i| (scale * (0.001 * i as f64).sin()) as f32)
            .collect()
    };
    let nodes = NODES * NODES * 6;
    let probes = (NODES - POINTS / 2) * (NODES - POINTS / 2) * 6;
    let slice = Slice {
        poisson_ratio: 0.3,
        role: Role::Grid,
        cells: STORED,
        remainder: wave(1.0, nodes * STORED),
        moment: wave(1e-3, nodes * STORED),
        curvature: wave(1e-4, nodes * STORED),
        tail: wave(1.0, nodes * TERMS),
        verification: Verification {
            direct: wave(1.0, probes),
            looked_up: wave(1.0, probes),
            error: vec![1e-6; probes],
        },
    };
    Table::new(Content {
        origin: Origin {
            grid: "bench = true\n".to_owned(),
            format_version: lookup::schema::FORMAT_VERSION_VALUE.to_owned(),
            software_version: "0".to_owned(),
            numbers_revision: 1,
            git_revision: "unknown".to_owned(),
            created_unix_s: 0,
            accuracy_asked: 1e-8,
            accuracy_reached: vec![1e-6],
        },
        r: axis.clone(),
        z: axis,
        r_max: max,
        z_max: max,
        cell_width: 0.125,
        stencil_points: POINTS,
        pulse_lengths: vec![10.0],
        slices: vec![slice],
        between_r: Vec::new(),
        between_z: Vec::new(),
        between: Vec::new(),
    })
    .expect("the stand-in is a valid table")
}

/// Bytes that a trace of plain averages reads off the grid: all nodes of the stencil, all fields and cells.
pub const BYTES: usize = POINTS * POINTS * 6 * STORED * size_of::<f32>();

/// Number `index` of a fixed sequence in [0, 1).
#[allow(dead_code, reason = "not every bench draws numbers")]
pub fn uniform(index: u64) -> f64 {
    random::unit(random::number(0, index))
}
