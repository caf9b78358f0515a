//! The impact on the half-space.

use super::US;
use crate::case::{RADIUS_M, kmax};
use crate::row::Row;
use crate::runs::Runs;
use impact::Run;

/// The force is printed with two digits.
pub(super) const ROUNDED: &str = "160 kN is rounded: the printed Kmax of 14.11 is 161.0 kN";

/// What the paper's step does.
const STEP: &str = "time-step error of the explicit scheme, see its own rows below";

pub(super) fn rows(runs: &Runs) -> Vec<Row> {
    let (table_1, printed) = (&runs.table_1, &runs.printed);
    let force_n = |what, run: &Run| {
        Row::new("Fig. 6", what, [160e3, run.peak_force_n])
            .unit("N", 0)
            .why(ROUNDED)
    };
    let time_us = |what, run: &Run| {
        Row::new("Fig. 4", what, [27.0, US * run.contact_time_s])
            .unit("us", 3)
            .why(STEP)
    };
    let restitution = |what, run: &Run| {
        Row::new("Fig. 4", what, [0.991, run.restitution])
            .unit("", 5)
            .why(STEP)
    };
    let drop = 100.0 * (1.0 - printed.peak_force_n / runs.hertz_printed.peak_force_n);
    let kmax = kmax(printed.peak_force_n, RADIUS_M);
    vec![
        force_n("peak force, 123 GPa", table_1),
        force_n("peak force, 129 GPa", printed),
        time_us("contact time, 123 GPa", table_1),
        time_us("contact time, 129 GPa", printed),
        restitution("restitution, 123 GPa", table_1),
        restitution("restitution, 129 GPa", printed),
        Row::new(
            "Fig. 4",
            "velocity of departure, 129 GPa",
            [99.1, printed.rebound_velocity_m_s],
        )
        .unit("m/s", 2)
        .why(STEP),
        Row::new("Fig. 6", "Kmax with 227 MPa, 129 GPa", [14.11, kmax]).why(STEP),
        Row::new(
            "Fig. 6",
            "drop of the peak force against Hertz, 129 GPa",
            [11.6, drop],
        )
        .unit("%", 2)
        .why(STEP),
    ]
}
