//! Vertical lines and their labels, side by side above the panel, placed and drawn.

use super::plan::PanelPlan;
use crate::colour::{MARK, WHITE};
use crate::geometry::{Frame, Rect};
use crate::layers::{Layer, Mark};
use crate::scene::{Anchor, Scene, Shape, Stroke, Text};
use crate::text::{LINE, Rich, Typeface, wrap};

/// The label of a vertical line.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Label {
    /// The line, from the left side of the plot.
    line: f64,
    /// Middle of the label.
    centre: f64,
    /// Row of the label, 0 the nearest to the plot.
    row: usize,
    /// One line of text.
    text: String,
}

/// The vertical lines of a panel.
fn lines<'a>(plan: &PanelPlan<'a>) -> impl Iterator<Item = &'a Mark> {
    let interval = plan.x.interval;
    plan.panel
        .layers
        .iter()
        .filter_map(move |layer| match layer {
            Layer::Mark(mark) if interval.contains(mark.x) => Some(mark),
            _ => None,
        })
}

/// Labels over a plot of a width, in as few rows as hold them, none over another; and the number of rows.
pub(super) fn labels(plan: &PanelPlan<'_>, width: f64, faces: &Typeface) -> (Vec<Label>, usize) {
    let frame = plan.frame(Rect::new(0.0, 0.0, width, 1.0));
    let named = lines(plan).filter(|mark| !mark.label.trim().is_empty());
    let mut found: Vec<(f64, &str)> = named
        .map(|mark| (frame.across(mark.x), mark.label.as_str()))
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    placed(&found, width, faces)
}

/// Labels of lines from the left side, rising.
///
/// A label that has no room above its line is moved aside; one wider than the plot is broken, its lines one above
/// the other.
fn placed(marks: &[(f64, &str)], width: f64, faces: &Typeface) -> (Vec<Label>, usize) {
    let gap = 0.7 * faces.mark;
    let size = |label: &str| Rich::new(label).width(faces.mark) + gap;
    if marks.iter().any(|(_, label)| size(label) > width) {
        return stacked(marks, width - gap, faces);
    }
    let total: f64 = marks.iter().map(|(_, label)| size(label)).sum();
    let mut rows = ((total / width).ceil() as usize).max(usize::from(!marks.is_empty()));
    let members = |row: usize, rows: usize| marks.iter().skip(row).step_by(rows);
    let length = |row, rows| {
        members(row, rows)
            .map(|(_, label)| size(label))
            .sum::<f64>()
    };
    while !(0..rows).all(|row| length(row, rows) <= width) {
        rows += 1;
    }
    let mut placed = Vec::with_capacity(marks.len());
    for row in 0..rows {
        let widths: Vec<f64> = members(row, rows).map(|(_, label)| size(label)).collect();
        let wishes: Vec<f64> = members(row, rows).map(|(line, _)| *line).collect();
        let centres = spread(&wishes, &widths, width);
        for ((line, label), centre) in members(row, rows).zip(centres) {
            placed.push(Label {
                line: *line,
                centre,
                row,
                text: (*label).to_owned(),
            });
        }
    }
    (placed, rows)
}

/// One below the other, each broken to the width of the plot.
fn stacked(marks: &[(f64, &str)], width: f64, faces: &Typeface) -> (Vec<Label>, usize) {
    let mut placed = Vec::new();
    for (line, label) in marks.iter().rev() {
        for text in wrap(label, faces.mark, width).into_iter().rev() {
            placed.push(Label {
                line: *line,
                centre: 0.5 * width,
                row: placed.len(),
                text,
            });
        }
    }
    let rows = placed.len();
    (placed, rows)
}

/// Draws the lines of a panel and their labels.
pub(crate) fn draw(
    scene: &mut Scene,
    plan: &PanelPlan<'_>,
    frame: &Frame,
    labels: &[Label],
    faces: &Typeface,
) {
    let area = frame.area;
    for mark in lines(plan) {
        let x = frame.across(mark.x);
        let mut line = |stroke| {
            let ends = [(x, area.bottom), (x, area.top)];
            scene.shape(Shape::polyline(&ends, stroke));
        };
        if plan.is_filled() {
            line(Stroke::solid(WHITE, 2.2));
        }
        line(Stroke::new(MARK, 1.0, &[3.0, 3.0]));
    }
    for label in labels {
        let rise = faces.gap() + (label.row as f64 + 0.2) * LINE * faces.mark;
        let at = (area.left + label.centre, area.top - rise);
        scene.text(Text::new(&label.text, at, faces.mark, Anchor::Middle));
        if label.row == 0 {
            // from the line to its label, which may have moved aside
            let from = (area.left + label.line, area.top);
            let foot = (at.0, area.top - 0.8 * faces.gap());
            scene.shape(Shape::polyline(&[from, foot], Stroke::solid(MARK, 1.0)));
        }
    }
}

/// Centres of boxes side by side, as near their wishes as they get, within 0 to `width`.
fn spread(wishes: &[f64], widths: &[f64], width: f64) -> Vec<f64> {
    // groups of boxes that touch: members, sum of the wishes for the group's left side, width
    let mut groups: Vec<(usize, f64, f64)> = Vec::new();
    let left = |&(count, sum, size): &(usize, f64, f64)| {
        (sum / count as f64).clamp(0.0, (width - size).max(0.0))
    };
    for (&wish, &size) in wishes.iter().zip(widths) {
        let mut group = (1, wish - 0.5 * size, size);
        while let Some(before) = groups.last() {
            if left(before) + before.2 <= left(&group) {
                break;
            }
            // its members wish the group's left side to be further left by the width before them
            let shifted = group.1 - group.0 as f64 * before.2;
            group = (before.0 + group.0, before.1 + shifted, before.2 + group.2);
            groups.pop();
        }
        groups.push(group);
    }
    let mut centres = Vec::with_capacity(wishes.len());
    for group in &groups {
        let mut at = left(group);
        for size in &widths[centres.len()..][..group.0] {
            centres.push(at + 0.5 * size);
            at += size;
        }
    }
    centres
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxes(marks: &[(f64, &str)], width: f64) -> (Vec<Label>, usize) {
        placed(marks, width, &Typeface::new(12.0))
    }

    #[test]
    fn labels_with_room_stand_above_their_lines() {
        let (placed, rows) = boxes(&[(50.0, "P"), (150.0, "S"), (250.0, "R")], 300.0);
        assert_eq!(rows, 1);
        assert!(placed.iter().all(|m| (m.centre - m.line).abs() < 1e-9));
    }

    #[test]
    fn labels_never_overlap_nor_leave_the_plot() {
        let near = [
            (1.0, "first front"),
            (2.0, "S"),
            (3.0, "Rayleigh"),
            (299.0, "end"),
        ];
        for width in [300.0, 120.0, 70.0, 30.0] {
            let (placed, rows) = boxes(&near, width);
            assert!(rows >= 1);
            for (i, a) in placed.iter().enumerate() {
                let half = |m: &Label| 0.5 * Rich::new(&m.text).width(0.95 * 12.0);
                assert!(a.centre - half(a) > -1e-9 && a.centre + half(a) < width + 1e-9);
                for b in &placed[..i] {
                    let apart = (a.centre - b.centre).abs() >= half(a) + half(b);
                    assert!(a.row != b.row || apart, "{width}: {a:?} {b:?}");
                }
            }
        }
        assert_eq!(boxes(&[], 100.0).1, 0);
    }
}
