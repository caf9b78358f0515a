//! One axis: what it shows, in which unit, over which values.

use crate::interval::{Interval, Scale};

/// In which unit an axis or a colour bar shows its values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unit {
    /// A number without unit.
    One,
    /// A unit that takes SI prefixes, such as `s`, `N`, `m/s`; values are in the unit itself.
    ///
    /// A linear axis shows the prefix that suits its values: seconds of 1e-5 are shown as 10 µs.
    Si(String),
    /// Any other unit, shown as it stands, such as `r_{0}/c_{1}` or `kg`.
    Fixed(String),
}

/// In which direction the values of an axis grow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// To the right, or upward.
    Usual,
    /// To the left, or downward: depths.
    Reversed,
}

/// One axis.
#[must_use]
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What it shows: "contact force".
    pub quantity: String,
    /// Its unit.
    pub unit: Unit,
    /// How values are spread along it.
    pub scale: Scale,
    /// Values from and to; none: those of the panel's layers, with a little air.
    pub range: Option<(f64, f64)>,
    /// Where it grows to.
    pub direction: Direction,
}

impl Axis {
    /// A linear axis of a number without unit, over the values of the panel's layers.
    pub fn linear(quantity: &str) -> Self {
        Self {
            quantity: quantity.to_owned(),
            unit: Unit::One,
            scale: Scale::Linear,
            range: None,
            direction: Direction::Usual,
        }
    }

    /// The same, logarithmic.
    pub fn logarithmic(quantity: &str) -> Self {
        Self {
            scale: Scale::Logarithmic,
            ..Self::linear(quantity)
        }
    }

    /// An axis of a given interval.
    pub fn over(interval: Interval, quantity: &str) -> Self {
        Self {
            scale: interval.scale,
            range: Some((interval.low, interval.high)),
            ..Self::linear(quantity)
        }
    }

    /// With a unit that takes SI prefixes.
    pub fn si(mut self, unit: &str) -> Self {
        self.unit = Unit::Si(unit.to_owned());
        self
    }

    /// With a unit that is shown as it stands.
    pub fn unit(mut self, unit: &str) -> Self {
        self.unit = Unit::Fixed(unit.to_owned());
        self
    }

    /// From and to given values.
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }

    /// Growing downward or to the left.
    pub fn reversed(mut self) -> Self {
        self.direction = Direction::Reversed;
        self
    }

    /// Its interval, where it is given.
    pub fn interval(&self) -> Option<Interval> {
        self.range.map(|(low, high)| Interval {
            scale: self.scale,
            low,
            high,
        })
    }

    /// Quantity and unit without a prefix: "time \[s\]".
    pub fn label(&self) -> String {
        match &self.unit {
            Unit::One => self.quantity.clone(),
            Unit::Si(unit) | Unit::Fixed(unit) => format!("{} [{unit}]", self.quantity),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_label_has_its_unit() {
        assert_eq!(Axis::linear("time").si("s").label(), "time [s]");
        assert_eq!(Axis::logarithmic("error").label(), "error");
        let axis = Axis::over(Interval::logarithmic(1.0, 9.0), "length").unit("r0");
        assert_eq!(axis.interval(), Some(Interval::logarithmic(1.0, 9.0)));
        assert_eq!(axis.label(), "length [r0]");
    }
}
