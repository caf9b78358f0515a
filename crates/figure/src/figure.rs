//! A figure as data: panels in rows, each with two axes and layers.

use crate::axis::{Axis, Interval, Scale};
use crate::error::FigureError;
use crate::layers::{Layer, Line};
use crate::look::Style;

/// Sharing of axes between panels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sharing {
    /// Each panel has its own axes.
    Separate,
    /// Panels in a column share their x axis, which is labelled below the last of them.
    X,
    /// Panels in a column share their x axis and panels in a row their y axis, which is labelled at the first of them.
    Both,
}

/// A figure: panels in rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Title; may be empty.
    pub title: String,
    /// Subtitle; may be empty.
    pub subtitle: String,
    /// Panels, row by row.
    pub panels: Vec<Panel>,
    /// Number of panels in a row.
    pub columns: usize,
    /// Sharing of axes between panels.
    pub sharing: Sharing,
    /// Whether all images share one colour bar. Its limits follow from all images, and its label from the first.
    /// Otherwise each panel with an image has its own.
    pub has_common_bar: bool,
    /// Width in pixels, which increases if labels need more. The height follows from the panels.
    pub width: f64,
    /// Size of the text at the ticks in pixels; the sizes of other texts follow.
    pub text: f64,
}

impl Figure {
    /// A figure without panels.
    pub fn new(title: &str) -> Self {
        Self {
            title: title.to_owned(),
            subtitle: String::new(),
            panels: Vec::new(),
            columns: 1,
            sharing: Sharing::Separate,
            has_common_bar: false,
            width: 860.0,
            text: 12.0,
        }
    }

    /// Adds a subtitle.
    pub fn subtitle(mut self, subtitle: &str) -> Self {
        subtitle.clone_into(&mut self.subtitle);
        self
    }

    /// Adds a panel.
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// Adds panels.
    pub fn panels(mut self, panels: impl IntoIterator<Item = Panel>) -> Self {
        self.panels.extend(panels);
        self
    }

    /// Sets the number of panels in a row.
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns;
        self
    }

    /// Sets the sharing of axes.
    pub fn sharing(mut self, sharing: Sharing) -> Self {
        self.sharing = sharing;
        self
    }

    /// Sets the width in pixels.
    pub fn width(mut self, pixels: f64) -> Self {
        self.width = pixels;
        self
    }

    /// Checks that the figure can be drawn; returns the first defect.
    pub(crate) fn check(&self) -> Result<(), FigureError> {
        if self.panels.is_empty() || self.columns == 0 {
            return Err(FigureError("the figure has no panels".to_owned()));
        }
        check_size("width", self.width)?;
        check_size("text height", self.text)?;
        self.panels.iter().enumerate().try_for_each(check_panel)
    }
}

/// Position of a panel's legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Legend {
    /// In a corner that no curve enters, or outside if there is none.
    Auto,
    /// At the right of the panel, or below it if the figure is too narrow.
    Outside,
    /// No legend.
    Off,
}

/// One panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Title above the panel; may be empty.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Layers, from the bottom to the top.
    pub layers: Vec<Layer>,
    /// Whether both axes have the same scale, as in a section through the body; both are linear then.
    pub has_equal_lengths: bool,
    /// Whether the layers are also shown at -x, for functions of r alone.
    pub is_mirrored: bool,
    /// Position of the legend.
    pub legend: Legend,
    /// Height of the plot in pixels; without effect if both axes have the same scale.
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
            has_equal_lengths: false,
            is_mirrored: false,
            legend: Legend::Auto,
            height: 260.0,
        }
    }

    /// Whether a layer fills the plot, so that no corner is empty.
    pub(crate) fn is_filled(&self) -> bool {
        let mut layers = self.layers.iter();
        layers.any(|layer| matches!(layer, Layer::Image(_) | Layer::Classes(_)))
    }

    /// Sets the title.
    pub fn title(mut self, title: &str) -> Self {
        title.clone_into(&mut self.title);
        self
    }

    /// Sets the height of the plot in pixels.
    pub fn height(mut self, pixels: f64) -> Self {
        self.height = pixels;
        self
    }

    /// Sets the position of the legend.
    pub fn legend(mut self, legend: Legend) -> Self {
        self.legend = legend;
        self
    }

    /// Adds a layer over the others.
    pub fn layer(mut self, layer: Layer) -> Self {
        self.layers.push(layer);
        self
    }

    /// Adds a curve.
    pub fn line(self, name: &str, style: Style, points: Vec<(f64, f64)>) -> Self {
        self.layer(Layer::line(name, style, points))
    }

    /// Adds a curve within a band, such as its error: x, and the lower end of the band, value and upper end.
    pub fn banded(self, name: &str, style: Style, points: &[(f64, [f64; 3])]) -> Self {
        let [lower, middle, upper] =
            [0, 1, 2].map(|i| points.iter().map(|(x, ys)| (*x, ys[i])).collect());
        self.layer(Layer::Line(Line {
            band: [lower, upper],
            ..Line::new(name, style, middle)
        }))
    }

    /// Adds a vertical line.
    pub fn mark(self, x: f64, label: &str) -> Self {
        self.layer(Layer::mark(x, label))
    }
}

/// Largest side of a figure in pixels: a PNG of twice the size is still possible.
const LARGEST_PX: f64 = 16_384.0;

fn check_size(name: &str, pixels: f64) -> Result<(), FigureError> {
    let fault = || format!("the {name} of {pixels} px is outside [1, {LARGEST_PX}] px");
    let is_size = (1.0..=LARGEST_PX).contains(&pixels);
    is_size.then_some(()).ok_or_else(|| FigureError(fault()))
}

fn check_panel((i, panel): (usize, &Panel)) -> Result<(), FigureError> {
    check_size("panel height", panel.height)?;
    for (side, axis) in [("x", &panel.x), ("y", &panel.y)] {
        let fault = |why: String| FigureError(format!("panel {i}: the {side} axis {why}"));
        if let Some(Interval { low, high, .. }) = axis.interval().filter(|given| !given.is_valid())
        {
            let [low, high] = [low, high].map(fault::number);
            return Err(fault(format!("cannot run from {low} to {high}")));
        }
        let needs_linear = panel.has_equal_lengths || panel.is_mirrored && side == "x";
        if needs_linear && axis.scale == Scale::Logarithmic {
            let why = "is mirrored or has equal lengths, and must be linear";
            return Err(fault(why.to_owned()));
        }
    }
    panel.layers.iter().try_for_each(|layer| layer.check(i))
}
