//! Random draws of keys. They are reproducible, independent of the number of threads, and computed on request, so that
//! they need no memory.
//!
//! Correlations between keys use a Gaussian copula: each key has a standard normal number per draw, the numbers of
//! correlated keys are mixed by the Cholesky factor of their correlation matrix, and each is mapped to its own
//! distribution at the same quantile. Every key therefore keeps its distribution. The coefficient is that of the values
//! for normal keys, and of their logarithms for log-normal keys.
//! logarithms for log-normal keys.

use crate::error::SceneError;
use crate::scene::keys::{FINITE, POSITIVE, Range};
use crate::scene::section::TomlSection;
use contact::choice;
use halfspace::random::mix;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// The draws of one key.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    samples: usize,
    own: Distribution,
    stream: u64,
    /// The streams whose normal numbers are mixed for this key, with their weights, if it is correlated with others.
    mixed: Vec<(u64, f64)>,
    /// Number of random keys.
    keys: usize,
}

impl Drawn {
    /// The draws of all keys of the section `[random]`, each with its section and name; `samples` is their number.
    pub(super) fn read(
        random: &TomlSection<'_>,
        samples: usize,
    ) -> Result<Vec<(String, String, Self)>, SceneError> {
        let seed = random
            .count("seed", 0..=usize::MAX, "[0, 2^63)")?
            .unwrap_or(0) as u64;
        let (mut found, mut names) = (Vec::new(), Vec::new());
        for section in random.subsections(&["samples", "seed", "correlation"])? {
            for key in section.names() {
                let inner = section.inner(key).ok_or_else(|| SceneError::missing(format!("{}.distribution", section.key(key)), "a random key is a table such as { distribution = \"normal\", mean = 1.0, deviation = 0.1 }"))?;
                names.push(section.key(key));
                found.push((section.name, key, Distribution::read(&inner)?));
            }
        }
        let factor = correlations(random, &names)?;
        let streams = names.iter().map(|name| stream(seed, name));
        let streams: Vec<u64> = streams.collect();
        let of = |(i, (section, key, own)): (usize, (&str, &str, _))| {
            let weighted = streams.iter().copied().zip(factor[i].iter().copied());
            let mixed: Vec<_> = weighted.filter(|(_, weight)| *weight != 0.0).collect();
            let bound = mixed.len() > 1 || factor[i + 1..].iter().any(|row| row[i] != 0.0);
            let drawn = Self {
                samples,
                own,
                stream: streams[i],
                mixed: if bound { mixed } else { Vec::new() },
                keys: names.len(),
            };
            (section.to_owned(), key.to_owned(), drawn)
        };
        Ok(found.into_iter().enumerate().map(of).collect())
    }

    /// Number of draws.
    pub fn count(&self) -> usize {
        self.samples
    }

    /// Draw number `index`: a function of the seed, the keys and this number only.
    pub fn at(&self, index: usize) -> f64 {
        let index = index as u64;
        if self.mixed.is_empty() {
            return self.own.draw(self.stream, index);
        }
        let weighted = self.mixed.iter();
        let normal = weighted
            .map(|&(stream, weight)| weight * normal(stream, index))
            .sum();
        self.own.value(|| normal_probability(normal), || normal)
    }

    /// A value that is not finite, if such values are possible for any number of draws.
    pub(super) fn infinite(&self) -> Option<f64> {
        // the numbers of correlated keys are weighted sums whose squared weights add up to one
        let most = LARGEST_NORMAL * (self.keys as f64).sqrt();
        let ends = [(f64::EPSILON, -most), (1.0, most)].into_iter();
        let mut values = ends.map(|(uniform, normal)| self.own.value(|| uniform, || normal));
        values.find(|end| !end.is_finite())
    }
}

/// A distribution of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Distribution {
    kind: DistributionKind,
    /// Both ends, or the mean or median and the deviation.
    numbers: [f64; 2],
}

/// The kind of a distribution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum DistributionKind {
    /// Uniform between two numbers.
    Uniform,
    /// Uniform in the logarithm between two positive numbers.
    LogUniform,
    /// Normal.
    Normal,
    /// Normal in the natural logarithm, with the deviation of that logarithm.
    LogNormal,
}

choice!(DistributionKind: Uniform = "uniform", LogUniform = "log_uniform", Normal = "normal", LogNormal = "log_normal");

impl Distribution {
    fn read(section: &TomlSection<'_>) -> Result<Self, SceneError> {
        let kind = section.choice("distribution")?.ok_or_else(|| {
            section.missing("distribution", "uniform, log_uniform, normal or log_normal")
        })?;
        let (keys, ranges) = match kind {
            DistributionKind::Uniform => (["low", "high"], [FINITE, FINITE]),
            DistributionKind::LogUniform => (["low", "high"], [POSITIVE, POSITIVE]),
            DistributionKind::Normal => (["mean", "deviation"], [FINITE, POSITIVE]),
            DistributionKind::LogNormal => (["median", "deviation"], [POSITIVE, POSITIVE]),
        };
        section.allow(["distribution", keys[0], keys[1]])?;
        let a = section.required(keys[0], ranges[0], "the distribution requires it")?;
        let b = section.required(keys[1], ranges[1], "the distribution requires it")?;
        if keys[1] == "high" && b <= a {
            return Err(SceneError::conflict(
                format!("{} = {b}", section.key("high")),
                format!("low = {a}"),
                "high must be above low",
            ));
        }
        let numbers = [a, b];
        Ok(Self { kind, numbers })
    }

    /// Draw number `index` of a stream: a function of its arguments only.
    fn draw(self, stream: u64, index: u64) -> f64 {
        let one = || uniform(stream, index, 0);
        self.value(one, || normal(stream, index))
    }

    /// The value of the distribution, from a uniform or a standard normal number.
    fn value(self, uniform: impl Fn() -> f64, normal: impl Fn() -> f64) -> f64 {
        let [a, b] = self.numbers;
        match self.kind {
            DistributionKind::Uniform => a + (b - a) * uniform(),
            DistributionKind::LogUniform => a * (b / a).powf(uniform()),
            DistributionKind::Normal => a + b * normal(),
            DistributionKind::LogNormal => a * (b * normal()).exp(),
        }
    }
}

/// The stream of draws of a key.
fn stream(seed: u64, key: &str) -> u64 {
    key.bytes()
        .fold(mix(seed), |hash, byte| mix(hash ^ u64::from(byte)))
}

/// Uniform number `which` of a draw of a stream, in (0, 1) without the ends.
fn uniform(stream: u64, index: u64, which: u64) -> f64 {
    let bits = mix(stream ^ mix(2 * index + which));
    ((bits >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
}

/// Largest magnitude of a standard normal number, since the smallest uniform number is 2^-54.
const LARGEST_NORMAL: f64 = 8.66;

/// The standard normal number of a draw of a stream, by Box and Muller.
fn normal(stream: u64, index: u64) -> f64 {
    let [radius, angle] = [0, 1].map(|which| uniform(stream, index, which));
    (-2.0 * radius.ln()).sqrt() * (TAU * angle).cos()
}

/// Open on both sides: fully correlated keys are one key.
const COEFFICIENT: Range = Range::new("(-1, 1)", |x| x > -1.0 && x < 1.0);

/// The Cholesky factor of `[[random.correlation]]`, sections with a pair of `keys` and a `coefficient`.
fn correlations(random: &TomlSection<'_>, keys: &[String]) -> Result<Vec<Vec<f64>>, SceneError> {
    let n = keys.len();
    let mut matrix: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect())
        .collect();
    for (name, table) in random.list("correlation")? {
        let section = TomlSection::of(&name, table);
        section.allow(["keys", "coefficient"])?;
        let [i, j] = pair(&section, keys)?;
        let hint = "the correlation of the two keys";
        let coefficient = section.required("coefficient", COEFFICIENT, hint)?;
        if matrix[i][j] != 0.0 || i == j {
            return Err(SceneError::conflict(
                format!("{name} of {}", keys[i]),
                keys[j].clone(),
                "two different keys can have only one correlation",
            ));
        }
        matrix[i][j] = coefficient;
        matrix[j][i] = coefficient;
    }
    cholesky(&matrix).ok_or_else(|| {
        SceneError::conflict(
            "random.correlation",
            "the other ones",
            "these coefficients do not form a valid correlation matrix: it is not positive definite",
        )
    })
}

fn pair(section: &TomlSection<'_>, keys: &[String]) -> Result<[usize; 2], SceneError> {
    let hint = "two random keys, such as [\"striker.diameter_m\", \"striker.velocity_m_s\"]";
    let words = section.words("keys", "a pair of random keys")?;
    let [first, second] = words.ok_or_else(|| section.missing("keys", hint))?;
    let place = |word: String| {
        let found = keys.iter().position(|key| *key == word);
        found.ok_or_else(|| {
            let drawn = format!("the random keys: {}", keys.join(", "));
            SceneError::unknown_choice(section.key("keys"), &word, &drawn)
        })
    };
    Ok([place(first)?, place(second)?])
}

/// The lower factor; none if the matrix is not positive definite.
fn cholesky(matrix: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let n = matrix.len();
    let mut factor = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let rest = matrix[i][j] - known;
            factor[i][j] = if i == j {
                if rest <= 1e-12 {
                    return None;
                }
                rest.sqrt()
            } else {
                rest / factor[j][j]
            };
        }
    }
    Some(factor)
}

/// The probability that a standard normal number is below `normal`, in (0, 1).
fn normal_probability(normal: f64) -> f64 {
    let below = 0.5 * libm::erfc(-normal * FRAC_1_SQRT_2);
    below.clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(kind: DistributionKind, numbers: [f64; 2]) -> Distribution {
        Distribution { kind, numbers }
    }

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
            moments(of(DistributionKind::Uniform, [2.0, 5.0]), |x| x),
            3.5,
            3.0 / even,
        );
        let log = of(DistributionKind::LogUniform, [1.0, 1f64.exp()]);
        close(moments(log, f64::ln), 0.5, 1.0 / even);
        let normal = of(DistributionKind::Normal, [-1.0, 0.3]);
        close(moments(normal, |x| x), -1.0, 0.3);
        let log_normal = of(DistributionKind::LogNormal, [1.0, 0.2]);
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
        let even = of(DistributionKind::Uniform, [0.0, 1.0]);
        let a = even.draw(stream(1, "striker.mass_kg"), 3);
        assert_eq!(a, even.draw(stream(1, "striker.mass_kg"), 3));
        assert_ne!(a, even.draw(stream(2, "striker.mass_kg"), 3));
        assert_ne!(a, even.draw(stream(1, "striker.velocity_m_s"), 3));
        assert_ne!(a, even.draw(stream(1, "striker.mass_kg"), 4));
    }

    #[test]
    fn factors_give_their_matrix() {
        let matrix = vec![
            vec![1.0, 0.6, -0.2],
            vec![0.6, 1.0, 0.3],
            vec![-0.2, 0.3, 1.0],
        ];
        let factor = cholesky(&matrix).unwrap_or_default();
        for i in 0..3 {
            for j in 0..3 {
                let product: f64 = (0..3).map(|k| factor[i][k] * factor[j][k]).sum();
                assert!((product - matrix[i][j]).abs() < 1e-15);
            }
        }
        let impossible = [
            vec![1.0, 0.9, -0.9],
            vec![0.9, 1.0, 0.9],
            vec![-0.9, 0.9, 1.0],
        ];
        assert_eq!(cholesky(&impossible), None);
    }

    #[test]
    fn probabilities_are_those_of_tables() {
        // Abramowitz and Stegun, table 26.1
        assert_eq!(normal_probability(0.0), 0.5);
        assert!((normal_probability(1.0) - 0.841344746068543).abs() < 1e-15);
        assert!((normal_probability(-2.0) - 0.022750131948179).abs() < 1e-15);
        assert!(normal_probability(50.0) < 1.0 && normal_probability(-50.0) > 0.0);
    }
}
