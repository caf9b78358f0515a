//! A picture as data: panels in rows, each with two axes and layers.

use crate::axis::{Axis, Interval, Scale};
use crate::error::FigureError;
use crate::layers::{Layer, Line};
use crate::look::Style;

/// Whether panels have one axis in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sharing {
    /// Each has its own.
    Separate,
    /// Those above one another have the same x axis, written below the last.
    X,
    /// So have those above one another their x axis and those side by side their y axis, written at the first.
    Both,
}

/// A picture: panels in rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Title; may be empty.
    pub title: String,
    /// A smaller line below it; may be empty.
    pub subtitle: String,
    /// Panels, row by row.
    pub panels: Vec<Panel>,
    /// Panels in a row.
    pub columns: usize,
    /// Whether panels have one axis in common.
    pub sharing: Sharing,
    /// Whether colours of images are explained once, with limits from all images together, of which the first says what
    /// is shown; at every panel with an image otherwise.
    pub has_common_bar: bool,
    /// Width in pixels; it grows where labels need more. The height follows from the panels.
    pub width: f64,
    /// Height of the text at the ticks in pixels; other text follows.
    pub text: f64,
}

impl Figure {
    /// A picture without panels.
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

    /// With a line below the title.
    pub fn subtitle(mut self, subtitle: &str) -> Self {
        subtitle.clone_into(&mut self.subtitle);
        self
    }

    /// With one more panel.
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// With more panels.
    pub fn panels(mut self, panels: impl IntoIterator<Item = Panel>) -> Self {
        self.panels.extend(panels);
        self
    }

    /// With so many panels in a row.
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns;
        self
    }

    /// With axes in common.
    pub fn sharing(mut self, sharing: Sharing) -> Self {
        self.sharing = sharing;
        self
    }

    /// With another width in pixels.
    pub fn width(mut self, pixels: f64) -> Self {
        self.width = pixels;
        self
    }

    /// Whether it can be drawn, or the first thing that cannot.
    pub(crate) fn check(&self) -> Result<(), FigureError> {
        if self.panels.is_empty() || self.columns == 0 {
            return Err(FigureError("the figure has no panels".to_owned()));
        }
        check_size("width", self.width)?;
        check_size("text height", self.text)?;
        self.panels.iter().enumerate().try_for_each(check_panel)
    }
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
    /// Whether one unit is equally long on both axes, as in a section through the body; both are linear then.
    pub has_equal_lengths: bool,
    /// Whether it shows its layers at -x as well: what does not depend on the angle, such as a pressure over r.
    pub is_mirrored: bool,
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
            has_equal_lengths: false,
            is_mirrored: false,
            legend: Legend::Auto,
            height: 260.0,
        }
    }

    /// Whether a layer fills it, so that nothing can be written into an empty corner.
    pub(crate) fn is_filled(&self) -> bool {
        let mut layers = self.layers.iter();
        layers.any(|layer| matches!(layer, Layer::Image(_) | Layer::Classes(_)))
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

    /// With one more layer, over the others.
    pub fn layer(mut self, layer: Layer) -> Self {
        self.layers.push(layer);
        self
    }

    /// With one more curve.
    pub fn line(self, name: &str, style: Style, points: Vec<(f64, f64)>) -> Self {
        self.layer(Layer::line(name, style, points))
    }

    /// With one more curve within a band, such as of its error: place, and lower end of the band, value and upper end.
    pub fn banded(self, name: &str, style: Style, points: &[(f64, [f64; 3])]) -> Self {
        let [lower, middle, upper] =
            [0, 1, 2].map(|i| points.iter().map(|(x, ys)| (*x, ys[i])).collect());
        self.layer(Layer::Line(Line {
            band: [lower, upper],
            ..Line::new(name, style, middle)
        }))
    }

    /// With one more vertical line.
    pub fn mark(self, x: f64, label: &str) -> Self {
        self.layer(Layer::mark(x, label))
    }
}

/// Largest side of a picture in pixels: a PNG of it at twice the size still has a size.
const LARGEST_PX: f64 = 16_384.0;

fn check_size(name: &str, pixels: f64) -> Result<(), FigureError> {
    let fault = || format!("{name} of {pixels} px: 1 to {LARGEST_PX} px can be drawn");
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
