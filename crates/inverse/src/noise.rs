//! Noise of a trace from its quiet part: an autoregressive model, and the filter that whitens it.
//!
//! A resonant sensor has coloured noise, in which white noise of the same size would hide another force.
//! The model is fitted by Burg's method, which suits short parts; Akaike's corrected criterion chooses its order.
//! Its inverse is a short causal filter: applied to trace and response alike, it leaves the force as it is.
//!
//! ```text
//! e_i = (d_i + a_1 d_{i-1} + .. + a_p d_{i-p})/s,     e white with standard deviation 1
//! ```
//!
//! Theory: `docs/theory.md` (T74).

use crate::nnls::dot;

/// Fewest quiet samples from which noise is measured: the standard deviation of so many has an error of 18 %.
pub(crate) const FEWEST_QUIET: usize = 16;

/// Quiet samples for each coefficient of the largest order tried, and the largest order itself: two resonances with room.
/// `tests/noise.rs` (`coloured_noise_is_whitened`) fails with an order of 1.
const SAMPLES_PER_COEFFICIENT: usize = 8;
const LARGEST_ORDER: usize = 24;

/// A filter that whitens noise, and the size of the noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Whitening {
    /// Coefficients, from that of the present sample back in time, in 1/unit of the trace.
    pub filter: Vec<f64>,
    /// Standard deviation of the noise in the unit of the trace.
    pub sigma: f64,
}

impl Whitening {
    /// Of white noise with this standard deviation.
    pub fn white(sigma: f64) -> Self {
        let filter = vec![1.0 / sigma];
        Self { filter, sigma }
    }

    /// Of the noise in a quiet part, whose mean is zero.
    pub fn of_quiet(quiet: &[f64]) -> Self {
        let (count, power) = (quiet.len(), mean_square(quiet));
        let most = (count / SAMPLES_PER_COEFFICIENT).min(LARGEST_ORDER);
        let criterion = |power: f64, order: usize| {
            let free = count as f64 - order as f64 - 2.0;
            count as f64 * (power.ln() + 2.0 * (order as f64 + 1.0) / free)
        };
        let (mut filter, mut error) = (vec![1.0], power);
        let mut best = (criterion(power, 0), filter.clone(), power);
        let (mut forward, mut backward) = (quiet.to_vec(), quiet.to_vec());
        for order in 1..=most {
            let (ahead, behind) = (&forward[order..], &backward[order - 1..count - 1]);
            let square = dot(ahead, ahead) + dot(behind, behind);
            if square <= 0.0 {
                break;
            }
            let reflection = -2.0 * dot(ahead, behind) / square;
            for i in (order..count).rev() {
                let (f, b) = (forward[i], backward[i - 1]);
                (forward[i], backward[i]) = (f + reflection * b, b + reflection * f);
            }
            filter.push(0.0);
            let turned = filter.clone().into_iter().rev();
            let pairs = filter.iter_mut().zip(turned);
            pairs.for_each(|(a, b)| *a += reflection * b);
            error *= 1.0 - reflection * reflection;
            let found = criterion(error, order);
            if found < best.0 {
                // each coefficient fits a sample's worth of noise away
                let lost = count as f64 / (count - order) as f64;
                best = (found, filter.clone(), error * lost);
            }
        }
        let scale = best.2.sqrt().recip();
        let filter = best.1.iter().map(|a| a * scale).collect();
        Self {
            filter,
            sigma: power.sqrt(),
        }
    }

    /// Order of the autoregressive model; 0 is white noise.
    pub fn order(&self) -> usize {
        self.filter.len() - 1
    }

    /// Standard error of the mean of so many samples.
    pub(crate) fn error_of_mean(&self, count: usize) -> f64 {
        1.0 / (self.filter.iter().sum::<f64>().abs() * (count as f64).sqrt())
    }

    /// The filtered samples, which are zero before the first; `stride` samples lie between two coefficients.
    pub fn apply(&self, samples: &[f64], stride: usize) -> Vec<f64> {
        let mut out = vec![0.0; samples.len()];
        for (lag, a) in self.filter.iter().enumerate() {
            for (value, sample) in out.iter_mut().skip(lag * stride).zip(samples) {
                *value += a * sample;
            }
        }
        out
    }
}

/// Mean of the squares.
pub(crate) fn mean_square(samples: &[f64]) -> f64 {
    dot(samples, samples) / samples.len().max(1) as f64
}
