//! What is drawn, as a list: shapes, pictures and texts with their places. Every format is written from it.

use crate::colour::{BLACK, Colour};
use crate::font;
use crate::geometry::{Point, Rect};
use crate::text::{Run, runs};

/// A part of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Segment {
    Move(f64, f64),
    Line(f64, f64),
    /// A cubic: two control points and the end.
    Curve([f64; 6]),
    Close,
}

/// How an outline is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) colour: Colour,
    pub(crate) width: f64,
    /// Lengths of dashes and gaps; empty for a whole line.
    pub(crate) dash: &'static [f64],
}

impl Stroke {
    pub(crate) fn new(colour: Colour, width: f64, dash: &'static [f64]) -> Self {
        Self {
            colour,
            width,
            dash,
        }
    }

    pub(crate) fn solid(colour: Colour, width: f64) -> Self {
        Self::new(colour, width, &[])
    }
}

/// An outline, filled or drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Shape {
    pub(crate) segments: Vec<Segment>,
    /// With an opacity: 1 hides what is below.
    pub(crate) fill: Option<(Colour, f64)>,
    pub(crate) stroke: Option<Stroke>,
    /// Nothing is drawn outside.
    pub(crate) clip: Option<Rect>,
}

impl Shape {
    fn new(segments: Vec<Segment>) -> Self {
        Self {
            segments,
            ..Self::default()
        }
    }

    /// Straight lines through points.
    pub(crate) fn polyline(points: &[Point], stroke: Stroke) -> Self {
        let segments = points.iter().enumerate().map(|(i, &(x, y))| match i {
            0 => Segment::Move(x, y),
            _ => Segment::Line(x, y),
        });
        Self::new(segments.collect()).stroked(stroke)
    }

    /// Straight lines, each from one point to another.
    pub(crate) fn lines(ends: impl IntoIterator<Item = [Point; 2]>) -> Self {
        let segments = ends
            .into_iter()
            .flat_map(|[from, to]| [Segment::Move(from.0, from.1), Segment::Line(to.0, to.1)]);
        Self::new(segments.collect())
    }

    /// A closed outline through points.
    pub(crate) fn polygon(points: &[Point]) -> Self {
        let mut shape = Self::polyline(points, Stroke::solid(BLACK, 0.0));
        shape.segments.push(Segment::Close);
        shape.stroke = None;
        shape
    }

    pub(crate) fn rectangle(area: Rect) -> Self {
        Self::polygon(&[
            (area.left, area.top),
            (area.right, area.top),
            (area.right, area.bottom),
            (area.left, area.bottom),
        ])
    }

    pub(crate) fn circle((x, y): Point, radius: f64) -> Self {
        // a cubic's distance from the circle is below 3e-4 of the radius
        let (r, c) = (radius, 0.552_284_75 * radius);
        Self::new(vec![
            Segment::Move(x + r, y),
            Segment::Curve([x + r, y + c, x + c, y + r, x, y + r]),
            Segment::Curve([x - c, y + r, x - r, y + c, x - r, y]),
            Segment::Curve([x - r, y - c, x - c, y - r, x, y - r]),
            Segment::Curve([x + c, y - r, x + r, y - c, x + r, y]),
            Segment::Close,
        ])
    }

    pub(crate) fn filled(mut self, colour: Colour, opacity: f64) -> Self {
        self.fill = Some((colour, opacity));
        self
    }

    pub(crate) fn stroked(mut self, stroke: Stroke) -> Self {
        self.stroke = Some(stroke);
        self
    }

    pub(crate) fn clipped(mut self, area: Rect) -> Self {
        self.clip = Some(area);
        self
    }
}

/// Pixels stretched over an area; rows from the top.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Picture {
    pub(crate) area: Rect,
    pub(crate) columns: u32,
    pub(crate) rows: u32,
    /// None where nothing is to be seen.
    pub(crate) pixels: Vec<Option<Colour>>,
}

/// Which way a text runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turn {
    /// From left to right.
    Level,
    /// From the bottom to the top.
    Upward,
}

/// Which point of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A line of text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Text {
    runs: Vec<Run>,
    /// Its start on the line on which letters stand.
    pub(crate) start: Point,
    pub(crate) size: f64,
    pub(crate) turn: Turn,
    /// Whether it has a white rim, to be read over lines.
    pub(crate) rim: bool,
}

impl Text {
    /// A text at a place on the line on which letters stand.
    pub(crate) fn new(markup: &str, (x, y): Point, size: f64, anchor: Anchor) -> Self {
        let mut text = Self {
            runs: runs(markup),
            start: (x, y),
            size,
            turn: Turn::Level,
            rim: false,
        };
        text.start.0 -= match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * text.width(),
            Anchor::End => text.width(),
        };
        text
    }

    /// A text that runs upward, its middle at a place.
    pub(crate) fn upward(markup: &str, (x, y): Point, size: f64) -> Self {
        let mut text = Self::new(markup, (x, y), size, Anchor::Start);
        text.start.1 += 0.5 * text.width();
        text.turn = Turn::Upward;
        text
    }

    fn width(&self) -> f64 {
        self.size * self.runs.iter().map(Run::width).sum::<f64>()
    }

    /// With a white rim.
    pub(crate) fn rimmed(mut self) -> Self {
        self.rim = true;
        self
    }

    /// Its parts from the start on; blanks around one are left out, its place says them.
    pub(crate) fn parts(&self) -> Vec<Part<'_>> {
        let mut along = 0.0;
        let mut parts = Vec::with_capacity(self.runs.len());
        for run in &self.runs {
            let text = run.text.trim();
            let width = |text: &str| self.size * run.size * font::width(text);
            let indent = width(&run.text[..run.text.len() - run.text.trim_start().len()]);
            let (x, y) = self.start;
            let up = self.size * run.rise;
            let start = along + indent;
            parts.push(Part {
                text,
                size: self.size * run.size,
                start: match self.turn {
                    Turn::Level => (x + start, y - up),
                    Turn::Upward => (x - up, y - start),
                },
            });
            along += width(&run.text);
        }
        parts
    }

    /// The rectangle that it covers.
    pub(crate) fn bounds(&self) -> Rect {
        let (x, y) = self.start;
        let width = self.width();
        let (mut above, mut below) = (0.0_f64, 0.0_f64);
        for run in &self.runs {
            above = above.max(run.rise + run.size * font::ASCENT);
            below = below.max(run.size * font::DESCENT - run.rise);
        }
        let (above, below) = (above * self.size, below * self.size);
        match self.turn {
            Turn::Level => Rect::new(x, y - above, width, above + below),
            Turn::Upward => Rect::new(x - above, y - width, above + below, width),
        }
    }

    /// What it says, without raising and lowering.
    pub(crate) fn plain(&self) -> String {
        self.runs.iter().map(|run| run.text.as_str()).collect()
    }
}

/// A part of a text at one size and height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Part<'a> {
    pub(crate) text: &'a str,
    pub(crate) size: f64,
    pub(crate) start: Point,
}

/// One thing that is drawn.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Item {
    Shape(Shape),
    Picture(Picture),
    Text(Text),
}

/// Everything that is drawn, later over earlier.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scene {
    pub(crate) width: f64,
    pub(crate) height: f64,
    /// Areas of the plots.
    pub(crate) plots: Vec<Rect>,
    pub(crate) items: Vec<Item>,
}

impl Scene {
    pub(crate) fn shape(&mut self, shape: Shape) {
        self.items.push(Item::Shape(shape));
    }

    pub(crate) fn text(&mut self, text: Text) {
        self.items.push(Item::Text(text));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_covers_what_it_is_anchored_to() {
        let level = Text::new("10^{6} s", (100.0, 50.0), 12.0, Anchor::End);
        let bounds = level.bounds();
        assert!((bounds.right - 100.0).abs() < 1e-9 && bounds.has((90.0, 45.0)));
        assert_eq!(level.plain(), "106 s");
        let upward = Text::upward("force", (20.0, 80.0), 12.0).bounds();
        assert!((upward.centre().1 - 80.0).abs() < 1e-9);
        assert!(upward.height() > upward.width());
    }

    #[test]
    fn parts_follow_one_another() {
        let text = Text::upward("r_{0}/c", (10.0, 10.0), 10.0);
        let parts = text.parts();
        assert_eq!(parts.len(), 3);
        assert!(parts[1].start.0 > parts[0].start.0, "lowered to the right");
        let width = |part: &Part<'_>| part.size * font::width(part.text);
        assert!((parts[0].start.1 - width(&parts[0]) - parts[1].start.1).abs() < 1e-12);
        // a blank after a raised part keeps its place
        let text = Text::new("10^{6} s", (0.0, 0.0), 10.0, Anchor::Start);
        let parts = text.parts();
        assert_eq!(parts[2].text, "s");
        assert!(
            parts[2].start.0 > parts[1].start.0 + parts[1].size * font::width(parts[1].text) + 1.0
        );
    }
}
