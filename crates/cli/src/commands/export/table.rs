//! CSV table of the rebound over velocity: elastic, and plastic if the scene has a plasticity law.

use crate::commands::export::case::{Case, named};
use crate::commands::export::head;
use crate::failure::Failure;
use contact::Plasticity;

/// Coefficient of the second-order loss in terms of the squared first-order loss, docs/theory.md (T53).
const SECOND_ORDER: f64 = 0.65;

/// The table, with logarithmically spaced velocities in m/s.
pub(super) fn table(case: &Case, velocities: Option<&[f64]>, rows: u32) -> Result<String, Failure> {
    let top = case.impact.velocity_m_s;
    let &[from, to] = velocities.unwrap_or(&[top / 100.0, top]) else {
        return Err(Failure::input("--velocities requires two values: FROM,TO"));
    };
    if !(from > 0.0 && from < to && to.is_finite()) {
        return Err(Failure::input(format!(
            "--velocities = {from},{to} is outside 0 < FROM < TO < inf"
        )));
    }
    let mut text = head(&case.run, &case.notes);
    let factor = case.loss_factor();
    if factor > 0.0 {
        let from = case.echoes_below_m_s();
        let from = from.map_or_else(String::new, |v| format!(" and above about {v:.4} m/s"));
        text += &format!(
            "# elastic loss 1 - e^2 = {factor:.6e} v^0.6, v in m/s, accurate to 1 % below {:.4} m/s{from}\n",
            (0.01 / SECOND_ORDER / factor).powf(5.0 / 3.0)
        );
    }
    text += "velocity_m_s";
    let kinds: &[(&str, bool)] = match case.impact.settings.plasticity {
        Plasticity::None => &[("elastic", true)],
        Plasticity::Thornton | Plasticity::Recovery | Plasticity::JacksonGreen => {
            &[("elastic", true), ("plastic", false)]
        }
    };
    for (kind, _) in kinds {
        text.extend(named(&case.run).map(|(name, _)| format!(",{kind}_{name}")));
    }
    text.push('\n');
    for row in 0..rows {
        let place = f64::from(row) / f64::from(rows - 1);
        // both ends exactly as given
        let velocity = from.powf(1.0 - place) * to.powf(place);
        text += &format!("{velocity:?}");
        for &(_, elastic) in kinds {
            let run = case.at(velocity, elastic)?;
            text.extend(named(&run).map(|(_, value)| format!(",{value:?}")));
        }
        text.push('\n');
    }
    Ok(text)
}
