//! The areas of all panels on the canvas.

use super::bar::Bar;
use super::fit::{Context, Fitted};
use super::plan::{AxisPlan, PanelPlan, plan};
use crate::figure::{Aspect, ColourBar, Figure};
use crate::geometry::{Frame, Rect};
use crate::text::{Typeface, wrap};

/// A panel with its area.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Placed<'a> {
    pub(crate) plan: PanelPlan<'a>,
    pub(crate) fitted: Fitted,
    pub(crate) frame: Frame,
}

/// Everything with its place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layout<'a> {
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) faces: Typeface,
    /// Lines of the title and of the line below it.
    pub(crate) title: Vec<String>,
    pub(crate) subtitle: Vec<String>,
    pub(crate) panels: Vec<Placed<'a>>,
    /// The common colour bar and the area of all plots at its left.
    pub(crate) bar: Option<(Bar, Rect)>,
}

/// Lays a figure out.
pub(crate) fn lay_out(figure: &Figure) -> Layout<'_> {
    let mut layout = arrange(figure, 0.0);
    if figure.colour_bar == ColourBar::Each {
        return layout;
    }
    let colours = layout.panels.first().and_then(|p| p.plan.colours.clone());
    let Some(colours) = colours else {
        return layout;
    };
    // a bar needs the width of its numbers, which depend on the height, which depends on the width
    let mut reserved = 0.0;
    loop {
        let plots = plots(&layout.panels);
        let bar = Bar::new(&colours, plots.height(), &layout.faces);
        if bar.width <= reserved {
            layout.width += reserved;
            layout.bar = Some((bar, plots));
            return layout;
        }
        reserved = bar.width;
        layout = arrange(figure, reserved);
    }
}

/// Lays everything out but the common colour bar, which gets a width at the right.
fn arrange(figure: &Figure, bar: f64) -> Layout<'_> {
    let faces = Typeface::new(figure.text);
    let plans = plan(figure);
    let count = figure.columns.min(plans.len());
    let context = Context {
        faces: &faces,
        own_bars: figure.colour_bar == ColourBar::Each,
        legend_width: (0.34 * figure.width / count as f64).min(22.0 * faces.tick),
    };
    let (columns, fitted) = Columns::fit(&plans, count, figure.width - bar, &context);
    let width = columns.width();
    let line = |text: &str, size: f64| wrap(text, size, width + bar - 2.0 * PAD);
    let title = line(&figure.title, faces.title);
    let subtitle = line(&figure.subtitle, faces.subtitle);
    let mut top = PAD
        + Typeface::lines(faces.title, title.len())
        + Typeface::lines(faces.subtitle, subtitle.len());
    if top > PAD {
        top += faces.gap();
    }
    let (panels, bottom) = rows(plans, fitted, &columns, top, 1.2 * faces.tick);
    Layout {
        width,
        height: bottom + PAD,
        faces,
        title,
        subtitle,
        panels,
        bar: None,
    }
}

/// Gives every panel its area, row below row from `top` on; and the bottom of the last row.
fn rows<'a>(
    plans: Vec<PanelPlan<'a>>,
    fitted: Vec<Fitted>,
    columns: &Columns,
    mut top: f64,
    gap: f64,
) -> (Vec<Placed<'a>>, f64) {
    let members: Vec<(PanelPlan<'a>, Fitted)> = plans.into_iter().zip(fitted).collect();
    let mut panels = Vec::with_capacity(members.len());
    for row in members.chunk_by(|a, b| a.0.row == b.0.row) {
        let most =
            |of: &dyn Fn(&(PanelPlan<'a>, Fitted)) -> f64| row.iter().map(of).fold(0.0, f64::max);
        let height = most(&|(plan, _)| size(plan, columns.plot)[1]);
        top += most(&|(_, fitted)| fitted.needs.top);
        for (plan, fitted) in row {
            let [width, height] = size(plan, columns.plot);
            let area = Rect::new(columns.start(plan.column), top, width, height);
            panels.push(Placed {
                frame: plan.frame(area),
                plan: plan.clone(),
                fitted: fitted.clone(),
            });
        }
        top += height + most(&|(_, fitted)| fitted.needs.bottom) + gap;
    }
    (panels, top - gap)
}

/// From the first plot to the last, with what the last column needs at its right.
fn plots(panels: &[Placed<'_>]) -> Rect {
    let areas = panels.iter().map(|panel| Rect {
        right: panel.frame.area.right + panel.fitted.needs.right,
        ..panel.frame.area
    });
    areas.reduce(Rect::union).unwrap_or_default()
}

/// Distance from the sides of the canvas.
pub(crate) const PAD: f64 = 14.0;

/// Narrowest plot.
const NARROWEST: f64 = 60.0;

/// The columns of a figure: all plots are equally wide.
#[derive(Debug, Clone, PartialEq)]
struct Columns {
    /// Width of a plot.
    plot: f64,
    /// Needed at the left of each column.
    left: Vec<f64>,
    /// Needed at the right of each column.
    right: Vec<f64>,
    gap: f64,
}

impl Columns {
    /// Fits panels into columns within a width, which is exceeded rather than that plots vanish.
    fn fit(
        plans: &[PanelPlan<'_>],
        count: usize,
        width: f64,
        context: &Context<'_>,
    ) -> (Self, Vec<Fitted>) {
        let mut columns = Self {
            plot: width / count as f64,
            left: vec![0.0; count],
            right: vec![0.0; count],
            gap: 1.4 * context.faces.tick,
        };
        // what is reserved at the sides only grows, so that it is enough for the plots at the end
        loop {
            let fitted: Vec<Fitted> = plans
                .iter()
                .map(|plan| Fitted::new(plan, size(plan, columns.plot), context))
                .collect();
            let mut is_enough = true;
            for (plan, fitted) in plans.iter().zip(&fitted) {
                for (side, needed) in [
                    (&mut columns.left[plan.column], fitted.needs.left),
                    (&mut columns.right[plan.column], fitted.needs.right),
                ] {
                    is_enough &= needed <= *side;
                    *side = side.max(needed);
                }
            }
            let plot = ((width - columns.sides()) / count as f64).max(NARROWEST);
            if is_enough && plot == columns.plot {
                return (columns, fitted);
            }
            columns.plot = plot;
        }
    }

    /// Width of everything beside the plots.
    fn sides(&self) -> f64 {
        let needed: f64 = self.left.iter().chain(&self.right).sum();
        needed + self.gap * (self.left.len() - 1) as f64 + 2.0 * PAD
    }

    /// Width of the canvas.
    fn width(&self) -> f64 {
        self.sides() + self.plot * self.left.len() as f64
    }

    /// Left side of the plots of a column.
    fn start(&self, column: usize) -> f64 {
        let before = (0..column).map(|k| self.left[k] + self.plot + self.right[k] + self.gap);
        PAD + before.sum::<f64>() + self.left[column]
    }
}

/// Size of the plot of a panel in a column of plots of a width.
///
/// Equal lengths give the height; a section that is much deeper than wide is narrower than its column.
fn size(plan: &PanelPlan<'_>, width: f64) -> [f64; 2] {
    const TALLEST: f64 = 1.5;
    match plan.panel.aspect {
        Aspect::Free => [width, plan.panel.height],
        Aspect::Equal => {
            let length = |of: &AxisPlan<'_>| of.interval.high - of.interval.low;
            let ratio = length(&plan.y) / length(&plan.x);
            match ratio > TALLEST {
                true => [TALLEST * width / ratio, TALLEST * width],
                false => [width, ratio * width],
            }
        }
    }
}
