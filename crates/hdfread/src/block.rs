//! Blocks of several dimensions in lists.

use std::ops::Range;

/// Gives the rows of a part, whose first value is `first` of the whole, that lie in a block of the whole.
pub(crate) fn copy(
    block: &[Range<usize>],
    part: &[usize],
    first: &[usize],
    whole: &[usize],
    width: usize,
    bytes: &[u8],
    give: &mut impl FnMut(usize, &[u8]),
) {
    let Some(last) = block.len().checked_sub(1) else {
        give(0, bytes);
        return;
    };
    // what part and block share, along each dimension of the whole
    let shared: Vec<Range<usize>> = (0..=last)
        .map(|d| {
            let end = first[d]
                .saturating_add(part[d])
                .min(whole[d])
                .min(block[d].end);
            first[d].max(block[d].start)..end
        })
        .collect();
    if shared.iter().any(Range::is_empty) {
        return;
    }
    let mut place: Vec<usize> = shared.iter().map(|range| range.start).collect();
    let row = shared[last].len() * width;
    loop {
        let (mut from, mut to) = (0, 0);
        for d in 0..=last {
            from = from * part[d] + (place[d] - first[d]);
            to = to * block[d].len() + (place[d] - block[d].start);
        }
        if let Some(values) = bytes.get(from * width..from * width + row) {
            give(to, values);
        }
        // the next row: the last dimension but one runs fastest
        let mut d = last;
        loop {
            if d == 0 {
                return;
            }
            d -= 1;
            place[d] += 1;
            if place[d] < shared[d].end {
                break;
            }
            place[d] = shared[d].start;
        }
    }
}
