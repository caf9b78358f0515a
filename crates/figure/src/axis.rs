//! Axes: quantity, unit, range of values, and positions along the axis.

/// One axis of a panel or of a colour scale.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Quantity on the axis, such as "contact force".
    pub quantity: String,
    /// Unit, such as `s`, `m/s`, `r_{0}/c_{1}`; empty for a dimensionless number.
    pub unit: String,
    /// Whether the unit accepts SI prefixes; values are in the unit without a prefix.
    ///
    /// A linear axis chooses the prefix that suits its values: times of 1e-5 s are shown as 10 µs.
    pub has_prefixes: bool,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Range of values. Default: the range of the panel's layers with a small margin.
    pub range: Option<(f64, f64)>,
    /// Whether values increase to the left, or downward as for depths.
    pub is_reversed: bool,
}

impl Axis {
    /// A linear axis of a dimensionless number, over the values of the panel's layers.
    pub fn linear(quantity: &str) -> Self {
        Self {
            quantity: quantity.to_owned(),
            unit: String::new(),
            has_prefixes: false,
            scale: Scale::Linear,
            range: None,
            is_reversed: false,
        }
    }

    /// A logarithmic axis of a dimensionless number, over the values of the panel's layers.
    pub fn logarithmic(quantity: &str) -> Self {
        Self {
            scale: Scale::Logarithmic,
            ..Self::linear(quantity)
        }
    }

    /// An axis over a given interval.
    pub fn over(interval: Interval, quantity: &str) -> Self {
        Self {
            scale: interval.scale,
            range: Some((interval.low, interval.high)),
            ..Self::linear(quantity)
        }
    }

    /// Sets a unit that accepts SI prefixes.
    pub fn si(mut self, unit: &str) -> Self {
        self.has_prefixes = true;
        self.unit(unit)
    }

    /// Sets a unit that is shown unchanged.
    pub fn unit(mut self, unit: &str) -> Self {
        unit.clone_into(&mut self.unit);
        self
    }

    /// Sets the range of values.
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }

    /// Makes values increase downward or to the left.
    pub fn reversed(mut self) -> Self {
        self.is_reversed = true;
        self
    }

    /// The given interval, if any.
    pub fn interval(&self) -> Option<Interval> {
        let (low, high) = self.range?;
        Some(Interval::new(self.scale, low, high))
    }
}

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences have equal lengths.
    Linear,
    /// Equal ratios have equal lengths.
    Logarithmic,
}

impl Scale {
    /// Whether the scale can show a value: finite, and positive on a logarithmic scale.
    pub fn shows(self, value: f64) -> bool {
        match self {
            Self::Linear => value.is_finite(),
            Self::Logarithmic => value.is_finite() && value > 0.0,
        }
    }
}

/// The values from `low` to `high`, `low < high`; both positive on a logarithmic scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Scale.
    pub scale: Scale,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// The interval between two values.
    pub fn new(scale: Scale, low: f64, high: f64) -> Self {
        Self { scale, low, high }
    }

    /// A linear interval.
    pub fn linear(low: f64, high: f64) -> Self {
        Self::new(Scale::Linear, low, high)
    }

    /// A logarithmic interval.
    pub fn logarithmic(low: f64, high: f64) -> Self {
        Self::new(Scale::Logarithmic, low, high)
    }

    /// Whether an axis can show the interval: ends finite, in order, and positive on a logarithmic scale, and length
    /// finite.
    pub fn is_valid(&self) -> bool {
        let is_long = match self.scale {
            Scale::Linear => (self.high - self.low).is_finite(),
            Scale::Logarithmic => (self.high / self.low).is_finite(),
        };
        let is_shown = self.scale.shows(self.low) && self.scale.shows(self.high);
        is_shown && is_long && self.low < self.high
    }

    /// Position of a value: 0 at the low end, 1 at the high end.
    pub fn fraction(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Logarithmic => (value / self.low).ln() / (self.high / self.low).ln(),
        }
    }

    /// The value at a position.
    pub fn value(&self, fraction: f64) -> f64 {
        match self.scale {
            Scale::Linear => self.low + fraction * (self.high - self.low),
            Scale::Logarithmic => self.low * (self.high / self.low).powf(fraction),
        }
    }

    /// Whether a value lies in the interval, up to a billionth of its length.
    pub fn contains(&self, value: f64) -> bool {
        self.scale.shows(value) && (-1e-9..=1.0 + 1e-9).contains(&self.fraction(value))
    }

    /// Centres of `count` equal cells.
    pub fn cells(&self, count: usize) -> Vec<f64> {
        (0..count)
            .map(|i| self.value((i as f64 + 0.5) / count as f64))
            .collect()
    }

    /// The smallest interval of a scale with all values that it can show; none if there are none.
    pub(crate) fn around(scale: Scale, values: impl Iterator<Item = f64>) -> Option<Self> {
        let shown = values.filter(|&value| scale.shows(value));
        let each = shown.map(|value| Self::new(scale, value, value));
        each.reduce(Self::union)
    }

    /// The smallest interval that contains both.
    pub(crate) fn union(self, other: Self) -> Self {
        let (low, high) = (self.low.min(other.low), self.high.max(other.high));
        Self::new(self.scale, low, high)
    }

    /// The interval of a scale for some values, [with a margin](Self::with_air); without valid values, one decade or
    /// the interval from 0 to 1.
    pub(crate) fn showing(scale: Scale, values: impl Iterator<Item = f64>, air: f64) -> Self {
        let usual = || match scale {
            Scale::Linear => Self::linear(0.0, 1.0),
            Scale::Logarithmic => Self::logarithmic(1.0, 10.0),
        };
        let found = Self::around(scale, values);
        found.unwrap_or_else(usual).with_air(air)
    }

    /// The interval extended by a fraction of its length at both ends; a single value becomes an interval around it.
    ///
    /// A linear end at zero is kept, so that an axis of a force that begins at zero begins at zero.
    pub(crate) fn with_air(self, air: f64) -> Self {
        if self.low < self.high {
            let end = |end: f64, aired: f64| match self.scale {
                Scale::Linear if end == 0.0 => 0.0,
                _ if air == 0.0 => end,
                Scale::Linear | Scale::Logarithmic => aired,
            };
            let low = end(self.low, self.value(-air));
            return Self::new(self.scale, low, end(self.high, self.value(1.0 + air)));
        }
        match self.scale {
            Scale::Linear => {
                let size = 0.5 * self.low.abs();
                let half = if size == 0.0 { 1.0 } else { size };
                Self::linear(self.low - half, self.high + half)
            }
            Scale::Logarithmic => Self::logarithmic(self.low / 3.0, self.high * 3.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_values_are_inverse() {
        for interval in [
            Interval::linear(-2.0, 6.0),
            Interval::logarithmic(1e-9, 30.0),
        ] {
            for fraction in [0.0, 0.2, 0.5, 1.0] {
                let back = interval.fraction(interval.value(fraction));
                assert!((back - fraction).abs() < 1e-12);
            }
            assert!(interval.contains(interval.high) && !interval.contains(40.0));
        }
        assert!((Interval::logarithmic(1.0, 100.0).fraction(10.0) - 0.5).abs() < 1e-15);
        assert_eq!(Interval::linear(0.0, 4.0).cells(4), [0.5, 1.5, 2.5, 3.5]);
    }

    #[test]
    fn what_no_axis_can_show_is_not_valid() {
        assert!(!Interval::linear(1.0, 1.0).is_valid());
        assert!(!Interval::linear(0.0, f64::NAN).is_valid());
        assert!(!Interval::logarithmic(0.0, 1.0).is_valid());
        assert!(Interval::logarithmic(1e-150, 1e150).is_valid());
        assert!(!Interval::logarithmic(1e-300, 1e300).is_valid());
    }

    #[test]
    fn values_that_cannot_be_shown_do_not_count() {
        let values = [f64::NAN, 3.0, -1.0, 0.0, f64::INFINITY, 30.0];
        let found = Interval::around(Scale::Logarithmic, values.into_iter());
        assert_eq!(found, Some(Interval::logarithmic(3.0, 30.0)));
        assert_eq!(Interval::around(Scale::Linear, std::iter::empty()), None);
        let air = Interval::linear(0.0, 10.0).with_air(0.1);
        assert_eq!((air.low, air.high), (0.0, 11.0));
        assert!(Interval::linear(2.0, 2.0).with_air(0.1).is_valid());
    }
}
