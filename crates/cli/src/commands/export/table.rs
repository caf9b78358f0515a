//! The rebound over velocities as CSV, elastic and, where the scene has a law of flow, plastic.

use crate::commands::export::case::Case;
use crate::failure::Failure;
use contact::Plasticity;
use formats::QUANTITIES;
use std::fmt::Write;

/// Results of a velocity.
const COLUMNS: [&str; 5] = [
    "restitution",
    "loss",
    "contact_time_s",
    "peak_force_n",
    "relative_error_estimate",
];

/// The second order of the loss over the square of the first, docs/theory.md (T53).
const SECOND_ORDER: f64 = 0.65;

/// The table, its velocities in m/s evenly in their logarithm.
pub(super) fn table(case: &Case, velocities: Option<&[f64]>, rows: u32) -> Result<String, Failure> {
    let top = case.impact.velocity_m_s;
    let &[from, to] = velocities.unwrap_or(&[top / 100.0, top]) else {
        return Err(Failure::input(
            "--velocities has not two values: give FROM,TO",
        ));
    };
    if !(from > 0.0 && from < to && to.is_finite()) {
        return Err(Failure::input(format!(
            "--velocities = {from},{to} is outside 0 < FROM < TO < inf"
        )));
    }
    let mut text = case.header();
    let factor = case.loss_factor();
    if factor > 0.0 {
        text += &format!(
            "# elastic loss 1 - e^2 = {factor:.6e} v^0.6, v in m/s, to 1 % below {:.4} m/s\n",
            (0.01 / SECOND_ORDER / factor).powf(5.0 / 3.0)
        );
    }
    text += "velocity_m_s";
    let kinds: &[(&str, bool)] = match case.impact.settings.plasticity {
        Plasticity::None => &[("elastic", true)],
        _ => &[("elastic", true), ("plastic", false)],
    };
    for (kind, _) in kinds {
        text.extend(COLUMNS.map(|column| format!(",{kind}_{column}")));
    }
    text.push('\n');
    for row in 0..rows {
        let place = f64::from(row) / f64::from(rows - 1);
        // both ends as they were given
        let velocity = from.powf(1.0 - place) * to.powf(place);
        text += &format!("{velocity:?}");
        for &(_, elastic) in kinds {
            let results = case.at(velocity, elastic)?.results;
            for column in COLUMNS {
                let known = QUANTITIES.iter().find(|known| known.name == column);
                let value = known.map_or(f64::NAN, |known| (known.of_contact)(&results));
                let _ = write!(text, ",{value:?}");
            }
        }
        text.push('\n');
    }
    Ok(text)
}
