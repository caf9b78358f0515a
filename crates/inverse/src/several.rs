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
    /// Mean of the aligned samples of each sensor.
    pub mean: Vec<Vec<f64>>,
    /// Standard deviation of the mean of each sensor, from the scatter of the drops.
    pub sd: Vec<Vec<f64>>,
    /// Time in s by which each drop is later than the first.
    pub shifts_s: Vec<f64>,
}

/// Correlation below which a drop is another event.
const LEAST_CORRELATION: f64 = 0.5;

/// The mean of repeated drops of the same ball from the same height, each with a trace of every sensor, aligned by correlation.
///
/// All traces of a drop have one shift, at which their correlation with those of the first drop is largest; between samples they are read by cubic interpolation. Samples that a shift brings in from outside a trace are zero.
///
/// # Errors
/// [`InverseError`] for fewer than two drops, drops without traces, traces of different lengths or numbers, samples that are not
/// finite, and a drop that does not resemble the first.
pub fn average(drops: &[Vec<Vec<f64>>], step_s: f64) -> Result<Averaged, InverseError> {
    positive("step_s", step_s)?;
    let count = drops.len() as f64;
    check(drops.len() > 1, "the number of drops", count, "[2, inf)")?;
    let (sensors, size) = (drops[0].len(), drops[0].first().map_or(0, Vec::len));
    let key = "the number of samples of a drop";
    check(size > 3, key, size as f64, "[4, inf)")?;
    for (drop, number) in drops.iter().zip(1..) {
        let key = format!("the number of traces of drop {number}");
        let range = format!("[{sensors}, {sensors}]");
        check(drop.len() == sensors, &key, drop.len() as f64, &range)?;
        for trace in drop {
            finite(&format!("drop {number}"), trace)?;
            if trace.len() != size {
                let key = format!("the number of samples of drop {number}");
                let (found, range) = (trace.len() as f64, format!("[{size}, {size}]"));
                let remedy = ": cut all drops to the same length";
                return Err(InverseError::outside(&key, found, &range, remedy));
            }
        }
    }
    let mut shifts = Vec::new();
    for (drop, number) in drops.iter().zip(1..) {
        let (shift, correlation) = delay(drop, &drops[0]);
        if correlation < LEAST_CORRELATION {
            let key = format!("the correlation of drop {number} with the first");
            let range = format!("[{LEAST_CORRELATION}, 1]");
            let remedy = ": remove it, or average drops of the same ball, height and place only";
            return Err(InverseError::outside(&key, correlation, &range, remedy));
        }
        shifts.push(shift);
    }
    let (mut mean, mut sd) = (Vec::new(), Vec::new());
    for sensor in 0..sensors {
        let drops = drops.iter().zip(&shifts);
        let aligned = drops.map(|(drop, shift)| {
            let sample = |i: usize| at(&drop[sensor], i as f64 + shift);
            (0..size).map(sample).collect()
        });
        let aligned: Vec<Vec<f64>> = aligned.collect();
        let sample = |i: usize| aligned.iter().map(|drop| drop[i]).sum::<f64>() / count;
        let own: Vec<f64> = (0..size).map(sample).collect();
        let scatter = |i: usize| {
            let squares = aligned.iter().map(|drop| (drop[i] - own[i]).powi(2));
            (squares.sum::<f64>() / (count * (count - 1.0))).sqrt()
        };
        sd.push((0..size).map(scatter).collect());
        mean.push(own);
    }
    Ok(Averaged {
        mean,
        sd,
        shifts_s: shifts.iter().map(|shift| shift * step_s).collect(),
    })
}

/// Samples by which the traces of a drop are later than those of another, with their correlation there. Sensors count by the inverse
/// of the variance of their noise, of which the second differences tell.
fn delay(drop: &[Vec<f64>], other: &[Vec<f64>]) -> (f64, f64) {
    let count = other[0].len();
    let most = count / 2;
    let weight = |trace: &Vec<f64>| {
        let bends = trace.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).powi(2));
        let square = bends.sum::<f64>();
        if square > 0.0 { square.recip() } else { 0.0 }
    };
    let weights: Vec<f64> = other.iter().map(weight).collect();
    let sum = |product: &dyn Fn(&[f64], &[f64]) -> f64| -> f64 {
        let pairs = drop.iter().zip(other).zip(&weights);
        pairs
            .map(|((own, other), weight)| weight * product(own, other))
            .sum()
    };
    let size = (sum(&|own, _| dot(own, own)) * sum(&|_, other| dot(other, other))).sqrt();
    // a lag of -most is the place 0
    let correlation = |place: usize| {
        let (late, early) = (place.saturating_sub(most), most.saturating_sub(place));
        let product =
            sum(&|own, other| dot(&own[late..count - early], &other[early..count - late]));
        if size > 0.0 { product / size } else { 0.0 }
    };
    let correlations: Vec<f64> = (0..=2 * most).map(correlation).collect();
    let best = (1..2 * most).max_by(|&i, &j| correlations[i].total_cmp(&correlations[j]));
    let best = best.unwrap_or(most);
    let [a, b, c] = [-1, 0, 1].map(|one| correlations[best.saturating_add_signed(one)]);
    let curvature = a - 2.0 * b + c;
    let between = if curvature < 0.0 {
        (0.5 * (a - c) / curvature).clamp(-0.5, 0.5)
    } else {
        0.0
    };
    (best as f64 - most as f64 + between, b)
}

/// A trace between its samples, by the cubic of Catmull and Rom through four; zero outside.
fn at(trace: &[f64], place: f64) -> f64 {
    let (first, s) = (place.floor() as isize - 1, place - place.floor());
    let sample = |i: isize| usize::try_from(i).ok().and_then(|i| trace.get(i));
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| sample(first + i).copied().unwrap_or(0.0));
    let bend = 2.0 * a - 5.0 * b + 4.0 * c - d;
    b + 0.5 * s * (c - a + s * (bend + s * (3.0 * (b - c) + d - a)))
}
