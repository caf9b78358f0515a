//! How wide the plots of a figure are, and what each panel needs around them.

use super::fit::{Context, Fitted, fit};
use super::plan::PanelPlan;
use crate::panel::Aspect;

/// Distance from the sides of the canvas.
pub(crate) const PAD: f64 = 14.0;

/// Narrowest plot.
const NARROWEST: f64 = 60.0;

/// The columns of a figure: all plots are equally wide.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Columns {
    /// Width of a plot.
    pub(super) plot: f64,
    /// Needed at the left of each column.
    left: Vec<f64>,
    /// Needed at the right of each column.
    right: Vec<f64>,
    gap: f64,
}

impl Columns {
    /// Fits panels into columns within a width, which is exceeded rather than that plots vanish.
    pub(super) fn fit(
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
                .map(|plan| fit(plan, size(plan, columns.plot), context))
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
    pub(super) fn width(&self) -> f64 {
        self.sides() + self.plot * self.left.len() as f64
    }

    /// Left side of the plots of a column.
    pub(super) fn start(&self, column: usize) -> f64 {
        let before = (0..column).map(|k| self.left[k] + self.plot + self.right[k] + self.gap);
        PAD + before.sum::<f64>() + self.left[column]
    }
}

/// Size of the plot of a panel in a column of plots of a width.
///
/// Equal lengths give the height; a section that is much deeper than wide is narrower than its column.
pub(super) fn size(plan: &PanelPlan<'_>, width: f64) -> [f64; 2] {
    const TALLEST: f64 = 1.5;
    match plan.panel.aspect {
        Aspect::Free => [width, plan.panel.height],
        Aspect::Equal => {
            let length = |of: &super::AxisPlan| of.interval.high - of.interval.low;
            let ratio = length(&plan.y) / length(&plan.x);
            if ratio > TALLEST {
                [TALLEST * width / ratio, TALLEST * width]
            } else {
                [width, ratio * width]
            }
        }
    }
}
