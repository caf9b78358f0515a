//! A small kernel table filled from a smooth function.

use lookup::{Between, Content, Origin, Role, Slice, Verification, schema};

const NODES: usize = 9;
const CELLS: usize = 20;
const TERMS: usize = 3;

/// Three slices, one of them of role `exact`, and what lies between the other two.
pub(crate) fn content() -> Content {
    let axis: Vec<f64> = (0..NODES).map(|i| 0.25 * i as f64).collect();
    let places = (NODES - 1) * (NODES - 1) * 6;
    let verification = |count: usize| Verification {
        direct: vec![1.0; count],
        looked_up: vec![1.0; count],
        error: vec![1e-5; count],
    };
    let slice = |poisson_ratio: f64, role: Role| {
        let numbers = |each: usize, size: f32| {
            let at = |i: usize| size * (0.01 * i as f32 + poisson_ratio as f32).sin();
            (0..NODES * NODES * 6 * each).map(at).collect::<Vec<f32>>()
        };
        Slice {
            poisson_ratio,
            role,
            cells: CELLS,
            remainder: numbers(CELLS, 1.0),
            moment: numbers(CELLS, 0.01),
            curvature: numbers(CELLS, 0.001),
            tail: numbers(TERMS, 0.1),
            verification: verification(places),
        }
    };
    Content {
        origin: Origin {
            grid: "stand_in = true\n".to_owned(),
            format_version: schema::FORMAT_VERSION_VALUE.to_owned(),
            software_version: "0".to_owned(),
            numbers_revision: 1,
            git_revision: "unknown".to_owned(),
            created_unix_s: 0,
            accuracy_asked: 1e-9,
            accuracy_reached: vec![1e-5],
        },
        r_max: axis[NODES - 1],
        z_max: axis[NODES - 1],
        r: axis.clone(),
        z: axis,
        cell_width: 0.25,
        stencil_points: 4,
        pulse_lengths: vec![10.0],
        slices: vec![
            slice(0.25, Role::Grid),
            slice(0.3, Role::Grid),
            slice(0.31, Role::Exact),
        ],
        between_r: vec![0.5, 1.0],
        between_z: vec![0.5],
        between: vec![Between {
            poisson_ratio: 0.275,
            verification: verification(2 * 6),
        }],
    }
}
