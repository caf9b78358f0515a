//! Ticks: round values whose labels fit beside one another.

mod linear;
mod logarithmic;
mod prefix;

pub(crate) use prefix::shown;

use crate::interval::{Interval, Scale};

/// A tick with a label, as markup.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) label: String,
}

/// Ticks of an axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ticks {
    /// Those with labels.
    pub(crate) major: Vec<Tick>,
    /// Shorter ones between them.
    pub(crate) minor: Vec<f64>,
}

/// How much room ticks have.
pub(crate) struct Room<'a> {
    /// Length of the axis in pixels.
    pub(crate) length: f64,
    /// Wished distance of two labels in pixels.
    pub(crate) distance: f64,
    /// Pixels that a label needs along the axis, with a gap.
    pub(crate) needs: &'a dyn Fn(&str) -> f64,
}

impl Room<'_> {
    /// Whether labels fit beside one another.
    fn fits(&self, interval: &Interval, ticks: &[Tick]) -> bool {
        ticks.windows(2).all(|pair| {
            let distance = interval.fraction(pair[1].value) - interval.fraction(pair[0].value);
            let needed = 0.5 * ((self.needs)(&pair[0].label) + (self.needs)(&pair[1].label));
            distance.abs() * self.length >= needed
        })
    }
}

/// Ticks over an interval whose labels are values over `factor`.
pub(crate) fn ticks(interval: &Interval, factor: f64, room: &Room<'_>) -> Ticks {
    match interval.scale {
        Scale::Linear => linear::ticks(interval, factor, room),
        Scale::Logarithmic => logarithmic::ticks(interval, factor, room),
    }
}
