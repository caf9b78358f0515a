//! What a panel needs around a plot of a given size.

use super::axes::{Axes, Needs};
use super::bar::Bar;
use super::legend::{Legend, Place};
use super::marks::{Label, labels};
use super::plan::PanelPlan;
use crate::text::{Typeface, wrap};

/// A panel fitted around a plot whose upper left corner is at 0, 0.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fitted {
    pub(crate) axes: Axes,
    pub(crate) title: Vec<String>,
    pub(crate) marks: Vec<Label>,
    /// Rows of the labels of marks.
    pub(crate) mark_rows: usize,
    pub(crate) legend: Option<Legend>,
    pub(crate) bar: Option<Bar>,
    pub(crate) needs: Needs,
}

/// What is the same for all panels.
pub(super) struct Context<'a> {
    pub(super) faces: &'a Typeface,
    /// Whether a panel has its own colour bar.
    pub(super) own_bars: bool,
    /// Most pixels for a legend at the right.
    pub(super) legend_width: f64,
}

impl Fitted {
    /// Fits a panel around a plot of a size.
    pub(super) fn new(plan: &PanelPlan<'_>, size: [f64; 2], context: &Context<'_>) -> Self {
        let (faces, [width, height]) = (context.faces, size);
        let axes = Axes::new(plan, size, faces);
        let mut needs = axes.needs(plan, width, faces);
        let title = wrap(&plan.panel.title, faces.panel, width);
        let (marks, mark_rows) = labels(plan, width, faces);
        let title_height = Typeface::lines(faces.panel, title.len());
        let above = Typeface::lines(faces.mark, mark_rows) + title_height;
        if above > 0.0 {
            needs.top = needs.top.max(above + faces.gap());
        }
        let colours = plan.colours.as_ref().filter(|_| context.own_bars);
        let bar = colours.map(|colours| Bar::new(colours, height, faces));
        if let Some(bar) = &bar {
            needs.right = needs.right.max(bar.width);
        }
        let legend = Legend::new(plan, size, faces, &needs, context.legend_width);
        if let Some(legend) = &legend {
            match legend.place {
                Place::Right(from) => {
                    needs.right = from + legend.width;
                    needs.bottom = needs.bottom.max(legend.height - height);
                }
                Place::Below(from) => needs.bottom = from + legend.height,
                Place::Inside(_) => {}
            }
        }
        Self {
            axes,
            title,
            marks,
            mark_rows,
            legend,
            bar,
            needs,
        }
    }
}
