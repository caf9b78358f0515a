//! The legend of a panel: its entries, broken into lines and columns.

use super::looks::{Look, Looks, fills, look};
use super::plan::PanelPlan;
use super::typeface::{SWATCH, Typeface};
use crate::colour::Colour;
use crate::geometry::Rect;
use crate::layer::{Layer, Style};
use crate::text::{LINE, Rich, wrap};

/// The sample beside a name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Swatch {
    /// A class.
    Fill(Colour),
    /// The bars of a histogram.
    Bars(Look),
    /// A curve, a band of its colour, or both.
    Curve {
        line: Option<Look>,
        band: Option<Colour>,
    },
}

/// A name with its sample.
#[derive(Debug, Clone, PartialEq)]
struct Entry {
    name: String,
    swatch: Swatch,
}

/// An entry with its place from the upper left corner of the legend.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlacedEntry {
    pub(crate) swatch: Swatch,
    pub(crate) lines: Vec<String>,
    pub(crate) left: f64,
    pub(crate) top: f64,
}

/// A legend of a known size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Block {
    pub(crate) entries: Vec<PlacedEntry>,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

/// Where a legend is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LegendPlace {
    /// In the plot, which starts at 0, 0.
    Inside(Rect),
    /// At its right, so far from the side of the plot.
    Right(f64),
    /// Below the label of the x axis, so far below the plot.
    Below(f64),
}

/// Names of a panel; a band and a line of the same name are one.
fn entries(plan: &PanelPlan<'_>, looks: &Looks) -> Vec<Entry> {
    let mut found: Vec<Entry> = Vec::new();
    let slots = looks.slots(&plan.panel.layers);
    for (layer, &slot) in plan.panel.layers.iter().zip(&slots) {
        let curve = |style| Swatch::Curve {
            line: Some(look(slot, style)),
            band: None,
        };
        let colour = look(slot, Style::Plain).colour;
        let swatch = match layer {
            Layer::Classes(classes) => {
                let fills = fills(classes.names.len());
                let named = classes.names.iter().zip(fills);
                found.extend(named.map(|(name, &fill)| Entry {
                    name: name.clone(),
                    swatch: Swatch::Fill(fill),
                }));
                continue;
            }
            Layer::Line(line) => curve(line.style),
            Layer::Band(_) => Swatch::Curve {
                line: None,
                band: Some(colour),
            },
            Layer::Histogram(_) => Swatch::Bars(look(slot, Style::Plain)),
            Layer::Image(_) | Layer::Mark(_) | Layer::Point(_) => continue,
        };
        let name = layer.name();
        if name.is_empty() {
            continue;
        }
        match (found.iter_mut().find(|e| e.name == name), swatch) {
            (
                Some(Entry {
                    swatch: Swatch::Curve { line, band },
                    ..
                }),
                Swatch::Curve {
                    line: more_line,
                    band: more_band,
                },
            ) => {
                *line = line.or(more_line);
                *band = band.or(more_band);
            }
            (Some(_), _) => {}
            (None, swatch) => found.push(Entry {
                name: name.to_owned(),
                swatch,
            }),
        }
    }
    found
}

impl Block {
    /// The names of a panel in columns within a width; none for a panel without names.
    pub(super) fn new(
        plan: &PanelPlan<'_>,
        looks: &Looks,
        width: f64,
        most_columns: usize,
        faces: &Typeface,
    ) -> Option<Self> {
        let entries = entries(plan, looks);
        if entries.is_empty() {
            return None;
        }
        let size = faces.legend;
        let indent = SWATCH + 0.5 * size;
        let room = (width - indent).max(2.0 * size);
        let natural = entries
            .iter()
            .map(|e| Rich::new(&e.name).width(size))
            .fold(0.0, f64::max);
        let text = natural.min(room);
        let gap = 1.4 * size;
        let columns = (((width + gap) / (indent + text + gap)) as usize)
            .clamp(1, most_columns.min(entries.len()));
        let mut placed = Vec::new();
        let (mut top, mut widest) = (0.0, 0.0_f64);
        for row in entries.chunks(columns) {
            let mut lines_in_row = 1;
            for (i, entry) in row.iter().enumerate() {
                let lines = wrap(&entry.name, size, text);
                let found = lines.iter().map(|l| Rich::new(l).width(size));
                let left = i as f64 * (indent + text + gap);
                widest = widest.max(left + indent + found.fold(0.0, f64::max));
                lines_in_row = lines_in_row.max(lines.len());
                placed.push(PlacedEntry {
                    swatch: entry.swatch.clone(),
                    lines,
                    left,
                    top,
                });
            }
            top += size * (LINE * lines_in_row as f64 + 0.25);
        }
        Some(Self {
            entries: placed,
            width: widest,
            height: top,
        })
    }
}
