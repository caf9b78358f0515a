//! The waves under a flat punch as a measure over slowness, and Gauss's rules for it.
//!
//! The relaxation of the punch of radius a is a superposition of triangles,
//!
//! ```text
//! V_p(t) = int (1 - t/X)_+ dmu,     X = 2 x, x the slowness; all times in a/c1, slownesses in 1/c1
//! dmu = 2 K/(pi (1 - nu)) Re[p/R] dx  on 0 < x < 1/kappa,    + m_R delta(x - 1/c)
//! p = sqrt(1 - x^2),  y = sqrt(K - x^2),  K = 1/kappa^2,  R = (2 x^2 - K)^2 + 4 x^2 p y
//! m_R = 2 a c K/((1 - nu) D'(c)),  a = sqrt(1 - c^2)
//! ```
//!
//! a positive measure of total mass one: each slowness brings the load on one rim to the other after X.
//! The contact needs integrals over this measure of functions that are analytic in X,
//! so that Gauss's rule of the whole measure, Rayleigh's wave included, converges exponentially.

use crate::numeric::gauss::gauss_rule;
use halfspace::{Medium, surface_measure};
use std::sync::{Arc, OnceLock};

/// Nodes of the rules, coarse to fine.
const NODES_OF_RULES: [usize; 12] = [3, 5, 8, 12, 18, 26, 38, 56, 80, 112, 156, 220];

/// Rules that there are.
pub(crate) const LEVELS: usize = NODES_OF_RULES.len();

/// The waves under a flat punch; by default none, as of a half-space that answers at once.
#[derive(Debug, Clone, Default)]
pub struct PunchWaves {
    /// Time after which the response of a punch is static, in a/c1: Rayleigh's wave across the diameter, 2/c.
    pub memory: f64,
    /// int (X/memory)^n dmu, n = 0 to 3.
    moments: [f64; 4],
    /// Of each level the delays X in a/c1, ascending, and the mass over the delay of each.
    rules: [OnceLock<Vec<(f64, f64)>>; LEVELS],
    /// Slownesses over the largest, ascending, and their masses; none between two ratios.
    points: Vec<(f64, f64)>,
    /// Sums over the points before each of mass times X, mass, and mass over X, X in the memory.
    sums: Vec<[f64; 3]>,
    /// The waves of two neighbouring ratios and the place between them, where everything is interpolated.
    neighbours: Option<(Arc<PunchWaves>, Arc<PunchWaves>, f64)>,
}

impl PunchWaves {
    /// The waves of a half-space.
    pub fn new(medium: &Medium) -> Self {
        let c = medium.rayleigh_speed();
        let mut points = surface_measure(medium, HALVINGS_OF_SLOWNESS, NODES_OF_PANEL);
        let slowest = 1.0 / c;
        points.iter_mut().for_each(|(x, _)| *x /= slowest);
        let mut sum = [0.0; 3];
        let mut sums = vec![sum];
        for (x, mass) in &points {
            sum = [sum[0] + mass * x, sum[1] + mass, sum[2] + mass / x];
            sums.push(sum);
        }
        Self {
            moments: std::array::from_fn(|n| moment(&points, n as i32)),
            points,
            sums,
            memory: 2.0 / c,
            ..Self::default()
        }
    }

    /// Linear between those of two ratios, `fraction` of the way to the second.
    ///
    /// Nodes and masses of the rules are smooth in the ratio.
    pub fn between(near: Arc<Self>, far: Arc<Self>, fraction: f64) -> Self {
        let mix = |a: f64, b: f64| a + fraction * (b - a);
        Self {
            moments: std::array::from_fn(|n| mix(near.moments[n], far.moments[n])),
            // the slowness of Rayleigh's wave grows without bound toward a ratio of one half, its speed is smooth
            memory: 1.0 / mix(1.0 / near.memory, 1.0 / far.memory),
            neighbours: Some((near, far, fraction)),
            ..Self::default()
        }
    }

    /// int V_p dt in a/c1: 3/2 of the relaxation time of a Hertz disc's centre.
    pub fn relaxation_time(&self) -> f64 {
        0.5 * self.moment(1)
    }

    /// int X^n dmu, n = 0 to 3.
    pub fn moment(&self, n: usize) -> f64 {
        self.moments[n] * self.memory.powi(n as i32)
    }

    /// V_p(t), t in a/c1, and its integral from 0 to t; constant from the memory on.
    ///
    /// By summation; the convergence is that of the points: 1e-4, and of the integral 2e-6 of the relaxation time.
    pub fn relaxation(&self, t: f64) -> [f64; 2] {
        let [value, integral] = self.reduced(t / self.memory);
        [value, self.memory * integral]
    }

    /// The same in the memory: of the points, linear between the neighbours where these waves have none of their own.
    fn reduced(&self, x: f64) -> [f64; 2] {
        if let Some((near, far, fraction)) = &self.neighbours {
            let (near, far) = (near.reduced(x), far.reduced(x));
            return std::array::from_fn(|k| near[k] + fraction * (far[k] - near[k]));
        }
        let before = self.sums[self.points.partition_point(|(slowness, _)| *slowness <= x)];
        let all = self.sums[self.points.len()];
        let (mass, rate) = (all[1] - before[1], all[2] - before[2]);
        let integral = 0.5 * before[0] + x * (mass - 0.5 * x * rate);
        [mass - x * rate, integral]
    }

    /// The rule of a level, delays and rates; computed at the first call.
    pub(crate) fn rule(&self, level: usize) -> &[(f64, f64)] {
        let level = level.min(LEVELS - 1);
        self.rules[level].get_or_init(|| match &self.neighbours {
            None if self.points.is_empty() => Vec::new(),
            None => {
                let rule = gauss_rule(&self.points, NODES_OF_RULES[level]).into_iter();
                rule.map(|(x, mass)| (x * self.memory, mass / (x * self.memory)))
                    .collect()
            }
            Some((near, far, fraction)) => {
                // delays over the memory, and rates by it
                let scaled = |(x, rate): (f64, f64), unit: f64| (unit * x, rate / unit);
                let (to_near, to_far) = (1.0 / near.memory, 1.0 / far.memory);
                let mix = |a: f64, b: f64| a + fraction * (b - a);
                let pairs = near.rule(level).iter().zip(far.rule(level));
                pairs
                    .map(|(&a, &b)| {
                        let (a, b) = (scaled(a, to_near), scaled(b, to_far));
                        scaled((mix(a.0, b.0), mix(a.1, b.1)), self.memory)
                    })
                    .collect()
            }
        })
    }
}

/// An impact whose contact radius follows the load, in dimensionless groups.
#[derive(Debug, Clone, Copy)]
pub struct GrowingContact<'a> {
    /// The waves under a flat punch on the half-space.
    pub waves: &'a PunchWaves,
    /// phi: the half-space's part of the contact's compliance, in (0, 1].
    pub target_share: f64,
    /// tau = a/c1 in collision times, a = sqrt(R alpha) the contact radius at Hertz's largest approach; positive.
    pub wave_time: f64,
}

/// int x^n over points and their masses.
fn moment(points: &[(f64, f64)], n: i32) -> f64 {
    points.iter().map(|(x, mass)| mass * x.powi(n)).sum()
}

/// Nodes of a panel.
const NODES_OF_PANEL: usize = 18;

/// Halvings of the panels toward the ends of the two intervals of slowness: they shrink toward slowness one, where a zero
/// of the Rayleigh function on a neighbouring sheet may be near, and a little toward the shear slowness.
const HALVINGS_OF_SLOWNESS: [[i32; 2]; 2] = [[3, 16], [16, 4]];

#[cfg(test)]
mod tests {
    use super::*;
    use halfspace::{Deflection, SurfaceResponse};

    #[test]
    fn the_measure_is_that_of_the_surface_response() {
        for nu in [
            -0.5,
            0.0,
            0.01,
            0.25,
            0.263_082_06,
            0.3,
            0.45,
            0.499,
            0.4999,
        ] {
            let medium = Medium::new(nu).unwrap();
            let waves = PunchWaves::new(&medium);
            let centre = SurfaceResponse::new(&medium, Deflection::Centre);
            assert!(
                (waves.moment(0) - 1.0).abs() < 1e-12,
                "nu = {nu}: {:e}",
                waves.moment(0) - 1.0
            );
            let relaxation = waves.relaxation_time() / centre.disc.relaxation_time;
            assert!((relaxation - 1.5).abs() < 1e-12, "nu = {nu}: {relaxation}");
            assert!((waves.memory / centre.disc.memory - 2.0).abs() < 1e-14);
        }
    }

    /// int_0^t V_p from the centre's V by exchanging the order of integration, y = t/2:
    /// 3/2 int_0^y V + (y^2/2) int_y^inf V/x^2 dx, by the midpoint rule in the root of x.
    #[test]
    fn the_relaxation_is_that_of_the_surface_response() {
        const MIDPOINTS: i32 = 50_000;
        let mut worst = 0.0_f64;
        for nu in [-0.5, 0.0, 0.3, 0.49] {
            let medium = Medium::new(nu).unwrap();
            let waves = PunchWaves::new(&medium);
            let centre = SurfaceResponse::new(&medium, Deflection::Centre);
            let end = waves.memory;
            assert!((waves.relaxation(0.0)[0] - 1.0).abs() < 1e-12);
            let all = waves.relaxation(1.1 * end);
            assert!(all[0].abs() < 1e-12 && (all[1] / waves.relaxation_time() - 1.0).abs() < 1e-12);
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
                let error = waves.relaxation(fraction * end)[1] - exact;
                worst = worst.max(error.abs() / centre.disc.relaxation_time);
            }
        }
        println!("{worst:.1e} of the relaxation time");
        assert!(worst < 2e-6, "{worst:e}");
    }

    #[test]
    fn rules_have_the_moments_of_the_measure() {
        let waves = PunchWaves::new(&Medium::new(0.3).unwrap());
        for (level, &size) in NODES_OF_RULES.iter().enumerate() {
            let rule = waves.rule(level);
            for power in (0..2 * size as i32).step_by(1 + level) {
                let sum: f64 = (rule.iter())
                    .map(|(x, rate)| rate * x * (x / waves.memory).powi(power))
                    .sum();
                let exact = moment(&waves.points, power);
                assert!((sum / exact - 1.0).abs() < 1e-11, "{level} {power}");
            }
        }
    }
}
