//! Layers of a panel, one file per kind: data and drawing.
//!
//! Begin with [`Layer`]; `curves` has lines with their bands and histograms, `colours` the limits of colour maps.

mod classes;
mod colours;
mod curves;
mod image;

pub use classes::Classes;
pub use curves::Line;
pub use image::Image;

pub(crate) use colours::Colours;
pub(crate) use curves::{BAND, draw_run};

use crate::drawing::{Drawing, Item};
use crate::error::FigureError;
use crate::geometry::{Frame, Point};
use crate::look::{Look, Style};

/// One layer of a panel; later ones lie over earlier ones.
#[derive(Debug, Clone, PartialEq)]
pub enum Layer {
    /// A curve.
    Line(Line),
    /// A field shown by colours.
    Image(Image),
    /// A few classes on a regular grid of cells.
    Classes(Classes),
    /// A vertical line with a label above the panel, such as an arrival time or the end of validity.
    Mark {
        /// Its x value; not drawn outside the axis.
        x: f64,
        /// Label above the line.
        label: String,
    },
    /// A point with a label; not drawn outside the axes.
    Point {
        /// Its position on both axes.
        at: (f64, f64),
        /// Label of the point.
        label: String,
        /// Whether a star marks the point; otherwise the label is placed there, such as the name of a curve or region.
        is_starred: bool,
    },
}

impl Layer {
    /// A curve without a band.
    pub fn line(name: &str, style: Style, points: Vec<(f64, f64)>) -> Self {
        Self::Line(Line::new(name, style, points))
    }

    /// A vertical line.
    pub fn mark(x: f64, label: &str) -> Self {
        let label = label.to_owned();
        Self::Mark { x, label }
    }

    /// A star with a label next to it.
    pub fn star(at: (f64, f64), label: &str) -> Self {
        Self::point(at, label, true)
    }

    /// A label without a star, at the point or near it.
    pub fn text(at: (f64, f64), label: &str) -> Self {
        Self::point(at, label, false)
    }

    /// The curve, if the layer is one.
    pub fn as_line(&self) -> Option<&Line> {
        match self {
            Self::Line(line) => Some(line),
            Self::Image(_) | Self::Classes(_) | Self::Mark { .. } | Self::Point { .. } => None,
        }
    }

    /// The image, if the layer is one.
    fn as_image(&self) -> Option<&Image> {
        match self {
            Self::Image(image) => Some(image),
            Self::Line(_) | Self::Classes(_) | Self::Mark { .. } | Self::Point { .. } => None,
        }
    }

    fn point(at: (f64, f64), label: &str, is_starred: bool) -> Self {
        Self::Point {
            at,
            label: label.to_owned(),
            is_starred,
        }
    }

    /// Checks that it can be drawn in the panel with a number.
    pub(crate) fn check(&self, panel: usize) -> Result<(), FigureError> {
        match self {
            Self::Image(image) => image.check(panel),
            Self::Classes(classes) => classes.check(panel),
            Self::Line(_) | Self::Mark { .. } | Self::Point { .. } => Ok(()),
        }
    }

    /// All points that an automatic axis must show; layers without an own x or y return NaN for it.
    pub(crate) fn places(&self) -> Vec<Point> {
        match self {
            Self::Line(line) => line.places(),
            Self::Image(image) => image.corners(),
            // these layers fill any range of the panel
            Self::Classes(_) => Vec::new(),
            Self::Mark { x, .. } => vec![(*x, f64::NAN)],
            Self::Point { at, .. } => vec![*at],
        }
    }

    /// Parts of the layer that must remain visible, as curves.
    pub(crate) fn curves(&self, frame: &Frame) -> Vec<Vec<Point>> {
        match self {
            Self::Line(line) => line.curves(frame),
            Self::Image(_) | Self::Classes(_) => Vec::new(),
            Self::Mark { x, .. } => vec![vec![(*x, frame.y.low), (*x, frame.y.high)]],
            Self::Point { .. } => vec![self.places()],
        }
    }

    /// Its names in the legend with their samples.
    pub(crate) fn swatches(&self, numbers: [usize; 2]) -> Vec<(&str, Swatch)> {
        match self {
            Self::Line(line) => vec![(&line.name, line.swatch(numbers))],
            Self::Classes(classes) => classes.swatches(),
            Self::Image(_) | Self::Mark { .. } | Self::Point { .. } => Vec::new(),
        }
    }

    /// Draws the layer, an image in the colours of its panel; labels are drawn later, over everything else.
    pub(crate) fn draw(
        &self,
        drawing: &mut Drawing,
        frame: &Frame,
        colours: Option<&Colours>,
        numbers: [usize; 2],
    ) {
        match self {
            Self::Line(line) => line.draw(drawing, frame, numbers),
            Self::Image(image) => {
                let picture = colours.map(|colours| image.pixels(frame, colours));
                drawing.items.extend(picture.map(Item::Bitmap));
            }
            Self::Classes(classes) => classes.draw(drawing, frame.area),
            Self::Mark { .. } | Self::Point { .. } => {}
        }
    }
}

/// The colours of the first image among some layers, for the values of all images; none without an image.
pub(crate) fn colours_of<'a>(layers: impl IntoIterator<Item = &'a Layer>) -> Option<Colours> {
    let images: Vec<&Image> = layers.into_iter().filter_map(Layer::as_image).collect();
    let first = images.first()?;
    let values = images.iter().flat_map(|image| image.values.iter().copied());
    Some(Colours::new(&first.colours, first.map, &values))
}

/// Sample in front of a name in the legend.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Swatch {
    /// A class.
    Fill(u32),
    /// A curve, or the bars of a histogram.
    Curve { look: Look, has_band: bool },
}

/// Checks the length of a list.
fn count(panel: usize, what: &str, needed: usize, found: usize) -> Result<(), FigureError> {
    let fault = || format!("panel {panel}: {found} {what}, but {needed} are required");
    let is_right = needed == found;
    is_right.then_some(()).ok_or_else(|| FigureError(fault()))
}
