//! One panel: two axes and layers.

use crate::axis::Axis;
use crate::layer::{Band, Layer, Line, Mark, Style};

/// Whether lengths along both axes are equal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aspect {
    /// Each axis fills its side.
    Free,
    /// One unit is equally long on both axes: a section through the body. Both axes are linear.
    Equal,
}

/// Whether a panel shows its layers at -x as well.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mirror {
    /// Only where they are.
    Off,
    /// The same at x and -x: what does not depend on the angle, such as a pressure over r.
    Even,
    /// As `Even`, images with the other sign at -x: the horizontal component of a radial displacement.
    Odd,
}

/// Where a panel's legend is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Legend {
    /// In a corner that no curve enters; outside where there is none.
    Auto,
    /// At the right of the panel, or below where that is too narrow.
    Outside,
    /// Nowhere.
    Off,
}

/// One panel.
#[must_use]
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Written above it; may be empty.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What it shows, from the bottom to the top.
    pub layers: Vec<Layer>,
    /// Whether lengths along both axes are equal.
    pub aspect: Aspect,
    /// Whether it shows its layers at -x as well.
    pub mirror: Mirror,
    /// Where the legend is.
    pub legend: Legend,
    /// Height of the plot in pixels; of no effect where lengths are equal.
    pub height: f64,
}

impl Panel {
    /// A panel without layers.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self {
            title: String::new(),
            x,
            y,
            layers: Vec::new(),
            aspect: Aspect::Free,
            mirror: Mirror::Off,
            legend: Legend::Auto,
            height: 260.0,
        }
    }

    /// With a title.
    pub fn title(mut self, title: &str) -> Self {
        title.clone_into(&mut self.title);
        self
    }

    /// With a plot of another height in pixels.
    pub fn height(mut self, pixels: f64) -> Self {
        self.height = pixels;
        self
    }

    /// With its legend elsewhere.
    pub fn legend(mut self, legend: Legend) -> Self {
        self.legend = legend;
        self
    }

    /// With lengths that are equal along both axes.
    pub fn equal_lengths(mut self) -> Self {
        self.aspect = Aspect::Equal;
        self
    }

    /// Mirrored at x = 0.
    pub fn mirrored(mut self, mirror: Mirror) -> Self {
        self.mirror = mirror;
        self
    }

    /// With one more layer, over the others.
    pub fn layer(mut self, layer: Layer) -> Self {
        self.layers.push(layer);
        self
    }

    /// With one more curve.
    pub fn line(self, name: &str, style: Style, points: Vec<(f64, f64)>) -> Self {
        self.layer(Layer::Line(Line::new(name, style, points)))
    }

    /// With one more band between two curves: place, lower and upper value.
    pub fn band(self, name: &str, points: Vec<(f64, f64, f64)>) -> Self {
        self.layer(Layer::Band(Band::new(name, points)))
    }

    /// With one more vertical line.
    pub fn mark(self, x: f64, label: &str) -> Self {
        self.layer(Layer::Mark(Mark::new(x, label)))
    }
}
