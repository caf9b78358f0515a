//! A drawing as a list of shapes, pictures and texts with their positions. All formats are written from it.

use crate::font;
use crate::geometry::{Point, Rect};
use crate::text::{TextRun, runs, width};

/// A part of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum OutlinePart {
    Move(f64, f64),
    Line(f64, f64),
    /// A cubic Bezier curve: two control points and the end.
    Curve([f64; 6]),
    Close,
}

/// Style of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) colour: u32,
    pub(crate) width: f64,
    /// Lengths of dashes and gaps; empty for a solid line.
    pub(crate) dash: &'static [f64],
}

impl Stroke {
    pub(crate) const fn new(colour: u32, width: f64, dash: &'static [f64]) -> Self {
        Self {
            colour,
            width,
            dash,
        }
    }

    pub(crate) const fn solid(colour: u32, width: f64) -> Self {
        Self::new(colour, width, &[])
    }
}

/// An outline, filled or stroked.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct DrawnPath {
    pub(crate) segments: Vec<OutlinePart>,
    /// Fill with an opacity: 1 is opaque.
    pub(crate) fill: Option<(u32, f64)>,
    pub(crate) stroke: Option<Stroke>,
    /// Area to which drawing is restricted.
    pub(crate) clip: Option<Rect>,
}

impl DrawnPath {
    fn new(segments: Vec<OutlinePart>) -> Self {
        Self {
            segments,
            ..Self::default()
        }
    }

    /// Straight lines through points.
    pub(crate) fn polyline(points: &[Point]) -> Self {
        let segments = points.iter().enumerate().map(|(i, &(x, y))| match i {
            0 => OutlinePart::Move(x, y),
            _ => OutlinePart::Line(x, y),
        });
        Self::new(segments.collect())
    }

    /// Straight lines, each from one point to another.
    pub(crate) fn lines(ends: impl IntoIterator<Item = [Point; 2]>) -> Self {
        let lines = ends.into_iter().map(|ends| Self::polyline(&ends).segments);
        Self::new(lines.flatten().collect())
    }

    /// A closed outline through points.
    pub(crate) fn polygon(points: &[Point]) -> Self {
        let mut shape = Self::polyline(points);
        shape.segments.push(OutlinePart::Close);
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
            OutlinePart::Move(x + r, y),
            OutlinePart::Curve([x + r, y + c, x + c, y + r, x, y + r]),
            OutlinePart::Curve([x - c, y + r, x - r, y + c, x - r, y]),
            OutlinePart::Curve([x - r, y - c, x - c, y - r, x, y - r]),
            OutlinePart::Curve([x + c, y - r, x + r, y - c, x + r, y]),
            OutlinePart::Close,
        ])
    }

    pub(crate) fn filled(mut self, colour: u32, opacity: f64) -> Self {
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
pub(crate) struct Bitmap {
    pub(crate) area: Rect,
    pub(crate) columns: u32,
    pub(crate) rows: u32,
    /// None for transparent pixels.
    pub(crate) pixels: Vec<Option<u32>>,
}

/// Anchor of a text, as a fraction of its width.
pub(crate) const START: f64 = 0.0;
pub(crate) const MIDDLE: f64 = 0.5;
pub(crate) const END: f64 = 1.0;

/// A line of text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Text {
    runs: Vec<TextRun>,
    /// Its start on the baseline.
    start: Point,
    size: f64,
    /// Whether it runs from the bottom to the top.
    pub(crate) is_upward: bool,
    /// Whether it has a white rim, so that it is readable over lines.
    pub(crate) has_rim: bool,
}

impl Text {
    /// A text at a position on the baseline.
    pub(crate) fn new(markup: &str, (x, y): Point, size: f64, anchor: f64) -> Self {
        Self {
            runs: runs(markup),
            start: (x - anchor * width(markup, size), y),
            size,
            is_upward: false,
            has_rim: false,
        }
    }

    /// A text that runs upward, centred at a position.
    pub(crate) fn upward(markup: &str, (x, y): Point, size: f64) -> Self {
        let mut text = Self::new(markup, (x, y), size, START);
        text.start.1 += 0.5 * text.width();
        text.is_upward = true;
        text
    }

    fn width(&self) -> f64 {
        self.size * self.runs.iter().map(TextRun::width).sum::<f64>()
    }

    /// Its parts with their sizes and starts. Blanks around a part are left out; its position includes them.
    pub(crate) fn parts<'a>(&'a self) -> Vec<(&'a str, f64, Point)> {
        let mut along = 0.0;
        let part = |run: &'a TextRun| {
            let TextRun { text, size, rise } = run;
            let size = self.size * size;
            let width = |text: &str| size * font::width(text);
            let indent = width(&text[..text.len() - text.trim_start().len()]);
            let (start, up) = (along + indent, self.size * rise);
            along += width(text);
            let (x, y) = self.start;
            let place = match self.is_upward {
                true => (x - up, y - start),
                false => (x + start, y - up),
            };
            (text.trim(), size, place)
        };
        self.runs.iter().map(part).collect()
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
        match self.is_upward {
            true => Rect::new(x - above, y - width, above + below, width),
            false => Rect::new(x, y - above, width, above + below),
        }
    }

    /// The text without superscripts and subscripts.
    pub(crate) fn plain(&self) -> String {
        self.runs.iter().map(|run| run.text.as_str()).collect()
    }
}

/// One element of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Item {
    DrawnPath(DrawnPath),
    Bitmap(Bitmap),
    Text(Text),
}

/// All elements of a drawing, later ones over earlier ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// The canvas.
    pub canvas: Rect,
    /// The plots of the panels, without the labels around them.
    pub plots: Vec<Rect>,
    pub(crate) items: Vec<Item>,
}

impl Drawing {
    /// All texts with the rectangles that they cover; superscripts and subscripts are written on the baseline.
    pub fn texts(&self) -> Vec<(String, Rect)> {
        let texts = self.items.iter().filter_map(|item| match item {
            Item::Text(text) => Some((text.plain(), text.bounds())),
            Item::DrawnPath(_) | Item::Bitmap(_) => None,
        });
        texts.collect()
    }

    pub(crate) fn shape(&mut self, shape: DrawnPath) {
        self.items.push(Item::DrawnPath(shape));
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
        let level = Text::new("10^{6} s", (100.0, 50.0), 12.0, END);
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
        assert!(parts[1].2.0 > parts[0].2.0, "lowered to the right");
        let end = |(text, size, start): (&str, f64, Point)| (start, size * font::width(text));
        let (start, length) = end(parts[0]);
        assert!((start.1 - length - parts[1].2.1).abs() < 1e-12);
        // a blank after a superscript keeps its position
        let text = Text::new("10^{6} s", (0.0, 0.0), 10.0, START);
        let parts = text.parts();
        assert_eq!(parts[2].0, "s");
        let (start, length) = end(parts[1]);
        assert!(parts[2].2.0 > start.0 + length + 1.0);
    }
}
