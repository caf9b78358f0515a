//! The two axes of a panel: ticks, numbers and labels, fitted and drawn.

use super::plan::PanelPlan;
use crate::axis::{Axis, Interval};
use crate::colour::{BLACK, GRID};
use crate::drawing::{Drawing, DrawnPath, END, MIDDLE, Stroke, Text};
use crate::geometry::Frame;
use crate::text::{LINE, Typeface, width as width_of, wrap};
use crate::ticks::{Room, Ticks, shown, ticks};

/// Space on each side of a plot in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Needs {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
}

/// An axis fitted to a length.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FittedAxis {
    pub(super) ticks: Ticks,
    /// Width of the widest number.
    pub(super) numbers: f64,
    /// Lines of the label.
    pub(super) label: Vec<String>,
}

impl FittedAxis {
    /// Ticks of a panel or of a colour bar.
    pub(super) fn new(axis: &Axis, interval: &Interval, room: &Room<'_>, faces: &Typeface) -> Self {
        let (label, factor) = shown(axis, interval);
        let ticks = ticks(interval, factor, room);
        let widths = ticks.major.iter().map(|tick| width_of(&tick.1, faces.tick));
        Self {
            numbers: widths.fold(0.0, f64::max),
            ticks,
            label: wrap(&label, faces.label, room.length),
        }
    }

    /// Positions of all ticks, with their lengths.
    pub(super) fn lengths(&self, faces: &Typeface) -> impl Iterator<Item = (f64, f64)> {
        let (long, short) = (faces.tick_length(), 0.23 * faces.tick);
        let major = self.ticks.major.iter().map(move |tick| (tick.0, long));
        let minor = self.ticks.minor.iter().map(move |&value| (value, short));
        major.chain(minor)
    }
}

/// Width of the frame of a plot and of its ticks.
pub(super) const THIN: Stroke = Stroke::solid(BLACK, 1.0);

/// Both axes fitted to a plot.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlotAxes {
    x: FittedAxis,
    y: FittedAxis,
    /// Whether numbers and labels are written; with shared axes another panel may do so.
    labelled: [bool; 2],
}

impl PlotAxes {
    /// Fits the axes to a plot of a given size.
    pub(super) fn new(plan: &PanelPlan<'_>, [width, height]: [f64; 2], faces: &Typeface) -> Self {
        let beside = Room {
            length: width,
            distance: 6.6 * faces.tick,
            needs: &|text| width_of(text, faces.tick) + 0.9 * faces.tick,
        };
        let above = Room {
            length: height,
            distance: 3.6 * faces.tick,
            needs: &|_| LINE * faces.tick,
        };
        let [x, y] = &plan.intervals;
        Self {
            x: FittedAxis::new(&plan.panel.x, x, &beside, faces),
            y: FittedAxis::new(&plan.panel.y, y, &above, faces),
            labelled: plan.labelled,
        }
    }

    /// Space for numbers and labels around a plot of a given width.
    pub(super) fn needs(&self, plan: &PanelPlan<'_>, width: f64, faces: &Typeface) -> Needs {
        let mut needs = Needs::default();
        if self.labelled[1] {
            needs.left = faces.tick_length() + 0.35 * faces.tick + self.y.numbers;
            if !self.y.label.is_empty() {
                needs.left += faces.gap() + Typeface::lines(faces.label, self.y.label.len());
            }
            needs.top = 0.5 * LINE * faces.tick;
        }
        if self.labelled[0] {
            // overhang of the numbers at the ends beyond the nearer end of the axis
            let ends = [self.x.ticks.major.first(), self.x.ticks.major.last()].map(|tick| {
                tick.map_or(0.0, |(value, label)| {
                    let fraction = plan.intervals[0].fraction(*value);
                    let inside = width * fraction.min(1.0 - fraction);
                    (0.5 * width_of(label, faces.tick) - inside).max(0.0)
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

    /// Draws grid lines at the ticks, below everything else.
    pub(crate) fn draw_grid(&self, drawing: &mut Drawing, frame: &Frame) {
        let area = frame.area;
        let upright = self.x.ticks.major.iter().map(|tick| {
            let x = frame.across(tick.0);
            [(x, area.top), (x, area.bottom)]
        });
        let level = self.y.ticks.major.iter().map(|tick| {
            let y = frame.down(tick.0);
            [(area.left, y), (area.right, y)]
        });
        drawing.shape(DrawnPath::lines(upright.chain(level)).stroked(Stroke::solid(GRID, 1.0)));
    }

    /// Draws frame, ticks, numbers and labels.
    pub(crate) fn draw(&self, drawing: &mut Drawing, frame: &Frame, faces: &Typeface) {
        let area = frame.area;
        let below = self.x.lengths(faces).map(|(value, length)| {
            let x = frame.across(value);
            [(x, area.bottom), (x, area.bottom + length)]
        });
        let beside = self.y.lengths(faces).map(|(value, length)| {
            let y = frame.down(value);
            [(area.left - length, y), (area.left, y)]
        });
        drawing.shape(DrawnPath::lines(below.chain(beside)).stroked(THIN));
        drawing.shape(DrawnPath::rectangle(area).stroked(THIN));
        let middle = area.centre();
        if self.labelled[0] {
            let mut line = area.bottom + faces.tick_length() + 0.2 * faces.tick + faces.tick;
            for (value, label) in &self.x.ticks.major {
                let at = (frame.across(*value), line);
                drawing.text(Text::new(label, at, faces.tick, MIDDLE));
            }
            line += 0.55 * faces.tick + faces.label;
            for label in &self.x.label {
                drawing.text(Text::new(label, (middle.0, line), faces.label, MIDDLE));
                line += LINE * faces.label;
            }
        }
        if self.labelled[1] {
            let right = area.left - faces.tick_length() - 0.35 * faces.tick;
            for (value, label) in &self.y.ticks.major {
                let at = (right, frame.down(*value) + 0.35 * faces.tick);
                drawing.text(Text::new(label, at, faces.tick, END));
            }
            // upward text stands on its right side, with its first line at the left
            let mut line = right - self.y.numbers - faces.gap() - 0.25 * faces.label;
            for label in self.y.label.iter().rev() {
                drawing.text(Text::upward(label, (line, middle.1), faces.label));
                line -= LINE * faces.label;
            }
        }
    }
}
