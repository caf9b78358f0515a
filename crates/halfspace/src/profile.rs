//! Load profiles: distribution of the force over the disc.
//!
//! Theory: `docs/theory.md` (T4).

/// Distribution of a unit force over the surface, with its Hankel transform Z_H(k).
///
/// Each transform is an integral over chords sigma of the disc, Z_H(k) = int h(sigma) e^{i k sigma} dsigma,
/// and everything in this crate follows from the chord function h.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Profile {
    /// Hertz contact: Z = 3/(2 pi) sqrt(1 - r^2), Z_H = 3/(2 pi) (sin k - k cos k)/k^3, h = 3/(8 pi) (1 - sigma^2).
    Hertz,
    /// Rigid flat punch: Z = 1/(2 pi sqrt(1 - r^2)), Z_H = sin k/(2 pi k), h = 1/(4 pi).
    Punch,
    /// Point force, the limit of a small disc: Z_H = 1/(2 pi), h = delta(sigma)/(2 pi).
    /// The unit of length is then arbitrary.
    Point,
}

impl Profile {
    /// Radius of the loaded disc: 1, or 0 for the point force.
    pub fn radius(self) -> f64 {
        match self {
            Self::Hertz | Self::Punch => 1.0,
            Self::Point => 0.0,
        }
    }

    /// Pressure of a unit force at radius r, in P/r0^2.
    ///
    /// Zero outside the disc; infinite at the edge of a punch and under a point force; NaN for NaN.
    pub fn pressure(self, r: f64) -> f64 {
        use std::f64::consts::PI;
        let inside = (1.0 - r) * (1.0 + r);
        if inside.is_nan() {
            return inside;
        }
        match self {
            Self::Hertz => 1.5 / PI * inside.max(0.0).sqrt(),
            Self::Punch if inside >= 0.0 => 0.5 / (PI * inside.sqrt()),
            Self::Point if r == 0.0 => f64::INFINITY,
            Self::Punch | Self::Point => 0.0,
        }
    }
}
