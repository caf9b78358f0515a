//! First-order radiated loss: the cheapest model with waves.
//!
//! A half-space that is slow to follow lags by w = -c dp/dt, whatever the shape of the load, with
//!
//! ```text
//! c = J/(mu c2) in collision units,     J = S0 int (1 - W) dT
//! 1 - e^2 = (5/2) c int p'^2 dt = 3.80583978 (J/(mu c2)) K^(6/5) m^(-1/5) V0^(3/5)
//! ```
//!
//! To first order in c the striker meets the force p = d^(3/2) + (9/4) c d d', the well-posed form
//! of the same lag.
//! The peaks and the duration are the first-order solution of that equation.
//!
//! Theory: `docs/theory.md` (T49 to T51, T53).

use crate::law::hertz;
use crate::summary::Summary;

/// int p'^2 dt of Hertz's pulse in collision units times 5/2: 1 - e^2 over c.
pub const LOSS: f64 = 3.979_536_606;

/// First-order coefficients of the lag: peak force, its time, duration, largest displacement; docs/theory.md (T50).
const PEAK_FORCE: f64 = -0.3 * LOSS;
const PEAK_FORCE_TIME: f64 = -2.087_13;
const CONTACT_TIME: f64 = 0.585_644;
const PEAK_DISPLACEMENT: f64 = -0.2 * LOSS;

/// Largest loss for which a first-order loss makes sense: half of the energy.
pub const MOST_LOSS: f64 = 0.5;

/// Results of an impact with lag c (collision units) to first order in c, [`LOSS`] c in [0, [`MOST_LOSS`]].
///
/// The largest deflection is c times the largest slope of Hertz's pulse.
pub fn radiation(lag: f64) -> Summary {
    let loss = LOSS * lag;
    let restitution = (1.0 - loss).max(0.0).sqrt();
    Summary {
        peak_force: 1.0 + PEAK_FORCE * lag,
        peak_force_time: 0.5 * hertz::CONTACT_TIME + PEAK_FORCE_TIME * lag,
        contact_time: hertz::CONTACT_TIME + CONTACT_TIME * lag,
        loss,
        peak_displacement: 1.0 + PEAK_DISPLACEMENT * lag,
        // -w' has its largest value in the rebound: max of (3/2) sqrt(d (1 - d^(5/2)))
        peak_deflection: lag * STEEPEST,
        ..Summary::rebound(restitution)
    }
}

/// max (3/2) sqrt(d (1 - d^(5/2))), at d^(5/2) = 2/7.
const STEEPEST: f64 = 0.986_765;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::quasi_static::{quasi_static, quasi_static_radiation};

    #[test]
    fn without_coupling_the_lag_is_that_of_the_radiation_law() {
        let lag = 1e-5;
        let (found, law) = (quasi_static_radiation(0.0, lag), radiation(lag));
        assert!((quasi_static(0.0).1 - LOSS).abs() < 1e-7);
        for (a, b) in [
            (found.peak_force, law.peak_force),
            (found.contact_time, law.contact_time),
            (found.peak_displacement, law.peak_displacement),
            (found.loss, law.loss),
            (found.peak_force_time, law.peak_force_time),
        ] {
            // the law's own coefficients are first order
            assert!((a - b).abs() < 1e-3 * lag, "{found:?} {law:?}");
        }
    }

    #[test]
    fn the_steepest_place_of_hertz_pulse() {
        let d = (2.0_f64 / 7.0).powf(0.4);
        assert!((1.5 * (d * 5.0 / 7.0).sqrt() - STEEPEST).abs() < 1e-6);
    }
}
