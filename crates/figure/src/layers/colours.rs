//! What colours mean, and which values get the colours at the ends of a map.

use crate::axis::{Interval, Scale, Unit};
use crate::colour::{Colour, ColourMap};
use crate::layers::Image;

/// What colours mean.
#[must_use]
#[derive(Debug, Clone, PartialEq)]
pub struct ColourScale {
    /// What is shown: "axial stress".
    pub quantity: String,
    /// Its unit.
    pub unit: Unit,
    /// Colours.
    pub map: ColourMap,
    /// Which values get the colours at the ends.
    pub limits: Limits,
    /// How colours are spread between them; a diverging map is linear always.
    pub spread: Scale,
}

impl ColourScale {
    /// A scale from the smallest value to the largest.
    pub fn new(quantity: &str, unit: Unit, map: ColourMap) -> Self {
        Self {
            quantity: quantity.to_owned(),
            unit,
            map,
            limits: Limits::All,
            spread: Scale::Linear,
        }
    }

    /// With equal steps of colour for equal ratios: magnitudes over decades. What is not positive is left white.
    pub fn logarithmic(mut self) -> Self {
        self.spread = Scale::Logarithmic;
        self
    }

    /// With other limits.
    pub fn limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// The values whose colours are at the ends of the map; those that it cannot show do not count.
    fn interval<'a>(&self, values: impl Iterator<Item = &'a f64>) -> Interval {
        let spread = match self.map {
            ColourMap::Diverging => Scale::Linear,
            ColourMap::Sequential => self.spread,
        };
        let mut known: Vec<f64> = values.copied().filter(|&v| spread.shows(v)).collect();
        if self.map == ColourMap::Diverging {
            for value in &mut known {
                *value = value.abs();
            }
        }
        known.sort_by(f64::total_cmp);
        let most = match self.limits {
            Limits::Percentile(percent) => 0.01 * percent,
            Limits::All | Limits::Between(..) => 1.0,
        };
        let (low, high) = match (self.limits, self.map) {
            (Limits::Between(low, high), ColourMap::Sequential) => (low.min(high), low.max(high)),
            // white is zero whatever was asked for
            (Limits::Between(low, high), ColourMap::Diverging) => {
                let size = low.abs().max(high.abs());
                (-size, size)
            }
            (Limits::All | Limits::Percentile(_), ColourMap::Sequential) => {
                let most = most.clamp(0.5, 1.0);
                (quantile(&known, 1.0 - most), quantile(&known, most))
            }
            (Limits::All | Limits::Percentile(_), ColourMap::Diverging) => {
                let size = quantile(&known, most.clamp(0.0, 1.0));
                (-size, size)
            }
        };
        let found = Interval::new(spread, low, high);
        match spread {
            Scale::Logarithmic if low <= 0.0 => Interval::logarithmic(1.0, 1.0).with_air(0.0),
            _ if low < high => found,
            // one value only, or none
            Scale::Linear | Scale::Logarithmic => found.with_air(0.0),
        }
    }
}

/// Which values get the colours at the ends of a map; a diverging map's limits are always equal in size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limits {
    /// The smallest and the largest value.
    All,
    /// All but the largest values: this percentage of the sizes is below the limit (of a sequential map: of the
    /// values, and the same at the low end), so that one singular place does not leave the rest white.
    Percentile(f64),
    /// These.
    Between(f64, f64),
}

/// The value below which a fraction of sorted values lies; 0 without values.
fn quantile(sorted: &[f64], fraction: f64) -> f64 {
    let last = sorted.len().saturating_sub(1) as f64;
    let found = sorted.get((fraction * last).round() as usize);
    found.copied().unwrap_or(0.0)
}

/// Colours of some images with their limits.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Colours {
    pub(crate) scale: ColourScale,
    pub(crate) limits: Interval,
    /// Whether values lie below and above the limits.
    pub(crate) beyond: [bool; 2],
}

impl Colours {
    /// Those of the first image, for the values of all; none without an image.
    pub(crate) fn of(images: &[&Image]) -> Option<Self> {
        let scale = images.first()?.colours.clone();
        let values = || images.iter().flat_map(|image| &image.values);
        let limits = scale.interval(values());
        let place = |value: &f64| limits.scale.shows(*value).then(|| limits.fraction(*value));
        Some(Self {
            beyond: [
                values().filter_map(place).any(|at| at < -1e-9),
                values().filter_map(place).any(|at| at > 1.0 + 1e-9),
            ],
            scale,
            limits,
        })
    }

    /// The colour of a value; none for one that is not shown.
    pub(crate) fn of_value(&self, value: f64) -> Option<Colour> {
        let is_shown = self.limits.scale.shows(value) || value.is_infinite() && value > 0.0;
        is_shown.then(|| self.scale.map.at(self.limits.fraction(value)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(map: ColourMap, which: Limits, values: &[f64]) -> (f64, f64) {
        let scale = ColourScale::new("", Unit::One, map).limits(which);
        let found = scale.interval(values.iter());
        (found.low, found.high)
    }

    #[test]
    fn decades_are_spread_over_what_is_positive() {
        let scale = ColourScale::new("", Unit::One, ColourMap::Sequential).logarithmic();
        let found = scale.interval([0.0, -3.0, 1e-6, f64::NAN, 10.0].iter());
        assert_eq!(found, Interval::logarithmic(1e-6, 10.0));
        assert!(scale.interval([0.0].iter()).is_valid());
        let from_zero = scale.limits(Limits::Between(0.0, 1e8));
        assert!(from_zero.interval([1.0].iter()).low > 0.0);
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
