//! Samples over time: thinned curves, beginning and end of a force, and arrival times.

use crate::error::PlotError;
use contact::WaveSpeeds;
use formats::stored::StoredImpact;
use impact::Series;
use std::ops::Range;

/// Largest number of points of a curve; longer curves are drawn by the extremes of their parts.
const MOST_POINTS: usize = 4000;

/// A curve over a range of times and one more sample at both ends; too many samples are thinned to their extremes.
pub(crate) fn curve(time_s: &[f64], samples: &[f64], [from_s, to_s]: [f64; 2]) -> Vec<(f64, f64)> {
    let first = time_s.partition_point(|&t| t < from_s).saturating_sub(1);
    let end = (time_s.partition_point(|&t| t <= to_s) + 1).clamp(first, time_s.len());
    let pairs = time_s[first..end].iter().zip(&samples[first..end]);
    let points: Vec<(f64, f64)> = pairs.map(|(t, x)| (*t, *x)).collect();
    if points.len() <= MOST_POINTS {
        return points;
    }
    let part = points.len().div_ceil(MOST_POINTS / 4);
    let mut kept = Vec::with_capacity(MOST_POINTS + 4);
    for points in points.chunks(part) {
        let by = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let extremes = [points.iter().min_by(by), points.iter().max_by(by)];
        let mut few = vec![points[0], points[points.len() - 1]];
        few.extend(extremes.into_iter().flatten().copied());
        few.sort_by(|a, b| a.0.total_cmp(&b.0));
        few.dedup();
        kept.extend(few);
    }
    kept
}

/// The samples from the last zero before the force to the first zero after it, if they exist.
pub(crate) fn loaded(force_n: &[f64]) -> Range<usize> {
    let is_loaded = |force: &f64| *force != 0.0;
    let first = force_n.iter().position(is_loaded).unwrap_or(0);
    let last = force_n.iter().rposition(is_loaded).unwrap_or(0);
    first.saturating_sub(1)..(last + 2).min(force_n.len())
}

/// End time of a force.
pub(crate) fn end_s(series: &Series) -> f64 {
    series.time_s[loaded(&series.force_n).end - 1]
}

/// Wave speeds in the half-space of an impact, and the onset of its force in s: the onset of a record if the scene sets
/// one.
pub(crate) fn waves_of(impact: &StoredImpact) -> Result<(WaveSpeeds, f64), PlotError> {
    let series = &impact.series;
    let keys = impact.keys();
    let key = |name: &str| {
        let value = keys.iter().find(|(key, _)| key == name);
        value.and_then(|(_, value)| value.as_float())
    };
    let onset_s = key("force.onset_s").map(|t| t - key("force.start_s").unwrap_or(0.0));
    let start_s = onset_s.unwrap_or(series.time_s[loaded(&series.force_n).start]);
    Ok((WaveSpeeds::of(&impact.target)?, start_s))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_curves_keep_their_extremes() {
        let time: Vec<f64> = (0..100_000).map(f64::from).collect();
        let mut samples: Vec<f64> = time.iter().map(|t| (0.01 * t).sin()).collect();
        samples[54_321] = 7.0;
        let found = curve(&time, &samples, [0.0, 90_000.0]);
        assert!(found.len() <= MOST_POINTS + 4 && found.contains(&(54_321.0, 7.0)));
        assert!(found.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(found.last().map(|p| p.0), Some(90_001.0));
        // the lines extend to the ends of the axis
        let places = |span| -> Vec<f64> {
            let points = curve(&time[..10], &samples, span);
            points.into_iter().map(|p| p.0).collect()
        };
        assert_eq!(places([2.5, 4.5]), [2.0, 3.0, 4.0, 5.0]);
        assert_eq!(places([-1.0, 99.0]).len(), 10);
    }

    #[test]
    fn a_force_begins_where_it_leaves_zero() {
        let force = [0.0, 0.0, 3.0, 1.0, 0.0, 0.0];
        assert_eq!(loaded(&force), 1..5);
        assert_eq!(loaded(&[2.0; 6]), 0..6);
    }
}
