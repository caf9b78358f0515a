//! What a panel needs around a plot of a given size.

use super::bar::BarFit;
use super::frame::Frame;
use super::legend::{Block, LegendPlace};
use super::looks::Looks;
use super::marks::{PlacedMark, place_marks};
use super::plan::{AxisPlan, PanelPlan};
use super::room::{free, occupied};
use super::typeface::Typeface;
use crate::geometry::Rect;
use crate::layer::Layer;
use crate::panel::{Legend, Mirror};
use crate::text::{LINE, Rich, wrap};
use crate::ticks::{Room, Ticks, shown, ticks};

/// Pixels on each side of a plot.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Needs {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
}

/// A panel fitted around a plot whose upper left corner is at 0, 0.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fitted {
    pub(crate) x_ticks: Ticks,
    pub(crate) y_ticks: Ticks,
    pub(crate) title: Vec<String>,
    pub(crate) marks: Vec<PlacedMark>,
    /// Rows of the labels of marks.
    pub(crate) mark_rows: usize,
    pub(crate) x_label: Vec<String>,
    pub(crate) y_label: Vec<String>,
    /// Width of the widest number at the y axis.
    pub(crate) y_numbers: f64,
    pub(crate) legend: Option<(Block, LegendPlace)>,
    pub(crate) bar: Option<BarFit>,
    pub(crate) needs: Needs,
}

/// What is the same for all panels.
pub(crate) struct Context<'a> {
    pub(crate) faces: &'a Typeface,
    pub(crate) looks: &'a Looks,
    /// Whether a panel has its own colour bar.
    pub(crate) own_bars: bool,
    /// Most pixels for a legend at the right.
    pub(crate) legend_width: f64,
}

/// Fits a panel around a plot of a size.
pub(crate) fn fit(
    plan: &PanelPlan<'_>,
    [width, height]: [f64; 2],
    context: &Context<'_>,
) -> Fitted {
    let faces = context.faces;
    let (x_ticks, x_label) = along_x(&plan.x, width, faces);
    let (y_ticks, y_label) = along_y(&plan.y, height, faces);
    let title = wrap(&plan.panel.title, faces.panel, width);
    let (marks, mark_rows) = marks(plan, width, faces);
    let y_numbers = widest(&y_ticks, faces);
    let bar = match &plan.colours {
        Some(colours) if context.own_bars => Some(BarFit::new(colours, height, faces)),
        Some(_) | None => None,
    };
    let mut needs = Needs::default();
    if plan.y.labelled {
        needs.left = faces.tick_length() + 0.35 * faces.tick + y_numbers;
        if !y_label.is_empty() {
            needs.left += faces.gap() + Typeface::lines(faces.label, y_label.len());
        }
        needs.top = 0.5 * LINE * faces.tick;
    }
    if plan.x.labelled {
        let first = x_ticks.major.first();
        let last = x_ticks.major.last();
        let ends = [first, last].map(|tick| {
            tick.map_or(0.0, |tick| {
                overhang(plan, tick.value, &tick.label, width, faces)
            })
        });
        needs.left = needs.left.max(ends[0]);
        needs.right = ends[0].max(ends[1]);
        needs.bottom = faces.tick_length() + 0.2 * faces.tick + LINE * faces.tick;
        if !x_label.is_empty() {
            needs.bottom += 0.3 * faces.tick + Typeface::lines(faces.label, x_label.len());
        }
    }
    let above = Typeface::lines(faces.mark, mark_rows) + Typeface::lines(faces.panel, title.len());
    if above > 0.0 {
        needs.top = needs.top.max(above + faces.gap());
    }
    if let Some(bar) = &bar {
        needs.right = needs.right.max(bar.width);
    }
    let legend = legend(plan, [width, height], context, &needs);
    match &legend {
        Some((block, LegendPlace::Right(from))) => {
            needs.right = from + block.width;
            needs.bottom = needs.bottom.max(block.height - height);
        }
        Some((block, LegendPlace::Below(from))) => needs.bottom = from + block.height,
        Some((_, LegendPlace::Inside(_))) | None => {}
    }
    Fitted {
        x_ticks,
        y_ticks,
        title,
        marks,
        mark_rows,
        x_label,
        y_label,
        y_numbers,
        legend,
        bar,
        needs,
    }
}

fn along_x(axis: &AxisPlan, width: f64, faces: &Typeface) -> (Ticks, Vec<String>) {
    let shown = shown(&axis.quantity, &axis.unit, &axis.interval);
    let needs = |label: &str| Rich::new(label).width(faces.tick) + 0.9 * faces.tick;
    let room = Room {
        length: width,
        distance: 6.6 * faces.tick,
        needs: &needs,
    };
    let label = if axis.labelled {
        wrap(&shown.label, faces.label, width)
    } else {
        Vec::new()
    };
    (ticks(&axis.interval, shown.factor, &room), label)
}

fn along_y(axis: &AxisPlan, height: f64, faces: &Typeface) -> (Ticks, Vec<String>) {
    let shown = shown(&axis.quantity, &axis.unit, &axis.interval);
    let needs = |_: &str| LINE * faces.tick;
    let room = Room {
        length: height,
        distance: 3.6 * faces.tick,
        needs: &needs,
    };
    let label = if axis.labelled {
        wrap(&shown.label, faces.label, height)
    } else {
        Vec::new()
    };
    (ticks(&axis.interval, shown.factor, &room), label)
}

fn widest(ticks: &Ticks, faces: &Typeface) -> f64 {
    let widths = ticks.major.iter();
    widths.fold(0.0, |most, tick| {
        f64::max(most, Rich::new(&tick.label).width(faces.tick))
    })
}

/// How far the label of a tick reaches beyond the nearer end of the axis.
fn overhang(plan: &PanelPlan<'_>, value: f64, label: &str, width: f64, faces: &Typeface) -> f64 {
    let fraction = plan.x.interval.fraction(value);
    let inside = width * fraction.min(1.0 - fraction);
    (0.5 * Rich::new(label).width(faces.tick) - inside).max(0.0)
}

/// Marks within the axis, from left to right.
fn marks(plan: &PanelPlan<'_>, width: f64, faces: &Typeface) -> (Vec<PlacedMark>, usize) {
    let frame = Frame::new(Rect::new(0.0, 0.0, width, 1.0), &plan.x, &plan.y);
    let mut found: Vec<(f64, String)> = plan
        .panel
        .layers
        .iter()
        .filter_map(|layer| match layer {
            Layer::Mark(mark) if plan.x.interval.contains(mark.x) => {
                Some((frame.across(mark.x), mark.label.clone()))
            }
            Layer::Mark(_)
            | Layer::Line(_)
            | Layer::Band(_)
            | Layer::Histogram(_)
            | Layer::Image(_)
            | Layer::Classes(_)
            | Layer::Point(_) => None,
        })
        .filter(|(_, label)| !label.trim().is_empty())
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    place_marks(&found, width, faces)
}

/// The legend and its place around a plot that has the given needs without it.
fn legend(
    plan: &PanelPlan<'_>,
    [width, height]: [f64; 2],
    context: &Context<'_>,
    needs: &Needs,
) -> Option<(Block, LegendPlace)> {
    let faces = context.faces;
    let is_inside_wanted = match plan.panel.legend {
        Legend::Off => return None,
        Legend::Outside => false,
        // the other half of a mirrored section is full as well
        Legend::Auto => {
            !plan.panel.layers.iter().any(Layer::fills) && plan.panel.mirror == Mirror::Off
        }
    };
    if is_inside_wanted {
        let block = Block::new(plan, context.looks, 0.62 * width, 1, faces)?;
        let air = 0.7 * faces.tick;
        let area = Rect::new(0.0, 0.0, width, height);
        let frame = Frame::new(area, &plan.x, &plan.y);
        let taken = occupied(plan.panel, &frame);
        let size = (block.width + air, block.height + 0.6 * air);
        if let Some(found) = free(area, size, air, &taken) {
            return Some((block, LegendPlace::Inside(found)));
        }
    }
    let gap = 1.3 * faces.tick;
    let right = Block::new(plan, context.looks, context.legend_width, 1, faces)?;
    if context.legend_width >= 14.0 * faces.tick && right.height < 1.6 * height {
        return Some((right, LegendPlace::Right(needs.right + gap)));
    }
    let below = Block::new(plan, context.looks, width, 6, faces)?;
    Some((below, LegendPlace::Below(needs.bottom + faces.gap())))
}
