//! Labels of vertical lines, side by side above the panel.

use super::typeface::Typeface;
use crate::text::{Rich, wrap};

/// A vertical line and its label.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlacedMark {
    /// The line, from the left side of the plot.
    pub(crate) line: f64,
    /// Middle of the label.
    pub(crate) centre: f64,
    /// Row of the label, 0 the nearest to the plot.
    pub(crate) row: usize,
    /// One line of text.
    pub(crate) label: String,
}

/// Labels over an axis of a width, in as few rows as hold them, none over another; and the number of rows.
///
/// `marks` are lines from the left side, rising, with their labels. A label that has no room above its line is
/// moved aside; one wider than the plot is broken, its lines one above the other.
pub(crate) fn place_marks(
    marks: &[(f64, String)],
    width: f64,
    faces: &Typeface,
) -> (Vec<PlacedMark>, usize) {
    let gap = 0.7 * faces.mark;
    let size = |label: &str| Rich::new(label).width(faces.mark) + gap;
    if let Some((line, label)) = marks.iter().find(|(_, label)| size(label) > width) {
        // too narrow for rows: one line of text after another
        let _ = (line, label);
        return stacked(marks, width - gap, faces);
    }
    let total: f64 = marks.iter().map(|(_, label)| size(label)).sum();
    let mut rows = ((total / width).ceil() as usize).max(usize::from(!marks.is_empty()));
    loop {
        let members = |row: usize| marks.iter().skip(row).step_by(rows);
        let fits = |row: usize| members(row).map(|(_, l)| size(l)).sum::<f64>() <= width;
        if (0..rows).all(fits) {
            break;
        }
        rows += 1;
    }
    let mut placed = Vec::with_capacity(marks.len());
    for row in 0..rows {
        let members: Vec<&(f64, String)> = marks.iter().skip(row).step_by(rows).collect();
        let widths: Vec<f64> = members.iter().map(|(_, label)| size(label)).collect();
        let wishes: Vec<f64> = members.iter().map(|(line, _)| *line).collect();
        for ((line, label), centre) in members.iter().zip(spread(&wishes, &widths, width)) {
            placed.push(PlacedMark {
                line: *line,
                centre,
                row,
                label: label.clone(),
            });
        }
    }
    (placed, rows)
}

/// One below the other, each broken to the width of the plot.
fn stacked(marks: &[(f64, String)], width: f64, faces: &Typeface) -> (Vec<PlacedMark>, usize) {
    let mut placed = Vec::new();
    for (line, label) in marks.iter().rev() {
        for text in wrap(label, faces.mark, width).into_iter().rev() {
            placed.push(PlacedMark {
                line: *line,
                centre: 0.5 * width,
                row: placed.len(),
                label: text,
            });
        }
    }
    let rows = placed.len();
    (placed, rows)
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
        for _ in 0..group.0 {
            let size = widths[centres.len()];
            centres.push(at + 0.5 * size);
            at += size;
        }
    }
    centres
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxes(marks: &[(f64, &str)], width: f64) -> (Vec<PlacedMark>, usize) {
        let marks: Vec<(f64, String)> = marks.iter().map(|(x, l)| (*x, (*l).to_owned())).collect();
        place_marks(&marks, width, &Typeface::new(12.0))
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
                let half = |m: &PlacedMark| 0.5 * Rich::new(&m.label).width(0.95 * 12.0);
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
