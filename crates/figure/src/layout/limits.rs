//! Which values get the colours at the ends of a map.

use crate::colour::ColourMap;
use crate::interval::{Interval, Scale};
use crate::layer::{ColourScale, Limits};

/// The interval of a scale over values; those that it cannot show do not count.
pub(crate) fn limits<'a>(scale: &ColourScale, values: impl Iterator<Item = &'a f64>) -> Interval {
    let spread = match scale.map {
        ColourMap::Diverging => Scale::Linear,
        ColourMap::Sequential => scale.spread,
    };
    let (low, high) = ends(scale, values.copied().filter(|&v| spread.shows(v)));
    Interval {
        scale: spread,
        low,
        high,
    }
}

/// The ends of a scale over values, low below high.
fn ends(scale: &ColourScale, values: impl Iterator<Item = f64>) -> (f64, f64) {
    let mut known: Vec<f64> = values.collect();
    known.sort_by(f64::total_cmp);
    let found = match (scale.map, scale.limits) {
        (_, Limits::Between(low, high)) => (low.min(high), low.max(high)),
        (ColourMap::Sequential, Limits::All) => (quantile(&known, 0.0), quantile(&known, 1.0)),
        (ColourMap::Sequential, Limits::Percentile(percent)) => {
            let most = (0.01 * percent).clamp(0.5, 1.0);
            (quantile(&known, 1.0 - most), quantile(&known, most))
        }
        (ColourMap::Diverging, Limits::All | Limits::Percentile(_)) => {
            let mut sizes: Vec<f64> = known.iter().map(|v| v.abs()).collect();
            sizes.sort_by(f64::total_cmp);
            let most = match scale.limits {
                Limits::Percentile(percent) => (0.01 * percent).clamp(0.0, 1.0),
                Limits::All | Limits::Between(..) => 1.0,
            };
            let size = quantile(&sizes, most);
            (-size, size)
        }
    };
    let (low, high) = match scale.map {
        // white is zero whatever was asked for
        ColourMap::Diverging => {
            let size = found.0.abs().max(found.1.abs());
            (-size, size)
        }
        ColourMap::Sequential => found,
    };
    if low < high {
        return (low, high);
    }
    // one value only, or none
    if scale.spread == Scale::Logarithmic {
        let middle = if low > 0.0 { low } else { 1.0 };
        return (middle / 3.0, middle * 3.0);
    }
    let half = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
    (low - half, high + half)
}

/// The value below which a fraction of sorted values lies; 0 without values.
fn quantile(sorted: &[f64], fraction: f64) -> f64 {
    let last = sorted.len().saturating_sub(1) as f64;
    sorted
        .get((fraction * last).round() as usize)
        .copied()
        .unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::Unit;

    fn of(map: ColourMap, which: Limits, values: &[f64]) -> (f64, f64) {
        let scale = ColourScale::new("", Unit::One, map).limits(which);
        let found = limits(&scale, values.iter());
        (found.low, found.high)
    }

    #[test]
    fn decades_are_spread_over_what_is_positive() {
        let scale = ColourScale::new("", Unit::One, ColourMap::Sequential).logarithmic();
        let found = limits(&scale, [0.0, -3.0, 1e-6, f64::NAN, 10.0].iter());
        assert_eq!(found, Interval::logarithmic(1e-6, 10.0));
        assert!(limits(&scale, [0.0].iter()).is_valid());
    }

    #[test]
    fn one_singular_place_does_not_decide() {
        let mut values: Vec<f64> = (0..1000).map(|i| f64::from(i) / 1000.0).collect();
        values.extend([1e9, f64::NAN, f64::INFINITY]);
        let (low, high) = of(ColourMap::Diverging, Limits::Percentile(99.0), &values);
        assert!(high < 1.0 && high > 0.98 && low == -high);
        let (low, high) = of(ColourMap::Sequential, Limits::Percentile(99.0), &values);
        assert!((low - 0.01).abs() < 2e-3 && high < 1.0);
        assert_eq!(of(ColourMap::Sequential, Limits::All, &values).1, 1e9);
    }

    #[test]
    fn a_diverging_map_has_zero_in_its_middle() {
        assert_eq!(
            of(ColourMap::Diverging, Limits::All, &[-1.0, 4.0]),
            (-4.0, 4.0)
        );
        assert_eq!(
            of(ColourMap::Diverging, Limits::Between(-1.0, 3.0), &[]),
            (-3.0, 3.0)
        );
        assert_eq!(
            of(ColourMap::Sequential, Limits::All, &[2.0, 2.0]),
            (1.0, 3.0)
        );
        assert_eq!(of(ColourMap::Diverging, Limits::All, &[]), (-1.0, 1.0));
    }
}
