//! Counts over bins.

use super::{Kind, Plot, Swatch, count};
use crate::axis::{Interval, Scale};
use crate::error::FigureError;
use crate::geometry::{Frame, Point, Rect};
use crate::look::{Look, Slot, Style};
use crate::scene::{Scene, Shape};

/// Counts over bins.
#[derive(Debug, Clone, PartialEq)]
pub struct Histogram {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// Ends of the bins, rising, one more than there are bins.
    pub edges: Vec<f64>,
    /// What each bin holds.
    pub counts: Vec<f64>,
}

impl Histogram {
    /// Counts values over `bins` bins that are equally long on an axis of the given scale.
    ///
    /// Values that such an axis cannot show (NaN, or negative on a logarithmic one) are not counted.
    pub fn of(name: &str, values: &[f64], bins: usize, scale: Scale) -> Self {
        let bins = bins.max(1);
        let interval = match Interval::around(scale, values.iter().copied()) {
            Some(found) if found.low < found.high => found,
            Some(single) => single.with_air(0.0),
            None => Interval::linear(0.0, 1.0),
        };
        let mut counts = vec![0.0; bins];
        for &value in values.iter().filter(|&&v| scale.shows(v)) {
            let bin = (interval.fraction(value) * bins as f64) as usize;
            counts[bin.min(bins - 1)] += 1.0;
        }
        let edges = (0..=bins).map(|i| interval.value(i as f64 / bins as f64));
        Self {
            name: name.to_owned(),
            edges: edges.collect(),
            counts,
        }
    }

    /// The curve along the tops of the bars, from zero to zero.
    fn outline(&self) -> Vec<Point> {
        let mut points = Vec::with_capacity(2 * self.counts.len() + 2);
        for (pair, &count) in self.edges.windows(2).zip(&self.counts) {
            points.extend([(pair[0], count), (pair[1], count)]);
        }
        if let (Some(&first), Some(&last)) = (self.edges.first(), self.edges.last()) {
            points.insert(0, (first, 0.0));
            points.push((last, 0.0));
        }
        points
    }

    /// The same on the axes of a plot: a logarithmic axis has no zero, bars stand on its end.
    fn standing(&self, frame: &Frame) -> Vec<Point> {
        let above = |(x, y): Point| (x, y.max(frame.y.low));
        self.outline().into_iter().map(above).collect()
    }

    /// Bars as one outline, lightly filled, so that several lie over one another.
    pub(crate) fn draw_outline(scene: &mut Scene, points: &[Point], look: &Look, clip: Rect) {
        let fill = Shape::polygon(points).filled(look.stroke.colour, 0.18);
        scene.shape(fill.clipped(clip));
        scene.shape(Shape::polyline(points, look.stroke).clipped(clip));
    }
}

impl Kind for Histogram {
    fn name(&self) -> &str {
        &self.name
    }

    fn check(&self, panel: usize) -> Result<(), FigureError> {
        let expected = self.counts.len() + 1;
        count(panel, "edges of a histogram", expected, self.edges.len())
    }

    fn places(&self) -> Vec<Point> {
        self.outline()
    }

    fn is_coloured(&self) -> bool {
        true
    }

    /// Whole bars, not only their tops.
    fn curves(&self, frame: &Frame) -> Vec<Vec<Point>> {
        let base = frame.y.low.max(0.0);
        let top = self.standing(frame);
        let bars = top.iter().map(|&(x, y)| vec![(x, base), (x, y)]);
        bars.chain([top.clone()]).collect()
    }

    fn swatches(&self, slot: Slot) -> Vec<(&str, Swatch)> {
        vec![(&self.name, Swatch::Bars(Look::new(slot, Style::Plain)))]
    }

    fn draw(&self, scene: &mut Scene, plot: &Plot<'_>, slot: Slot) {
        let (frame, look) = (plot.frame, Look::new(slot, Style::Plain));
        let runs = frame.runs(&self.standing(frame));
        for run in runs.iter().filter(|run| run.len() > 1) {
            Self::draw_outline(scene, run, &look, frame.area);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_that_can_be_shown_is_counted_once() {
        let values = [1.0, 10.0, 99.0, 100.0, -3.0, f64::NAN, 1000.0];
        let found = Histogram::of("", &values, 3, Scale::Logarithmic);
        assert_eq!(found.counts, [1.0, 2.0, 2.0]);
        assert!((found.edges[1] - 10.0).abs() < 1e-12 && found.edges.len() == 4);
        let same = Histogram::of("", &[5.0, 5.0], 4, Scale::Linear);
        assert_eq!(same.counts.iter().sum::<f64>(), 2.0);
        assert!(
            Histogram::of("", &[], 2, Scale::Linear)
                .counts
                .iter()
                .all(|&c| c == 0.0)
        );
    }

    #[test]
    fn the_outline_starts_and_ends_at_zero() {
        let found = Histogram::of("", &[0.0, 1.0, 1.0, 2.0], 2, Scale::Linear).outline();
        assert_eq!(found.first(), Some(&(0.0, 0.0)));
        assert_eq!(found.last(), Some(&(2.0, 0.0)));
        assert_eq!(found.len(), 6);
    }
}
