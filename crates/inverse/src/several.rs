//! Several traces: the force without each of them, and the mean of repeated drops.

use crate::deconvolve::{ForceHistory, Normal};
use crate::error::{InverseError, check, finite, positive};
use crate::nnls::dot;

/// Results without each of the traces, with the gains and the smoothness of all.
#[derive(Debug, Clone, PartialEq)]
pub struct Jackknife {
    /// Peak in N without each trace.
    pub peak_n: Vec<f64>,
    /// Impulse in N s without each trace.
    pub impulse_n_s: Vec<f64>,
    /// Standard deviation of the peak in N by the jackknife.
    pub peak_sd_n: f64,
    /// Standard deviation of the impulse in N s by the jackknife.
    pub impulse_sd_n_s: f64,
}

/// The force without each trace; none of a single trace.
pub(crate) fn jackknife(
    normal: &Normal,
    history: &ForceHistory,
) -> Result<Option<Jackknife>, InverseError> {
    let (gains, lambda) = (&history.gains, history.lambda);
    if gains.len() < 2 {
        return Ok(None);
    }
    let (mut peak_n, mut impulse_n_s) = (Vec::new(), Vec::new());
    for k in 0..gains.len() {
        let others = normal.stacked(gains, Some(k));
        let force = normal.solve(&others, lambda, &history.force_n)?.x;
        peak_n.push(force.iter().copied().fold(0.0, f64::max));
        impulse_n_s.push(history.step_s * force.iter().sum::<f64>());
    }
    let sd = |values: &[f64]| {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        ((count - 1.0) / count * values.iter().map(|x| (x - mean).powi(2)).sum::<f64>()).sqrt()
    };
    Ok(Some(Jackknife {
        peak_sd_n: sd(&peak_n),
        impulse_sd_n_s: sd(&impulse_n_s),
        peak_n,
        impulse_n_s,
    }))
}

/// The mean of repeated drops.
#[derive(Debug, Clone, PartialEq)]
pub struct Averaged {
    /// Mean of the aligned traces.
    pub mean: Vec<f64>,
    /// Standard deviation of the mean, from the scatter of the drops.
    pub sd: Vec<f64>,
    /// Time in s by which each drop is later than the first.
    pub shifts_s: Vec<f64>,
}

/// Correlation below which a drop is another event.
const LEAST_CORRELATION: f64 = 0.5;

/// The mean of repeated drops of the same ball from the same height, aligned by correlation.
///
/// Each trace is shifted to the largest correlation with the first; between samples it is read by cubic interpolation. Samples that a shift brings in from outside a trace are zero.
///
/// # Errors
/// [`InverseError`] for fewer than two drops, drops of different lengths, samples that are not finite, and a drop that does
/// not resemble the others.
pub fn average(drops: &[Vec<f64>], step_s: f64) -> Result<Averaged, InverseError> {
    positive("step_s", step_s)?;
    let (count, size) = (drops.len() as f64, drops.first().map_or(0, Vec::len));
    check(drops.len() > 1, "the number of drops", count, "[2, inf)")?;
    let key = "the number of samples of a drop";
    check(size > 3, key, size as f64, "[4, inf)")?;
    for (index, drop) in drops.iter().enumerate() {
        finite(&format!("drop {}", index + 1), drop)?;
        if drop.len() != size {
            let key = format!("the number of samples of drop {}", index + 1);
            let (found, range) = (drop.len() as f64, format!("[{size}, {size}]"));
            let remedy = ": cut all drops to the same length";
            return Err(InverseError::outside(&key, found, &range, remedy));
        }
    }
    let (mut shifts, mut aligned) = (Vec::new(), Vec::new());
    for (index, drop) in drops.iter().enumerate() {
        let (shift, correlation) = delay(drop, &drops[0]);
        if correlation < LEAST_CORRELATION {
            let key = format!("the correlation of drop {} with the first", index + 1);
            let range = format!("[{LEAST_CORRELATION}, 1]");
            let remedy = ": remove it, or average drops of the same ball, height and place only";
            return Err(InverseError::outside(&key, correlation, &range, remedy));
        }
        let samples = (0..size).map(|i| at(drop, i as f64 + shift));
        aligned.push(samples.collect::<Vec<f64>>());
        shifts.push(shift);
    }
    let sample = |i: usize| aligned.iter().map(|drop| drop[i]).sum::<f64>() / count;
    let mean: Vec<f64> = (0..size).map(sample).collect();
    let sd = |i: usize| {
        let squares = aligned.iter().map(|drop| (drop[i] - mean[i]).powi(2));
        (squares.sum::<f64>() / (count * (count - 1.0))).sqrt()
    };
    Ok(Averaged {
        sd: (0..size).map(sd).collect(),
        shifts_s: shifts.iter().map(|shift| shift * step_s).collect(),
        mean,
    })
}

/// Samples by which a trace is later than another, with the correlation there.
fn delay(trace: &[f64], other: &[f64]) -> (f64, f64) {
    let (count, most) = (trace.len(), trace.len() / 2);
    // a lag of -most is the place 0
    let product = |place: usize| {
        let (late, early) = (place.saturating_sub(most), most.saturating_sub(place));
        dot(&trace[late..count - early], &other[early..count - late])
    };
    let products: Vec<f64> = (0..=2 * most).map(product).collect();
    let best = (1..2 * most).max_by(|&i, &j| products[i].total_cmp(&products[j]));
    let best = best.unwrap_or(most);
    let [a, b, c] = [products[best - 1], products[best], products[best + 1]];
    let curvature = a - 2.0 * b + c;
    let between = if curvature < 0.0 {
        (0.5 * (a - c) / curvature).clamp(-0.5, 0.5)
    } else {
        0.0
    };
    let size = (dot(trace, trace) * dot(other, other)).sqrt();
    let correlation = if size > 0.0 { b / size } else { 0.0 };
    (best as f64 - most as f64 + between, correlation)
}

/// A trace between its samples, by the cubic of Catmull and Rom through four; zero outside.
fn at(trace: &[f64], place: f64) -> f64 {
    let (first, s) = (place.floor() as isize - 1, place - place.floor());
    let sample = |i: isize| usize::try_from(i).ok().and_then(|i| trace.get(i));
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| sample(first + i).copied().unwrap_or(0.0));
    let bend = 2.0 * a - 5.0 * b + 4.0 * c - d;
    b + 0.5 * s * (c - a + s * (bend + s * (3.0 * (b - c) + d - a)))
}
