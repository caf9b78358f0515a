//! Wave speeds of the half-space, and when and where waves arrive.

use contact::HalfSpace;
use halfspace::{DomainError, Medium};

/// Speeds of the waves of a half-space in m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Speeds {
    /// Longitudinal wave.
    pub(crate) p: f64,
    /// Shear wave.
    pub(crate) s: f64,
    /// Rayleigh wave.
    pub(crate) rayleigh: f64,
}

impl Speeds {
    pub(crate) fn of(target: &HalfSpace) -> Result<Self, DomainError> {
        let medium = Medium::new(target.material().poisson_ratio)?;
        let p = target.longitudinal_speed_m_s();
        Ok(Self {
            p,
            s: p * medium.kappa(),
            rayleigh: p * medium.rayleigh_speed(),
        })
    }

    /// Whether a Rayleigh wave of its own arrives at a distance from the axis and a depth.
    ///
    /// It grows out of the shear wave where that meets the surface beyond
    ///
    /// ```text
    /// r = z cR/sqrt(c2^2 - cR^2)
    /// ```
    ///
    /// (Nakano 1925; Aki and Richards, Quantitative Seismology, section 6.3); nearer to the axis there is none.
    pub(crate) fn has_rayleigh(&self, r_m: f64, z_m: f64, disc_radius_m: f64) -> bool {
        let cotangent = self.rayleigh / (self.s * self.s - self.rayleigh * self.rayleigh).sqrt();
        r_m > disc_radius_m && r_m - disc_radius_m > z_m * cotangent
    }

    /// Time in s from the load's start to the first echo from the lower face of a plate of a thickness.
    ///
    /// The longitudinal wave goes down and up again: a straight path from the load's mirror image.
    pub(crate) fn first_echo_s(
        &self,
        r_m: f64,
        z_m: f64,
        disc_radius_m: f64,
        thickness_m: f64,
    ) -> f64 {
        (r_m - disc_radius_m)
            .max(0.0)
            .hypot(2.0 * thickness_m - z_m)
            / self.p
    }
}

/// When a force begins: the last time before it is not zero any more.
pub(crate) fn onset_s(time_s: &[f64], force_n: &[f64]) -> f64 {
    let first = force_n.iter().position(|&force| force != 0.0);
    first.map_or(0.0, |i| time_s[i.saturating_sub(1)])
}

/// When a force ends: the first time from which on it is zero; the last time where it is not.
pub(crate) fn end_s(time_s: &[f64], force_n: &[f64]) -> f64 {
    let last = force_n.iter().rposition(|&force| force != 0.0).unwrap_or(0);
    time_s[(last + 1).min(time_s.len() - 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rayleigh_waves_arrive_along_the_surface_only() {
        let speeds = Speeds {
            p: 5900.0,
            s: 3150.0,
            rayleigh: 2920.0,
        };
        assert!(speeds.has_rayleigh(0.02, 0.0, 1e-4));
        assert!(!speeds.has_rayleigh(0.0, 0.05, 1e-4) && !speeds.has_rayleigh(0.02, 0.02, 1e-4));
        assert!(!speeds.has_rayleigh(5e-5, 0.0, 1e-4));
        // straight down and up through 50 mm
        let echo = speeds.first_echo_s(0.0, 0.0, 1e-4, 0.05);
        assert!((echo - 0.1 / 5900.0).abs() < 1e-15);
    }

    #[test]
    fn a_force_begins_where_it_leaves_zero() {
        let time = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        let force = [0.0, 0.0, 3.0, 1.0, 0.0, 0.0];
        assert_eq!((onset_s(&time, &force), end_s(&time, &force)), (1.0, 4.0));
        assert_eq!(onset_s(&time, &[2.0; 6]), 0.0);
        assert_eq!(end_s(&time, &[2.0; 6]), 5.0);
    }
}
