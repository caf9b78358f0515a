//! When waves from the loaded disc arrive at a place of a block, and when the first echo does.

use crate::bodies::HalfSpace;
use halfspace::{DomainError, Echo, Medium, Rays};

/// Speeds of the waves of a half-space in m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveSpeeds {
    /// Longitudinal wave.
    pub p: f64,
    /// Shear wave.
    pub s: f64,
    /// Rayleigh wave.
    pub rayleigh: f64,
}

impl WaveSpeeds {
    /// Of a half-space.
    ///
    /// # Errors
    /// [`DomainError`] for a Poisson's ratio outside the physics.
    pub fn of(half_space: &HalfSpace) -> Result<Self, DomainError> {
        let medium = Medium::new(half_space.material().poisson_ratio)?;
        Ok(Self::new(&medium, half_space.longitudinal_speed_m_s()))
    }

    /// Of a medium with a longitudinal speed in m/s.
    pub fn new(medium: &Medium, longitudinal_m_s: f64) -> Self {
        Self {
            p: longitudinal_m_s,
            s: longitudinal_m_s * medium.kappa(),
            rayleigh: longitudinal_m_s * medium.rayleigh_speed(),
        }
    }

    /// First arrivals in s after the force begins of the P, S and Rayleigh wave at a distance from the axis and a depth in m.
    ///
    /// From the nearest point of a disc of a radius in m: straight above inside it, else its edge.
    /// A Rayleigh wave of its own grows out of the shear wave where that meets the surface beyond
    ///
    /// ```text
    /// r = z cR/sqrt(c2^2 - cR^2)
    /// ```
    ///
    /// (Nakano 1925; Aki and Richards, Quantitative Seismology, section 6.3); nearer to the axis there is none, and its arrival
    /// is infinite.
    pub fn arrivals_s(&self, r_m: f64, z_m: f64, disc_radius_m: f64) -> [f64; 3] {
        let aside_m = (r_m - disc_radius_m).max(0.0);
        let cotangent = self.rayleigh / (self.s * self.s - self.rayleigh * self.rayleigh).sqrt();
        let rayleigh = if r_m > disc_radius_m && r_m - disc_radius_m > z_m * cotangent {
            aside_m / self.rayleigh
        } else {
            f64::INFINITY
        };
        let path_m = aside_m.hypot(z_m);
        [path_m / self.p, path_m / self.s, rayleigh]
    }

    /// Time in s from the force's start until which fields are those of the block: to the first echo from its faces that they do
    /// not contain; none where no face is known.
    ///
    /// The longitudinal wave runs down and up once more than the fields have it, n legs in a plate and none in a half-space,
    /// or to the nearest side and back: straight paths to the mirror images of the place behind the faces at the depths 0 and
    /// h, and the side at the distance b from the axis,
    ///
    /// ```text
    /// sqrt(max(r - a, 0)^2 + d^2)/c1,   d = (n + 2) h - z for even n, (n + 1) h + z for odd
    /// sqrt((2 b - r - a)^2 + z^2)/c1
    /// ```
    ///
    /// and in a plate at most as long as its echoes can be computed. For a place inside the block.
    pub fn first_echo_s(
        &self,
        block: &HalfSpace,
        [r_m, z_m]: [f64; 2],
        disc_radius_m: f64,
    ) -> Option<f64> {
        let aside_m = (r_m - disc_radius_m).max(0.0);
        let plate = block.echoing();
        let legs = plate.map_or(0, |plate| plate.legs);
        let below = block.thickness_m.map(|h| {
            let last_m = if legs.is_multiple_of(2) { h - z_m } else { z_m };
            aside_m.hypot((legs + 1) as f64 * h + last_m)
        });
        let side = |b: f64| (2.0 * b - r_m - disc_radius_m).max(0.0).hypot(z_m);
        let paths_m = below.into_iter().chain(block.radius_m.map(side));
        let echoes_s = paths_m.map(|path_m| path_m / self.p);
        let latest_s = plate.map(|plate| plate.latest_s);
        echoes_s.chain(latest_s).reduce(f64::min)
    }

    /// Names of the waves between the faces of a plate that its fields have at a place, and when the first of each arrives in s
    /// after the force's start, in this order; none for a half-space.
    pub fn echoes_s(
        &self,
        block: &HalfSpace,
        [r_m, z_m]: [f64; 2],
        disc_radius_m: f64,
    ) -> Vec<(String, f64)> {
        let Some(plate) = block.echoing() else {
            return Vec::new();
        };
        let rays = Rays {
            thickness: plate.thickness_m,
            legs: plate.legs,
            shear: (self.p / self.s).powi(2),
        };
        let aside_m = (r_m - disc_radius_m).max(0.0);
        let found = rays.arrivals(aside_m, z_m);
        let named = |echo: &Echo| (echo.name(), echo.time / self.p);
        found.iter().map(named).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::material::Material;

    const SPEEDS: WaveSpeeds = WaveSpeeds {
        p: 5900.0,
        s: 3150.0,
        rayleigh: 2920.0,
    };

    #[test]
    fn rayleigh_waves_arrive_along_the_surface_only() {
        let has_rayleigh = |r, z, disc| SPEEDS.arrivals_s(r, z, disc)[2].is_finite();
        assert!(has_rayleigh(0.02, 0.0, 1e-4));
        assert!(!has_rayleigh(0.0, 0.05, 1e-4) && !has_rayleigh(0.02, 0.02, 1e-4));
        assert!(!has_rayleigh(5e-5, 0.0, 1e-4));
        let below = SPEEDS.arrivals_s(0.0, 0.05, 1e-4);
        assert_eq!(below, [0.05 / 5900.0, 0.05 / 3150.0, f64::INFINITY]);
        let beside = SPEEDS.arrivals_s(0.0201, 0.0, 1e-4);
        assert!((beside[2] - 0.02 / 2920.0).abs() < 1e-18);
    }

    #[test]
    fn the_first_echo_is_that_of_the_nearest_face() {
        let steel = Material::named("steel").unwrap_or_else(|error| panic!("{error}"));
        let mut block = HalfSpace::new(steel).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(SPEEDS.first_echo_s(&block, [0.0, 0.0], 0.0), None);
        // straight down and up through 50 mm
        block.thickness_m = Some(0.05);
        let echo =
            |block: &HalfSpace, place| SPEEDS.first_echo_s(block, place, 1e-4).unwrap_or(0.0);
        assert!((echo(&block, [0.0, 0.0]) - 0.1 / 5900.0).abs() < 1e-15);
        // a probe on the lower face hears it at once
        assert!((echo(&block, [0.0, 0.05]) - 0.05 / 5900.0).abs() < 1e-15);
        // 2 sqrt(h^2 + (r/2)^2)/c1 of a plate of 101.6 mm at 105 mm, from the axis
        block.thickness_m = Some(0.1016);
        let far = SPEEDS
            .first_echo_s(&block, [0.105, 0.0], 0.0)
            .unwrap_or(0.0);
        assert!((far - 2.0 * 0.1016_f64.hypot(0.0525) / 5900.0).abs() < 1e-15);
        // the side is nearer
        block.radius_m = Some(0.06);
        assert!((echo(&block, [0.05, 0.0]) - (0.07 - 1e-4) / 5900.0).abs() < 1e-15);
        assert!(
            (echo(&block, [0.06, 0.01]) - (0.06_f64 - 1e-4).hypot(0.01) / 5900.0).abs() < 1e-15
        );
    }
}
