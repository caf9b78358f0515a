//! Whether the deflection of a fixed disc makes a contact at all: the same answer at every tolerance.
//!
//! A fast change of the force meets the tangent compliance (2/3)/y of Hertz's law, y = p^(1/3), and the disc's dynamic
//! compliance sigma C(i w), C the transform of the impulse response of its deflection over the static value:
//!
//! ```text
//! full share      2/(3 y) + sigma C             the centre's C is real and negative at some frequencies
//! dynamic share   2/(3 y) + sigma (C - 1)       C -> 0 for the fastest
//! ```
//!
//! Where such a sum has a zero that grows (Nyquist: the second term is real and below -2/(3 y) somewhere), waves
//! feed the contact or there is no solution at all.
//! Coarse steps do not see it, fine ones do, so that a result or a refusal would depend on the tolerance.
//! Hence the question is put once, before the model is chosen, with the largest y of a contact without waves.
//! Where nothing grows the disc is sound; what grows has hundreds of memories for it if the memory is short; in between
//! one march decides whose step resolves the memory.
//! The mean deflection does the pressure's work and is passive: with the full share it is always sound.
//!
//! Theory: `docs/theory.md` (T42, T57).

use crate::disc::FixedDisc;
use crate::disc::implicit::march_into;
use crate::error::{ContactError, MarchError};
use crate::history::History;
use crate::law::quasi_static::{largest_force, quasi_static};
use crate::settings::StaticShare;
use crate::summary::Summary;
use crate::waves::compliance::LARGEST_NEGATIVE;
use crate::waves::response::DiscResponse;
use halfspace::Deflection;

/// Memory over the contact time below which whatever grows has grown beyond bounds.
const SHORT_MEMORY: f64 = 2e-3;

/// Cells of the memory, and steps of the contact at least, of the march that decides.
const CELLS_OF_MEMORY: f64 = 24.0;
const STEPS_OF_TRIAL: f64 = 300.0;

/// Margin of that march from the fold of the dynamic share.
const MARGIN: f64 = 0.975;

/// Refuses a disc whose model makes no sense.
///
/// # Errors
/// [`MarchError::NoSolution`] for a dynamic share that folds back, [`ContactError::EnergyFed`] for a centre that feeds
/// waves.
pub(crate) fn check(
    impact: &FixedDisc<'_, impl DiscResponse>,
    history: &mut History,
) -> Result<(), ContactError> {
    let (still, coupling) = (impact.static_coupling(), impact.coupling);
    let no_solution = |time| ContactError::from(MarchError::NoSolution { time, coupling });
    let fed = |found| ContactError::EnergyFed { coupling, found };
    let steepness = 1.5 * coupling * largest_force(still).cbrt();
    let at_once = 1.0 - impact.share.factor();
    let centre = impact.response.disc().deflection == Deflection::Centre;
    let sound = |negative: f64| steepness * (at_once + negative) <= MARGIN;
    let exactly = || sound(impact.response.negative_compliance());
    if !centre && sound(0.0) || centre && (sound(LARGEST_NEGATIVE) || exactly()) {
        return Ok(());
    }
    let (springs, _) = quasi_static(still);
    if impact.memory() < SHORT_MEMORY * springs.contact_time {
        return Err(match impact.share {
            StaticShare::Dynamic => no_solution(0.5 * springs.contact_time),
            StaticShare::Full => fed(None),
        });
    }
    let step = (impact.memory() / CELLS_OF_MEMORY).min(springs.contact_time / STEPS_OF_TRIAL);
    march_into(history, impact, step)?;
    match impact.share {
        StaticShare::Dynamic => {
            let largest = history.force.iter().copied().fold(0.0, f64::max);
            if 1.5 * coupling * largest.cbrt() > MARGIN {
                let place = history.force.iter().position(|&p| p == largest);
                return Err(no_solution(place.unwrap_or(0) as f64 * step));
            }
        }
        StaticShare::Full => {
            let found = Summary::new(history)?;
            if found.contacts > 1 || found.restitution > 1.0 {
                return Err(fed(Some((found.restitution, found.contacts))));
            }
        }
    }
    Ok(())
}
