//! A picture as data.

use crate::error::{FigureError, Side};
use crate::interval::Scale;
use crate::layer::Layer;
use crate::panel::{Aspect, Mirror, Panel};

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

/// Where the colours of images are explained.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourBar {
    /// At every panel with an image.
    Each,
    /// Once, with limits from all images together; the first image says what is shown.
    Common,
}

/// A picture: panels in rows.
#[must_use]
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
    /// Where the colours of images are explained.
    pub colour_bar: ColourBar,
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
            colour_bar: ColourBar::Each,
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
        self.colour_bar = ColourBar::Common;
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
        if let Some(interval) = axis.interval()
            && !interval.is_valid()
        {
            return Err(FigureError::Range {
                panel: i,
                side,
                low: interval.low,
                high: interval.high,
            });
        }
        let needs_linear =
            panel.aspect == Aspect::Equal || (panel.mirror != Mirror::Off && side == Side::X);
        if needs_linear && axis.scale == Scale::Logarithmic {
            return Err(FigureError::NotLinear { panel: i, side });
        }
    }
    panel
        .layers
        .iter()
        .try_for_each(|layer| check_layer(i, layer))
}

fn check_layer(panel: usize, layer: &Layer) -> Result<(), FigureError> {
    let counts = |what, expected, found| {
        if expected == found {
            Ok(())
        } else {
            Err(FigureError::Count {
                panel,
                what,
                expected,
                found,
            })
        }
    };
    match layer {
        Layer::Image(image) => {
            for (side, nodes) in [(Side::X, &image.x), (Side::Y, &image.y)] {
                let rising = nodes.windows(2).all(|pair| pair[0] < pair[1]);
                if nodes.is_empty() || !rising || nodes.iter().any(|n| !n.is_finite()) {
                    return Err(FigureError::Nodes { panel, side });
                }
            }
            let expected = image.x.len() * image.y.len();
            counts("values of an image", expected, image.values.len())
        }
        Layer::Classes(classes) => {
            let [columns, rows] = classes.shape;
            counts("cells of classes", columns * rows, classes.class.len())
        }
        Layer::Histogram(histogram) => counts(
            "edges of a histogram",
            histogram.counts.len() + 1,
            histogram.edges.len(),
        ),
        Layer::Line(_) | Layer::Band(_) | Layer::Mark(_) | Layer::Point(_) => Ok(()),
    }
}
