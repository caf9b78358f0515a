//! Properties of each panel that do not depend on its size: intervals of its axes, limits of its colours, looks of its
//! curves.

use crate::axis::Interval;
use crate::figure::{Figure, Panel, Sharing};
use crate::geometry::{Frame, Point, Rect};
use crate::layers::{Colours, Layer, colours_of};
use std::collections::BTreeMap;

/// A panel with its properties that do not depend on its size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PanelPlan<'a> {
    pub(crate) panel: &'a Panel,
    /// Values along x and y.
    pub(crate) intervals: [Interval; 2],
    /// Whether numbers and labels are written along x and y.
    pub(crate) labelled: [bool; 2],
    /// Meaning of the colours of its images.
    pub(crate) colours: Option<Colours>,
    /// Whether it has its own colour bar.
    pub(crate) has_bar: bool,
    /// Numbers of each layer that determine its look. The first counts the names of the figure in order of appearance.
    /// The second is the smallest one that no other name has in any panel with this name, so that the first curve of a
    /// panel is a solid line. Layers without a colour of their own have the first numbers.
    pub(crate) numbers: Vec<[usize; 2]>,
}

impl PanelPlan<'_> {
    /// The map to pixels in an area.
    pub(crate) fn frame(&self, area: Rect) -> Frame {
        Frame {
            area,
            x: self.intervals[0],
            y: self.intervals[1],
            reversed: [self.panel.x.is_reversed, self.panel.y.is_reversed],
            is_mirrored: self.panel.is_mirrored,
        }
    }
}

/// Plans every panel of a figure.
pub(crate) fn plan(figure: &Figure) -> Vec<PanelPlan<'_>> {
    let layers = figure.panels.iter().flat_map(|panel| &panel.layers);
    let common = colours_of(layers).filter(|_| figure.has_common_bar);
    let panels = figure.panels.iter().zip(numbers(figure));
    let plan = |(panel, numbers)| PanelPlan {
        panel,
        intervals: intervals(panel),
        labelled: [true; 2],
        colours: common.clone().or_else(|| colours_of(&panel.layers)),
        has_bar: !figure.has_common_bar,
        numbers,
    };
    let mut plans: Vec<PanelPlan<'_>> = panels.map(plan).collect();
    let columns = figure.columns;
    if figure.sharing != Sharing::Separate {
        share(&mut plans, 0, |i| i % columns);
    }
    if figure.sharing == Sharing::Both {
        share(&mut plans, 1, |i| i / columns);
    }
    plans
}

/// Gives the axes of all panels in a column or row the same interval. Shared x axes are written at the last panel of a
/// column, shared y axes at the first panel of a row.
fn share(plans: &mut [PanelPlan<'_>], side: usize, line: impl Fn(usize) -> usize) {
    for i in 0..plans.len() {
        let beside: Vec<usize> = (0..plans.len()).filter(|&k| line(k) == line(i)).collect();
        let intervals = beside.iter().map(|&k| plans[k].intervals[side]);
        let union = intervals.reduce(Interval::union);
        plans[i].intervals[side] = union.unwrap_or(plans[i].intervals[side]);
        plans[i].labelled[side] = [beside.last(), beside.first()][side] == Some(&i);
    }
}

/// The ranges of the axes of a panel: given, or those of its layers. The range along y considers only points within a
/// given x range, and the range along x both sides of a mirrored panel.
///
/// Curves extend from end to end along x, and images fill their panel. Therefore only curves get a margin, above and
/// below.
fn intervals(panel: &Panel) -> [Interval; 2] {
    let is_image = |layer: &&Layer| matches!(layer, Layer::Image(_));
    let has_image = panel.layers.iter().any(|layer| is_image(&layer));
    let layers = panel.layers.iter();
    let shown = layers.filter(|layer| !has_image || is_image(layer));
    let places: Vec<Point> = shown.flat_map(Layer::places).collect();
    let given = panel.x.interval();
    let mut x = given.unwrap_or_else(|| {
        let values = places.iter().map(|place| place.0);
        Interval::showing(panel.x.scale, values, 0.0)
    });
    if panel.is_mirrored {
        let most = x.low.abs().max(x.high.abs());
        x = Interval::linear(-most, most);
    }
    let y = panel.y.interval().unwrap_or_else(|| {
        let is_seen = |(x, _): &&Point| given.is_none_or(|found| found.contains(*x));
        let values = places.iter().filter(is_seen).map(|place| place.1);
        let air = if panel.is_filled() { 0.0 } else { 0.05 };
        Interval::showing(panel.y.scale, values, air)
    });
    [x, y]
}

/// The numbers of each layer of each panel.
fn numbers(figure: &Figure) -> Vec<Vec<[usize; 2]>> {
    let panels: Vec<Vec<Option<String>>> = figure.panels.iter().map(names).collect();
    let mut known: BTreeMap<&String, [usize; 2]> = BTreeMap::new();
    for name in panels.iter().flatten().flatten() {
        let has = |panel: &[_], name: &String| panel.iter().flatten().any(|own| own == name);
        let beside = |other: &String| panels.iter().any(|p| has(p, name) && has(p, other));
        let taken = known.iter().filter(|(other, _)| beside(other));
        let is_free = |n: &usize| taken.clone().all(|(_, numbers)| numbers[1] != *n);
        let numbers = [known.len(), (0..).find(is_free).unwrap_or(0)];
        known.entry(name).or_insert(numbers);
    }
    let number = |name: &Option<String>| name.as_ref().map_or([0; 2], |name| known[name]);
    let of_panel = |names: &Vec<_>| names.iter().map(number).collect();
    panels.iter().map(of_panel).collect()
}

/// The name of each layer of a panel with a colour of its own; a layer without a name is named by its number among
/// them.
fn names(panel: &Panel) -> Vec<Option<String>> {
    let mut coloured = 0;
    let names = panel.layers.iter().map(|layer| {
        let line = layer.as_line().filter(|line| line.style.is_coloured())?;
        coloured += 1;
        Some(match line.name.as_str() {
            "" => format!("\0{coloured}"),
            name => name.to_owned(),
        })
    });
    names.collect()
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
        let highs: Vec<f64> = plans.iter().map(|p| p.intervals[0].high).collect();
        assert_eq!(highs, [4.0, 2.0, 4.0]);
        let written: Vec<[bool; 2]> = plans.iter().map(|p| p.labelled).collect();
        assert_eq!(written, [[false, true], [true, false], [true, true]]);
        let along_y = [0, 1].map(|i| plans[i].intervals[1]);
        assert!(along_y[0].high > 4.0 && along_y[0] == along_y[1]);
    }

    #[test]
    fn a_given_x_axis_chooses_the_values_that_count() {
        let mut panel = panel(10.0);
        panel.x = panel.x.range(0.0, 1.0);
        let figure = Figure::new("").panel(panel.clone());
        assert!(plan(&figure)[0].intervals[1].high <= 1.0);
        panel.is_mirrored = true;
        let figure = Figure::new("").panel(panel);
        assert_eq!(plan(&figure)[0].intervals[0], Interval::linear(-1.0, 1.0));
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
                    .banded("b", Style::Plain, &[])
                    .line("c", Style::Plain, vec![]),
            );
        let numbers = numbers(&figure);
        assert_eq!(numbers[0], [[0, 0], [0, 0], [1, 1]]);
        // a name keeps its numbers, and no dash pattern occurs twice in a panel
        assert_eq!(numbers[1], [[1, 1], [2, 0]]);
    }
}
