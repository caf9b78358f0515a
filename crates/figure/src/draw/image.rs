//! A field as colours.

use crate::layer::Image;
use crate::layout::{Colours, Frame};
use crate::panel::Mirror;
use crate::scene::Picture;

/// Pixels of the image for each pixel of the canvas.
const FINE: f64 = 2.0;

/// Most pixels along a side.
const MOST: f64 = 2000.0;

/// A pixel for every place of the plot, so that uneven grids, logarithmic axes and mirrors need nothing else.
pub(super) fn pixels(image: &Image, frame: &Frame, colours: &Colours, mirror: Mirror) -> Picture {
    let count = |length: f64| (FINE * length).ceil().clamp(1.0, MOST);
    let (columns, rows) = (count(frame.area.width()), count(frame.area.height()));
    let limits = colours.limits;
    let at = |column: f64, row: f64| {
        let across = frame.area.left + (column + 0.5) / columns * frame.area.width();
        let down = frame.area.top + (row + 0.5) / rows * frame.area.height();
        let (x, y) = frame.values((across, down));
        let value = match mirror {
            Mirror::Off => image.at(x, y),
            Mirror::Even => image.at(x.abs(), y),
            Mirror::Odd => image.at(x.abs(), y) * x.signum(),
        };
        let is_shown = limits.scale.shows(value) || value.is_infinite() && value > 0.0;
        is_shown.then(|| colours.scale.map.at(limits.fraction(value)))
    };
    let (columns, rows) = (columns as u32, rows as u32);
    Picture {
        area: frame.area,
        columns,
        rows,
        pixels: (0..rows)
            .flat_map(|row| (0..columns).map(move |column| (column, row)))
            .map(|(column, row)| at(f64::from(column), f64::from(row)))
            .collect(),
    }
}
