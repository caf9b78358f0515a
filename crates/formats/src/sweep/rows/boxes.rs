//! Consecutive rows of a sweep as boxes of its dimensions.

use std::ops::Range;

/// Boxes that hold the rows of a range in their order, each once: ranges along the dimensions, the last of which runs
/// fastest; twice as many as dimensions at most.
pub(super) fn boxes(shape: &[usize], rows: Range<usize>) -> Vec<Vec<Range<usize>>> {
    let mut found = Vec::new();
    divide(shape, rows, &mut Vec::new(), &mut found);
    found
}

fn divide(
    shape: &[usize],
    rows: Range<usize>,
    before: &mut Vec<Range<usize>>,
    found: &mut Vec<Vec<Range<usize>>>,
) {
    if rows.is_empty() {
        return;
    }
    let [_, inner @ ..] = shape else {
        found.push(before.clone());
        return;
    };
    let stride: usize = inner.iter().product();
    let within = |at: usize| {
        rows.start.max(at * stride) - at * stride..rows.end.min((at + 1) * stride) - at * stride
    };
    let (first, last) = (rows.start / stride, rows.end.div_ceil(stride));
    // whole slices are one box; what is left of the first and the last is divided further
    let whole = rows.start.div_ceil(stride)..rows.end / stride;
    let mut partial = |at: usize, before: &mut Vec<Range<usize>>| {
        before.push(at..at + 1);
        divide(inner, within(at), before, found);
        before.pop();
    };
    if whole.is_empty() {
        (first..last).for_each(|at| partial(at, before));
        return;
    }
    if first < whole.start {
        partial(first, before);
    }
    let mut slices = before.clone();
    slices.push(whole.clone());
    slices.extend(inner.iter().map(|&length| 0..length));
    found.push(slices);
    if whole.end < last {
        let at = whole.end;
        before.push(at..at + 1);
        divide(inner, within(at), before, found);
        before.pop();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of a box in their order.
    fn rows(shape: &[usize], ranges: &[Range<usize>]) -> Vec<usize> {
        let mut found = vec![0];
        for (length, range) in shape.iter().zip(ranges) {
            found = (found.iter())
                .flat_map(|row| range.clone().map(move |i| row * length + i))
                .collect();
        }
        found
    }

    #[test]
    fn boxes_are_the_rows_in_their_order() {
        for shape in [
            &[7][..],
            &[3, 5],
            &[2, 3, 4],
            &[3, 1, 4],
            &[1, 1],
            &[2, 2, 3, 2],
        ] {
            let all: usize = shape.iter().product();
            for start in 0..=all {
                for end in start..=all {
                    let found = boxes(shape, start..end);
                    assert!(found.len() <= 2 * shape.len(), "{shape:?} {start}..{end}");
                    let found: Vec<usize> = found
                        .iter()
                        .flat_map(|ranges| rows(shape, ranges))
                        .collect();
                    assert_eq!(found, (start..end).collect::<Vec<_>>(), "{shape:?}");
                }
            }
        }
    }
}
