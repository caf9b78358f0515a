//! What each panel shows: its place in the grid, the intervals of its axes, the limits of its colours.

use super::limits::limits;
use crate::axis::{Axis, Direction, Unit};
use crate::error::Side;
use crate::figure::{ColourBar, Figure, Sharing};
use crate::interval::{Interval, Scale};
use crate::layer::{ColourScale, Layer};
use crate::panel::{Mirror, Panel};

/// An axis with its interval.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AxisPlan {
    pub(crate) quantity: String,
    pub(crate) unit: Unit,
    pub(crate) interval: Interval,
    pub(crate) direction: Direction,
    /// Whether numbers and label are written.
    pub(crate) labelled: bool,
}

impl AxisPlan {
    pub(crate) fn new(axis: &Axis, interval: Interval) -> Self {
        Self {
            quantity: axis.quantity.clone(),
            unit: axis.unit.clone(),
            interval,
            direction: axis.direction,
            labelled: true,
        }
    }
}

/// Colours of a panel's images.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Colours {
    pub(crate) scale: ColourScale,
    pub(crate) limits: Interval,
    /// Whether values lie below and above the limits.
    pub(crate) beyond: [bool; 2],
}

/// A panel with everything that is known before its size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PanelPlan<'a> {
    pub(crate) panel: &'a Panel,
    pub(crate) row: usize,
    pub(crate) column: usize,
    pub(crate) x: AxisPlan,
    pub(crate) y: AxisPlan,
    pub(crate) colours: Option<Colours>,
}

/// Air beside the values of an automatic axis, over its length.
const AIR: f64 = 0.05;

/// Plans every panel of a figure.
pub(crate) fn plan(figure: &Figure) -> Vec<PanelPlan<'_>> {
    let all: Vec<&Panel> = figure.panels.iter().collect();
    let common = match figure.colour_bar {
        ColourBar::Common => colours(&all),
        ColourBar::Each => None,
    };
    let mut plans: Vec<PanelPlan<'_>> = all
        .iter()
        .enumerate()
        .map(|(i, &panel)| PanelPlan {
            panel,
            row: i / figure.columns,
            column: i % figure.columns,
            x: AxisPlan::new(&panel.x, x_interval(panel)),
            y: AxisPlan::new(&panel.y, y_interval(panel)),
            colours: common.clone().or_else(|| colours(&[panel])),
        })
        .collect();
    let (x, y) = match figure.sharing {
        Sharing::Separate => (false, false),
        Sharing::X => (true, false),
        Sharing::Y => (false, true),
        Sharing::Both => (true, true),
    };
    if x {
        share(&mut plans, |p| p.column, |p| &mut p.x, Written::Last);
    }
    if y {
        share(&mut plans, |p| p.row, |p| &mut p.y, Written::First);
    }
    plans
}

/// Which panel of a line has the common axis written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Written {
    First,
    Last,
}

/// Gives panels of the same line the union of their intervals; one of them is labelled.
fn share<'p>(
    plans: &mut [PanelPlan<'p>],
    line: impl Fn(&PanelPlan<'p>) -> usize,
    axis: impl for<'a> Fn(&'a mut PanelPlan<'p>) -> &'a mut AxisPlan,
    written: Written,
) {
    let lines = plans.iter().map(&line).max().map_or(0, |last| last + 1);
    for at in 0..lines {
        let members: Vec<usize> = (0..plans.len())
            .filter(|&i| line(&plans[i]) == at)
            .collect();
        let intervals = members.iter().map(|&i| axis(&mut plans[i]).interval);
        let Some(union) = intervals.reduce(Interval::union) else {
            continue;
        };
        let labelled = match written {
            Written::First => members.first(),
            Written::Last => members.last(),
        };
        for i in &members {
            let axis = axis(&mut plans[*i]);
            axis.interval = union;
            axis.labelled = Some(i) == labelled;
        }
    }
}

fn x_interval(panel: &Panel) -> Interval {
    let given = panel.x.interval();
    let found = given.unwrap_or_else(|| automatic(panel, Side::X));
    match panel.mirror {
        Mirror::Off => found,
        Mirror::Even | Mirror::Odd => {
            let most = found.low.abs().max(found.high.abs());
            Interval::linear(-most, most)
        }
    }
}

fn y_interval(panel: &Panel) -> Interval {
    let given = panel.y.interval();
    given.unwrap_or_else(|| automatic(panel, Side::Y))
}

/// Holds all layers; along y only what lies within a given x axis.
///
/// Along x curves run from end to end, and images fill their panel, whatever is drawn over them: there is air
/// above and below curves alone.
fn automatic(panel: &Panel, side: Side) -> Interval {
    let is_image = |layer: &&Layer| matches!(layer, Layer::Image(_));
    let has_image = panel.layers.iter().any(|layer| is_image(&layer));
    let layers = panel
        .layers
        .iter()
        .filter(|layer| !has_image || is_image(layer));
    let places = layers.flat_map(Layer::places);
    let (scale, found) = match side {
        Side::X => {
            let scale = panel.x.scale;
            (scale, Interval::around(scale, places.map(|(x, _)| x)))
        }
        Side::Y => {
            let scale = panel.y.scale;
            let within = panel.x.interval();
            let seen = places.filter(|(x, _)| within.is_none_or(|found| found.contains(*x)));
            (scale, Interval::around(scale, seen.map(|(_, y)| y)))
        }
    };
    let found = found.unwrap_or(match scale {
        Scale::Linear => Interval::linear(0.0, 1.0),
        Scale::Logarithmic => Interval::logarithmic(1.0, 10.0),
    });
    let air = match side {
        Side::Y if !panel.layers.iter().any(Layer::fills) => AIR,
        Side::X | Side::Y => 0.0,
    };
    found.with_air(air)
}

/// The colours of all images of some panels; none without an image.
fn colours(panels: &[&Panel]) -> Option<Colours> {
    let images = || {
        let layers = panels.iter().flat_map(|panel| &panel.layers);
        layers.filter_map(|layer| match layer {
            Layer::Image(image) => Some(image),
            Layer::Line(_)
            | Layer::Band(_)
            | Layer::Histogram(_)
            | Layer::Classes(_)
            | Layer::Mark(_)
            | Layer::Point(_) => None,
        })
    };
    let scale = images().next()?.colours.clone();
    let values = || images().flat_map(|image| &image.values);
    let limits = limits(&scale, values());
    let place = |value: &f64| limits.scale.shows(*value).then(|| limits.fraction(*value));
    Some(Colours {
        scale,
        limits,
        beyond: [
            values().filter_map(place).any(|at| at < -1e-9),
            values().filter_map(place).any(|at| at > 1.0 + 1e-9),
        ],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layer::Style;

    fn panel(high: f64) -> Panel {
        Panel::new(Axis::linear("t").si("s"), Axis::linear("P")).line(
            "a",
            Style::Plain,
            vec![(0.0, 0.0), (high, 2.0 * high)],
        )
    }

    #[test]
    fn shared_axes_hold_all_panels_and_are_written_once() {
        let figure = Figure::new("")
            .columns(2)
            .sharing(Sharing::Both)
            .panel(panel(1.0))
            .panel(panel(2.0))
            .panel(panel(4.0));
        let plans = plan(&figure);
        let highs: Vec<f64> = plans.iter().map(|p| p.x.interval.high).collect();
        assert_eq!(highs, [4.0, 2.0, 4.0]);
        let written: Vec<[bool; 2]> = plans.iter().map(|p| [p.x.labelled, p.y.labelled]).collect();
        assert_eq!(written, [[false, true], [true, false], [true, true]]);
        assert!(plans[0].y.interval.high > 4.0 && plans[0].y.interval == plans[1].y.interval);
    }

    #[test]
    fn a_given_x_axis_chooses_the_values_that_count() {
        let mut panel = panel(10.0).mirrored(Mirror::Off);
        panel.x = panel.x.range(0.0, 1.0);
        let figure = Figure::new("").panel(panel.clone());
        assert!(plan(&figure)[0].y.interval.high <= 1.0);
        let figure = Figure::new("").panel(panel.mirrored(Mirror::Even));
        assert_eq!(plan(&figure)[0].x.interval, Interval::linear(-1.0, 1.0));
    }
}
