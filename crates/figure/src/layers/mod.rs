//! What a panel shows, one kind of layer a file: what it is, and how it is drawn.
//!
//! Begin with [`Kind`], which is what all of them can be asked; `curves` has lines with their bands and histograms,
//! `labels` what is only written, `colours` what the colours of an image mean.

mod classes;
mod colours;
mod curves;
mod image;
mod labels;

pub use classes::Classes;
pub use curves::Line;
pub use image::Image;
pub use labels::{LabelledPoint, Mark};

pub(crate) use colours::Colours;
pub(crate) use curves::{BAND, draw_run};

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
    pub(crate) fn kind(&self) -> &dyn Kind {
        match self {
            Self::Line(line) => line,
            Self::Image(image) => image,
            Self::Classes(classes) => classes,
            Self::Mark(mark) => mark,
            Self::Point(point) => point,
        }
    }
}

/// What every kind of layer can be asked; each answers what concerns it.
pub(crate) trait Kind {
    /// Whether it can be drawn in the panel of a number.
    fn check(&self, _panel: usize) -> Result<(), FigureError> {
        Ok(())
    }

    /// Every place that an automatic axis has to hold; what has no x or y of its own gives NaN for it.
    fn places(&self) -> Vec<Point>;

    /// What of it must stay readable in a frame, as curves.
    fn curves(&self, _frame: &Frame) -> Vec<Vec<Point>> {
        vec![self.places()]
    }

    /// Its names in the legend with their samples.
    fn swatches(&self, _slot: Slot) -> Vec<(&str, Swatch)> {
        Vec::new()
    }

    /// Draws it, an image in the colours of its panel; labels come later, over everything else.
    fn draw(&self, _: &mut Scene, _: &Frame, _: Option<&Colours>, _: Slot) {}
}

/// The sample beside a name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Swatch {
    /// A class.
    Fill(Colour),
    /// A curve, or the bars of a histogram.
    Curve { look: Look, has_band: bool },
}

/// Whether a list is as long as it must be.
fn count(panel: usize, what: &str, needed: usize, found: usize) -> Result<(), FigureError> {
    let fault = || format!("panel {panel}: {found} {what}, and {needed} are needed");
    (needed == found)
        .then_some(())
        .ok_or_else(|| FigureError(fault()))
}
