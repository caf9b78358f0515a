//! The areas of all panels on the canvas.

use super::bar::BarFit;
use super::columns::{Columns, PAD, size};
use super::fit::{Context, Fitted};
use super::frame::Frame;
use super::looks::Looks;
use super::plan::{PanelPlan, plan};
use super::typeface::Typeface;
use crate::figure::{ColourBar, Figure};
use crate::geometry::Rect;
use crate::text::wrap;

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
    pub(crate) looks: Looks,
    /// Lines of the title and of the line below it.
    pub(crate) title: Vec<String>,
    pub(crate) subtitle: Vec<String>,
    pub(crate) panels: Vec<Placed<'a>>,
    /// The common colour bar and the area of all plots at its left.
    pub(crate) bar: Option<(BarFit, Rect)>,
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
        let bar = BarFit::new(&colours, plots.height(), &layout.faces);
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
    let looks = Looks::of(figure);
    let plans = plan(figure);
    let count = figure.columns.min(plans.len());
    let context = Context {
        faces: &faces,
        looks: &looks,
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
        looks,
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
                frame: Frame::new(area, &plan.x, &plan.y),
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
    panels.iter().fold(
        Rect {
            left: f64::INFINITY,
            top: f64::INFINITY,
            right: 0.0,
            bottom: 0.0,
        },
        |all, panel| {
            let area = panel.frame.area;
            Rect {
                left: all.left.min(area.left),
                top: all.top.min(area.top),
                right: all.right.max(area.right + panel.fitted.needs.right),
                bottom: all.bottom.max(area.bottom),
            }
        },
    )
}
