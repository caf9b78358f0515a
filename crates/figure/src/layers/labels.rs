//! What is only labelled: vertical lines and single points. They are drawn over all other layers.

use super::Kind;
use crate::geometry::{Frame, Point};

/// A vertical line with a label above the panel: an arrival, the end of validity.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Its place; not drawn outside the axis.
    pub x: f64,
    /// What is written above it.
    pub label: String,
}

impl Mark {
    /// A vertical line.
    pub fn new(x: f64, label: &str) -> Self {
        let label = label.to_owned();
        Self { x, label }
    }
}

impl Kind for Mark {
    fn places(&self) -> Vec<Point> {
        vec![(self.x, f64::NAN)]
    }

    fn curves(&self, frame: &Frame) -> Vec<Vec<Point>> {
        vec![vec![(self.x, frame.y.low), (self.x, frame.y.high)]]
    }
}

/// A point with a label.
#[derive(Debug, Clone, PartialEq)]
pub struct LabelledPoint {
    /// Place on the x axis; the point is not drawn outside the axes.
    pub x: f64,
    /// Place on the y axis.
    pub y: f64,
    /// What is written at it.
    pub label: String,
    /// Whether a star stands there; otherwise the label itself does, the name of a curve or of a region.
    pub is_starred: bool,
}

impl LabelledPoint {
    /// A star with a label beside it.
    pub fn new(x: f64, y: f64, label: &str) -> Self {
        Self {
            x,
            y,
            label: label.to_owned(),
            is_starred: true,
        }
    }

    /// A label alone, on the point or near it.
    pub fn text(x: f64, y: f64, label: &str) -> Self {
        Self {
            is_starred: false,
            ..Self::new(x, y, label)
        }
    }
}

impl Kind for LabelledPoint {
    fn places(&self) -> Vec<Point> {
        vec![(self.x, self.y)]
    }
}
