//! The inversions with the settings that the chart gives them.

use crate::effort::Effort;
use crate::inversion::{DeHoog, Framework, Window, cme, crump, durbin, euler, stehfest, talbot};
use crate::route::{Path, Route};
use halfspace::{Medium, Six};
use num_complex::Complex64;

/// A numerical inversion of the Laplace transform at one setting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Inversion {
    Talbot(usize),
    Stehfest(usize),
    Euler(usize),
    Cme(usize),
    Durbin(usize),
    Crump(usize),
    DeHoog(usize),
}

/// The sum of a series method at all times of a window.
type Sum = fn(&Window, &[Complex64], &[f64]) -> Vec<f64>;

/// Ratio of the last to the first time that share the samples of an accelerated series: over more the early
/// ones are not resolved, over less the samples are not used.
///
/// Durbin's plain sum gains nothing by it.
const SPAN: f64 = 4.0;

/// An inversion ready to run.
#[derive(Debug)]
pub(crate) enum Prepared {
    Framework(Framework, Path),
    Series(Inversion, f64),
}

impl Inversion {
    /// All methods at increasing settings.
    pub(crate) fn all(effort: Effort) -> Vec<Self> {
        let some = |quick: &[usize], full: &[usize], make: fn(usize) -> Self| -> Vec<Self> {
            effort.pick(quick, full).iter().map(|&n| make(n)).collect()
        };
        let mut all = some(&[12, 24], &[8, 12, 16, 24, 32], Self::Talbot);
        all.extend(some(&[6, 14], &[6, 10, 14, 18], Self::Stehfest));
        all.extend(some(&[6, 14], &[6, 10, 14, 18, 24], Self::Euler));
        all.extend(some(&[8, 24], &[8, 20, 50, 100], Self::Cme));
        all.extend(some(&[50, 200], &[50, 100, 200, 400, 800], Self::Durbin));
        all.extend(some(&[21, 81], &[21, 41, 81, 161], Self::Crump));
        all.extend(some(&[21, 81], &[21, 41, 81, 161], Self::DeHoog));
        all
    }

    /// The best setting of each method in the charts of error over time.
    pub(crate) fn best() -> [Self; 7] {
        [
            Self::Talbot(24),
            Self::Stehfest(14),
            Self::Euler(18),
            Self::Cme(50),
            Self::Durbin(400),
            Self::Crump(81),
            Self::DeHoog(161),
        ]
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Talbot(_) => "fixed Talbot",
            Self::Stehfest(_) => "Gaver-Stehfest",
            Self::Euler(_) => "Euler",
            Self::Cme(_) => "CME",
            Self::Durbin(_) => "Durbin",
            Self::Crump(_) => "Crump",
            Self::DeHoog(_) => "de Hoog",
        }
    }

    pub(crate) fn setting(self) -> String {
        match self {
            Self::Talbot(n) | Self::Stehfest(n) => format!("{n} terms"),
            Self::Euler(n) | Self::Cme(n) => format!("order {n}"),
            Self::Durbin(n) | Self::Crump(n) | Self::DeHoog(n) => format!("{n} samples"),
        }
    }

    /// Digits that the transform needs: those of the result and those that the weights cancel.
    pub(crate) fn digits(self) -> f64 {
        let wanted = match self {
            Self::Talbot(n) => 0.7 * n as f64,
            Self::Stehfest(_) => 15.0,
            Self::Euler(n) => n as f64,
            Self::Cme(_) => 6.0,
            Self::Durbin(_) | Self::Crump(_) | Self::DeHoog(_) => 2.0 - self.aliasing().log10(),
        };
        wanted.clamp(4.0, 15.0)
    }

    /// Aliasing error of a series method, matched to what its number of samples reaches.
    fn aliasing(self) -> f64 {
        match self {
            Self::Durbin(_) => 1e-6,
            Self::Crump(n) | Self::DeHoog(n) => 10.0_f64.powf(-3.0 - n as f64 / 20.0).max(1e-11),
            Self::Talbot(_) | Self::Stehfest(_) | Self::Euler(_) | Self::Cme(_) => 1.0,
        }
    }

    /// What does not depend on scene or time.
    pub(crate) fn prepare(self) -> Prepared {
        match self {
            Self::Talbot(n) => Prepared::Framework(talbot(n), Path::Continued),
            Self::Stehfest(n) => Prepared::Framework(stehfest(n), Path::RightHalf),
            Self::Euler(n) => Prepared::Framework(euler(n), Path::RightHalf),
            Self::Cme(n) => Prepared::Framework(cme(n), Path::RightHalf),
            Self::Durbin(_) | Self::Crump(_) | Self::DeHoog(_) => {
                Prepared::Series(self, self.aliasing())
            }
        }
    }
}

impl Prepared {
    /// Step responses at ascending times, and the integrand evaluations they took.
    pub(crate) fn run(
        &self,
        medium: &Medium,
        [r, z]: [f64; 2],
        digits: f64,
        times: &[f64],
    ) -> (Vec<Six>, u64) {
        let route = Route::new(medium, r, z, digits);
        let values = match self {
            Self::Framework(rule, path) => times
                .iter()
                .map(|&t| route.framework(rule, t, *path))
                .collect(),
            Self::Series(method, aliasing) => {
                let (samples, sum): (usize, Sum) = match *method {
                    Inversion::Durbin(n) => (n, |window, samples, times| {
                        times.iter().map(|&t| durbin(window, samples, t)).collect()
                    }),
                    Inversion::Crump(n) => (n, |window, samples, times| {
                        times.iter().map(|&t| crump(window, samples, t)).collect()
                    }),
                    Inversion::DeHoog(n)
                    | Inversion::Talbot(n)
                    | Inversion::Stehfest(n)
                    | Inversion::Euler(n)
                    | Inversion::Cme(n) => (n, |window, samples, times| {
                        let fraction = DeHoog::new(window, samples);
                        times.iter().map(|&t| fraction.at(t)).collect()
                    }),
                };
                let span = match method {
                    Inversion::Durbin(_) => f64::INFINITY,
                    Inversion::Crump(_)
                    | Inversion::DeHoog(_)
                    | Inversion::Talbot(_)
                    | Inversion::Stehfest(_)
                    | Inversion::Euler(_)
                    | Inversion::Cme(_) => SPAN,
                };
                let mut values = Vec::with_capacity(times.len());
                let mut rest = times;
                while let Some(first) = rest.first() {
                    let (now, later) = rest.split_at(rest.partition_point(|t| *t <= span * first));
                    let longest = now.last().copied().unwrap_or(*first);
                    values.extend(route.series(
                        &Window::new(longest, *aliasing, samples),
                        now,
                        sum,
                    ));
                    rest = later;
                }
                values
            }
        };
        (values, route.evaluations())
    }
}
