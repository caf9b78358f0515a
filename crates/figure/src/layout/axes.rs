//! The two axes of a panel: ticks, numbers and labels, fitted and drawn.

use super::plan::{AxisPlan, PanelPlan};
use crate::colour::{BLACK, GRID};
use crate::error::Side;
use crate::geometry::Frame;
use crate::scene::{Anchor, Scene, Shape, Stroke, Text};
use crate::text::{LINE, Typeface, width as width_of, wrap};
use crate::ticks::{Room, Ticks, shown};

/// Pixels on each side of a plot.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Needs {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
}

/// An axis fitted to a length.
#[derive(Debug, Clone, PartialEq)]
struct FittedAxis {
    ticks: Ticks,
    /// Lines of the label.
    label: Vec<String>,
    /// Whether numbers and label are written.
    labelled: bool,
}

/// Both axes fitted to a plot.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axes {
    x: FittedAxis,
    y: FittedAxis,
    /// Width of the widest number at the y axis.
    y_numbers: f64,
}

/// Width of the widest number of some ticks.
pub(super) fn widest(ticks: &Ticks, size: f64) -> f64 {
    let widths = ticks.major.iter().map(|tick| width_of(&tick.label, size));
    widths.fold(0.0, f64::max)
}

/// The thin line around a plot and of its ticks.
pub(crate) fn thin() -> Stroke {
    Stroke::solid(BLACK, 1.0)
}

/// Places of all ticks, with their lengths.
pub(super) fn lengths(ticks: &Ticks, faces: &Typeface) -> Vec<(f64, f64)> {
    let long = ticks
        .major
        .iter()
        .map(|tick| (tick.value, faces.tick_length()));
    let short = ticks
        .minor
        .iter()
        .map(|&value| (value, faces.minor_length()));
    long.chain(short).collect()
}

impl FittedAxis {
    fn new(plan: &AxisPlan<'_>, side: Side, length: f64, faces: &Typeface) -> Self {
        let (label, factor) = shown(&plan.axis.quantity, &plan.axis.unit, &plan.interval);
        let room = match side {
            Side::X => Room {
                length,
                distance: 6.6 * faces.tick,
                needs: Box::new(|text| width_of(text, faces.tick) + 0.9 * faces.tick),
            },
            Side::Y => Room::of_lines(length, 3.6 * faces.tick, faces.tick),
        };
        Self {
            ticks: Ticks::new(&plan.interval, factor, &room),
            label: match plan.labelled {
                true => wrap(&label, faces.label, length),
                false => Vec::new(),
            },
            labelled: plan.labelled,
        }
    }
}

impl Axes {
    /// Fits the axes to a plot of a size.
    pub(super) fn new(plan: &PanelPlan<'_>, [width, height]: [f64; 2], faces: &Typeface) -> Self {
        let y = FittedAxis::new(&plan.y, Side::Y, height, faces);
        Self {
            x: FittedAxis::new(&plan.x, Side::X, width, faces),
            y_numbers: widest(&y.ticks, faces.tick),
            y,
        }
    }

    /// What numbers and labels need around a plot of a width.
    pub(super) fn needs(&self, plan: &PanelPlan<'_>, width: f64, faces: &Typeface) -> Needs {
        let mut needs = Needs::default();
        if self.y.labelled {
            needs.left = faces.tick_length() + 0.35 * faces.tick + self.y_numbers;
            if !self.y.label.is_empty() {
                needs.left += faces.gap() + Typeface::lines(faces.label, self.y.label.len());
            }
            needs.top = 0.5 * LINE * faces.tick;
        }
        if self.x.labelled {
            // how far the numbers at the ends reach beyond the nearer end of the axis
            let ends = [self.x.ticks.major.first(), self.x.ticks.major.last()].map(|tick| {
                tick.map_or(0.0, |tick| {
                    let fraction = plan.x.interval.fraction(tick.value);
                    let inside = width * fraction.min(1.0 - fraction);
                    (0.5 * width_of(&tick.label, faces.tick) - inside).max(0.0)
                })
            });
            needs.left = needs.left.max(ends[0]);
            needs.right = ends[0].max(ends[1]);
            needs.bottom = faces.tick_length() + 0.2 * faces.tick + LINE * faces.tick;
            if !self.x.label.is_empty() {
                needs.bottom += 0.3 * faces.tick + Typeface::lines(faces.label, self.x.label.len());
            }
        }
        needs
    }

    /// Draws lines at the ticks, below everything else.
    pub(crate) fn draw_grid(&self, scene: &mut Scene, frame: &Frame) {
        let area = frame.area;
        let upright = self.x.ticks.major.iter().map(|tick| {
            let x = frame.across(tick.value);
            [(x, area.top), (x, area.bottom)]
        });
        let level = self.y.ticks.major.iter().map(|tick| {
            let y = frame.down(tick.value);
            [(area.left, y), (area.right, y)]
        });
        scene.shape(Shape::lines(upright.chain(level)).stroked(Stroke::solid(GRID, 1.0)));
    }

    /// Draws frame, ticks, numbers and labels.
    pub(crate) fn draw(&self, scene: &mut Scene, frame: &Frame, faces: &Typeface) {
        let area = frame.area;
        let below = lengths(&self.x.ticks, faces)
            .into_iter()
            .map(|(value, length)| {
                let x = frame.across(value);
                [(x, area.bottom), (x, area.bottom + length)]
            });
        let beside = lengths(&self.y.ticks, faces)
            .into_iter()
            .map(|(value, length)| {
                let y = frame.down(value);
                [(area.left - length, y), (area.left, y)]
            });
        scene.shape(Shape::lines(below.chain(beside)).stroked(thin()));
        scene.shape(Shape::rectangle(area).stroked(thin()));
        let middle = area.centre();
        if self.x.labelled {
            let mut line = area.bottom + faces.tick_length() + 0.2 * faces.tick + faces.tick;
            for tick in &self.x.ticks.major {
                let at = (frame.across(tick.value), line);
                scene.text(Text::new(&tick.label, at, faces.tick, Anchor::Middle));
            }
            line += 0.55 * faces.tick + faces.label;
            for label in &self.x.label {
                let at = (middle.0, line);
                scene.text(Text::new(label, at, faces.label, Anchor::Middle));
                line += LINE * faces.label;
            }
        }
        if self.y.labelled {
            let right = area.left - faces.tick_length() - 0.35 * faces.tick;
            for tick in &self.y.ticks.major {
                let at = (right, frame.down(tick.value) + 0.35 * faces.tick);
                scene.text(Text::new(&tick.label, at, faces.tick, Anchor::End));
            }
            // upward text stands on its right side, its first line at the left
            let mut line = right - self.y_numbers - faces.gap() - 0.25 * faces.label;
            for label in self.y.label.iter().rev() {
                scene.text(Text::upward(label, (line, middle.1), faces.label));
                line -= LINE * faces.label;
            }
        }
    }
}
