//! Curves: lines, points, the bars of a histogram, and their bands.

use super::Swatch;
use crate::axis::{Interval, Scale};
use crate::colour::WHITE;
use crate::drawing::{Drawing, DrawnPath, Stroke};
use crate::geometry::{Frame, Point, Rect};
use crate::look::{Look, Style};

/// Opacity of a band.
pub(crate) const BAND: f64 = 0.22;

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Name in the legend; empty for none.
    pub name: String,
    /// Points; the line is interrupted at points that the axes cannot show, such as NaN.
    pub points: Vec<(f64, f64)>,
    /// Style.
    pub style: Style,
    /// Error band in its colour: lower and upper side over the same x; empty for none.
    pub band: [Vec<(f64, f64)>; 2],
}

impl Line {
    /// A curve without a band.
    pub fn new(name: &str, style: Style, points: Vec<(f64, f64)>) -> Self {
        Self {
            name: name.to_owned(),
            points,
            style,
            band: Default::default(),
        }
    }

    /// A histogram: counts of values in `bins` bins of equal length on an axis of the given scale.
    ///
    /// Values that the axis cannot show (NaN, or not positive on a logarithmic axis) are not counted. The curve follows
    /// the tops of the bars, from zero to zero.
    pub fn histogram(name: &str, values: &[f64], bins: usize, scale: Scale) -> Self {
        let bins = bins.max(1);
        let interval = Interval::showing(scale, values.iter().copied(), 0.0);
        let mut counts = vec![0.0; bins];
        for &value in values.iter().filter(|&&v| scale.shows(v)) {
            let bin = (interval.fraction(value) * bins as f64) as usize;
            counts[bin.min(bins - 1)] += 1.0;
        }
        let edge = |i: usize| interval.value(i as f64 / bins as f64);
        let mut points = vec![(edge(0), 0.0)];
        for (i, count) in counts.into_iter().enumerate() {
            points.extend([(edge(i), count), (edge(i + 1), count)]);
        }
        points.push((edge(bins), 0.0));
        Self::new(name, Style::Bars, points)
    }

    /// Its points on the axes of a plot: on a logarithmic axis, which has no zero, bars begin at its end.
    fn standing(&self, frame: &Frame) -> Vec<Point> {
        let mut points = self.points.clone();
        if self.style == Style::Bars {
            points.iter_mut().for_each(|p| p.1 = p.1.max(frame.y.low));
        }
        points
    }

    fn draw_band(&self, drawing: &mut Drawing, frame: &Frame, look: &Look) {
        let place = |point: &Point| frame.place(*point);
        let [lower, upper] = self.band.each_ref().map(|side| frame.sides(side));
        for (lower, upper) in lower.iter().zip(&upper) {
            let pairs = lower.iter().zip(upper);
            let pairs: Vec<_> = pairs.map(|(a, b)| place(a).zip(place(b))).collect();
            for run in pairs.split(Option::is_none).filter(|run| run.len() > 1) {
                let run = || run.iter().flatten();
                let back = run().rev().map(|pair| pair.1);
                let outline: Vec<Point> = run().map(|pair| pair.0).chain(back).collect();
                let area = DrawnPath::polygon(&outline).filled(look.stroke.colour, BAND);
                drawing.shape(area.clipped(frame.area));
            }
        }
    }

    pub(super) fn places(&self) -> Vec<Point> {
        [self.band.concat(), self.points.clone()].concat()
    }

    /// Range of whole bars, including their bottoms.
    pub(super) fn curves(&self, frame: &Frame) -> Vec<Vec<Point>> {
        let points = self.standing(frame);
        let mut curves = self.band.to_vec();
        if self.style == Style::Bars {
            let base = frame.y.low.max(0.0);
            curves.extend(points.iter().map(|&(x, y)| vec![(x, base), (x, y)]));
        }
        curves.push(points);
        curves
    }

    pub(super) fn swatch(&self, numbers: [usize; 2]) -> Swatch {
        let has_band = !self.band[0].is_empty();
        let look = Look::new(numbers, self.style);
        Swatch::Curve { look, has_band }
    }

    pub(super) fn draw(&self, drawing: &mut Drawing, frame: &Frame, numbers: [usize; 2]) {
        let look = Look::new(numbers, self.style);
        self.draw_band(drawing, frame, &look);
        for points in frame.sides(&self.standing(frame)) {
            let runs = frame.runs(&points);
            for run in runs.iter().filter(|run| look.has_line() && run.len() > 1) {
                draw_run(drawing, run, &look, frame.area);
            }
            for &at in runs.iter().flatten() {
                // markers at the sides of a plot are drawn completely, those of points outside are not
                if frame.area.grown(0.01).has(at) {
                    look.mark(drawing, at);
                }
            }
        }
    }
}

/// Draws a line through points in pixels, over its rim or over the light filling of histogram bars, which may overlap.
pub(crate) fn draw_run(drawing: &mut Drawing, run: &[Point], look: &Look, clip: Rect) {
    if look.style == Style::Bars {
        let fill = DrawnPath::polygon(run).filled(look.stroke.colour, 0.18);
        drawing.shape(fill.clipped(clip));
    }
    if look.style == Style::Rimmed {
        let rim = Stroke::solid(WHITE, look.stroke.width + 2.4);
        drawing.shape(DrawnPath::polyline(run).stroked(rim).clipped(clip));
    }
    drawing.shape(DrawnPath::polyline(run).stroked(look.stroke).clipped(clip));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_that_can_be_shown_is_counted_once() {
        let values = [1.0, 10.0, 99.0, 100.0, -3.0, f64::NAN, 1000.0];
        let found = Line::histogram("", &values, 3, Scale::Logarithmic).points;
        let tops: Vec<f64> = found[1..].chunks_exact(2).map(|bar| bar[0].1).collect();
        assert_eq!(tops, [1.0, 2.0, 2.0]);
        assert!((found[2].0 - 10.0).abs() < 1e-12 && found.len() == 8);
        assert_eq!((found[0].1, found[7].1), (0.0, 0.0));
        let same = Line::histogram("", &[5.0, 5.0], 4, Scale::Linear).points;
        assert_eq!(same.iter().map(|p| p.1).sum::<f64>(), 2.0 * 2.0);
        let none = Line::histogram("", &[], 2, Scale::Linear).points;
        assert!(none.iter().all(|p| p.1 == 0.0));
    }
}
