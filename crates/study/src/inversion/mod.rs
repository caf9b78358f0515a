//! Numerical inversion of the Laplace transform: the way of the source paper to a kernel.
//!
//! `framework` and `cme` have the methods that evaluate the transform anew for every time, at nodes beta/t; `series`
//! those that share their samples among all times of a window. `hankel` has the paper's
//! transforms with the quadrature that an inversion needs of them.
//!
//! ```text
//! f(t) ~ (1/t) sum_k Re[ weight_k F(beta_k/t) ]                              Abate and Whitt (2006)
//! f(t) ~ (e^{a t}/T) Re[ F(a)/2 + sum_k F(a + i k pi/T) e^{i k pi t/T} ]     Dubner and Abate (1968)
//! ```

mod cme;
mod framework;
mod hankel;
mod series;

use crate::measure::Effort;
use cme::cme;
use framework::{Framework, euler, stehfest, talbot};
use halfspace::{Medium, Six};
use hankel::Hankel;
use num_complex::Complex64;
use series::{CRUMP, DE_HOOG, DURBIN, Series, Window};

/// A numerical inversion of the Laplace transform at one setting, ready for any scene and time.
#[derive(Debug)]
pub(crate) struct Inversion {
    pub(crate) name: &'static str,
    pub(crate) setting: String,
    /// Digits that the transform needs: those of the result and those that the weights cancel.
    digits: f64,
    rule: Rule,
}

#[derive(Debug)]
enum Rule {
    Framework(Framework),
    Series {
        series: Series,
        samples: usize,
        /// Aliasing error, matched to what the number of samples reaches.
        aliasing: f64,
        /// Ratio of the last to the first time that share the samples.
        span: f64,
    },
}

/// Ratio of times that share the samples of an accelerated series: over more the early ones are not resolved, over
/// less the samples are not used.
///
/// Durbin's plain sum gains nothing by it.
const SPAN: f64 = 4.0;

/// A method, with its settings in a quick and a full chart, and in the pictures of errors over time of both: in a full
/// one its best.
type Method = (fn(usize) -> Inversion, [&'static [usize]; 2], [usize; 2]);

const METHODS: [Method; 7] = [
    (
        |n| Inversion::framework("fixed Talbot", terms(n), 0.7 * n as f64, talbot(n)),
        [&[12, 24], &[8, 12, 16, 24, 32]],
        [16, 24],
    ),
    (
        |n| Inversion::framework("Gaver-Stehfest", terms(n), 15.0, stehfest(n)),
        [&[6, 14], &[6, 10, 14, 18]],
        [14, 14],
    ),
    (
        |n| Inversion::framework("Euler", format!("order {n}"), n as f64, euler(n)),
        [&[6, 14], &[6, 10, 14, 18, 24]],
        [10, 18],
    ),
    (
        |n| Inversion::framework("CME", format!("order {n}"), 6.0, cme(n)),
        [&[8, 24], &[8, 20, 50, 100]],
        [20, 50],
    ),
    (
        |n| Inversion::series("Durbin", DURBIN, n, 1e-6, f64::INFINITY),
        [&[50, 200], &[50, 100, 200, 400, 800]],
        [200, 400],
    ),
    (
        |n| Inversion::series("Crump", CRUMP, n, accelerated(n), SPAN),
        [&[21, 81], &[21, 41, 81, 161]],
        [41, 81],
    ),
    (
        |n| Inversion::series("de Hoog", DE_HOOG, n, accelerated(n), SPAN),
        [&[21, 81], &[21, 41, 81, 161]],
        [81, 161],
    ),
];

fn terms(n: usize) -> String {
    format!("{n} terms")
}

/// Aliasing error that an accelerated series reaches.
fn accelerated(samples: usize) -> f64 {
    10.0_f64.powf(-3.0 - samples as f64 / 20.0).max(1e-11)
}

impl Inversion {
    /// All methods at increasing settings.
    pub(crate) fn all(effort: Effort) -> Vec<Self> {
        let of = |(make, [quick, full], _): Method| {
            effort.pick(quick, full).iter().map(move |&n| make(n))
        };
        METHODS.into_iter().flat_map(of).collect()
    }

    /// The setting of each method in the pictures of errors over time.
    pub(crate) fn pictured(effort: Effort) -> Vec<Self> {
        let of = |(make, _, [quick, best]): Method| make(effort.pick(quick, best));
        METHODS.into_iter().map(of).collect()
    }

    fn framework(name: &'static str, setting: String, digits: f64, rule: Framework) -> Self {
        Self {
            name,
            setting,
            digits: digits.clamp(4.0, 15.0),
            rule: Rule::Framework(rule),
        }
    }

    fn series(
        name: &'static str,
        series: Series,
        samples: usize,
        aliasing: f64,
        span: f64,
    ) -> Self {
        Self {
            name,
            setting: format!("{samples} samples"),
            digits: (2.0 - aliasing.log10()).clamp(4.0, 15.0),
            rule: Rule::Series {
                series,
                samples,
                aliasing,
                span,
            },
        }
    }

    /// Step responses at ascending times, and the integrand evaluations they took; at the centre of the surface only
    /// w over its static value.
    pub(crate) fn run(&self, medium: &Medium, place: [f64; 2], times: &[f64]) -> (Vec<Six>, u64) {
        let hankel = Hankel::new(medium, place, self.digits);
        let mut values = Vec::with_capacity(times.len());
        match &self.rule {
            Rule::Framework(rule) => {
                let at = |&t: &f64| rule.invert(t, |s| hankel.values(s));
                values.extend(times.iter().map(at));
            }
            Rule::Series {
                series,
                samples,
                aliasing,
                span,
            } => {
                let mut rest = times;
                while let Some(first) = rest.first() {
                    let (now, later) = rest.split_at(rest.partition_point(|t| *t <= span * first));
                    let longest = now.last().copied().unwrap_or(*first);
                    let window = Window::new(longest, *aliasing, *samples);
                    values.extend(in_window(&hankel, &window, series, now));
                    rest = later;
                }
            }
        }
        (values, hankel.evaluations())
    }
}

/// Fields at many times by a series method, whose samples are shared.
fn in_window(hankel: &Hankel, window: &Window, series: &Series, times: &[f64]) -> Vec<Six> {
    let samples = hankel.values(&window.nodes());
    let fields: [Vec<f64>; 6] = std::array::from_fn(|f| {
        let column: Vec<Complex64> = samples.iter().map(|s| s[f]).collect();
        if column.iter().any(|v| v.norm_sqr() > 0.0) {
            window.invert(series, &column, times)
        } else {
            vec![0.0; times.len()]
        }
    });
    (0..times.len())
        .map(|i| std::array::from_fn(|f| fields[f][i]))
        .collect()
}

#[cfg(test)]
mod tests;
