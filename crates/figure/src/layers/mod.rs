//! What a panel shows, one kind of layer a file: what it is, and how it is drawn.
//!
//! Begin with [`Kind`], which is what all of them can be asked; `curves` has lines and bands, `labels` what is only
//! written, `colours` what the colours of an image mean.

mod classes;
mod colours;
mod curves;
mod histogram;
mod image;
mod labels;

pub use classes::Classes;
pub use colours::{ColourScale, Limits};
pub use curves::{Band, Line};
pub use histogram::Histogram;
pub use image::{Image, Shading};
pub use labels::{LabelledPoint, Mark};

pub(crate) use colours::Colours;

use crate::colour::Colour;
use crate::error::FigureError;
use crate::geometry::{Frame, Point};
use crate::look::{Look, Slot};
use crate::scene::Scene;

/// One layer of a panel; later ones lie over earlier ones.
#[derive(Debug, Clone, PartialEq)]
pub enum Layer {
    /// A curve.
    Line(Line),
    /// The area between two curves: an error band.
    Band(Band),
    /// Counts over bins.
    Histogram(Histogram),
    /// A field as colours.
    Image(Image),
    /// A few classes on a regular grid of cells.
    Classes(Classes),
    /// A vertical line with a label above the panel.
    Mark(Mark),
    /// A point with a label beside it.
    Point(LabelledPoint),
}

impl Layer {
    /// Its name in the legend; empty for none.
    pub fn name(&self) -> &str {
        self.kind().name()
    }

    pub(crate) fn kind(&self) -> &dyn Kind {
        match self {
            Self::Line(line) => line,
            Self::Band(band) => band,
            Self::Histogram(histogram) => histogram,
            Self::Image(image) => image,
            Self::Classes(classes) => classes,
            Self::Mark(mark) => mark,
            Self::Point(point) => point,
        }
    }
}

/// A plot in which a layer is drawn.
pub(crate) struct Plot<'a> {
    pub(crate) frame: &'a Frame,
    /// What the colours of its images mean.
    pub(crate) colours: Option<&'a Colours>,
}

/// What every kind of layer can be asked; each answers what concerns it.
pub(crate) trait Kind {
    /// Its name in the legend; empty for none.
    fn name(&self) -> &str {
        ""
    }

    /// Whether it can be drawn in the panel of a number.
    fn check(&self, _panel: usize) -> Result<(), FigureError> {
        Ok(())
    }

    /// Every place that an automatic axis has to hold; what has no x or y of its own gives NaN for it.
    fn places(&self) -> Vec<Point>;

    /// Whether it fills its panel, so that nothing can be written into an empty corner.
    fn fills(&self) -> bool {
        false
    }

    /// Whether it has a colour of its own, by its name.
    fn is_coloured(&self) -> bool {
        false
    }

    /// What of it must stay readable in a frame, as curves.
    fn curves(&self, _frame: &Frame) -> Vec<Vec<Point>> {
        vec![self.places()]
    }

    /// Its names in the legend with their samples.
    fn swatches(&self, _slot: Slot) -> Vec<(&str, Swatch)> {
        Vec::new()
    }

    /// Draws it; labels come later, over everything else.
    fn draw(&self, _scene: &mut Scene, _plot: &Plot<'_>, _slot: Slot) {}
}

/// The sample beside a name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Swatch {
    /// A class.
    Fill(Colour),
    /// The bars of a histogram.
    Bars(Look),
    /// A curve, a band of its colour, or both.
    Curve {
        line: Option<Look>,
        band: Option<Colour>,
    },
}

/// Whether a list is as long as it must be.
fn count(
    panel: usize,
    what: &'static str,
    expected: usize,
    found: usize,
) -> Result<(), FigureError> {
    if expected == found {
        return Ok(());
    }
    Err(FigureError::Count {
        panel,
        what,
        expected,
        found,
    })
}
