//! Numerical inversion of the Laplace transform, the source paper's method for kernels.
//!
//! `framework` contains the methods that evaluate the transform anew for every time, at nodes beta/t, and `series` the
//! methods that share their samples among all times of a window. `hankel` contains the paper's transforms and their
//! quadrature.
//!
//! ```text
//! f(t) ~ (1/t) sum_k Re[ weight_k F(beta_k/t) ]                              Abate and Whitt (2006)
//! f(t) ~ (e^{a t}/T) Re[ F(a)/2 + sum_k F(a + i k pi/T) e^{i k pi t/T} ]     Dubner and Abate (1968)
//! ```

mod framework;
mod hankel;
mod series;

use crate::measure::{Effort, Found};
use crate::method::ComparedMethod;
use framework::{euler, invert, stehfest, talbot};
use halfspace::{Medium, Six};
use hankel::Hankel;
use num_complex::Complex64;
use series::{Series, de_hoog, durbin, in_window};

/// A numerical inversion of the Laplace transform at one setting, for any scene and time.
pub(crate) struct Inversion {
    pub(crate) method: ComparedMethod,
    pub(crate) setting: String,
    /// Digits needed of the transform: those of the result and those that the weights cancel.
    digits: f64,
    invert: Box<Invert>,
}

/// Step responses at ascending times.
type Invert = dyn Fn(&Hankel, &[f64]) -> Vec<Six>;

/// Ratio of the times that share the samples of an accelerated series. With a larger ratio early times are not
/// resolved; with a smaller one the samples are not used fully.
///
/// Durbin's plain sum gains nothing from a ratio above 1.
const SPAN: f64 = 4.0;

/// Setting, digits and inversion of a method with a given number of terms or samples.
type Make = fn(usize) -> (String, f64, Box<Invert>);

/// Methods, with their settings in a quick chart, in a full chart, and in the pictures of errors over time of a full
/// chart.
const METHODS: [(ComparedMethod, Make, [&[usize]; 3]); 5] = [
    (
        ComparedMethod::FixedTalbot,
        |n| (format!("{n} terms"), 0.7 * n as f64, anew(talbot(n))),
        [&[12, 24], &[8, 12, 16, 24, 32], &[16, 24]],
    ),
    (
        ComparedMethod::GaverStehfest,
        |n| (format!("{n} terms"), 15.0, anew(stehfest(n))),
        [&[6, 14], &[6, 10, 14, 18], &[14, 14]],
    ),
    (
        ComparedMethod::Euler,
        |n| (format!("order {n}"), n as f64, anew(euler(n))),
        [&[6, 14], &[6, 10, 14, 18, 24], &[10, 18]],
    ),
    (
        ComparedMethod::Durbin,
        |n| in_windows(durbin, n, 1e-6, f64::INFINITY),
        [&[50, 200], &[50, 100, 200, 400, 800], &[200, 400]],
    ),
    (
        ComparedMethod::DeHoog,
        // aliasing error that the accelerated series can reach
        |n| {
            in_windows(
                de_hoog,
                n,
                10.0_f64.powf(-3.0 - n as f64 / 20.0).max(1e-11),
                SPAN,
            )
        },
        [&[21, 81], &[21, 41, 81, 161], &[81, 161]],
    ),
];

impl Inversion {
    /// A method at a setting.
    fn new(method: ComparedMethod, make: Make, n: usize) -> Self {
        let (setting, digits, invert) = make(n);
        Self {
            method,
            setting,
            digits: digits.clamp(4.0, 15.0),
            invert,
        }
    }

    /// All methods at increasing settings.
    pub(crate) fn all(effort: Effort) -> Vec<Self> {
        let settings = METHODS
            .into_iter()
            .flat_map(|(method, make, [quick, full, _])| {
                let settings = effort.pick(quick, full).iter();
                settings.map(move |&n| Self::new(method, make, n))
            });
        settings.collect()
    }

    /// The setting of each method in the pictures of errors over time.
    pub(crate) fn pictured(effort: Effort) -> Vec<Self> {
        let best = effort.pick(0, 1);
        let methods = METHODS.into_iter();
        let pictured = |(method, make, [.., settings]): (_, _, [&[usize]; 3])| {
            Self::new(method, make, settings[best])
        };
        methods.map(pictured).collect()
    }

    /// Step responses at ascending times, and the number of integrand evaluations; at the centre of the surface only w
    /// over its static value.
    pub(crate) fn run(&self, medium: &Medium, place: [f64; 2], times: &[f64]) -> Found<Vec<Six>> {
        let hankel = Hankel::new(medium, place, self.digits);
        let values = (self.invert)(&hankel, times);
        Ok((values, Some(hankel.evaluations.get())))
    }
}

/// A method that evaluates the transform anew for every time.
fn anew(rule: Vec<[Complex64; 2]>) -> Box<Invert> {
    Box::new(move |hankel, times| {
        let at = |&t: &f64| invert(&rule, t, |s| hankel.values(s));
        times.iter().map(at).collect()
    })
}

/// A method whose `n` samples are shared by the times up to `span` times the first of them, with its setting and digits.
fn in_windows(series: Series, n: usize, aliasing: f64, span: f64) -> (String, f64, Box<Invert>) {
    let run = move |hankel: &Hankel, mut rest: &[f64]| {
        let mut values = Vec::with_capacity(rest.len());
        while let Some(first) = rest.first() {
            let (now, later) = rest.split_at(rest.partition_point(|t| *t <= span * first));
            let of_window = [now.last().copied().unwrap_or(*first), aliasing];
            let transform = |s: &[Complex64]| hankel.values(s);
            values.extend(in_window(series, n, of_window, now, transform));
            rest = later;
        }
        values
    };
    let digits = 2.0 - aliasing.log10();
    (format!("{n} samples"), digits, Box::new(run))
}

#[cfg(test)]
mod tests;
