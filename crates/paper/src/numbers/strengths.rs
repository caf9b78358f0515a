//! What the conclusions say about strength under impact.

use crate::case::{RADIUS_M, STRENGTH_PA, area_m2};
use crate::row::Row;
use crate::runs::Runs;

/// Radius of the mushroom in m.
const MUSHROOM_M: f64 = 0.006;

pub(super) fn rows(runs: &Runs) -> Vec<Row> {
    let force_n = runs.table_1.peak_force_n;
    let rod_pa = force_n / area_m2(RADIUS_M);
    let mushroom_pa = force_n / area_m2(MUSHROOM_M);
    let row = |what, printed, here| Row::new("section 5", what, [printed, here]);
    vec![
        row(
            "steel, over the yield point of 1000 MPa",
            3.18,
            rod_pa / 1e9,
        ),
        row(
            "steel, over the tensile strength of 1200 MPa",
            2.65,
            rod_pa / 1.2e9,
        ),
        row(
            "copper, over the tensile strength of 227 MPa",
            14.0,
            rod_pa / STRENGTH_PA,
        ),
        row(
            "copper, on the mushroom of 6 mm",
            6.2,
            mushroom_pa / STRENGTH_PA,
        ),
    ]
}
