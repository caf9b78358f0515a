//! Sizes of texts and distances, in pixels.

use crate::text::LINE;

/// Width of the sample of a curve in a legend.
pub(crate) const SWATCH: f64 = 30.0;

/// Sizes of all texts, from that at the ticks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Typeface {
    pub(crate) tick: f64,
    pub(crate) label: f64,
    pub(crate) legend: f64,
    pub(crate) mark: f64,
    pub(crate) panel: f64,
    pub(crate) subtitle: f64,
    pub(crate) title: f64,
}

impl Typeface {
    pub(crate) fn new(tick: f64) -> Self {
        Self {
            tick,
            label: 1.15 * tick,
            legend: 1.04 * tick,
            mark: 0.95 * tick,
            panel: 1.15 * tick,
            subtitle: 1.1 * tick,
            title: 1.4 * tick,
        }
    }

    /// Height of so many lines of a size.
    pub(crate) fn lines(size: f64, count: usize) -> f64 {
        LINE * size * count as f64
    }

    /// Length of a tick with a label.
    pub(crate) fn tick_length(&self) -> f64 {
        0.42 * self.tick
    }

    /// Length of a tick without one.
    pub(crate) fn minor_length(&self) -> f64 {
        0.23 * self.tick
    }

    /// A small distance.
    pub(crate) fn gap(&self) -> f64 {
        0.5 * self.tick
    }
}
