//! From values to pixels.

use crate::axis::Direction;
use crate::geometry::Rect;
use crate::interval::Interval;
use crate::layout::AxisPlan;

/// The area of a plot and the values that it shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    pub(crate) area: Rect,
    pub(crate) x: Interval,
    pub(crate) y: Interval,
    x_direction: Direction,
    y_direction: Direction,
}

impl Frame {
    pub(crate) fn new(area: Rect, x: &AxisPlan, y: &AxisPlan) -> Self {
        Self {
            area,
            x: x.interval,
            y: y.interval,
            x_direction: x.direction,
            y_direction: y.direction,
        }
    }

    /// Pixel along x of a value.
    pub(crate) fn across(&self, x: f64) -> f64 {
        let fraction = match self.x_direction {
            Direction::Usual => self.x.fraction(x),
            Direction::Reversed => 1.0 - self.x.fraction(x),
        };
        self.area.left + fraction * self.area.width()
    }

    /// Pixel along y of a value.
    pub(crate) fn down(&self, y: f64) -> f64 {
        let fraction = match self.y_direction {
            Direction::Usual => 1.0 - self.y.fraction(y),
            Direction::Reversed => self.y.fraction(y),
        };
        self.area.top + fraction * self.area.height()
    }

    /// Pixels of a point; none for one that the axes cannot show.
    ///
    /// What is far outside is brought nearer, so that no format meets a number it cannot write.
    pub(crate) fn place(&self, (x, y): (f64, f64)) -> Option<(f64, f64)> {
        const FAR: f64 = 1e5;
        (self.x.scale.shows(x) && self.y.scale.shows(y)).then(|| {
            (
                self.across(x).clamp(-FAR, FAR),
                self.down(y).clamp(-FAR, FAR),
            )
        })
    }

    /// The values at a pixel.
    pub(crate) fn values(&self, (across, down): (f64, f64)) -> (f64, f64) {
        let x = (across - self.area.left) / self.area.width();
        let y = (self.area.bottom - down) / self.area.height();
        let turned = |direction, fraction: f64| match direction {
            Direction::Usual => fraction,
            Direction::Reversed => 1.0 - fraction,
        };
        (
            self.x.value(turned(self.x_direction, x)),
            self.y.value(turned(self.y_direction, y)),
        )
    }

    /// Runs of points that can be shown, in pixels: a curve breaks at the others.
    pub(crate) fn runs(&self, points: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
        points
            .iter()
            .map(|&point| self.place(point))
            .collect::<Vec<_>>()
            .split(Option::is_none)
            .filter(|run| !run.is_empty())
            .map(|run| run.iter().copied().flatten().collect())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::Axis;

    fn frame(y: &Axis) -> Frame {
        let area = Rect::new(50.0, 10.0, 200.0, 100.0);
        let x = AxisPlan::new(&Axis::linear("x"), Interval::linear(0.0, 4.0));
        let interval = y.interval().unwrap();
        Frame::new(area, &x, &AxisPlan::new(y, interval))
    }

    #[test]
    fn places_run_over_the_area_and_back() {
        let usual = frame(&Axis::logarithmic("y").range(1.0, 100.0));
        assert_eq!(usual.place((0.0, 1.0)), Some((50.0, 110.0)));
        assert_eq!(usual.place((4.0, 100.0)), Some((250.0, 10.0)));
        assert_eq!(usual.place((1.0, 0.0)), None);
        let (x, y) = usual.values((150.0, 60.0));
        assert!((x - 2.0).abs() < 1e-12 && (y - 10.0).abs() < 1e-12);
        let depth = frame(&Axis::linear("z").range(0.0, 1.0).reversed());
        assert_eq!(depth.place((0.0, 0.0)), Some((50.0, 10.0)));
        assert_eq!(depth.values((50.0, 110.0)), (0.0, 1.0));
    }

    #[test]
    fn a_curve_breaks_where_nothing_can_be_shown() {
        let frame = frame(&Axis::logarithmic("y").range(1.0, 100.0));
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
