//! Curves over time, thin enough to draw.

/// Points of a curve that is drawn: with more, parts of it are drawn by their extremes.
const MOST_POINTS: usize = 4000;

/// A curve over times up to an end, with its extremes kept where there are too many samples.
pub(crate) fn curve(time_s: &[f64], samples: &[f64], end_s: f64) -> Vec<(f64, f64)> {
    let count = time_s.partition_point(|&t| t <= end_s);
    let points: Vec<(f64, f64)> = time_s[..count]
        .iter()
        .copied()
        .zip(samples.iter().copied())
        .collect();
    thinned(points)
}

fn thinned(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_curves_keep_their_extremes() {
        let time: Vec<f64> = (0..100_000).map(f64::from).collect();
        let mut samples: Vec<f64> = time.iter().map(|t| (0.01 * t).sin()).collect();
        samples[54_321] = 7.0;
        let found = curve(&time, &samples, 90_000.0);
        assert!(found.len() <= MOST_POINTS + 4 && found.contains(&(54_321.0, 7.0)));
        assert!(found.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(found.last().map(|p| p.0), Some(90_000.0));
        assert_eq!(curve(&time[..10], &samples, 4.0).len(), 5);
    }
}
