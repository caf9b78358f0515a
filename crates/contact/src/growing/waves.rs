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
//! What the contact needs are integrals over this measure of functions that are analytic in X,
//! so that Gauss's rule of the whole measure, Rayleigh's wave included, converges exponentially.

use crate::growing::punch::PunchResponse;
use crate::numeric::gauss::{gauss, gauss_rule};
use halfspace::{Deflection, Medium, SurfaceResponse};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::{Arc, OnceLock};

/// Nodes of the rules, coarse to fine.
const SIZES: [usize; 12] = [3, 5, 8, 12, 18, 26, 38, 56, 80, 112, 156, 220];

/// Rules that there are.
pub(crate) const LEVELS: usize = SIZES.len();

/// The waves under a flat punch.
#[derive(Debug, Clone)]
pub struct PunchWaves {
    source: Source,
    /// Largest delay 2/c in a/c1.
    memory: f64,
    /// int (X/memory)^n dmu, n = 0 to 3.
    moments: [f64; 4],
    rules: [OnceLock<Rule>; LEVELS],
    punch: OnceLock<PunchResponse>,
}

/// What waves are made from.
#[derive(Debug, Clone)]
enum Source {
    /// A half-space: slownesses over the largest, and their masses.
    Medium(Medium, Vec<(f64, f64)>),
    /// The waves of two neighbouring ratios and the place between them, where the rules are interpolated.
    Neighbours(Arc<PunchWaves>, Arc<PunchWaves>, f64),
}

/// A rule for the measure: delays X in a/c1, ascending, and the mass over the delay of each.
#[derive(Debug, Clone)]
pub(crate) struct Rule {
    pub(crate) delays: Vec<f64>,
    pub(crate) rates: Vec<f64>,
}

impl PunchWaves {
    /// The waves of a half-space.
    #[must_use]
    pub fn new(medium: &Medium) -> Self {
        let c = medium.rayleigh_speed();
        let k = medium.kappa().powi(-2);
        let share = k / (1.0 - medium.poisson_ratio());
        let rayleigh = 2.0 * ((1.0 - c) * (1.0 + c)).sqrt() * c * share / medium.rayleigh_slope();
        let mut points = vec![];
        let rule = gauss(NODES);
        for zone in [Zone::Fast, Zone::Slow] {
            for (from, to) in zone.panels() {
                for &(x, weight) in &rule {
                    let (slowness, density) = zone.density(k, FRAC_PI_2 * (from + x * (to - from)));
                    let mass = FRAC_PI_2 * (to - from) * weight * density * share * 2.0 / PI;
                    points.push((slowness * c, mass));
                }
            }
        }
        points.push((1.0, rayleigh));
        Self {
            moments: std::array::from_fn(|n| moment(&points, n as i32)),
            source: Source::Medium(medium.clone(), points),
            memory: 2.0 / c,
            rules: Default::default(),
            punch: OnceLock::new(),
        }
    }

    /// Linear between those of two ratios, `fraction` of the way to the second.
    ///
    /// Nodes and masses of the rules are smooth in the ratio.
    #[must_use]
    pub fn between(near: Arc<Self>, far: Arc<Self>, fraction: f64) -> Self {
        let mix = |a: f64, b: f64| a + fraction * (b - a);
        Self {
            moments: std::array::from_fn(|n| mix(near.moments[n], far.moments[n])),
            // the slowness of Rayleigh's wave grows without bound toward a ratio of one half, its speed is smooth
            memory: 1.0 / mix(1.0 / near.memory, 1.0 / far.memory),
            rules: Default::default(),
            punch: OnceLock::new(),
            source: Source::Neighbours(near, far, fraction),
        }
    }

    /// Time after which the response of a punch is static, in a/c1: Rayleigh's wave across the diameter.
    #[must_use]
    pub fn memory(&self) -> f64 {
        self.memory
    }

    /// int V_p dt in a/c1: 3/2 of the relaxation time of a Hertz disc's centre.
    #[must_use]
    pub fn relaxation_time(&self) -> f64 {
        0.5 * self.moment(1)
    }

    /// int X^n dmu.
    #[must_use]
    pub fn moment(&self, n: i32) -> f64 {
        self.reduced_moment(n) * self.memory.powi(n)
    }

    /// The same of X over the memory.
    fn reduced_moment(&self, n: i32) -> f64 {
        match usize::try_from(n).ok().and_then(|n| self.moments.get(n)) {
            Some(known) => *known,
            None => self.mixed(&|points| moment(points, n)),
        }
    }

    /// V_p(t), t in a/c1, by summation; the convergence is that of the points.
    #[must_use]
    pub fn relaxation(&self, t: f64) -> f64 {
        let x = t / self.memory;
        self.mixed(&|points| {
            let parts = points.iter().filter(|(slowness, _)| *slowness > x);
            parts
                .map(|(slowness, mass)| mass * (1.0 - x / slowness))
                .sum()
        })
    }

    /// What the points give, linear between the neighbours where these waves have none of their own.
    fn mixed(&self, of: &impl Fn(&[(f64, f64)]) -> f64) -> f64 {
        match &self.source {
            Source::Medium(_, points) => of(points),
            Source::Neighbours(near, far, fraction) => {
                let near = near.mixed(of);
                near + fraction * (far.mixed(of) - near)
            }
        }
    }

    /// The response of the punch itself; made when it is first asked for.
    pub(crate) fn punch(&self) -> &PunchResponse {
        self.punch.get_or_init(|| match &self.source {
            Source::Medium(medium, _) => {
                PunchResponse::new(&SurfaceResponse::new(medium, Deflection::Centre))
            }
            Source::Neighbours(near, far, fraction) => {
                PunchResponse::between(near.punch(), far.punch(), *fraction)
            }
        })
    }

    /// The rule of a level; made when it is first asked for.
    pub(crate) fn rule(&self, level: usize) -> &Rule {
        let level = level.min(LEVELS - 1);
        self.rules[level].get_or_init(|| match &self.source {
            Source::Medium(_, points) => {
                let (nodes, masses) = gauss_rule(points, SIZES[level]);
                let delays: Vec<f64> = nodes.iter().map(|x| x * self.memory).collect();
                let rates = masses.iter().zip(&delays).map(|(m, x)| m / x).collect();
                Rule { delays, rates }
            }
            Source::Neighbours(near, far, fraction) => {
                let one = |waves: &Self| waves.rule(level).scaled(1.0 / waves.memory);
                one(near).between(&one(far), *fraction).scaled(self.memory)
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

impl Rule {
    /// The same in a unit of time that is shorter by a factor.
    fn scaled(&self, factor: f64) -> Self {
        Self {
            delays: self.delays.iter().map(|x| factor * x).collect(),
            rates: self.rates.iter().map(|x| x / factor).collect(),
        }
    }

    fn between(&self, other: &Self, fraction: f64) -> Self {
        let mix = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b);
            pairs.map(|(a, b)| a + fraction * (b - a)).collect()
        };
        Self {
            delays: mix(&self.delays, &other.delays),
            rates: mix(&self.rates, &other.rates),
        }
    }
}

/// int x^n over points and their masses.
fn moment(points: &[(f64, f64)], n: i32) -> f64 {
    points.iter().map(|(x, mass)| mass * x.powi(n)).sum()
}

/// Nodes of a panel.
const NODES: usize = 18;

/// The two intervals of slowness on which the density is smooth in an angle.
#[derive(Debug, Clone, Copy)]
enum Zone {
    /// 0 < x < 1, x = sin(angle).
    Fast,
    /// 1 < x < 1/kappa, x^2 = 1 + (K - 1) sin^2(angle).
    Slow,
}

impl Zone {
    /// Panels as fractions of the right angle; they shrink toward slowness one, where a zero of the
    /// Rayleigh function on a neighbouring sheet may be near, and a little toward the shear slowness.
    fn panels(self) -> Vec<(f64, f64)> {
        let toward_zero = |halvings: i32| {
            let ends = (1..=halvings).rev().map(|j| 0.5_f64.powi(j));
            [0.0].into_iter().chain(ends).collect::<Vec<f64>>()
        };
        let (lower, upper) = match self {
            Self::Fast => (3, 16),
            Self::Slow => (16, 4),
        };
        let mut ends = toward_zero(lower);
        ends.extend(toward_zero(upper).iter().rev().skip(1).map(|x| 1.0 - x));
        ends.windows(2).map(|pair| (pair[0], pair[1])).collect()
    }

    /// Slowness and Re[p/R] dx over the angle.
    fn density(self, k: f64, angle: f64) -> (f64, f64) {
        let s = angle.sin();
        let c = (FRAC_PI_2 - angle).sin();
        match self {
            Self::Fast => {
                let g = 2.0 * s * s - k;
                let y = (k - s * s).sqrt();
                (s, c * c / (g * g + 4.0 * s * s * c * y))
            }
            Self::Slow => {
                // p = -i p^, so Re[p/R] = 4 x^2 p^2 y/((2 x^2 - K)^4 + 16 x^4 p^2 y^2)
                let p2 = (k - 1.0) * s * s;
                let x2 = 1.0 + p2;
                let g = 2.0 * x2 - k;
                let y2 = (k - 1.0) * c * c;
                let density = 4.0 * x2 * p2 * y2.sqrt() / (g.powi(4) + 16.0 * x2 * x2 * p2 * y2);
                (x2.sqrt(), density * (k - 1.0) * s * c / x2.sqrt())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let relaxation = waves.relaxation_time() / centre.relaxation_time();
            assert!((relaxation - 1.5).abs() < 1e-12, "nu = {nu}: {relaxation}");
            assert!((waves.memory() / centre.memory() - 2.0).abs() < 1e-14);
            // the triangle's superposition, integrated, is the other way to the same punch
            let punch = PunchResponse::new(&centre);
            for part in [0.01, 0.1, 0.3, 0.6, 0.9, 1.0] {
                let t = part * waves.memory();
                let cells = 400;
                let sum: f64 = (0..cells)
                    .map(|i| waves.relaxation((f64::from(i) + 0.5) / f64::from(cells) * t))
                    .sum();
                let error = sum * t / f64::from(cells) - punch.relaxation_integral(t);
                assert!(
                    error.abs() < 1e-4 * waves.relaxation_time(),
                    "nu = {nu}, t = {t}: {error}"
                );
            }
        }
    }

    #[test]
    fn rules_have_the_moments_of_the_measure() {
        let waves = PunchWaves::new(&Medium::new(0.3).unwrap());
        for (level, &size) in SIZES.iter().enumerate() {
            let rule = waves.rule(level);
            for power in (0..2 * size as i32).step_by(1 + level) {
                let parts = rule.delays.iter().zip(&rule.rates);
                let sum: f64 = parts
                    .map(|(x, rate)| rate * x * (x / waves.memory).powi(power))
                    .sum();
                let exact = waves.moment(power) / waves.memory.powi(power);
                assert!((sum / exact - 1.0).abs() < 1e-11, "{level} {power}");
            }
        }
    }
}
