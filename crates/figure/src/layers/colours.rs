//! Limits of a colour map.

use crate::axis::{Axis, Interval, Scale};
use crate::colour::ColourMap;

/// Meaning of the colours of some images.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Colours {
    pub(crate) axis: Axis,
    pub(crate) map: ColourMap,
    pub(crate) limits: Interval,
    /// Whether there are values below and above the limits.
    pub(crate) beyond: [bool; 2],
}

impl Colours {
    /// The colours of a map for some values; the range of the axis, if given, sets the limits.
    pub(super) fn new(
        axis: &Axis,
        map: ColourMap,
        values: &(impl Iterator<Item = f64> + Clone),
    ) -> Self {
        let limits = limits(axis, map, values.clone());
        let shown = || values.clone().filter(|value| limits.scale.shows(*value));
        Self {
            axis: axis.clone(),
            map,
            limits,
            beyond: [
                shown().any(|value| limits.fraction(value) < -1e-9),
                shown().any(|value| limits.fraction(value) > 1.0 + 1e-9),
            ],
        }
    }

    /// The colour of a value; none if it is not shown.
    pub(crate) fn of_value(&self, value: f64) -> Option<u32> {
        let is_shown = self.limits.scale.shows(value) || value.is_infinite() && value > 0.0;
        is_shown.then(|| self.map.at(self.limits.fraction(value)))
    }
}

/// The values at the ends of a colour map: those of the axis, or the range of all values that it can show.
///
/// A diverging map is linear with limits of equal magnitude, so that zero is always white.
fn limits(axis: &Axis, map: ColourMap, values: impl Iterator<Item = f64>) -> Interval {
    let scale = match map {
        ColourMap::Diverging => Scale::Linear,
        ColourMap::Sequential => axis.scale,
    };
    let all = || Interval::around(scale, values).map(|found| (found.low, found.high));
    let (a, b) = axis.range.or_else(all).unwrap_or_default();
    let found = match map {
        ColourMap::Diverging => Interval::linear(-a.abs().max(b.abs()), a.abs().max(b.abs())),
        ColourMap::Sequential => Interval::new(scale, a.min(b), a.max(b)),
    };
    // a single value, or none, becomes an interval
    match scale {
        Scale::Logarithmic if found.low <= 0.0 => Interval::logarithmic(1.0, 1.0).with_air(0.0),
        Scale::Linear | Scale::Logarithmic => found.with_air(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(map: ColourMap, axis: &Axis, values: &[f64]) -> (f64, f64) {
        let found = limits(axis, map, values.iter().copied());
        (found.low, found.high)
    }

    #[test]
    fn decades_are_spread_over_what_is_positive() {
        let axis = Axis::logarithmic("");
        let values = [0.0, -3.0, 1e-6, f64::NAN, 10.0];
        assert_eq!(of(ColourMap::Sequential, &axis, &values), (1e-6, 10.0));
        let none = limits(&axis, ColourMap::Sequential, [0.0].into_iter());
        assert!(none.is_valid());
        let from_zero = Axis::logarithmic("").range(0.0, 1e8);
        assert!(of(ColourMap::Sequential, &from_zero, &values).0 > 0.0);
    }

    #[test]
    fn a_diverging_map_has_zero_in_its_middle() {
        let (all, given) = (Axis::linear(""), Axis::linear("").range(-1.0, 3.0));
        let diverging = |axis, values: &[f64]| of(ColourMap::Diverging, axis, values);
        assert_eq!(diverging(&all, &[-1.0, 4.0]), (-4.0, 4.0));
        assert_eq!(diverging(&given, &[]), (-3.0, 3.0));
        assert_eq!(diverging(&all, &[]), (-1.0, 1.0));
        assert_eq!(of(ColourMap::Sequential, &all, &[2.0, 2.0]), (1.0, 3.0));
    }
}
