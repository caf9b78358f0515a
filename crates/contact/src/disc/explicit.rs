//! The paper's explicit scheme (40)-(44), kept to be measured.
//!
//! ```text
//! d_n = d_{n-1} + v_{n-1} h + a_{n-1} h^2/2                                           (40)
//! w_n = h sum_{m=1}^{n-2} w_delta(t_{n-1} - t_m) p_m + (h/2) w_delta(0) p_{n-1}       (41)
//! p_n = (d_n - w_n)^(3/2),   a_n = -(5/4) p_n,   v_n = v_{n-1} + a_{n-1} h            (42)-(44)
//! ```
//!
//! First order: the velocity lags the force by half a step, which feeds energy into the rebound.

use crate::disc::FixedDisc;
use crate::disc::bounds::{affordable, memory_cells};
use crate::error::MarchError;
use crate::history::History;
use crate::numeric::quadrature::peak;
use crate::summary::Summary;
use crate::units::INVERSE_MASS;
use halfspace::SurfaceResponse;

/// Marches with a fixed step (collision units) until the first separation.
///
/// The impulse kernel is sampled on the step and holds all of the half-space's deflection, so
/// [`FixedDisc::share`] is not looked at: the scheme exists for the full share only.
///
/// # Errors
/// [`MarchError::Unstable`], [`MarchError::TooLong`], [`MarchError::StepTooLong`].
pub fn march_explicit(
    impact: &FixedDisc<'_, SurfaceResponse>,
    step: f64,
) -> Result<(History, Summary), MarchError> {
    let memory = impact.memory();
    let cells = memory_cells(memory, step)?;
    let kernel: Vec<f64> = (0..=cells + 1)
        .map(|i| {
            let t = i as f64 * step / impact.wave_time;
            impact.coupling * impact.response.impulse(t) * step / impact.wave_time
        })
        .collect();
    let mut history = History::at_touch(step);
    history.velocity.push(1.0);
    loop {
        let n = history.force.len();
        let (v, p) = (history.velocity[n - 1], history.force[n - 1]);
        let acceleration = -INVERSE_MASS * p;
        let displacement = history.displacement[n - 1] + step * (v + 0.5 * step * acceleration);
        let oldest = n.saturating_sub(kernel.len()).max(1);
        let mut deflection = 0.5 * kernel[0] * p;
        for m in oldest..n.saturating_sub(1) {
            deflection += kernel[n - 1 - m] * history.force[m];
        }
        let indentation = displacement - deflection;
        let force = indentation.max(0.0).powf(1.5);
        history.push(force, displacement, deflection);
        let velocity = v + step * acceleration;
        history.velocity.push(velocity);
        if indentation <= 0.0 {
            if n < 3 {
                return Err(MarchError::StepTooLong {
                    samples: n,
                    needed: 3,
                });
            }
            let inside = history.displacement[n - 1] - history.deflection[n - 1];
            let fraction = inside / (inside - indentation);
            let (place, peak_force) = peak(&history.force);
            let summary = Summary {
                peak_force,
                peak_force_time: place * step,
                contact_time: (n as f64 - 1.0 + fraction) * step,
                peak_displacement: peak(&history.displacement).1,
                peak_deflection: peak(&history.deflection).1,
                ..Summary::rebound(-(v + fraction * (velocity - v)))
            };
            return Ok((history, summary));
        }
        if force.is_nan() || force >= 1e3 {
            return Err(MarchError::Unstable {
                scheme: "explicit",
                force,
                steps: n,
            });
        }
        if n.is_multiple_of(1024) {
            affordable(n, cells, memory)?;
        }
    }
}
