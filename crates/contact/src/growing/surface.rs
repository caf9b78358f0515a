//! A surface that moves of itself: by the echoes of earlier force.

/// Velocity of the surface under a contact in collision units, positive into the half-space: samples that are equally spaced from the
/// touch on, between which it is a cubic.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SurfaceMotion {
    /// Distance of the samples.
    pub step: f64,
    /// The samples; after the last one the surface keeps its velocity.
    pub velocity: Vec<f64>,
}

impl SurfaceMotion {
    /// Velocity at a time.
    pub(crate) fn at(&self, time: f64) -> f64 {
        let Some(last) = self.velocity.len().checked_sub(1) else {
            return 0.0;
        };
        let place = (time / self.step).max(0.0);
        let cell = (place as usize).min(last);
        // through the two samples on each side, those at the ends repeated
        let [a, b, c, d] =
            [-1_isize, 0, 1, 2].map(|k| self.velocity[cell.saturating_add_signed(k).min(last)]);
        let s = (place - cell as f64).min(1.0);
        let slopes = [0.5 * (c - a), 0.5 * (d - b)];
        let bend = 3.0 * (c - b) - 2.0 * slopes[0] - slopes[1];
        let twist = slopes[0] + slopes[1] - 2.0 * (c - b);
        b + s * (slopes[0] + s * (bend + s * twist))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_motion_is_followed_between_its_samples() {
        let (step, of) = (0.01, |t: f64| (3.0 * t).sin());
        let velocity = (0..=100).map(|i| of(step * f64::from(i))).collect();
        let motion = SurfaceMotion { step, velocity };
        for t in [0.013, 0.5, 0.777, 0.985] {
            assert!((motion.at(t) - of(t)).abs() < 2e-5, "{t}");
        }
        assert_eq!(motion.at(7.0), motion.velocity[100]);
        assert_eq!(SurfaceMotion::default().at(0.3), 0.0);
    }
}
