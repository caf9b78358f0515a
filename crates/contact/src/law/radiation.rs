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

use super::hertz;
use super::quasi_static::expected_contact_time;
use crate::force_balance::force_root;
use crate::march::history::History;
use crate::summary::{EndOfContact, Summary};
use crate::units::INVERSE_MASS;

/// int p'^2 dt of Hertz's pulse in collision units times 5/2: 1 - e^2 over c.
pub const LOSS: f64 = 3.979_536_606;

/// First-order coefficients of the lag: peak force, its time, duration, largest displacement; docs/theory.md (T50).
const PEAK_FORCE: f64 = -0.3 * LOSS;
const PEAK_FORCE_TIME: f64 = -2.087_13;
const CONTACT_TIME: f64 = 0.585_644;
const PEAK_DISPLACEMENT: f64 = -0.2 * LOSS;

/// Largest lag for which a first-order loss makes sense: half of the energy.
pub const LARGEST_LAG: f64 = 0.5 / LOSS;

/// Results of an impact with lag c (collision units) to first order in c, c in [0, [`LARGEST_LAG`]].
///
/// The largest deflection is c times the largest slope of Hertz's pulse.
#[must_use]
pub fn radiation(lag: f64) -> Summary {
    let loss = LOSS * lag;
    let restitution = (1.0 - loss).max(0.0).sqrt();
    Summary {
        peak_force: 1.0 + PEAK_FORCE * lag,
        peak_force_time: 0.5 * hertz::CONTACT_TIME + PEAK_FORCE_TIME * lag,
        contact_time: hertz::CONTACT_TIME + CONTACT_TIME * lag,
        restitution,
        loss,
        peak_displacement: 1.0 + PEAK_DISPLACEMENT * lag,
        // -w' has its largest value in the rebound: max of (3/2) sqrt(d (1 - d^(5/2)))
        peak_deflection: lag * STEEPEST,
        impulse: (1.0 + restitution) / INVERSE_MASS,
        contacts: 1,
        end: EndOfContact::Smooth,
    }
}

/// max (3/2) sqrt(d (1 - d^(5/2))), at d^(5/2) = 2/7.
const STEEPEST: f64 = 0.986_765;

/// Samples of d'' = -(5/4) p, p = max(0, F + c F'^2 d'), by the classical Runge-Kutta rule.
///
/// F is the force of Hertz's spring in series with a linear one of compliance `coupling`; without it
/// this is p = d^(3/2) + (9/4) c d d'.
#[must_use]
pub fn march_radiation(coupling: f64, lag: f64, step: f64) -> History {
    let force = |d: f64, v: f64| {
        let y = force_root(coupling, d, 0.0).unwrap_or(0.0);
        let stiffness = 3.0 * y / (2.0 + 3.0 * coupling * y);
        (y * y * y + lag * stiffness * stiffness * v).max(0.0)
    };
    let longest = 2.0 * expected_contact_time(coupling);
    let mut history = History::at_touch(step, 256);
    history.velocity.push(1.0);
    let (mut d, mut v) = (0.0, 1.0);
    // Twice the contact time at most: the lag prolongs the contact by a fraction of itself.
    while d >= 0.0 && history.force.len() as f64 * step < longest {
        let (d1, v1) = (v, -INVERSE_MASS * force(d, v));
        let half = |a: f64, b: f64| (d + 0.5 * step * a, v + 0.5 * step * b);
        let (x, y) = half(d1, v1);
        let (d2, v2) = (y, -INVERSE_MASS * force(x, y));
        let (x, y) = half(d2, v2);
        let (d3, v3) = (y, -INVERSE_MASS * force(x, y));
        let (x, y) = (d + step * d3, v + step * v3);
        let (d4, v4) = (y, -INVERSE_MASS * force(x, y));
        d += step * (d1 + 2.0 * (d2 + d3) + d4) / 6.0;
        v += step * (v1 + 2.0 * (v2 + v3) + v4) / 6.0;
        let p = if d > 0.0 { force(d, v) } else { 0.0 };
        history.push(p, d, if p > 0.0 { d - p.cbrt().powi(2) } else { 0.0 });
        history.velocity.push(v);
    }
    history
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::quasi_static::{quasi_static, quasi_static_radiation};

    #[test]
    fn the_closed_form_is_the_limit_of_the_damped_contact() {
        for lag in [1e-3, 3e-3] {
            let law = radiation(lag);
            let history = march_radiation(0.0, lag, 1e-3);
            let (place, peak) = crate::quadrature::peak(&history.force);
            assert!((peak - law.peak_force).abs() < 7.0 * lag * lag);
            assert!((place * 1e-3 - law.peak_force_time).abs() < 7.0 * lag * lag);
            assert!((-history.last_velocity() - law.restitution).abs() < 7.0 * lag * lag);
        }
    }

    #[test]
    fn the_first_order_law_of_two_springs_is_the_limit_of_the_damped_contact() {
        for coupling in [0.1, 1.0, 4.0] {
            for lag in [1e-3, 3e-3] {
                let law = quasi_static_radiation(coupling, lag);
                let history = march_radiation(coupling, lag, 1e-3);
                let (place, peak) = crate::quadrature::peak(&history.force);
                assert!((peak - law.peak_force).abs() < 7.0 * lag * lag);
                assert!((place * 1e-3 - law.peak_force_time).abs() < 7.0 * lag * lag);
                assert!((-history.last_velocity() - law.restitution).abs() < 7.0 * lag * lag);
            }
        }
    }

    #[test]
    fn without_coupling_the_lag_is_that_of_the_radiation_law() {
        let lag = 1e-5;
        let (found, law) = (quasi_static_radiation(0.0, lag), radiation(lag));
        assert!((quasi_static(0.0).loss_per_lag - LOSS).abs() < 1e-7);
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
