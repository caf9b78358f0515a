//! Positions on the canvas, in pixels from its upper left corner, and the map from values to positions.

use crate::axis::Interval;

/// A rectangle; `top < bottom`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rect {
    /// Left side.
    pub left: f64,
    /// Upper side.
    pub top: f64,
    /// Right side.
    pub right: f64,
    /// Lower side.
    pub bottom: f64,
}

impl Rect {
    /// A rectangle from its upper left corner and its size.
    pub fn new(left: f64, top: f64, width: f64, height: f64) -> Self {
        Self {
            left,
            top,
            right: left + width,
            bottom: top + height,
        }
    }

    /// Its width.
    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    /// Its height.
    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// Whether both rectangles have a point in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        let across = self.left < other.right && other.left < self.right;
        across && self.top < other.bottom && other.top < self.bottom
    }

    /// Whether the other rectangle lies inside.
    pub fn holds(&self, other: &Self) -> bool {
        self.has((other.left, other.top)) && self.has((other.right, other.bottom))
    }

    /// Whether a point lies inside.
    pub(crate) fn has(&self, (x, y): Point) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }

    /// The rectangle extended by a distance on every side.
    pub(crate) fn grown(&self, by: f64) -> Self {
        Self {
            left: self.left - by,
            top: self.top - by,
            right: self.right + by,
            bottom: self.bottom + by,
        }
    }

    /// The smallest rectangle that contains both.
    pub(crate) fn union(self, other: Self) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// The middle.
    pub(crate) fn centre(&self) -> Point {
        let middle = |a: f64, b: f64| 0.5 * (a + b);
        (middle(self.left, self.right), middle(self.top, self.bottom))
    }
}

/// x and y, of values or of pixels.
pub(crate) type Point = (f64, f64);

/// The area of a plot and its range of values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    pub(crate) area: Rect,
    pub(crate) x: Interval,
    pub(crate) y: Interval,
    pub(crate) reversed: [bool; 2],
    /// Whether everything is also shown at -x.
    pub(crate) is_mirrored: bool,
}

impl Frame {
    /// Pixel along x of a value.
    pub(crate) fn across(&self, x: f64) -> f64 {
        let fraction = turned(self.reversed[0], self.x.fraction(x));
        self.area.left + fraction * self.area.width()
    }

    /// Pixel along y of a value.
    pub(crate) fn down(&self, y: f64) -> f64 {
        let fraction = turned(!self.reversed[1], self.y.fraction(y));
        self.area.top + fraction * self.area.height()
    }

    /// Pixels of a point; none if the axes cannot show it.
    ///
    /// Points far outside are moved closer, so that all formats can represent their coordinates.
    pub(crate) fn place(&self, (x, y): Point) -> Option<Point> {
        let near = |pixel: f64| pixel.clamp(-1e5, 1e5);
        let is_shown = self.x.scale.shows(x) && self.y.scale.shows(y);
        is_shown.then(|| (near(self.across(x)), near(self.down(y))))
    }

    /// The values at a pixel.
    pub(crate) fn values(&self, (across, down): Point) -> Point {
        let x = (across - self.area.left) / self.area.width();
        let y = (self.area.bottom - down) / self.area.height();
        let (x, y) = (turned(self.reversed[0], x), turned(self.reversed[1], y));
        (self.x.value(x), self.y.value(y))
    }

    /// Runs of points that can be shown, in pixels: a curve is interrupted at the others.
    pub(crate) fn runs(&self, points: &[Point]) -> Vec<Vec<Point>> {
        let places: Vec<_> = points.iter().map(|&point| self.place(point)).collect();
        let runs = places.split(Option::is_none);
        let runs = runs.map(|run| run.iter().copied().flatten().collect());
        runs.filter(|run: &Vec<Point>| !run.is_empty()).collect()
    }

    /// A curve, and its other half in a mirrored panel.
    pub(crate) fn sides(&self, points: &[Point]) -> Vec<Vec<Point>> {
        let other = || points.iter().map(|&(x, y)| (-x, y)).collect();
        let other = self.is_mirrored.then(other);
        [points.to_vec()].into_iter().chain(other).collect()
    }
}

/// A fraction of the way, counted from the other end on a reversed axis.
fn turned(is_reversed: bool, fraction: f64) -> f64 {
    if is_reversed {
        1.0 - fraction
    } else {
        fraction
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(y: Interval, is_reversed: bool) -> Frame {
        Frame {
            area: Rect::new(50.0, 10.0, 200.0, 100.0),
            x: Interval::linear(0.0, 4.0),
            y,
            reversed: [false, is_reversed],
            is_mirrored: false,
        }
    }

    #[test]
    fn places_run_over_the_area_and_back() {
        let usual = frame(Interval::logarithmic(1.0, 100.0), false);
        assert_eq!(usual.place((0.0, 1.0)), Some((50.0, 110.0)));
        assert_eq!(usual.place((4.0, 100.0)), Some((250.0, 10.0)));
        assert_eq!(usual.place((1.0, 0.0)), None);
        let (x, y) = usual.values((150.0, 60.0));
        assert!((x - 2.0).abs() < 1e-12 && (y - 10.0).abs() < 1e-12);
        let depth = frame(Interval::linear(0.0, 1.0), true);
        assert_eq!(depth.place((0.0, 0.0)), Some((50.0, 10.0)));
        assert_eq!(depth.values((50.0, 110.0)), (0.0, 1.0));
    }

    #[test]
    fn a_curve_breaks_where_nothing_can_be_shown() {
        let frame = frame(Interval::logarithmic(1.0, 100.0), false);
        let runs = frame.runs(&[
            (0.0, 1.0),
            (1.0, 2.0),
            (f64::NAN, 2.0),
            (2.0, 0.0),
            (3.0, 5.0),
        ]);
        assert_eq!(runs.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1]);
        assert!(frame.place((1e300, 1.0)).unwrap().0 <= 1e5);
    }
}
