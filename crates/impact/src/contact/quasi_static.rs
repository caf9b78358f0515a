//! Hertz's spring in series with the static compliance of the disc: the `full` share without waves.
//!
//! ```text
//! d = p^(2/3) + sigma p,     energy E(p) = (2/5) p^(5/3) + (sigma/2) p^2 = 2/5 at the turning point
//! contact time = 2 int dd/v,  v^2 = 1 - (5/2) E
//! ```
//!
//! Collision units; sigma = 0 is Hertz's closed form.

use crate::quadrature::{GAUSS_8, find_root};

/// Largest force, its striker displacement and the duration of a contact without waves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuasiStatic {
    /// Largest force.
    pub peak_force: f64,
    /// Largest displacement of the striker.
    pub peak_displacement: f64,
    /// Duration.
    pub contact_time: f64,
}

/// Solves the impact on two springs in series for `coupling` = sigma >= 0; accurate to 1e-9.
#[must_use]
pub fn quasi_static(coupling: f64) -> QuasiStatic {
    let sigma = coupling;
    // g(y) = E - 2/5 with y = p^(1/3)
    let energy = |y: f64| {
        (
            y.powi(5) * (0.4 + 0.5 * sigma * y) - 0.4,
            y.powi(4) * (2.0 + 3.0 * sigma * y),
        )
    };
    let top = find_root(energy, 0.0, 1.0);
    // y = top (1 - x^2): both v and the rate of d vanish as x.
    let panels = 4;
    let mut time = 0.0;
    for panel in 0..panels {
        for (node, weight) in GAUSS_8 {
            let x = (f64::from(panel) + node) / f64::from(panels);
            let y = top * (1.0 - x * x);
            let rate = y * (2.0 + 3.0 * sigma * y) * 2.0 * top * x;
            let v = (-2.5 * energy(y).0).max(0.0).sqrt();
            if v > 0.0 {
                time += weight / f64::from(panels) * rate / v;
            }
        }
    }
    QuasiStatic {
        peak_force: top.powi(3),
        peak_displacement: top * top * (1.0 + sigma * top),
        contact_time: 2.0 * time,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::hertz;

    #[test]
    fn without_coupling_it_is_hertz() {
        let found = quasi_static(0.0);
        assert!((found.peak_force - 1.0).abs() < 1e-14);
        assert!((found.contact_time - hertz::CONTACT_TIME).abs() < 1e-9);
    }

    #[test]
    fn with_a_soft_half_space_it_is_a_linear_oscillator() {
        // v' = -(5/4) d/sigma: half a period is pi sqrt(sigma/1.25)
        let sigma = 1e6_f64;
        let found = quasi_static(sigma);
        let period = std::f64::consts::PI * (sigma / 1.25).sqrt();
        assert!(
            (found.contact_time / period - 1.0).abs() < 0.02,
            "{found:?}"
        );
    }
}
