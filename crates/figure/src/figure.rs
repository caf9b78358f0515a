//! A picture as data: panels in rows, each with two axes and layers.

use crate::axis::{Axis, Interval, Mirror, Scale};
use crate::error::{FigureError, Side};
use crate::layers::{Band, Layer, Line, Mark};
use crate::look::Style;

/// Whether panels have one axis in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sharing {
    /// Each has its own.
    Separate,
    /// Those above one another have the same x axis, written below the last.
    X,
    /// Those side by side have the same y axis, written at the first.
    Y,
    /// Both.
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

    /// With one colour bar for all panels.
    pub fn common_colour_bar(mut self) -> Self {
        self.has_common_bar = true;
        self
    }

    /// With another width in pixels.
    pub fn width(mut self, pixels: f64) -> Self {
        self.width = pixels;
        self
    }

    /// With text of another height in pixels.
    pub fn text(mut self, pixels: f64) -> Self {
        self.text = pixels;
        self
    }

    /// Whether it can be drawn.
    ///
    /// # Errors
    /// [`FigureError`] with the first thing that cannot.
    pub fn check(&self) -> Result<(), FigureError> {
        if self.panels.is_empty() || self.columns == 0 {
            return Err(FigureError::NoPanels);
        }
        for (name, pixels) in [("width", self.width), ("text height", self.text)] {
            check_size(name, pixels)?;
        }
        for (i, panel) in self.panels.iter().enumerate() {
            check_panel(i, panel)?;
        }
        Ok(())
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
    /// Whether one unit is equally long on both axes, as in a section through the body; both are linear then.
    pub has_equal_lengths: bool,
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
            has_equal_lengths: false,
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
        self.has_equal_lengths = true;
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

/// Largest side of a picture in pixels: a PNG of it at twice the size still has a size.
pub(crate) const LARGEST_PX: f64 = 16_384.0;

fn check_size(name: &'static str, pixels: f64) -> Result<(), FigureError> {
    if (1.0..=LARGEST_PX).contains(&pixels) {
        Ok(())
    } else {
        Err(FigureError::Size {
            name,
            pixels,
            largest: LARGEST_PX,
        })
    }
}

fn check_panel(i: usize, panel: &Panel) -> Result<(), FigureError> {
    check_size("panel height", panel.height)?;
    for (side, axis) in [(Side::X, &panel.x), (Side::Y, &panel.y)] {
        if let Some(Interval { low, high, .. }) = axis.interval().filter(|given| !given.is_valid())
        {
            return Err(FigureError::Range {
                panel: i,
                side,
                low,
                high,
            });
        }
        let needs_linear =
            panel.has_equal_lengths || (panel.mirror != Mirror::Off && side == Side::X);
        if needs_linear && axis.scale == Scale::Logarithmic {
            return Err(FigureError::NotLinear { panel: i, side });
        }
    }
    let mut layers = panel.layers.iter();
    layers.try_for_each(|layer| layer.kind().check(i))
}
