//! A field as colours.

use super::{ColourScale, Colours, Kind, Plot, count};
use crate::axis::Mirror;
use crate::error::{FigureError, Side};
use crate::geometry::{Frame, Point};
use crate::look::Slot;
use crate::scene::{Item, Picture, Scene};

/// How colours change between the nodes of a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shading {
    /// Each node colours its own cell.
    Cells,
    /// Bilinear between the nodes.
    Smooth,
}

/// A field on a grid, which need not be even.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Nodes along x, rising.
    pub x: Vec<f64>,
    /// Nodes along y, rising.
    pub y: Vec<f64>,
    /// Values at the nodes, x runs fastest; NaN is left white.
    pub values: Vec<f64>,
    /// How colours change between the nodes.
    pub shading: Shading,
    /// What colours mean.
    pub colours: ColourScale,
}

impl Image {
    /// A smoothly shaded field, from a function of x and y.
    pub fn of(
        x: Vec<f64>,
        y: Vec<f64>,
        colours: ColourScale,
        mut value: impl FnMut(f64, f64) -> f64,
    ) -> Self {
        let mut values = Vec::with_capacity(x.len() * y.len());
        for &b in &y {
            values.extend(x.iter().map(|&a| value(a, b)));
        }
        Self {
            x,
            y,
            values,
            shading: Shading::Smooth,
            colours,
        }
    }

    /// The field at a place; NaN outside its grid.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        let (Some((i, a)), Some((k, b))) = (
            locate(&self.x, x, self.shading),
            locate(&self.y, y, self.shading),
        ) else {
            return f64::NAN;
        };
        let node = |i: usize, k: usize| self.values[k * self.x.len() + i];
        let row = |k: usize| blend(node(i, k), a, || node(i + 1, k));
        blend(row(k), b, || row(k + 1))
    }

    /// A pixel for every place of the plot, so that uneven grids, logarithmic axes and mirrors need nothing else.
    fn pixels(&self, frame: &Frame, colours: &Colours) -> Picture {
        /// Pixels of the image for each pixel of the canvas.
        const FINE: f64 = 2.0;
        /// Most pixels along a side.
        const MOST: f64 = 2000.0;
        let count = |length: f64| (FINE * length).ceil().clamp(1.0, MOST);
        let (columns, rows) = (count(frame.area.width()), count(frame.area.height()));
        let at = |column: u32, row: u32| {
            let across = (f64::from(column) + 0.5) / columns * frame.area.width();
            let down = (f64::from(row) + 0.5) / rows * frame.area.height();
            let (x, y) = frame.values((frame.area.left + across, frame.area.top + down));
            colours.of_value(match frame.mirror {
                Mirror::Off => self.at(x, y),
                Mirror::Even => self.at(x.abs(), y),
                Mirror::Odd => self.at(x.abs(), y) * x.signum(),
            })
        };
        let places = (0..rows as u32).flat_map(|row| (0..columns as u32).map(move |i| (i, row)));
        Picture {
            area: frame.area,
            columns: columns as u32,
            rows: rows as u32,
            pixels: places.map(|(column, row)| at(column, row)).collect(),
        }
    }
}

impl Kind for Image {
    fn check(&self, panel: usize) -> Result<(), FigureError> {
        for (side, nodes) in [(Side::X, &self.x), (Side::Y, &self.y)] {
            let rising = nodes.windows(2).all(|pair| pair[0] < pair[1]);
            if nodes.is_empty() || !rising || nodes.iter().any(|n| !n.is_finite()) {
                return Err(FigureError::Nodes { panel, side });
            }
        }
        let expected = self.x.len() * self.y.len();
        count(panel, "values of an image", expected, self.values.len())
    }

    /// Two opposite corners of what it covers.
    fn places(&self) -> Vec<Point> {
        let [x, y] = [&self.x, &self.y].map(|nodes| extent(nodes, self.shading));
        vec![(x.0, y.0), (x.1, y.1)]
    }

    fn fills(&self) -> bool {
        true
    }

    fn curves(&self, _: &Frame) -> Vec<Vec<Point>> {
        Vec::new()
    }

    fn draw(&self, scene: &mut Scene, plot: &Plot<'_>, _: Slot) {
        if let Some(colours) = plot.colours {
            let picture = self.pixels(plot.frame, colours);
            scene.items.push(Item::Picture(picture));
        }
    }
}

fn blend(a: f64, fraction: f64, b: impl Fn() -> f64) -> f64 {
    if fraction == 0.0 {
        a
    } else {
        a + fraction * (b() - a)
    }
}

/// What the nodes of an axis cover.
fn extent(nodes: &[f64], shading: Shading) -> (f64, f64) {
    let n = nodes.len();
    match (nodes, shading) {
        ([], _) => (f64::NAN, f64::NAN),
        ([only], _) => (only - 0.5, only + 0.5),
        ([first, .., last], Shading::Smooth) => (*first, *last),
        ([first, .., last], Shading::Cells) => (
            first - 0.5 * (nodes[1] - first),
            last + 0.5 * (last - nodes[n - 2]),
        ),
    }
}

/// The node below a place and the fraction of the way to the next one.
fn locate(nodes: &[f64], at: f64, shading: Shading) -> Option<(usize, f64)> {
    let (low, high) = extent(nodes, shading);
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
    match shading {
        Shading::Smooth => Some((lower, fraction)),
        Shading::Cells => Some((if fraction < 0.5 { lower } else { upper }, 0.0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::Unit;
    use crate::colour::ColourMap;

    fn plane(shading: Shading) -> Image {
        let scale = ColourScale::new("", Unit::One, ColourMap::Sequential);
        let mut image = Image::of(vec![0.0, 1.0, 3.0], vec![0.0, 2.0], scale, |x, y| {
            x + 10.0 * y
        });
        image.shading = shading;
        image
    }

    #[test]
    fn smooth_shading_reproduces_a_plane_on_an_uneven_grid() {
        let image = plane(Shading::Smooth);
        for (x, y) in [(0.0, 0.0), (0.5, 1.0), (2.5, 0.3), (3.0, 2.0)] {
            assert!((image.at(x, y) - (x + 10.0 * y)).abs() < 1e-12, "{x} {y}");
        }
        assert!(image.at(3.1, 0.0).is_nan() && image.at(0.0, -0.1).is_nan());
        assert_eq!(image.places(), [(0.0, 0.0), (3.0, 2.0)]);
    }

    #[test]
    fn cells_reach_half_way_to_their_neighbours() {
        let image = plane(Shading::Cells);
        assert_eq!(image.places(), [(-0.5, -1.0), (4.0, 3.0)]);
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
