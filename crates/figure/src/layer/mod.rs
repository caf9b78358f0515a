//! What a panel shows, one kind of layer a file.

mod band;
mod classes;
mod histogram;
mod image;
mod line;
mod mark;

pub use band::Band;
pub use classes::Classes;
pub use histogram::Histogram;
pub use image::{ColourScale, Image, Limits, Shading};
pub use line::{Line, Style};
pub use mark::{LabelledPoint, Mark, Symbol};

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
        match self {
            Self::Line(line) => &line.name,
            Self::Band(band) => &band.name,
            Self::Histogram(histogram) => &histogram.name,
            Self::Image(_) | Self::Classes(_) | Self::Mark(_) | Self::Point(_) => "",
        }
    }

    /// Every place that an automatic axis has to hold; what has no x or y of its own gives NaN for it.
    pub(crate) fn places(&self) -> Vec<(f64, f64)> {
        match self {
            Self::Line(line) => line.points.clone(),
            Self::Band(band) => band
                .points
                .iter()
                .flat_map(|&(x, low, high)| [(x, low), (x, high)])
                .collect(),
            Self::Histogram(histogram) => histogram.outline(),
            Self::Image(image) => image.corners().to_vec(),
            Self::Mark(mark) => vec![(mark.x, f64::NAN)],
            Self::Point(point) => vec![(point.x, point.y)],
            // they fill whatever the panel shows
            Self::Classes(_) => Vec::new(),
        }
    }

    /// Whether it fills its panel, so that nothing can be written into an empty corner.
    pub(crate) fn fills(&self) -> bool {
        match self {
            Self::Image(_) | Self::Classes(_) => true,
            Self::Line(_) | Self::Band(_) | Self::Histogram(_) | Self::Mark(_) | Self::Point(_) => {
                false
            }
        }
    }
}
