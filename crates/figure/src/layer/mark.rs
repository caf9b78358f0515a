//! Labels in a panel: vertical lines and single points.

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
    #[must_use]
    pub fn new(x: f64, label: &str) -> Self {
        Self {
            x,
            label: label.to_owned(),
        }
    }
}

/// A star with a label beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct LabelledPoint {
    /// Place on the x axis; the point is not drawn outside the axes.
    pub x: f64,
    /// Place on the y axis.
    pub y: f64,
    /// What is written beside it.
    pub label: String,
}

impl LabelledPoint {
    /// A point.
    #[must_use]
    pub fn new(x: f64, y: f64, label: &str) -> Self {
        Self {
            x,
            y,
            label: label.to_owned(),
        }
    }
}
