//! A field as colours.

use crate::axis::Unit;
use crate::colour::ColourMap;
use crate::interval::Scale;

/// What colours mean.
#[must_use]
#[derive(Debug, Clone, PartialEq)]
pub struct ColourScale {
    /// What is shown: "axial stress".
    pub quantity: String,
    /// Its unit.
    pub unit: Unit,
    /// Colours.
    pub map: ColourMap,
    /// Which values get the colours at the ends.
    pub limits: Limits,
    /// How colours are spread between them; a diverging map is linear always.
    pub spread: Scale,
}

impl ColourScale {
    /// A scale from the smallest value to the largest.
    pub fn new(quantity: &str, unit: Unit, map: ColourMap) -> Self {
        Self {
            quantity: quantity.to_owned(),
            unit,
            map,
            limits: Limits::All,
            spread: Scale::Linear,
        }
    }

    /// With equal steps of colour for equal ratios: magnitudes over decades. What is not positive is left white.
    pub fn logarithmic(mut self) -> Self {
        self.spread = Scale::Logarithmic;
        self
    }

    /// With other limits.
    pub fn limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }
}

/// Which values get the colours at the ends of a map; a diverging map's limits are always equal in size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limits {
    /// The smallest and the largest value.
    All,
    /// All but the largest values: this percentage of the sizes is below the limit (of a sequential map: of the
    /// values, and the same at the low end), so that one singular place does not leave the rest white.
    Percentile(f64),
    /// These.
    Between(f64, f64),
}

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
            for &a in &x {
                values.push(value(a, b));
            }
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

    /// Two opposite corners of what it covers.
    pub(crate) fn corners(&self) -> [(f64, f64); 2] {
        let [x, y] = [extent(&self.x, self.shading), extent(&self.y, self.shading)];
        [(x.0, y.0), (x.1, y.1)]
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
        assert_eq!(image.corners(), [(0.0, 0.0), (3.0, 2.0)]);
    }

    #[test]
    fn cells_reach_half_way_to_their_neighbours() {
        let image = plane(Shading::Cells);
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
