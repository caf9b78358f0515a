//! The legend of a panel: its entries, broken into lines and columns, inside or outside the plot.

use super::axes::Needs;
use super::labels::{free, occupied};
use super::plan::PanelPlan;
use crate::colour::{MARK, WHITE};
use crate::drawing::{Drawing, DrawnPath, START, Stroke, Text};
use crate::figure::Legend as Wish;
use crate::geometry::{Frame, Point, Rect};
use crate::layers::{BAND, Swatch, draw_run};
use crate::look::Style;
use crate::text::{LINE, Typeface, width as width_of, wrap};

/// Width of the sample of a curve.
const SWATCH: f64 = 30.0;

/// A name with its sample, and their position relative to the upper left corner of the legend.
#[derive(Debug, Clone, PartialEq)]
struct Entry {
    swatch: Swatch,
    /// Lines of the name.
    lines: Vec<String>,
    left: f64,
    top: f64,
}

/// Position of a legend.
#[derive(Debug, Clone, Copy, PartialEq)]
enum LegendPlace {
    /// In the plot, which starts at 0, 0.
    Inside(Rect),
    /// At the right of the plot, at a distance from its side.
    Right(f64),
    /// Below the label of the x axis, at a distance from the plot.
    Below(f64),
}

/// A legend with its position.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LegendBox {
    entries: Vec<Entry>,
    width: f64,
    height: f64,
    place: LegendPlace,
}

impl LegendBox {
    /// The legend around a plot at 0, 0, at its right at most `most_right` wide; it is added to the space around the
    /// plot.
    pub(super) fn new(
        plan: &PanelPlan<'_>,
        frame: &Frame,
        faces: &Typeface,
        needs: &mut Needs,
        most_right: f64,
    ) -> Option<Self> {
        let named = named(plan);
        if named.is_empty() || plan.panel.legend == Wish::Off {
            return None;
        }
        let (width, height) = (frame.area.width(), frame.area.height());
        // the other half of a mirrored section is filled as well
        let may_be_inside = !plan.panel.is_filled() && !plan.panel.is_mirrored;
        if plan.panel.legend == Wish::Auto && may_be_inside {
            let mut legend = Self::block(&named, 0.62 * width, 1, faces.legend);
            let air = 0.7 * faces.tick;
            let taken = occupied(plan.panel, frame);
            let size = (legend.width + air, legend.height + 0.6 * air);
            if let Some(found) = free(frame.area, size, air, &taken) {
                legend.place = LegendPlace::Inside(found);
                return Some(legend);
            }
        }
        let mut legend = Self::block(&named, most_right, 1, faces.legend);
        if most_right >= 14.0 * faces.tick && legend.height < 1.6 * height {
            let from = needs.right + 1.3 * faces.tick;
            legend.place = LegendPlace::Right(from);
            needs.right = from + legend.width;
            needs.bottom = needs.bottom.max(legend.height - height);
            return Some(legend);
        }
        legend = Self::block(&named, width, 6, faces.legend);
        let from = needs.bottom + faces.gap();
        legend.place = LegendPlace::Below(from);
        needs.bottom = from + legend.height;
        Some(legend)
    }

    /// Names in columns within a width, without a position.
    fn block(named: &[(&str, Swatch)], width: f64, most_columns: usize, size: f64) -> Self {
        let indent = SWATCH + 0.5 * size;
        let room = (width - indent).max(2.0 * size);
        let long = |name: &str| width_of(name, size);
        let natural = named.iter().map(|(name, _)| long(name)).fold(0.0, f64::max);
        let text = natural.min(room);
        let gap = 1.4 * size;
        let columns = (((width + gap) / (indent + text + gap)) as usize)
            .clamp(1, most_columns.min(named.len()));
        let mut entries = Vec::new();
        let (mut top, mut widest) = (0.0, 0.0_f64);
        for row in named.chunks(columns) {
            let mut lines_in_row = 1;
            for (i, (name, swatch)) in row.iter().enumerate() {
                let lines = wrap(name, size, text);
                let left = i as f64 * (indent + text + gap);
                let longest = lines.iter().map(|line| long(line)).fold(0.0, f64::max);
                widest = widest.max(left + indent + longest);
                lines_in_row = lines_in_row.max(lines.len());
                entries.push(Entry {
                    swatch: swatch.clone(),
                    lines,
                    left,
                    top,
                });
            }
            top += size * (LINE * lines_in_row as f64 + 0.25);
        }
        Self {
            entries,
            width: widest,
            height: top,
            place: LegendPlace::Below(0.0),
        }
    }

    /// The part of a plot that it covers.
    pub(crate) fn covered(&self, plot: Rect) -> Option<Rect> {
        let LegendPlace::Inside(found) = self.place else {
            return None;
        };
        let (left, top) = (plot.left + found.left, plot.top + found.top);
        Some(Rect::new(left, top, found.width(), found.height()))
    }

    /// Draws it around a plot.
    pub(crate) fn draw(&self, drawing: &mut Drawing, plot: Rect, size: f64) {
        if let Some(back) = self.covered(plot) {
            let edge = Stroke::solid(0xcc_cc_cc, 0.8);
            drawing.shape(DrawnPath::rectangle(back).filled(WHITE, 0.85).stroked(edge));
        }
        let (left, top) = match self.place {
            LegendPlace::Inside(found) => (
                plot.left + found.left + 0.5 * (found.width() - self.width),
                plot.top + found.top + 0.5 * (found.height() - self.height),
            ),
            LegendPlace::Right(from) => (plot.right + from, plot.top),
            LegendPlace::Below(from) => (plot.left, plot.bottom + from),
        };
        for entry in &self.entries {
            let (x, mut line) = (left + entry.left, top + entry.top + size);
            sample(drawing, &entry.swatch, (x, line - 0.33 * size), size);
            for text in &entry.lines {
                let at = (x + SWATCH + 0.5 * size, line);
                drawing.text(Text::new(text, at, size, START));
                line += LINE * size;
            }
        }
    }
}

/// Names in a panel with their samples, each curve once.
fn named<'a>(plan: &PanelPlan<'a>) -> Vec<(&'a str, Swatch)> {
    let mut found: Vec<(&str, Swatch)> = Vec::new();
    let layers = plan.panel.layers.iter().zip(&plan.numbers);
    let all = layers.flat_map(|(layer, &numbers)| layer.swatches(numbers));
    for (name, swatch) in all.filter(|(name, _)| !name.is_empty()) {
        let is_class = matches!(swatch, Swatch::Fill(_));
        if is_class || !found.iter().any(|(known, _)| *known == name) {
            found.push((name, swatch));
        }
    }
    found
}

/// Draws the sample of an entry to the right of a position.
fn sample(drawing: &mut Drawing, swatch: &Swatch, (x, y): Point, size: f64) {
    let patch = Rect::new(x + 2.0, y - 0.45 * size, SWATCH - 4.0, 0.9 * size);
    match swatch {
        Swatch::Fill(colour) => {
            let edge = Stroke::solid(MARK, 0.8);
            drawing.shape(
                DrawnPath::rectangle(patch)
                    .filled(*colour, 1.0)
                    .stroked(edge),
            );
        }
        Swatch::Curve { look, .. } if look.style == Style::Bars => {
            let bar = [
                (patch.left, patch.bottom),
                (patch.left, patch.top),
                (patch.right, patch.top),
                (patch.right, patch.bottom),
            ];
            draw_run(drawing, &bar, look, patch.grown(2.0));
        }
        Swatch::Curve { look, has_band } => {
            if *has_band {
                drawing.shape(DrawnPath::rectangle(patch).filled(look.stroke.colour, BAND));
            }
            if look.has_line() {
                let line = DrawnPath::polyline(&[(x, y), (x + SWATCH, y)]);
                drawing.shape(line.stroked(look.stroke));
            }
            look.mark(drawing, (x + 0.5 * SWATCH, y));
        }
    }
}
