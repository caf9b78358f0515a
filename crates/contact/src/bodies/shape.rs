//! Bodies whose mass and tip follow from a few lengths.

use std::f64::consts::PI;

/// A body of revolution that strikes with its tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// A ball.
    Ball {
        /// Diameter in m.
        diameter_m: f64,
    },
    /// A cylinder whose striking end is a spherical cap as wide as itself.
    Rod {
        /// Length in m, the cap included.
        length_m: f64,
        /// Diameter in m.
        diameter_m: f64,
        /// Radius of curvature of the cap in m, at least half of the diameter; that half, a hemisphere, where none is
        /// given.
        tip_radius_m: Option<f64>,
    },
}

impl Shape {
    /// Radius of curvature in m of the surface that strikes.
    pub fn tip_radius_m(&self) -> f64 {
        match *self {
            Self::Ball { diameter_m } => 0.5 * diameter_m,
            Self::Rod {
                diameter_m,
                tip_radius_m,
                ..
            } => tip_radius_m.unwrap_or(0.5 * diameter_m),
        }
    }

    /// Length in m of a rod.
    pub fn length_m(&self) -> Option<f64> {
        match *self {
            Self::Ball { .. } => None,
            Self::Rod { length_m, .. } => Some(length_m),
        }
    }

    /// Height in m of a rod's cap; zero for a ball.
    ///
    /// ```text
    /// h = a^2/(R + sqrt(R^2 - a^2)),   a = d/2
    /// ```
    ///
    /// NaN for a tip's radius R below half of the diameter d: no cap is as wide as the rod then.
    pub(crate) fn cap_m(&self) -> f64 {
        match *self {
            Self::Ball { .. } => 0.0,
            Self::Rod { diameter_m, .. } => {
                let (a, tip) = (0.5 * diameter_m, self.tip_radius_m());
                a * a / (tip + ((tip - a) * (tip + a)).sqrt())
            }
        }
    }

    /// Volume in m^3.
    ///
    /// ```text
    /// ball  pi d^3/6
    /// rod   pi a^2 (L - h) + pi h^2 (R - h/3),   a = d/2
    /// ```
    pub(crate) fn volume_m3(&self) -> f64 {
        match *self {
            Self::Ball { diameter_m } => PI / 6.0 * diameter_m.powi(3),
            Self::Rod {
                length_m,
                diameter_m,
                ..
            } => {
                let (a, cap) = (0.5 * diameter_m, self.cap_m());
                PI * a * a * (length_m - cap) + PI * cap * cap * (self.tip_radius_m() - cap / 3.0)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volumes_are_those_of_textbooks() {
        let close = |found: f64, wanted: f64| assert!((found / wanted - 1.0).abs() < 1e-14);
        close(Shape::Ball { diameter_m: 2.0 }.volume_m3(), 4.0 / 3.0 * PI);
        let rod = |length_m, tip_radius_m| Shape::Rod {
            length_m,
            diameter_m: 2.0,
            tip_radius_m,
        };
        // a hemisphere on a cylinder of length 4
        close(rod(5.0, None).volume_m3(), 4.0 * PI + 2.0 / 3.0 * PI);
        // a nearly flat end
        let flat = rod(5.0, Some(1e9));
        assert!((flat.volume_m3() / (5.0 * PI) - 1.0).abs() < 1e-9);
        assert!((flat.cap_m() / 0.5e-9 - 1.0).abs() < 1e-12);
        assert!(rod(5.0, Some(0.9)).cap_m().is_nan());
    }
}
