//! Attenuation in time: the weight of each instant of an elastic response in the damped one.
//!
//! The damped step response is the elastic one, averaged over the logarithm of time:
//!
//! ```text
//! D(t) = (omega0 t)^((v - 1) g) int q_v(x) U(tau) dx,     omega0 tau = (omega0 t e^(-y))^(1 - g),     y = g (x + ln g)
//! ```
//!
//! v is 3 for displacements and 1 for stresses, and g the exponent of the law. The density q_v is near a stable one, whose
//! width in x is of order 1 for any quality factor; for g to 0 it is Landau's.
//!
//! Theory: `docs/theory.md` (T80).

use crate::attenuation::Attenuation;
use crate::numeric::gauss;
use crate::numeric::polynomial::chebyshev;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Exponent of the density at its smallest x, below the logarithm of the tolerance (`densities_have_mass_one`).
const LEAST_EXPONENT: f64 = -4.0;

/// Largest logarithm of the ratio of times that counts; the density falls as its exponential.
const LONGEST: f64 = 60.0;

/// Terms of the density on a panel, in addition to one for each digit, and exponent that its integral leaves out, in addition to
/// that of the tolerance: with fewer `densities_have_mass_one` fails.
const TERMS: f64 = 8.0;
const FALLEN: f64 = 14.0;

/// Digits of a panel with one group of nodes, and more of each further group (`densities_have_mass_one`,
/// `damped_fields_are_those_of_spectra`).
const FIRST_DIGITS: f64 = 6.0;
const DIGITS_A_GROUP: f64 = 3.5;

/// Number of instants that are evaluated together.
pub(crate) const TOGETHER: usize = 8;

/// Instants tau, or their ratios to another, and weights of displacements and stresses.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Group {
    pub(crate) tau: [f64; TOGETHER],
    pub(crate) weights: [[f64; TOGETHER]; 2],
}

/// Densities of both kinds of fields: displacements, stresses.
type Both = [f64; 2];

/// v of both kinds.
const KINDS: Both = [3.0, 1.0];

/// An attenuation, prepared for traces of about one tolerance.
#[derive(Debug, Clone)]
pub struct Damping {
    law: Attenuation,
    g: f64,
    /// x before which the density is zero.
    first: f64,
    /// Ascending in x from there, without gaps.
    panels: Vec<Panel>,
    /// Places in (0, 1) and weights of the nodes of a part of a panel.
    nodes: Vec<[f64; 2]>,
    tolerance: f64,
}

/// Densities on an interval of x.
#[derive(Debug, Clone)]
struct Panel {
    x: [f64; 2],
    series: [Vec<f64>; 2],
    /// Nodes of the whole panel, with ratios to tau at y = 0.
    rule: Vec<Group>,
}

impl Damping {
    /// For traces of a tolerance in [1e-14, 0.1]. It takes about a millisecond.
    pub fn new(law: &Attenuation, tolerance: f64) -> Self {
        /// Width of the first panels, and widest panel in y, within which an elastic response between fronts is smooth.
        const NARROW: f64 = 2.0;
        const WIDE: f64 = 0.7;
        /// Width over y for large y, where weights are small.
        const LATE: f64 = 0.3;
        /// x of the peak, and width of later panels over their x.
        const PEAK: f64 = 0.0;
        const WIDENING: f64 = 1.5;
        let g = law.exponent();
        let digits = -tolerance.log10();
        let groups = 1 + ((digits - FIRST_DIGITS) / DIGITS_A_GROUP).ceil().max(0.0) as usize;
        let panels = Vec::new();
        let mut first = PEAK;
        while saddle(g, first)[1] > tolerance.ln() + LEAST_EXPONENT {
            first -= 0.25;
        }
        let mut damping = Self {
            law: *law,
            g,
            first,
            panels,
            nodes: rounded(groups * TOGETHER).collect(),
            tolerance,
        };
        let mut from = first;
        while damping.y(from) < LONGEST {
            let smooth = WIDE.max(LATE * damping.y(from)) / g;
            let width = NARROW.max(WIDENING * (from - PEAK)).min(smooth.max(NARROW));
            damping.panels.push(damping.panel([from, from + width]));
            from += width;
        }
        damping
    }

    /// The law.
    pub fn law(&self) -> &Attenuation {
        &self.law
    }

    /// The tolerance.
    pub(crate) fn tolerance(&self) -> f64 {
        self.tolerance
    }

    fn panel(&self, x: [f64; 2]) -> Panel {
        let [middle, half] = [0.5 * (x[0] + x[1]), 0.5 * (x[1] - x[0])];
        let terms = (TERMS - self.tolerance.log10()).round() as usize;
        let angle = |i: usize| PI * (i as f64 + 0.5) / terms as f64;
        let values: Vec<Both> = (0..terms)
            .map(|i| self.density(middle + half * angle(i).cos()))
            .collect();
        let series = [0, 1].map(|kind| {
            let term = |k: usize| {
                let sum: f64 = (0..terms)
                    .map(|i| values[i][kind] * (k as f64 * angle(i)).cos())
                    .sum();
                sum * if k == 0 { 1.0 } else { 2.0 } / terms as f64
            };
            (0..terms).map(term).collect()
        });
        let mut panel = Panel {
            x,
            series,
            rule: Vec::new(),
        };
        let mut rule = Vec::new();
        self.groups(&panel, x, |group| rule.push(*group));
        panel.rule = rule;
        panel
    }

    /// Calls `add` with the nodes of a part of a panel.
    fn groups(&self, panel: &Panel, [from, to]: [f64; 2], mut add: impl FnMut(&Group)) {
        for nodes in self.nodes.chunks_exact(TOGETHER) {
            let mut group = Group {
                tau: [0.0; TOGETHER],
                weights: [[0.0; TOGETHER]; 2],
            };
            for (i, [place, weight]) in nodes.iter().enumerate() {
                let x = from + (to - from) * place;
                group.tau[i] = self.ratio(x);
                for (weights, q) in group.weights.iter_mut().zip(panel.at(x)) {
                    weights[i] = (to - from) * weight * q;
                }
            }
            add(&group);
        }
    }

    /// Logarithm of the ratio of times at x.
    fn y(&self, x: f64) -> f64 {
        self.g * (x + self.g.ln())
    }

    /// x of a ratio of times.
    fn x(&self, ratio: f64) -> f64 {
        ratio.ln() / self.g - self.g.ln()
    }

    /// Factor of tau at x.
    fn ratio(&self, x: f64) -> f64 {
        (-(1.0 - self.g) * self.y(x)).exp()
    }

    /// q_v at x, by the trapezoidal rule on a parabola through the saddle point or near the origin.
    fn density(&self, x: f64) -> Both {
        /// Vertex of the parabola times the rate at which the integrand falls, for large x.
        const VERTEX: f64 = 3.0;
        /// Largest step on the parabola, times the root of the vertex and as it is, and most nodes: a hundred are usual.
        const STEPS: [f64; 2] = [0.35, 0.1];
        const MOST_NODES: u32 = 2000;
        let g = self.g;
        let y = self.y(x);
        let a = y.exp_m1() / g;
        // the exponent is S (a - h(S)), h = ((S/g)^-g - 1)/g
        let h = |log: Complex64| {
            let power = -g * (log - g.ln());
            (power * 0.5).exp() * 2.0 * (power * 0.5).sinh() / g
        };
        let [saddle, _] = saddle(g, x);
        let rate = a - (g * g.ln()).exp_m1() / g;
        let vertex = saddle.max(VERTEX / (rate.max(0.0) + VERTEX));
        let step = (STEPS[0] / vertex.sqrt()).min(STEPS[1]);
        let mut sums = [Complex64::default(); 2];
        let mut largest = f64::NEG_INFINITY;
        for i in 0..MOST_NODES {
            let u = step * f64::from(i);
            let root = Complex64::new(1.0, u);
            let s = vertex * root * root;
            let log = s.ln();
            let exponent = s * (a - h(log));
            largest = largest.max(exponent.re);
            if exponent.re < largest - FALLEN + self.tolerance.ln() {
                break;
            }
            let slope = 2.0 * Complex64::i() * vertex * root;
            let weight = if i == 0 { 0.5 } else { 1.0 } * step;
            for (sum, v) in sums.iter_mut().zip(KINDS) {
                *sum += weight * slope * (exponent - v * g * (log - g.ln())).exp();
            }
        }
        // both halves of the parabola are conjugates
        let [displacements, stresses] = sums.map(|sum| (1.0 - g) * sum.im / PI);
        [displacements * (-2.0 * g * y).exp(), stresses]
    }

    /// Time until which the elastic response is needed for the damped one until `end`, for a unit of time of which the
    /// reference frequency is `reference`.
    pub fn reach(&self, end: f64, reference: f64) -> f64 {
        self.elastic(end, reference) * self.ratio(self.first)
    }

    /// tau at y = 0.
    fn elastic(&self, t: f64, reference: f64) -> f64 {
        t * (TAU * reference * t).powf(-self.g)
    }

    /// Time at which an elastic response at tau has its largest weight, and the one before which it has none.
    pub(crate) fn arrival(&self, tau: f64, reference: f64) -> [f64; 2] {
        let t = tau * (TAU * reference * tau).powf(self.g / (1.0 - self.g));
        [0.0, self.first].map(|x| t * self.y(x).exp())
    }

    /// Factor of displacements at a time.
    pub(crate) fn creep(&self, t: f64, reference: f64) -> f64 {
        (TAU * reference * t).powf(2.0 * self.g)
    }

    /// Calls `add` with groups of instants tau and weights of displacements and stresses for D at a time, from the instant that has
    /// no weight back to `first`. The `breaks` of the elastic response, ascending, are not within a group.
    pub(crate) fn for_each_group(
        &self,
        (t, reference): (f64, f64),
        (first, breaks): (f64, &[f64]),
        mut add: impl FnMut(&Group),
    ) {
        let tau = self.elastic(t, reference);
        let last = self.x((tau / first).powf(1.0 / (1.0 - self.g)));
        let mut left = breaks.partition_point(|at| *at < tau * self.ratio(self.first));
        let mut scaled = |group: &Group| {
            add(&Group {
                tau: group.tau.map(|ratio| tau * ratio),
                ..*group
            });
        };
        for panel in &self.panels {
            if panel.x[0] >= last {
                break;
            }
            let end = tau * self.ratio(panel.x[1]);
            let is_whole = panel.x[1] <= last && (left == 0 || breaks[left - 1] <= end);
            if is_whole {
                panel.rule.iter().for_each(&mut scaled);
                continue;
            }
            let mut from = panel.x[0];
            let until = panel.x[1].min(last);
            while from < until {
                let next = match left.checked_sub(1).map(|i| breaks[i]) {
                    Some(at) if at > end => {
                        left -= 1;
                        self.x((tau / at).powf(1.0 / (1.0 - self.g))).min(until)
                    }
                    Some(_) | None => until,
                };
                if next > from {
                    self.groups(panel, [from, next], &mut scaled);
                    from = next;
                }
            }
        }
    }
}

/// The place S of the saddle point of the exponent at x, and the exponent there.
fn saddle(g: f64, x: f64) -> [f64; 2] {
    let a = (g * (x + g.ln())).exp_m1() / g;
    let h = (a + 1.0) / (1.0 - g);
    let s = g * (-(g * h).ln_1p() / g).exp();
    [s, s * (a - h)]
}

impl Panel {
    fn at(&self, x: f64) -> Both {
        let place = (2.0 * x - self.x[0] - self.x[1]) / (self.x[1] - self.x[0]);
        [0, 1].map(|kind| chebyshev(&self.series[kind], place))
    }
}

/// Gauss's rule in the angle of [0, 1], which makes roots at the ends smooth.
fn rounded(count: usize) -> impl Iterator<Item = [f64; 2]> {
    gauss::rule(count).on(0.0, 1.0).map(|(s, weight)| {
        let (sin, cos) = (FRAC_PI_2 * s).sin_cos();
        [sin * sin, weight * PI * sin * cos]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A constant elastic stress stays as it is, and the density of displacements has the mass 1/Gamma(1 + 2g) of the creep.
    #[test]
    fn densities_have_mass_one() {
        // Q, Gamma(1 + 2 atan(1/Q)/pi)
        for (quality, gamma) in [
            (1.0, 0.886_226_925_452_758),
            (20.0, 0.982_614_178_102_258_4),
            (1e3, 0.999_632_933_832_342_2),
            (1e12, 1.0),
        ] {
            let damping = Damping::new(&Attenuation::new(quality, 1.0).unwrap(), 1e-12);
            let mut mass = [0.0; 2];
            for panel in &damping.panels {
                for group in &panel.rule {
                    mass = [0, 1].map(|kind| mass[kind] + group.weights[kind].iter().sum::<f64>());
                }
            }
            println!("{quality}: {mass:?} {}", damping.panels.len());
            assert!((mass[1] - 1.0).abs() < 1e-11, "{quality}: {mass:?}");
            assert!((mass[0] * gamma - 1.0).abs() < 1e-11, "{quality}: {mass:?}");
        }
    }
}
