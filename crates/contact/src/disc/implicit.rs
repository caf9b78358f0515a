//! The implicit scheme on a disc of fixed radius: the default.
//!
//! Each step solves A y^3 + y^2 = B for y = p^(1/3), where A collects what the newest force does to
//! the striker and to the half-space, and B all that is known.
//! The striker moves by Numerov's sum with the 3/2-power start taken out, the half-space answers by
//! product integration that is exact for a force linear in each cell and corrected for its curvature:
//! the scheme is of an order between 2 and 4 where the force is smooth, and stable at any step.
//!
//! Theory: `docs/theory.md` (T42).

use crate::disc::FixedDisc;
use crate::disc::bounds::{affordable, memory_cells};
use crate::disc::edge::{Edge, RESOLVED, Relaxation};
use crate::disc::striker::{STARTING, StrikerMotion, starting_roots};
use crate::disc::weights::Weights;
use crate::error::MarchError;
use crate::history::History;
use crate::numeric::cubic::force_root;
use crate::waves::response::DiscResponse;

/// Marches with a fixed step (collision units).
///
/// # Errors
/// [`MarchError::NoSolution`] where the `dynamic` share is not well posed,
/// [`MarchError::TooLong`] when the work is out of bounds.
pub fn march_implicit(
    impact: &FixedDisc<'_, impl DiscResponse>,
    step: f64,
) -> Result<History, MarchError> {
    let mut history = History::default();
    march_into(&mut history, impact, step)?;
    Ok(history)
}

/// The same in the room of another history: no samples are allocated once there is enough of it.
pub(crate) fn march_into(
    history: &mut History,
    impact: &FixedDisc<'_, impl DiscResponse>,
    step: f64,
) -> Result<(), MarchError> {
    // before the weights, which need one evaluation a cell
    let cells = memory_cells(impact.memory(), step)?;
    let weights = Weights::of(impact, impact.response, step);
    history.restart(step);
    let (coupling, unit) = (impact.coupling, impact.wave_time / step);
    let relaxation = Relaxation::of(impact.response, coupling, unit);
    let newest_weight = weights.values[0];
    let elastic = coupling * (impact.share.factor() - newest_weight);
    let roots = starting_roots(step, elastic);
    let touch = Edge::touch(elastic.max(0.0), step);
    let missed = missed(&relaxation, &weights, &touch, &roots);
    let mut striker = StrikerMotion::new(step, elastic, &roots);
    let inertia = striker.newest_weight();
    history.start = striker.missed[0];
    let compliance = inertia + elastic;
    history.compliance = compliance;
    history.elastic = elastic;
    // the last five roots, newest first: the guess is the polynomial through them
    let mut roots = [0.0_f64; 5];
    let mut free_since = 0;
    loop {
        let n = history.force.len();
        let newest = history.force[n - 1];
        let past = weights.past(&history.force) + missed.get(n - 1).copied().unwrap_or(0.0);
        let known_deflection = coupling * (newest_weight * newest - past);
        let free = striker.free_displacement();
        let known = free - known_deflection;
        let guess = 5.0 * (roots[0] - roots[3]) + 10.0 * (roots[2] - roots[1]) + roots[4];
        let solved = force_root(compliance, known, guess).ok_or(MarchError::NoSolution {
            time: n as f64 * step,
            coupling,
        })?;
        roots = [solved, roots[0], roots[1], roots[2], roots[3]];
        let force = solved * solved * solved;
        let displacement = free - inertia * force;
        history.push(force, displacement, known_deflection + elastic * force);
        striker.push(force);
        if force > 0.0 {
            free_since = 0;
        } else {
            free_since += 1;
            if free_since >= weights.values.len() && history.last_velocity() <= 0.0 {
                break;
            }
        }
        if n.is_multiple_of(1024) {
            affordable(n, cells, impact.memory())?;
        }
    }
    history.separate(&relaxation);
    Ok(())
}

/// Error of the weights in the delayed deflection at the first samples.
///
/// They follow a parabola through the samples, the force at the touch has the roots of `edge`.
fn missed(
    relaxation: &Relaxation<impl Fn(f64) -> f64>,
    weights: &Weights,
    edge: &Edge,
    roots: &[f64; STARTING],
) -> [f64; STARTING] {
    if relaxation.memory > RESOLVED {
        return [0.0; STARTING];
    }
    let mut force = [0.0; STARTING + 1];
    std::array::from_fn(|i| {
        let y = roots[i];
        force[i + 1] = y * y * y;
        relaxation.delayed_at_touch(edge, y) - weights.delayed(&force[..i + 2])
    })
}
