//! Step response of a flat punch: the mean deflection under its own pressure.
//!
//! The centre under a punch jumps when the Rayleigh waves of its rim meet there, and a contact law fed
//! with that jump is unstable for a soft target; the pressure-weighted mean is work-conjugate to the
//! force, so what it feeds back is always dissipated.
//! Its chord function is the triangle 1 - eta/2 on [0, 2]. From the centre of the Hertz disc
//! (chord function 1 - eta^2, V = 1 - W):
//!
//! ```text
//! V_p(t) = V(y)/2 + (y/2) int_y^inf V(x)/x^2 dx,     y = t/2
//! ```
//!
//! Theory: `docs/theory.md` (T31).

use crate::numeric::quadrature::GAUSS_4;
use halfspace::{Deflection, SurfaceResponse};

/// int_0^t V_p of a flat punch in r0/c1, V_p = 1 - (step response over its static value).
///
/// Accuracy 1e-7 of the relaxation time; the start is like t log t, so the nodes are graded.
#[derive(Debug, Clone)]
pub(crate) struct PunchResponse {
    memory: f64,
    /// int t V_p dt.
    first_moment: f64,
    /// int V_p and V_p at the nodes memory (i/N)^2.
    nodes: Vec<[f64; 2]>,
}

/// Intervals of the graded grid.
const INTERVALS: usize = 600;

impl PunchResponse {
    /// From the response of a Hertz disc's centre; of another deflection it makes no sense.
    #[must_use]
    pub(crate) fn new(centre: &SurfaceResponse) -> Self {
        debug_assert_eq!(centre.deflection(), Deflection::Centre);
        let memory = 2.0 * centre.memory();
        let place = |i: usize| memory * (i as f64 / INTERVALS as f64).powi(2);
        let lag = |x: f64| 1.0 - centre.step(x);
        // from the end, where nothing is left
        let mut beyond = 0.0;
        let mut values = vec![0.0; INTERVALS + 1];
        for i in (1..INTERVALS).rev() {
            let (near, far) = (0.5 * place(i), 0.5 * place(i + 1));
            // in 1/x, where a constant V is integrated exactly
            let width = 1.0 / near - 1.0 / far;
            let part: f64 = GAUSS_4
                .iter()
                .map(|&(s, weight)| weight * lag(1.0 / (1.0 / far + s * width)))
                .sum();
            beyond += part * width;
            values[i] = 0.5 * (lag(near) + near * beyond);
        }
        values[0] = 1.0;
        let mut sum = 0.0;
        let mut nodes = vec![[0.0, 1.0]];
        for i in 1..=INTERVALS {
            // V is nearly a parabola over two intervals; the end correction makes the rule third order
            let width = place(i) - place(i - 1);
            sum += 0.5 * width * (values[i] + values[i - 1]);
            if i > 1 && i < INTERVALS {
                let before = (values[i - 1] - values[i - 2]) / (place(i - 1) - place(i - 2));
                let after = (values[i + 1] - values[i]) / (place(i + 1) - place(i));
                sum -= width * width / 24.0 * (after - before);
            }
            nodes.push([sum, values[i]]);
        }
        // The area is known exactly: that of the triangle equals that of the box.
        let scale = 1.5 * centre.relaxation_time() / sum;
        for node in &mut nodes {
            node[0] *= scale;
            node[1] *= scale;
        }
        // int t V_p = int (all - int_0^t V_p)
        let first_moment = (1..=INTERVALS)
            .map(|i| {
                let width = place(i) - place(i - 1);
                let left = |i: usize| nodes[INTERVALS][0] - nodes[i][0];
                0.5 * width * (left(i) + left(i - 1))
            })
            .sum();
        Self {
            memory,
            first_moment,
            nodes,
        }
    }

    /// The response of a Poisson's ratio between those of two others, linear in all its numbers.
    #[must_use]
    pub(crate) fn between(near: &Self, far: &Self, fraction: f64) -> Self {
        let mix = |a: f64, b: f64| a + fraction * (b - a);
        let nodes = near.nodes.iter().zip(&far.nodes);
        Self {
            memory: mix(near.memory, far.memory),
            first_moment: mix(near.first_moment, far.first_moment),
            nodes: nodes
                .map(|(a, b)| [mix(a[0], b[0]), mix(a[1], b[1])])
                .collect(),
        }
    }

    /// Time after which the response is static.
    #[must_use]
    pub(crate) fn memory(&self) -> f64 {
        self.memory
    }

    /// int t V_p dt, to 1e-5 of itself.
    pub(crate) fn first_moment(&self) -> f64 {
        self.first_moment
    }

    /// int_0^t V_p; constant from [`Self::memory`] on.
    #[must_use]
    pub(crate) fn relaxation_integral(&self, t: f64) -> f64 {
        let place = (t / self.memory).max(0.0).sqrt() * INTERVALS as f64;
        let i = place as usize;
        if i >= INTERVALS {
            return self.nodes[INTERVALS][0];
        }
        // cubic through both values and both slopes, in t
        let at = |i: usize| self.memory * (i as f64 / INTERVALS as f64).powi(2);
        let (from, to) = (at(i), at(i + 1));
        let width = to - from;
        let x = (t.max(0.0) - from) / width;
        let ([f0, s0], [f1, s1]) = (self.nodes[i], self.nodes[i + 1]);
        let rise = f1 - f0;
        f0 + x * (rise + (1.0 - x) * ((1.0 - x) * (s0 * width - rise) - x * (s1 * width - rise)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfspace::Medium;

    /// int_0^t V_p from the centre's V by exchanging the order of integration, y = t/2:
    /// 3/2 int_0^y V + (y^2/2) int_y^inf V/x^2 dx, by the midpoint rule in the root of x.
    #[test]
    fn the_integral_is_good_to_1e_7() {
        const MIDPOINTS: i32 = 200_000;
        let mut worst = 0.0_f64;
        for nu in [-0.5, 0.0, 0.3, 0.49] {
            let centre = SurfaceResponse::new(&Medium::new(nu).unwrap(), Deflection::Centre);
            let punch = PunchResponse::new(&centre);
            let end = punch.memory();
            for fraction in [1e-4, 0.01, 0.05, 0.2, 0.3, 0.5, 0.9] {
                let y = 0.5 * fraction * end;
                let (mut early, mut late) = (0.0, 0.0);
                let (from, until) = (y.sqrt(), (0.5 * end).sqrt());
                for i in 0..MIDPOINTS {
                    let middle = (f64::from(i) + 0.5) / f64::from(MIDPOINTS);
                    let (s, u) = (from * middle, from + (until - from) * middle);
                    early += 2.0 * s * (1.0 - centre.step(s * s));
                    late += 2.0 / u.powi(3) * (1.0 - centre.step(u * u));
                }
                early *= from / f64::from(MIDPOINTS);
                late *= (until - from) / f64::from(MIDPOINTS);
                let exact = 1.5 * early + 0.5 * y * y * late;
                let error = punch.relaxation_integral(fraction * end) - exact;
                worst = worst.max(error.abs() / centre.relaxation_time());
            }
        }
        println!("{worst:.1e} of the relaxation time");
        assert!(worst < 1e-7, "{worst:e}");
    }

    #[test]
    fn the_punch_relaxes_as_the_hertz_disc() {
        for nu in [-0.5, 0.0, 0.3, 0.49] {
            let medium = Medium::new(nu).unwrap();
            let centre = SurfaceResponse::new(&medium, Deflection::Centre);
            let punch = PunchResponse::new(&centre);
            // before its scaling the area comes out by itself
            let late = punch.relaxation_integral(punch.memory());
            assert!((late / centre.relaxation_time() - 1.5).abs() < 1e-12);
            assert!(
                (punch.nodes[0][1] - 1.0).abs() < 1e-5,
                "{:?}",
                punch.nodes[0]
            );
            let mut before = 0.0;
            let mut slope = 1.0 + 1e-4;
            for i in 1..=2000 {
                let t = f64::from(i) / 2000.0 * punch.memory();
                let now = punch.relaxation_integral(t);
                let next = (now - before) / punch.memory() * 2000.0;
                assert!(next > -1e-9 && next < slope + 1e-6, "nu = {nu}, t = {t}");
                (before, slope) = (now, next);
            }
        }
    }
}
