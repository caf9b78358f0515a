//! The implicit scheme on a contact whose radius follows the load.
//!
//! In Hertz's contact an increment of load is carried by a flat punch of the radius at that moment,
//! a(t') = sqrt(R u(t')), and deflects both bodies by du (the law u = p^(2/3) is the sum of the punches).
//! The half-space gives its part of each increment not at once but as the punch's waves allow:
//!
//! ```text
//! d(t) = u(t) - phi int_0^t V_p((t - t') c1/a(t')) du(t'),     phi = E* (1 - nu^2)/E
//! ```
//!
//! with V_p = 1 - step response of the punch ([`PunchWaves`](crate::PunchWaves)).
//! No radius is free, and no static part is counted twice.
//! Because du carries phi <= 1 of itself at most, the equation is well posed for every pair of
//! materials; with increments shaped like Hertz's pressure it would not be for phi > 2/3.
//! u is nearly linear at the touch, so that no start correction is needed for the deflection.
//!
//! Theory: `docs/theory.md` (T47, T48).

use crate::disc::history::{History, affordable, least_steps};
use crate::disc::striker::{StrikerMotion, starting_roots};
use crate::error::MarchError;
use crate::growing::waves::GrowingContact;
use crate::numeric::cubic::force_root;
use std::ops::Range;

/// Cells in which the force's curvature and the radius's change are followed more finely.
const SPLITS: [usize; 3] = [4, 2, 2];

/// Products that a cell of the memory takes as long as: its weight is two relaxations, at the radius of its moment.
///
/// `tests/beyond.rs` (`a_step_too_fine_is_refused_before_the_march`) fails where it is too small.
const CELL: usize = 64;

/// Iterations of a step at most; each gains two digits or more.
const ITERATIONS: usize = 30;

/// Marches with a fixed step (collision units).
///
/// # Errors
/// [`MarchError::TooLong`] when the work is out of bounds.
pub fn march_growing(contact: &GrowingContact<'_>, step: f64) -> Result<History, MarchError> {
    let memory = contact.waves.memory * contact.wave_time;
    let cells = (memory / step).min(1e9) as usize * CELL;
    affordable(least_steps(step), cells, memory)?;
    let mut striker = StrikerMotion::new(step, 0.0, &starting_roots(step, 0.0));
    let inertia = striker.newest_weight();
    let mut history = History::at_touch(step);
    history.start = striker.missed[0];
    history.end_layer = Some(end_layer(contact));
    let mut indentation = vec![0.0_f64];
    let mut widest = 0.0_f64;
    let mut free_since = 0.0;
    loop {
        let n = history.force.len();
        let free = striker.free_displacement();
        let mut newest = match indentation[..] {
            [.., before, last] => (2.0 * last - before).max(0.0),
            _ => step,
        };
        let mut deflection = 0.0;
        indentation.push(newest);
        // Cells that end before the newest sample are summed once.
        let guess = widest.max(newest.sqrt());
        let (past, _) = relaxing(contact, step, &indentation, guess, FIXED..n);
        for _ in 0..ITERATIONS {
            indentation[n] = newest;
            let (recent, prompt) = relaxing(contact, step, &indentation, guess, 0..FIXED.min(n));
            deflection = -contact.target_share * (past + recent);
            // the part that follows the newest increment is solved for, not iterated
            let stiffness = 1.0 - contact.target_share * prompt;
            let known = free - deflection - contact.target_share * prompt * newest;
            let root = force_root(inertia / stiffness, known / stiffness, newest.sqrt());
            let next = root.map_or(f64::NAN, |y| y * y);
            let change = (next - newest).abs();
            newest = next;
            if change.is_nan() || change <= 1e-12 * newest.max(1e-6) {
                break;
            }
        }
        if !newest.is_finite() {
            return Err(MarchError::Unstable {
                scheme: "growing",
                force: newest,
                steps: n,
            });
        }
        indentation[n] = newest;
        widest = widest.max(newest.sqrt());
        let force = newest * newest.sqrt();
        history.push(force, free - inertia * force, deflection);
        striker.push(force);
        if force > 0.0 {
            free_since = 0.0;
        } else {
            free_since += step;
            if free_since > memory * widest + step && history.last_velocity() <= 0.0 {
                return Ok(history);
            }
        }
        if n.is_multiple_of(256) {
            affordable(n, cells, memory)?;
        }
    }
}

/// Memory in collision times up to which the end of contact is a layer of its own.
const THIN: f64 = 0.4;

/// What happens in the last instants, when the contact is so small that it forgets at once.
///
/// There u ~ v times the time left and the memory shrinks with sqrt(u): everything scales with
/// tau^2 v, and contact ends while the striker is still pressed in by
///
/// ```text
/// d = K tau^2 v^2,     K = 2 phi m f(phi),     m = int t V_p dt,     f = 1 - 0.78 phi + 0.08 phi^2
/// ```
///
/// f is fitted to marches that resolve the layer for phi up to 0.95 and thin layers, 1 for small phi, where u = v t undisturbed gives int V_p(sqrt(x)) dx = 2 m.
fn end_layer(contact: &GrowingContact<'_>) -> [f64; 2] {
    let (phi, tau) = (contact.target_share, contact.wave_time);
    let memory = contact.waves.memory * tau;
    if memory > THIN {
        return [0.0; 2];
    }
    let factor = 1.0 - 0.78 * phi + 0.08 * phi * phi;
    let depth = 2.0 * phi * (contact.waves.moment(2) / 6.0) * factor * tau * tau;
    [depth, memory * memory]
}

/// Share of the half-space up to which the newest cell's curvature is taken from the cells before it.
const PROMPT: f64 = 0.7;

/// First cell from the newest sample in which nothing depends on that sample.
const FIXED: usize = 2;

/// int V_p du over some cells counted back from the newest sample, and the part of it that goes with
/// the newest value.
fn relaxing(
    contact: &GrowingContact<'_>,
    step: f64,
    indentation: &[f64],
    widest: f64,
    cells: Range<usize>,
) -> (f64, f64) {
    let n = indentation.len() - 1;
    let memory = contact.waves.memory * contact.wave_time;
    let mut sum = 0.0;
    let mut prompt = 0.0;
    for j in cells {
        let near = j as f64 * step;
        if near >= memory * widest {
            break;
        }
        let (older, newer) = (indentation[n - j - 1], indentation[n - j]);
        let radius = older.max(newer).sqrt();
        let live = (memory * radius - near).min(step);
        if live <= 0.0 {
            continue;
        }
        let slope = (newer - older) / step;
        let curvature = if j == 0 && contact.target_share > PROMPT && memory * widest > step {
            // Extrapolated curvature under a resolved memory is unstable where phi is near 1.
            0.0
        } else {
            curvature(indentation, n - j) / (step * step)
        };
        let parts = SPLITS.get(j).copied().unwrap_or(1);
        for part in 0..parts {
            let from = near + live * part as f64 / parts as f64;
            let to = near + live * (part + 1) as f64 / parts as f64;
            // place in the cell, from its older end
            let s = step - (0.5 * (from + to) - near);
            let u = older + slope * s + 0.5 * curvature * s * (s - step);
            if u <= 0.0 {
                continue;
            }
            let time = contact.wave_time * u.sqrt();
            let [until, before] = [to, from].map(|t| contact.waves.relaxation(t / time)[1]);
            let weight = time * (until - before);
            sum += weight * (slope + curvature * (s - 0.5 * step));
            if j == 0 {
                prompt += weight / step;
            }
        }
    }
    (sum, prompt)
}

/// Second difference of the samples over the cell that ends at `end`, from both sides where known.
fn curvature(samples: &[f64], end: usize) -> f64 {
    let second = |i: usize| {
        (i >= 1 && i + 1 < samples.len() && samples[i] > 0.0)
            .then(|| samples[i + 1] - 2.0 * samples[i] + samples[i - 1])
    };
    let (before, after) = (end.checked_sub(1).and_then(second), second(end));
    let sides = [before.or(after), after.or(before)];
    0.5 * sides.into_iter().flatten().sum::<f64>()
}
