//! Counts over bins.

use crate::interval::{Interval, Scale};

/// Counts over bins.
#[derive(Debug, Clone, PartialEq)]
pub struct Histogram {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// Ends of the bins, rising, one more than there are bins.
    pub edges: Vec<f64>,
    /// What each bin holds.
    pub counts: Vec<f64>,
}

impl Histogram {
    /// Counts values over `bins` bins that are equally long on an axis of the given scale.
    ///
    /// Values that such an axis cannot show (NaN, or negative on a logarithmic one) are not counted.
    pub fn of(name: &str, values: &[f64], bins: usize, scale: Scale) -> Self {
        let bins = bins.max(1);
        let interval = Interval::around(scale, values.iter().copied()).map_or(
            Interval::linear(0.0, 1.0),
            |found| {
                if found.low < found.high {
                    found
                } else {
                    found.with_air(0.0)
                }
            },
        );
        let mut counts = vec![0.0; bins];
        for &value in values.iter().filter(|&&v| scale.shows(v)) {
            let bin = (interval.fraction(value) * bins as f64) as usize;
            counts[bin.min(bins - 1)] += 1.0;
        }
        Self {
            name: name.to_owned(),
            edges: (0..=bins)
                .map(|i| interval.value(i as f64 / bins as f64))
                .collect(),
            counts,
        }
    }

    /// The curve along the tops of the bars, from zero to zero.
    pub(crate) fn outline(&self) -> Vec<(f64, f64)> {
        let mut points = Vec::with_capacity(2 * self.counts.len() + 2);
        for (pair, &count) in self.edges.windows(2).zip(&self.counts) {
            points.extend([(pair[0], count), (pair[1], count)]);
        }
        if let (Some(&first), Some(&last)) = (self.edges.first(), self.edges.last()) {
            points.insert(0, (first, 0.0));
            points.push((last, 0.0));
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_that_can_be_shown_is_counted_once() {
        let values = [1.0, 10.0, 99.0, 100.0, -3.0, f64::NAN, 1000.0];
        let found = Histogram::of("", &values, 3, Scale::Logarithmic);
        assert_eq!(found.counts, [1.0, 2.0, 2.0]);
        assert!((found.edges[1] - 10.0).abs() < 1e-12 && found.edges.len() == 4);
        let same = Histogram::of("", &[5.0, 5.0], 4, Scale::Linear);
        assert_eq!(same.counts.iter().sum::<f64>(), 2.0);
        assert!(
            Histogram::of("", &[], 2, Scale::Linear)
                .counts
                .iter()
                .all(|&c| c == 0.0)
        );
    }

    #[test]
    fn the_outline_starts_and_ends_at_zero() {
        let found = Histogram::of("", &[0.0, 1.0, 1.0, 2.0], 2, Scale::Linear).outline();
        assert_eq!(found.first(), Some(&(0.0, 0.0)));
        assert_eq!(found.last(), Some(&(2.0, 0.0)));
        assert_eq!(found.len(), 6);
    }
}
