//! What is known of each panel before its size: its place in the grid, the intervals of its axes, the limits of its
//! colours, the looks of its curves.

use crate::axis::{Axis, Interval, Mirror, Scale};
use crate::error::Side;
use crate::figure::{Figure, Panel, Sharing};
use crate::geometry::{Frame, Rect};
use crate::layers::{Colours, Image, Layer};
use crate::look::Slot;
use std::collections::BTreeMap;

/// An axis with its interval.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AxisPlan<'a> {
    pub(crate) axis: &'a Axis,
    pub(crate) interval: Interval,
    /// Whether numbers and label are written.
    pub(crate) labelled: bool,
}

/// A panel with everything that is known before its size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PanelPlan<'a> {
    pub(crate) panel: &'a Panel,
    pub(crate) row: usize,
    pub(crate) column: usize,
    pub(crate) x: AxisPlan<'a>,
    pub(crate) y: AxisPlan<'a>,
    /// What the colours of its images mean.
    pub(crate) colours: Option<Colours>,
    /// Whether it explains them itself.
    pub(crate) has_bar: bool,
    /// Numbers of each layer, from which its look follows; the first for those without a colour of their own.
    pub(crate) slots: Vec<Slot>,
}

impl PanelPlan<'_> {
    /// Its values in an area.
    pub(crate) fn frame(&self, area: Rect) -> Frame {
        Frame {
            area,
            x: self.x.interval,
            y: self.y.interval,
            reversed: [self.panel.x.is_reversed, self.panel.y.is_reversed],
            mirror: self.panel.mirror,
        }
    }

    /// Whether a layer fills it, so that nothing can be written into an empty corner.
    pub(crate) fn is_filled(&self) -> bool {
        is_filled(self.panel)
    }
}

fn is_filled(panel: &Panel) -> bool {
    panel.layers.iter().any(|layer| layer.kind().fills())
}

/// Plans every panel of a figure.
pub(crate) fn plan(figure: &Figure) -> Vec<PanelPlan<'_>> {
    let common = colours(&figure.panels).filter(|_| figure.has_common_bar);
    let axis = |panel, axis, side| AxisPlan {
        axis,
        interval: interval(panel, axis, side),
        labelled: true,
    };
    let panels = figure.panels.iter().zip(slots(figure)).enumerate();
    let mut plans: Vec<PanelPlan<'_>> = panels
        .map(|(i, (panel, slots))| PanelPlan {
            panel,
            row: i / figure.columns,
            column: i % figure.columns,
            x: axis(panel, &panel.x, Side::X),
            y: axis(panel, &panel.y, Side::Y),
            colours: common
                .clone()
                .or_else(|| colours(std::slice::from_ref(panel))),
            has_bar: !figure.has_common_bar,
            slots,
        })
        .collect();
    let shared: &[Side] = match figure.sharing {
        Sharing::Separate => &[],
        Sharing::X => &[Side::X],
        Sharing::Y => &[Side::Y],
        Sharing::Both => &[Side::X, Side::Y],
    };
    for &side in shared {
        share(&mut plans, side);
    }
    plans
}

/// Gives panels above one another the same x axis, written at the last, or those side by side the same y axis,
/// written at the first.
fn share(plans: &mut [PanelPlan<'_>], side: Side) {
    let mut lines: BTreeMap<usize, Vec<&mut AxisPlan<'_>>> = BTreeMap::new();
    for plan in plans {
        let (line, axis) = match side {
            Side::X => (plan.column, &mut plan.x),
            Side::Y => (plan.row, &mut plan.y),
        };
        lines.entry(line).or_default().push(axis);
    }
    for line in lines.values_mut() {
        let union = line
            .iter()
            .map(|axis| axis.interval)
            .reduce(Interval::union);
        let written = match side {
            Side::X => line.len() - 1,
            Side::Y => 0,
        };
        for (i, axis) in line.iter_mut().enumerate() {
            axis.interval = union.unwrap_or(axis.interval);
            axis.labelled = i == written;
        }
    }
}

/// The values that an axis shows: those that it is given, or those of the layers; on both sides where it is mirrored.
fn interval(panel: &Panel, axis: &Axis, side: Side) -> Interval {
    let given = axis.interval();
    let found = given.unwrap_or_else(|| automatic(panel, axis.scale, side));
    match (side, panel.mirror) {
        (Side::X, Mirror::Even | Mirror::Odd) => {
            let most = found.low.abs().max(found.high.abs());
            Interval::linear(-most, most)
        }
        (Side::X, Mirror::Off) | (Side::Y, _) => found,
    }
}

/// Holds all layers; along y only what lies within a given x axis.
///
/// Along x curves run from end to end, and images fill their panel, whatever is drawn over them: there is air
/// above and below curves alone.
fn automatic(panel: &Panel, scale: Scale, side: Side) -> Interval {
    let is_image = |layer: &&Layer| matches!(layer, Layer::Image(_));
    let has_image = panel.layers.iter().any(|layer| is_image(&layer));
    let layers = panel.layers.iter();
    let places = layers
        .filter(|layer| !has_image || is_image(layer))
        .flat_map(|layer| layer.kind().places());
    let found = match side {
        Side::X => Interval::around(scale, places.map(|(x, _)| x)),
        Side::Y => {
            let within = panel.x.interval();
            let seen = places.filter(|(x, _)| within.is_none_or(|found| found.contains(*x)));
            Interval::around(scale, seen.map(|(_, y)| y))
        }
    };
    let found = found.unwrap_or(match scale {
        Scale::Linear => Interval::linear(0.0, 1.0),
        Scale::Logarithmic => Interval::logarithmic(1.0, 10.0),
    });
    found.with_air(match side {
        Side::Y if !is_filled(panel) => 0.05,
        Side::X | Side::Y => 0.0,
    })
}

/// What the colours of all images of some panels mean.
fn colours(panels: &[Panel]) -> Option<Colours> {
    let layers = panels.iter().flat_map(|panel| &panel.layers);
    let mut images: Vec<&Image> = Vec::new();
    for layer in layers {
        if let Layer::Image(image) = layer {
            images.push(image);
        }
    }
    Colours::of(&images)
}

/// The numbers of each layer of each panel.
fn slots(figure: &Figure) -> Vec<Vec<Slot>> {
    let of_panel = |panel: &Panel| coloured(&panel.layers).map(|(_, name)| name).collect();
    let names: Vec<Vec<String>> = figure.panels.iter().map(of_panel).collect();
    let mut known: BTreeMap<&String, Slot> = BTreeMap::new();
    for name in names.iter().flatten() {
        if known.contains_key(name) {
            continue;
        }
        let beside = |other: &String| names.iter().any(|p| p.contains(name) && p.contains(other));
        let taken = |n: &usize| {
            known
                .iter()
                .any(|(other, slot)| slot.panel == *n && beside(other))
        };
        let slot = Slot {
            figure: known.len(),
            panel: (0..).find(|n| !taken(n)).unwrap_or(0),
        };
        known.insert(name, slot);
    }
    let of_panel = |panel: &Panel| {
        let mut slots = vec![Slot::default(); panel.layers.len()];
        for (i, name) in coloured(&panel.layers) {
            slots[i] = known[&name];
        }
        slots
    };
    figure.panels.iter().map(of_panel).collect()
}

/// Layers that have a colour of their own, each with its name; one without a name is named by its number in the panel.
fn coloured(layers: &[Layer]) -> impl Iterator<Item = (usize, String)> + '_ {
    let layers = layers.iter().enumerate();
    let own = layers.filter(|(_, layer)| layer.kind().is_coloured());
    own.enumerate().map(|(n, (i, layer))| match layer.name() {
        "" => (i, format!("\0{n}")),
        name => (i, name.to_owned()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::Axis;
    use crate::look::Style;

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

    #[test]
    fn a_name_looks_the_same_in_every_panel() {
        let panel = || Panel::new(Axis::linear("x"), Axis::linear("y"));
        let figure = Figure::new("")
            .panel(
                panel()
                    .line("a", Style::Plain, vec![])
                    .line("theory", Style::Heavy, vec![])
                    .line("b", Style::Marked, vec![]),
            )
            .panel(
                panel()
                    .band("b", vec![])
                    .line("b", Style::Plain, vec![])
                    .line("c", Style::Plain, vec![]),
            );
        let numbers = |panel: usize| -> Vec<[usize; 2]> {
            let slots = &slots(&figure)[panel];
            slots.iter().map(|s| [s.figure, s.panel]).collect()
        };
        assert_eq!(numbers(0), [[0, 0], [0, 0], [1, 1]]);
        // a name keeps its numbers, and no dash comes twice in a panel
        assert_eq!(numbers(1), [[1, 1], [1, 1], [2, 0]]);
    }
}
