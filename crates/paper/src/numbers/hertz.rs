//! (45)-(47).

use super::US;
use crate::case::{NAMED_STRENGTH_PA, RADIUS_M, area_m2, kmax};
use crate::row::Row;
use crate::runs::Runs;
use contact::law::hertz::CONTACT_TIME;
use impact::Run;

/// Why Table 1 does not give the printed values.
const STIFFER: &str = "the printed value belongs to copper of 129 GPa, Table 1 has 123 GPa";

/// Why the strength that is named does not give the printed value.
const YIELD: &str =
    "57 MPa is the yield point of Table 1; the value was divided by its tensile strength, 227 MPa";

pub(super) fn rows(runs: &Runs) -> Vec<Row> {
    let (table_1, printed) = (&runs.hertz_table_1, &runs.hertz_printed);
    let force_n =
        |what, run: &Run| Row::new("(46)", what, [182_191.0, run.peak_force_n]).unit("N", 0);
    let time_us = |what, run: &Run| Row::new("(47)", what, [24.6, US * rounded(run)]).unit("us", 2);
    let ratio = |what, here| Row::new("after (47)", what, [15.97, here]);
    let on_yield = printed.peak_force_n / area_m2(RADIUS_M) / NAMED_STRENGTH_PA;
    vec![
        force_n("peak force, copper at 123 GPa (Table 1)", table_1).why(STIFFER),
        force_n("peak force, copper at 129 GPa", printed),
        time_us("contact time with its 2.94, 123 GPa", table_1).why(STIFFER),
        time_us("contact time with its 2.94, 129 GPa", printed),
        ratio(
            "Kmax = Pmax/S/Rm, Rm = 227 MPa, 129 GPa",
            kmax(printed.peak_force_n, RADIUS_M),
        ),
        ratio(
            "Kmax with the 57 MPa that the text names, 129 GPa",
            on_yield,
        )
        .why(YIELD),
    ]
}

/// (47) with the factor 2.94 of the paper; exactly it is 2.9433.
fn rounded(hertz: &Run) -> f64 {
    hertz.contact_time_s * 2.94 / CONTACT_TIME
}
