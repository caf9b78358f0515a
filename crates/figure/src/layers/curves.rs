//! Curves, and the areas between two of them.

use super::{Kind, Plot, Swatch};
use crate::colour::WHITE;
use crate::geometry::{Frame, Point};
use crate::look::{Look, Slot, Style};
use crate::scene::{Scene, Shape, Stroke};

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// Its points; the line breaks at those that the axes cannot show, such as NaN.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub style: Style,
}

impl Line {
    /// A curve.
    pub fn new(name: &str, style: Style, points: Vec<(f64, f64)>) -> Self {
        Self {
            name: name.to_owned(),
            points,
            style,
        }
    }
}

impl Kind for Line {
    fn name(&self) -> &str {
        &self.name
    }

    fn places(&self) -> Vec<Point> {
        self.points.clone()
    }

    fn is_coloured(&self) -> bool {
        matches!(self.style, Style::Marked | Style::Plain | Style::Points)
    }

    fn swatches(&self, slot: Slot) -> Vec<(&str, Swatch)> {
        let line = Some(Look::new(slot, self.style));
        vec![(&self.name, Swatch::Curve { line, band: None })]
    }

    fn draw(&self, scene: &mut Scene, plot: &Plot<'_>, slot: Slot) {
        let look = Look::new(slot, self.style);
        let area = plot.frame.area;
        for points in plot.frame.sides(&self.points) {
            let runs = plot.frame.runs(&points);
            for run in runs.iter().filter(|run| look.line && run.len() > 1) {
                if look.rim {
                    let rim = Stroke::solid(WHITE, look.stroke.width + 2.4);
                    scene.shape(Shape::polyline(run, rim).clipped(area));
                }
                scene.shape(Shape::polyline(run, look.stroke).clipped(area));
            }
            for &at in runs.iter().flatten() {
                // whole markers at the sides of a plot, none of points beyond them
                if area.grown(0.01).has(at) {
                    look.mark(scene, at);
                }
            }
        }
    }
}

/// The area between two curves over the same places: what a curve may be wrong by.
///
/// It takes the colour of the curve with the same name, and shares its line in the legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// Place, lower and upper value.
    pub points: Vec<(f64, f64, f64)>,
}

impl Band {
    /// How much a band hides.
    pub(crate) const OPACITY: f64 = 0.22;

    /// A band.
    pub fn new(name: &str, points: Vec<(f64, f64, f64)>) -> Self {
        Self {
            name: name.to_owned(),
            points,
        }
    }

    /// Its lower and its upper side.
    fn edges(&self) -> [Vec<Point>; 2] {
        let lower = self.points.iter().map(|&(x, low, _)| (x, low));
        let upper = self.points.iter().map(|&(x, _, high)| (x, high));
        [lower.collect(), upper.collect()]
    }
}

impl Kind for Band {
    fn name(&self) -> &str {
        &self.name
    }

    fn places(&self) -> Vec<Point> {
        self.edges().concat()
    }

    fn is_coloured(&self) -> bool {
        true
    }

    fn curves(&self, _: &Frame) -> Vec<Vec<Point>> {
        self.edges().to_vec()
    }

    fn swatches(&self, slot: Slot) -> Vec<(&str, Swatch)> {
        let band = Some(Look::new(slot, Style::Plain).stroke.colour);
        vec![(&self.name, Swatch::Curve { line: None, band })]
    }

    fn draw(&self, scene: &mut Scene, plot: &Plot<'_>, slot: Slot) {
        let colour = Look::new(slot, Style::Plain).stroke.colour;
        let place = |point: &Point| plot.frame.place(*point);
        let [lower, upper] = self.edges().map(|edge| plot.frame.sides(&edge));
        for (lower, upper) in lower.iter().zip(&upper) {
            let pairs = lower.iter().zip(upper);
            let pairs: Vec<_> = pairs.map(|(a, b)| place(a).zip(place(b))).collect();
            for run in pairs.split(Option::is_none).filter(|run| run.len() > 1) {
                let run = || run.iter().flatten();
                let back = run().rev().map(|pair| pair.1);
                let outline: Vec<Point> = run().map(|pair| pair.0).chain(back).collect();
                let area = Shape::polygon(&outline).filled(colour, Self::OPACITY);
                scene.shape(area.clipped(plot.frame.area));
            }
        }
    }
}
