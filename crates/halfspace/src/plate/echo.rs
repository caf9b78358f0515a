//! When the waves of a plate arrive.

use crate::numeric::bisected;

/// Waves that are longitudinal over some legs between the faces and shear over the others, in any order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Echo {
    /// Legs as a longitudinal wave, then as a shear wave.
    pub legs: [usize; 2],
    /// Whether the last part, from a face to a point between them, is longitudinal; none on the faces.
    pub last_is_p: Option<bool>,
    /// When the first of them arrives, in r0/c1.
    pub time: f64,
}

impl Echo {
    /// Their name: a P or an S for each leg, and for the last part: "PPS".
    pub fn name(&self) -> String {
        let [p, s] = self.legs;
        let last = match self.last_is_p {
            None => "",
            Some(true) => "P",
            Some(false) => "S",
        };
        format!("{}{}{last}", "P".repeat(p), "S".repeat(s))
    }
}

/// When waves arrive that cover a distance `e` along a plate, and vertical distances as P and as S; k is the squared slowness of
/// shear waves.
///
/// The slowness along the plate is the one of the latest of all plane waves (Fermat).
pub(crate) fn arrival(e: f64, [as_p, as_s]: [f64; 2], k: f64) -> f64 {
    if as_p == 0.0 {
        return k.sqrt() * e.hypot(as_s);
    }
    // x = sin(angle) of P: the distance covered grows with it
    let covered = |angle: f64| {
        let (x, p) = angle.sin_cos();
        as_p * x / p + as_s * x / (k - x * x).sqrt()
    };
    let angle = bisected(0.0, std::f64::consts::FRAC_PI_2, |angle| covered(angle) < e);
    let (x, p) = angle.sin_cos();
    e * x + as_p * p + as_s * (k - x * x).sqrt()
}

/// When the head wave arrives, longitudinal along a face and shear across; none nearer than it exists.
pub(crate) fn head(e: f64, as_s: f64, k: f64) -> Option<f64> {
    let span = (k - 1.0).sqrt();
    (e * span >= as_s).then_some(e + as_s * span)
}
