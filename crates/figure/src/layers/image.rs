//! A field shown by colours.

use super::{Colours, count};
use crate::axis::Axis;
use crate::colour::ColourMap;
use crate::drawing::Bitmap;
use crate::error::FigureError;
use crate::geometry::{Frame, Point};

/// A field on a grid, which may be nonuniform.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Nodes along x, ascending.
    pub x: Vec<f64>,
    /// Nodes along y, ascending.
    pub y: Vec<f64>,
    /// Values at the nodes, x varies fastest; NaN is shown white.
    pub values: Vec<f64>,
    /// Axis of the colours. Its range has the values at the ends of the colour map, of equal magnitude for signed
    /// values.
    pub colours: Axis,
    /// Colours.
    pub map: ColourMap,
    /// Whether each node colours its own cell; otherwise colours are interpolated between nodes.
    pub has_cells: bool,
}

impl Image {
    /// A field with colours that are interpolated between its nodes.
    pub fn new(x: Vec<f64>, y: Vec<f64>, values: Vec<f64>, colours: Axis, map: ColourMap) -> Self {
        Self {
            x,
            y,
            values,
            colours,
            map,
            has_cells: false,
        }
    }

    /// The field at a point; NaN outside its grid.
    fn at(&self, x: f64, y: f64) -> f64 {
        let across = locate(&self.x, x, self.has_cells);
        let place = across.zip(locate(&self.y, y, self.has_cells));
        let Some(((i, a), (k, b))) = place else {
            return f64::NAN;
        };
        let node = |i: usize, k: usize| self.values[k * self.x.len() + i];
        let row = |k: usize| blend(node(i, k), a, || node(i + 1, k));
        blend(row(k), b, || row(k + 1))
    }

    /// A pixel for each point of the plot, which handles nonuniform grids, logarithmic axes and mirroring.
    pub(super) fn pixels(&self, frame: &Frame, colours: &Colours) -> Bitmap {
        /// Pixels of the image per pixel of the canvas.
        const FINE: f64 = 2.0;
        /// Largest number of pixels along a side.
        const MOST_PIXELS: f64 = 2000.0;
        let count = |length: f64| (FINE * length).ceil().clamp(1.0, MOST_PIXELS);
        let (columns, rows) = (count(frame.area.width()), count(frame.area.height()));
        let at = |column: u32, row: u32| {
            let across = (f64::from(column) + 0.5) / columns * frame.area.width();
            let down = (f64::from(row) + 0.5) / rows * frame.area.height();
            let (x, y) = frame.values((frame.area.left + across, frame.area.top + down));
            let x = if frame.is_mirrored { x.abs() } else { x };
            colours.of_value(self.at(x, y))
        };
        let places = (0..rows as u32).flat_map(|row| (0..columns as u32).map(move |i| (i, row)));
        Bitmap {
            area: frame.area,
            columns: columns as u32,
            rows: rows as u32,
            pixels: places.map(|(column, row)| at(column, row)).collect(),
        }
    }

    pub(super) fn check(&self, panel: usize) -> Result<(), FigureError> {
        for (side, nodes) in [("x", &self.x), ("y", &self.y)] {
            let rising = nodes.windows(2).all(|pair| pair[0] < pair[1]);
            if nodes.is_empty() || !rising || nodes.iter().any(|n| !n.is_finite()) {
                let must = "nodes of an image must be finite and ascending";
                return Err(FigureError(format!("panel {panel}: the {side} {must}")));
            }
        }
        let expected = self.x.len() * self.y.len();
        count(panel, "values of an image", expected, self.values.len())
    }

    /// Two opposite corners of its area.
    pub(super) fn corners(&self) -> Vec<Point> {
        let [x, y] = [&self.x, &self.y].map(|nodes| extent(nodes, self.has_cells));
        vec![(x.0, y.0), (x.1, y.1)]
    }
}

fn blend(a: f64, fraction: f64, b: impl Fn() -> f64) -> f64 {
    if fraction == 0.0 {
        a
    } else {
        a + fraction * (b() - a)
    }
}

/// Range covered by the nodes of an axis.
fn extent(nodes: &[f64], has_cells: bool) -> (f64, f64) {
    let n = nodes.len();
    match nodes {
        [] => (f64::NAN, f64::NAN),
        [only] => (only - 0.5, only + 0.5),
        [first, .., last] if has_cells => (
            first - 0.5 * (nodes[1] - first),
            last + 0.5 * (last - nodes[n - 2]),
        ),
        [first, .., last] => (*first, *last),
    }
}

/// The node below a position, and the fraction of the way to the next one.
fn locate(nodes: &[f64], at: f64, has_cells: bool) -> Option<(usize, f64)> {
    let (low, high) = extent(nodes, has_cells);
    if !(low..=high).contains(&at) {
        return None;
    }
    let upper = nodes
        .partition_point(|&node| node <= at)
        .clamp(1, nodes.len());
    let lower = upper - 1;
    if upper == nodes.len() {
        return Some((lower, 0.0));
    }
    let fraction = ((at - nodes[lower]) / (nodes[upper] - nodes[lower])).max(0.0);
    Some(match has_cells {
        true => (lower + usize::from(fraction >= 0.5), 0.0),
        false => (lower, fraction),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x + 10 y.
    fn plane(has_cells: bool) -> Image {
        let (x, y) = (vec![0.0, 1.0, 3.0], vec![0.0, 2.0]);
        let values = vec![0.0, 1.0, 3.0, 20.0, 21.0, 23.0];
        let colours = Axis::linear("");
        Image {
            has_cells,
            ..Image::new(x, y, values, colours, ColourMap::Sequential)
        }
    }

    #[test]
    fn smooth_shading_reproduces_a_plane_on_an_uneven_grid() {
        let image = plane(false);
        for (x, y) in [(0.0, 0.0), (0.5, 1.0), (2.5, 0.3), (3.0, 2.0)] {
            assert!((image.at(x, y) - (x + 10.0 * y)).abs() < 1e-12, "{x} {y}");
        }
        assert!(image.at(3.1, 0.0).is_nan() && image.at(0.0, -0.1).is_nan());
        assert_eq!(image.corners(), [(0.0, 0.0), (3.0, 2.0)]);
    }

    #[test]
    fn cells_reach_half_way_to_their_neighbours() {
        let image = plane(true);
        assert_eq!(image.corners(), [(-0.5, -1.0), (4.0, 3.0)]);
        for (x, node) in [
            (-0.4, 0.0),
            (0.4, 0.0),
            (0.6, 1.0),
            (1.9, 1.0),
            (2.1, 3.0),
            (3.9, 3.0),
        ] {
            assert_eq!(image.at(x, -0.9), node, "{x}");
        }
    }
}
