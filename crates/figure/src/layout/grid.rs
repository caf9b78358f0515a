//! From a figure to a drawing: fits the panels around their plots, places them on the canvas, and draws everything.

use super::axes::{Needs, PlotAxes};
use super::bar::ColourBar;
use super::labels::{self, Label};
use super::legend::LegendBox;
use super::plan::{PanelPlan, plan};
use crate::colour::WHITE;
use crate::drawing::{Drawing, DrawnPath, Item, MIDDLE, START, Text};
use crate::error::FigureError;
use crate::figure::Figure;
use crate::geometry::{Frame, Rect};
use crate::text::{LINE, Typeface, wrap};

/// The drawing of a figure, with positions in pixels. Texts do not overlap and do not leave the canvas.
///
/// # Errors
/// [`FigureError`] for a figure that cannot be drawn.
pub fn draw(figure: &Figure) -> Result<Drawing, FigureError> {
    figure.check()?;
    let faces = &Typeface::new(figure.text);
    let plans = plan(figure);
    let first = plans.first().filter(|_| figure.has_common_bar);
    let common = first.and_then(|plan| plan.colours.as_ref());
    // a bar needs the width of its numbers, which depends on the height, which depends on the width
    let mut reserved = 0.0;
    let (mut drawing, panels, plots, bar) = loop {
        let (drawing, panels) = arrange(figure, &plans, reserved);
        let plots = plots(&panels);
        match common.map(|colours| ColourBar::new(colours, plots.height(), faces)) {
            Some(bar) if bar.width > reserved => reserved = bar.width,
            bar => break (drawing, panels, plots, bar),
        }
    };
    for panel in &panels {
        panel.draw(&mut drawing, faces);
    }
    if let Some(bar) = bar {
        bar.draw(&mut drawing, plots, faces);
    }
    Ok(drawing)
}

/// The canvas with title and subtitle, and each panel with its position; a shared colour bar gets space at the right.
///
/// All plots have the same width; the figure becomes wider if they would otherwise vanish.
fn arrange<'a>(
    figure: &Figure,
    plans: &'a [PanelPlan<'a>],
    bar: f64,
) -> (Drawing, Vec<Fitted<'a>>) {
    let faces = &Typeface::new(figure.text);
    let count = figure.columns.min(plans.len());
    let legend_width = (0.34 * figure.width / count as f64).min(22.0 * faces.tick);
    let gap = 1.4 * faces.tick;
    let mut plot = (figure.width - bar) / count as f64;
    // space needed at the left and at the right of each column
    let (mut left, mut right) = (vec![0.0_f64; count], vec![0.0_f64; count]);
    // the reserved space at the sides only increases, so that it suffices for the final plots
    let (mut fitted, width) = loop {
        let fit = |(i, plan): (usize, &'a PanelPlan<'a>)| {
            // next to the last column only: elsewhere it would separate the columns
            let most_right = legend_width * f64::from(u8::from((i + 1) % count == 0));
            Fitted::new(plan, plot, faces, most_right)
        };
        let fitted: Vec<Fitted<'_>> = plans.iter().enumerate().map(fit).collect();
        let before = (left.clone(), right.clone());
        for (i, Fitted { needs, .. }) in fitted.iter().enumerate() {
            left[i % count] = left[i % count].max(needs.left);
            right[i % count] = right[i % count].max(needs.right);
        }
        let needed: f64 = left.iter().chain(&right).sum();
        let sides = needed + gap * (count - 1) as f64 + 2.0 * PAD;
        let next = ((figure.width - bar - sides) / count as f64).max(NARROWEST);
        if (&left, &right) == (&before.0, &before.1) && next == plot {
            break (fitted, sides + plot * count as f64);
        }
        plot = next;
    };
    let mut heading = Vec::new();
    let mut top = PAD;
    let (title, subtitle) = (&figure.title, &figure.subtitle);
    for (text, size) in [(title, faces.title), (subtitle, faces.subtitle)] {
        for line in wrap(text, size, width + bar - 2.0 * PAD) {
            heading.push(Text::new(&line, (PAD, top + size), size, START));
            top += Typeface::lines(size, 1);
        }
    }
    if top > PAD {
        top += faces.gap();
    }
    let start = |column: usize| {
        let before = (0..column).map(|k| left[k] + plot + right[k] + gap);
        PAD + before.sum::<f64>() + left[column]
    };
    let starts: Vec<f64> = (0..count).map(start).collect();
    let bottom = place(&mut fitted, &starts, top, 1.2 * faces.tick);
    let mut drawing = Drawing {
        canvas: Rect::new(0.0, 0.0, width + bar, bottom + PAD),
        plots: fitted.iter().map(|fitted| fitted.frame.area).collect(),
        items: Vec::new(),
    };
    drawing.shape(DrawnPath::rectangle(drawing.canvas).filled(WHITE, 1.0));
    drawing.items.extend(heading.into_iter().map(Item::Text));
    (drawing, fitted)
}

/// Places the panels in columns that start at given positions, row below row from `top` on; returns their positions and
/// the bottom of the last row.
fn place(fitted: &mut [Fitted<'_>], starts: &[f64], mut top: f64, gap: f64) -> f64 {
    for row in fitted.chunks_mut(starts.len()) {
        let most = |of: fn(&Fitted<'_>) -> f64| row.iter().map(of).fold(0.0, f64::max);
        let (height, below) = (most(|f| f.frame.area.height()), most(|f| f.needs.bottom));
        top += most(|f| f.needs.top);
        for (Fitted { frame, .. }, &left) in row.iter_mut().zip(starts) {
            frame.area = Rect::new(left, top, frame.area.width(), frame.area.height());
        }
        top += height + below + gap;
    }
    top - gap
}

/// Width from the first plot to the last, with the space at the right of the last column.
fn plots(panels: &[Fitted<'_>]) -> Rect {
    let areas = panels.iter().map(|Fitted { frame, needs, .. }| Rect {
        right: frame.area.right + needs.right,
        ..frame.area
    });
    areas.reduce(Rect::union).unwrap_or_default()
}

/// Margin of the canvas.
const PAD: f64 = 14.0;

/// Smallest width of a plot.
const NARROWEST: f64 = 60.0;

/// Size of the plot of a panel in a column with a given plot width.
///
/// Equal scales determine the height; a section much deeper than wide is narrower than its column.
fn size(plan: &PanelPlan<'_>, width: f64) -> [f64; 2] {
    const TALLEST: f64 = 1.5;
    if !plan.panel.has_equal_lengths {
        return [width, plan.panel.height];
    }
    let [x, y] = plan.intervals.map(|interval| interval.high - interval.low);
    let ratio = y / x;
    match ratio > TALLEST {
        true => [TALLEST * width / ratio, TALLEST * width],
        false => [width, ratio * width],
    }
}

/// A panel fitted around its plot.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fitted<'a> {
    plan: &'a PanelPlan<'a>,
    frame: Frame,
    axes: PlotAxes,
    title: Vec<String>,
    marks: Vec<Label>,
    legend: Option<LegendBox>,
    bar: Option<ColourBar>,
    needs: Needs,
}

impl<'a> Fitted<'a> {
    /// Fits a panel around its plot in a column with a given plot width, with its upper left corner at 0, 0.
    ///
    /// A legend at the right has at most `legend_width` pixels.
    fn new(plan: &'a PanelPlan<'a>, plot: f64, faces: &Typeface, legend_width: f64) -> Self {
        let [width, height] = size(plan, plot);
        let frame = plan.frame(Rect::new(0.0, 0.0, width, height));
        let axes = PlotAxes::new(plan, [width, height], faces);
        let mut needs = axes.needs(plan, width, faces);
        let title = wrap(&plan.panel.title, faces.label, width);
        let marks = labels::of_marks(plan, &frame, faces);
        let title_height = Typeface::lines(faces.label, title.len());
        let above = Typeface::lines(faces.mark, labels::rows(&marks)) + title_height;
        if above > 0.0 {
            needs.top = needs.top.max(above + faces.gap());
        }
        let colours = plan.colours.as_ref().filter(|_| plan.has_bar);
        let bar = colours.map(|colours| ColourBar::new(colours, height, faces));
        if let Some(bar) = &bar {
            needs.right = needs.right.max(bar.width);
        }
        let legend = LegendBox::new(plan, &frame, faces, &mut needs, legend_width);
        Self {
            plan,
            frame,
            axes,
            title,
            marks,
            legend,
            bar,
            needs,
        }
    }

    fn draw(&self, drawing: &mut Drawing, faces: &Typeface) {
        let Self { plan, frame, .. } = self;
        if !plan.panel.is_filled() {
            self.axes.draw_grid(drawing, frame);
        }
        for (layer, &numbers) in plan.panel.layers.iter().zip(&plan.numbers) {
            layer.draw(drawing, frame, plan.colours.as_ref(), numbers);
        }
        labels::draw_marks(drawing, (plan, frame), &self.marks, faces);
        self.axes.draw(drawing, frame, faces);
        let mark_rows = labels::rows(&self.marks);
        let mut line = frame.area.top - faces.gap() - Typeface::lines(faces.mark, mark_rows);
        for title in self.title.iter().rev() {
            let at = (frame.area.centre().0, line - 0.2 * faces.label);
            drawing.text(Text::new(title, at, faces.label, MIDDLE));
            line -= LINE * faces.label;
        }
        let legend = self.legend.as_ref();
        let taken = legend.and_then(|legend| legend.covered(frame.area));
        labels::draw_points(drawing, (plan, frame), taken, faces.tick);
        if let Some(legend) = legend {
            legend.draw(drawing, frame.area, faces.legend);
        }
        if let Some(bar) = &self.bar {
            bar.draw(drawing, frame.area, faces);
        }
    }
}
