//! The paper's own scheme and constants, which give its values.

use super::US;
use super::coupled::ROUNDED;
use crate::case::{RADIUS_M, kmax};
use crate::row::Row;
use crate::runs::Runs;

pub(super) fn rows(runs: &Runs) -> Vec<Row> {
    let run = &runs.scheme;
    let drop = 100.0 * (1.0 - run.peak_force_n / runs.hertz_printed.peak_force_n);
    let row = |place, what, printed, here| Row::new(place, what, [printed, here]);
    vec![
        row("Fig. 6", "peak force", 160e3, run.peak_force_n)
            .unit("N", 0)
            .why(ROUNDED),
        row("Fig. 4", "contact time", 27.0, US * run.contact_time_s).unit("us", 3),
        row("Fig. 4", "restitution", 0.991, run.restitution).unit("", 5),
        row(
            "Fig. 4",
            "velocity of departure",
            99.1,
            run.rebound_velocity_m_s,
        )
        .unit("m/s", 2),
        row(
            "Fig. 6",
            "Kmax with 227 MPa",
            14.11,
            kmax(run.peak_force_n, RADIUS_M),
        ),
        row("Fig. 6", "drop of the peak force against Hertz", 11.6, drop).unit("%", 2),
    ]
}
