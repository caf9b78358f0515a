//! Random draws: reproducible, and the same whatever the number of threads.

use super::correlation::normal_probability;
use crate::error::SceneError;
use crate::section::{FINITE, POSITIVE, Section};
use contact::Choice;
use std::f64::consts::TAU;

/// A distribution of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Distribution {
    /// Even between two numbers.
    Uniform { low: f64, high: f64 },
    /// Even in the logarithm between two positive numbers.
    LogUniform { low: f64, high: f64 },
    /// Gauss's.
    Normal { mean: f64, deviation: f64 },
    /// Gauss's in the natural logarithm, with the deviation of that logarithm.
    LogNormal { median: f64, deviation: f64 },
}

/// The kind of a distribution, as files name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Uniform,
    LogUniform,
    Normal,
    LogNormal,
}

impl Choice for Kind {
    const ALL: &'static [Self] = &[
        Self::Uniform,
        Self::LogUniform,
        Self::Normal,
        Self::LogNormal,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::LogUniform => "log_uniform",
            Self::Normal => "normal",
            Self::LogNormal => "log_normal",
        }
    }
}

impl Distribution {
    pub(crate) fn read(section: &Section<'_>) -> Result<Self, SceneError> {
        let kind = section.choice("distribution")?.ok_or_else(|| {
            section.missing("distribution", "uniform, log_uniform, normal or log_normal")
        })?;
        let (keys, ranges) = match kind {
            Kind::Uniform => (["low", "high"], [FINITE, FINITE]),
            Kind::LogUniform => (["low", "high"], [POSITIVE, POSITIVE]),
            Kind::Normal => (["mean", "deviation"], [FINITE, POSITIVE]),
            Kind::LogNormal => (["median", "deviation"], [POSITIVE, POSITIVE]),
        };
        section.allow(&["distribution", keys[0], keys[1]])?;
        let a = section.required(keys[0], ranges[0], "the distribution needs it")?;
        let b = section.required(keys[1], ranges[1], "the distribution needs it")?;
        if matches!(kind, Kind::Uniform | Kind::LogUniform) && b <= a {
            return Err(SceneError::Conflict {
                first: format!("{} = {b}", section.key("high")),
                second: format!("low = {a}"),
                reason: "high must be above low",
            });
        }
        Ok(match kind {
            Kind::Uniform => Self::Uniform { low: a, high: b },
            Kind::LogUniform => Self::LogUniform { low: a, high: b },
            Kind::Normal => Self::Normal {
                mean: a,
                deviation: b,
            },
            Kind::LogNormal => Self::LogNormal {
                median: a,
                deviation: b,
            },
        })
    }

    /// Draw number `index` of a stream: a function of its arguments only.
    pub(crate) fn draw(self, stream: u64, index: u64) -> f64 {
        let one = || uniform(stream, index, 0);
        self.value(one, || normal(stream, index))
    }

    /// Values between which all draws are whose normal numbers are at most this far from zero.
    pub(crate) fn ends(self, normal: f64) -> [f64; 2] {
        [(f64::EPSILON, -normal), (1.0, normal)]
            .map(|(uniform, normal)| self.value(|| uniform, || normal))
    }

    /// The value at the quantile of a standard normal number.
    pub(crate) fn at(self, normal: f64) -> f64 {
        self.value(|| normal_probability(normal), || normal)
    }

    /// The value at an even or a standard normal number, whichever it is made of.
    fn value(self, uniform: impl Fn() -> f64, normal: impl Fn() -> f64) -> f64 {
        match self {
            Self::Uniform { low, high } => low + (high - low) * uniform(),
            Self::LogUniform { low, high } => low * (high / low).powf(uniform()),
            Self::Normal { mean, deviation } => mean + deviation * normal(),
            Self::LogNormal { median, deviation } => median * (deviation * normal()).exp(),
        }
    }
}

/// The stream of draws of a key.
pub(crate) fn stream(seed: u64, key: &str) -> u64 {
    key.bytes()
        .fold(mix(seed), |hash, byte| mix(hash ^ u64::from(byte)))
}

/// Even number `which` of a draw of a stream, in (0, 1): never an end.
fn uniform(stream: u64, index: u64, which: u64) -> f64 {
    let bits = mix(stream ^ mix(2 * index + which));
    ((bits >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
}

/// No standard normal number is farther from zero: the smallest even number is 2^-54.
pub(crate) const LARGEST_NORMAL: f64 = 8.66;

/// The standard normal number of a draw of a stream, by Box and Muller.
pub(crate) fn normal(stream: u64, index: u64) -> f64 {
    let [radius, angle] = [0, 1].map(|which| uniform(stream, index, which));
    (-2.0 * radius.ln()).sqrt() * (TAU * angle).cos()
}

/// The finaliser of splitmix64 after one step of its sequence.
fn mix(state: u64) -> u64 {
    let mut z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moments(distribution: Distribution, of: impl Fn(f64) -> f64) -> (f64, f64) {
        let n = 100_000_u32;
        let draws =
            (0..n).map(|i| of(distribution.draw(stream(7, "striker.mass_kg"), u64::from(i))));
        let (sum, squares) = draws.fold((0.0, 0.0), |(s, q), x| (s + x, q + x * x));
        let mean = sum / f64::from(n);
        (mean, (squares / f64::from(n) - mean * mean).sqrt())
    }

    #[test]
    fn draws_have_their_moments() {
        let close = |found: (f64, f64), mean: f64, deviation: f64| {
            assert!((found.0 - mean).abs() < 0.015 * deviation, "{found:?}");
            assert!((found.1 / deviation - 1.0).abs() < 0.02, "{found:?}");
        };
        let even = 12.0_f64.sqrt();
        close(
            moments(
                Distribution::Uniform {
                    low: 2.0,
                    high: 5.0,
                },
                |x| x,
            ),
            3.5,
            3.0 / even,
        );
        let log = Distribution::LogUniform {
            low: 1.0,
            high: 1f64.exp(),
        };
        close(moments(log, f64::ln), 0.5, 1.0 / even);
        let normal = Distribution::Normal {
            mean: -1.0,
            deviation: 0.3,
        };
        close(moments(normal, |x| x), -1.0, 0.3);
        let log_normal = Distribution::LogNormal {
            median: 1.0,
            deviation: 0.2,
        };
        close(moments(log_normal, f64::ln), 0.0, 0.2);
    }

    #[test]
    fn no_normal_number_is_beyond_the_largest() {
        let smallest: f64 = 0.5 / (1_u64 << 53) as f64;
        let largest = (-2.0 * smallest.ln()).sqrt();
        assert!(largest < LARGEST_NORMAL && largest > LARGEST_NORMAL - 0.01);
    }

    #[test]
    fn draws_of_two_keys_and_two_seeds_differ() {
        let even = Distribution::Uniform {
            low: 0.0,
            high: 1.0,
        };
        let a = even.draw(stream(1, "striker.mass_kg"), 3);
        assert_eq!(a, even.draw(stream(1, "striker.mass_kg"), 3));
        assert_ne!(a, even.draw(stream(2, "striker.mass_kg"), 3));
        assert_ne!(a, even.draw(stream(1, "striker.velocity_m_s"), 3));
        assert_ne!(a, even.draw(stream(1, "striker.mass_kg"), 4));
    }
}
