//! Hertz's spring in series with the static spring of the disc: the `full` share without memory.
//!
//! ```text
//! d = g(p) = p^(2/3) + sigma p,     energy E(p) = (2/5) p^(5/3) + (sigma/2) p^2 = (2/5) e at the turning point
//! contact time = 2 int dd/v,  v^2 = e - (5/2) E,      1 - e^2 = (5/2) c int p'^2 dt for a lag c
//! ```
//!
//! With a lag w = sigma p - c p' the law becomes d = g(p) - c p'. To first order in c its energy
//! sinks evenly about the turning point, so that the peaks and the duration are those of an impact with the
//! mean of the energies before and after.
//! Collision units; sigma = 0 is Hertz's closed form.
//!
//! Theory: `docs/theory.md` (T39, T50).

use crate::numeric::quadrature::{GAUSS_4, GAUSS_8, find_root};
use crate::summary::Summary;

/// Solves the impact on two springs in series for `coupling` = sigma >= 0: its results without waves, accurate to 1e-9, and
/// (5/2) int p'^2 dt to 2e-6, the loss 1 - e^2 that a lag of one would cause to first order.
pub fn quasi_static(coupling: f64) -> (Summary, f64) {
    at_energy(coupling, 1.0)
}

/// Its largest force alone.
pub(crate) fn largest_force(coupling: f64) -> f64 {
    Springs::still(coupling).top().powi(3)
}

/// The results with a fraction `energy` in (0, 1] of the kinetic energy.
fn at_energy(coupling: f64, energy: f64) -> (Summary, f64) {
    let spring = Springs { coupling, energy };
    let top = spring.top();
    let (mut time, mut dissipation) = (0.0, 0.0);
    for panel in 0..2 {
        for (node, weight) in GAUSS_8 {
            let (y, dt) = spring.passing(top, 0.5 * (f64::from(panel) + node), 0.5 * weight);
            let slope = spring.velocity(y) * spring.stiffness(y);
            time += dt;
            dissipation += slope * slope * dt;
        }
    }
    let summary = Summary {
        peak_force: top.powi(3),
        peak_force_time: time,
        contact_time: 2.0 * time,
        peak_displacement: top * top * (1.0 + coupling * top),
        peak_deflection: coupling * top.powi(3),
        ..Summary::rebound(energy.sqrt())
    };
    (summary, 5.0 * dissipation)
}

/// Results with a lag c to first order; without coupling this is the radiation law.
///
/// `lag` times the loss per lag must be in [0, 1).
pub fn quasi_static_radiation(coupling: f64, lag: f64) -> Summary {
    let (still, loss_per_lag) = quasi_static(coupling);
    let loss = loss_per_lag * lag;
    let (mean, _) = at_energy(coupling, 1.0 - 0.5 * loss);
    let departed = Summary::rebound((1.0 - loss).max(0.0).sqrt());
    Summary {
        peak_force_time: still.peak_force_time + lag * peak_time_per_lag(coupling),
        restitution: departed.restitution,
        impulse: departed.impulse,
        loss,
        ..mean
    }
}

/// First-order change of the time of the largest force.
///
/// ```text
/// p = F(d) + c F'^2 v,   (5/4) U(d) = e sin^2 theta,  v = sqrt(2 e) cos theta
/// theta' = w + c (5/4) F'^2 sin theta cos theta,   w = (5/4) F/(sqrt(2 e) sin theta),   e' = -c (5/4) F'^2 v^2
/// ```
///
/// The turning point is at theta = pi/2; the force leads it by c F'.
fn peak_time_per_lag(coupling: f64) -> f64 {
    const CELLS: i32 = 200;
    let spring = Springs::still(coupling);
    let top = spring.top();
    let (mut spent, mut shift) = (0.0, 0.0);
    for i in (0..CELLS).rev() {
        let x = (f64::from(i) + 0.5) / f64::from(CELLS);
        let (y, dt) = spring.passing(top, x, 1.0 / f64::from(CELLS));
        let v = spring.velocity(y);
        let (force, stiffness) = (y.powi(3), spring.stiffness(y));
        let sine_squared = (1.0 - v * v).max(0.0);
        let half = 1.25 * stiffness * stiffness * v * v * dt;
        spent += half;
        let growth = 0.4 * stiffness * sine_squared / (force * force) - 0.5;
        shift -= dt * (stiffness * stiffness * sine_squared * v / force - spent * growth);
        spent += half;
    }
    shift - spring.stiffness(top)
}

/// Two springs in series, in y = p^(1/3).
struct Springs {
    coupling: f64,
    energy: f64,
}

impl Springs {
    /// With all of the kinetic energy.
    fn still(coupling: f64) -> Self {
        let energy = 1.0;
        Self { coupling, energy }
    }

    /// y at the turning point.
    fn top(&self) -> f64 {
        let missing = |y: f64| self.stored(y) - 0.4 * self.energy;
        let slope = |y: f64| y.powi(4) * (2.0 + 3.0 * self.coupling * y);
        find_root(|y| [missing(y), slope(y)], 0.0, 1.0)
    }

    /// The place y = top (1 - x^2), where velocity and the rate of d both vanish as x, and the time over `width` of x.
    fn passing(&self, top: f64, x: f64, width: f64) -> (f64, f64) {
        let y = top * (1.0 - x * x);
        let v = self.velocity(y);
        let time = match v > 0.0 {
            true => width * self.rate(y) * 2.0 * top * x / v,
            false => 0.0,
        };
        (y, time)
    }

    fn stored(&self, y: f64) -> f64 {
        y.powi(5) * (0.4 + 0.5 * self.coupling * y)
    }

    fn velocity(&self, y: f64) -> f64 {
        (self.energy - 2.5 * self.stored(y)).max(0.0).sqrt()
    }

    /// dd/dy.
    fn rate(&self, y: f64) -> f64 {
        y * (2.0 + 3.0 * self.coupling * y)
    }

    /// dp/dd.
    fn stiffness(&self, y: f64) -> f64 {
        3.0 * y / (2.0 + 3.0 * self.coupling * y)
    }
}

/// How long a quasi-static contact with this coupling lasts, in collision units, to 3e-4; any coupling >= 0.
pub fn expected_contact_time(coupling: f64) -> f64 {
    let spring = Springs::still(coupling);
    let top = spring.top();
    let times = GAUSS_4.map(|(x, weight)| spring.passing(top, x, weight).1);
    2.0 * times.iter().sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::hertz;

    #[test]
    fn without_coupling_it_is_hertz() {
        let (found, loss_per_lag) = quasi_static(0.0);
        assert!((found.peak_force - 1.0).abs() < 1e-14);
        assert!((found.contact_time - hertz::CONTACT_TIME).abs() < 1e-9);
        assert!((loss_per_lag - 3.979_536_606).abs() < 1e-7, "{found:?}");
    }

    #[test]
    fn with_coupling_it_is_as_good_as_promised() {
        // the midpoint rule in an angle, y = top sin, extrapolated
        for coupling in [1e-3, 0.03, 0.3, 1.0, 3.0, 10.0, 30.0, 1e3] {
            let (found, loss_per_lag) = quasi_static(coupling);
            // (5/2) (2/5 y^5 + sigma/2 y^6) = 1 at the top, by bisection
            let stored = |y: f64| y.powi(5) + 1.25 * coupling * y.powi(6);
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if stored(middle) < 1.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let integrals = |midpoints: i32| {
                let (mut time, mut dissipation) = (0.0, 0.0);
                let step = 0.5 * std::f64::consts::PI / f64::from(midpoints);
                for i in 0..midpoints {
                    let angle = step * (f64::from(i) + 0.5);
                    let q = angle.sin();
                    let y = low * q;
                    // v^2 = 1 - stored, divided by 1 - q^2 term by term: no digits are lost at the top
                    let rest = |power: i32| {
                        let all: f64 = (0..power).map(|k| q.powi(k)).sum();
                        all / (1.0 + q)
                    };
                    let squared = low.powi(5) * rest(5) + 1.25 * coupling * low.powi(6) * rest(6);
                    let v = squared.sqrt() * angle.cos();
                    let rate = 2.0 * y + 3.0 * coupling * y * y;
                    let dt = step * low * rate / squared.sqrt();
                    let slope = 3.0 * y * y * v / rate;
                    time += 2.0 * dt;
                    dissipation += 5.0 * slope * slope * dt;
                }
                [time, dissipation]
            };
            let (coarse, fine) = (integrals(2000), integrals(4000));
            let [time, dissipation] = [0, 1].map(|i| (4.0 * fine[i] - coarse[i]) / 3.0);
            for (value, exact, allowed) in [
                (found.peak_force, low.powi(3), 1e-9),
                (found.contact_time, time, 1e-9),
                (loss_per_lag, dissipation, 2e-6),
            ] {
                let error = (value / exact - 1.0).abs();
                assert!(error < allowed, "coupling {coupling}: {error:e}");
            }
        }
    }

    #[test]
    fn the_expected_contact_time_is_good_to_3e_4() {
        for coupling in [0.0, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e6] {
            let exact = quasi_static(coupling).0.contact_time;
            assert!((expected_contact_time(coupling) / exact - 1.0).abs() < 3e-4);
        }
    }

    #[test]
    fn with_a_soft_half_space_it_is_a_linear_oscillator() {
        // v' = -(5/4) d/sigma: half a period is pi sqrt(sigma/1.25)
        let sigma = 1e6_f64;
        let (found, loss_per_lag) = quasi_static(sigma);
        let period = std::f64::consts::PI * (sigma / 1.25).sqrt();
        assert!(
            (found.contact_time / period - 1.0).abs() < 0.02,
            "{found:?}"
        );
        // with a dashpot c p' its loss is (5/2) c int p'^2 = pi c/(2 sigma^(3/2)) sqrt(5)
        let loss = std::f64::consts::PI * 1.25_f64.sqrt() / sigma.powf(1.5);
        assert!((loss_per_lag / loss - 1.0).abs() < 0.02, "{found:?}");
    }
}
