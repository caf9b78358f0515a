//! The sum over the nodes of a stencil: where the time of a lookup goes.

use crate::content::FIELDS;
use crate::series::stencil::Stencil;
use halfspace::Field;

/// Rows of numbers that are added at a time, so that the sums are loaded and stored a fourth as often.
const ROWS: usize = 4;

/// Nodes of a patch `across` by `down`, of a grid with `depths` depths, each with `weight` times its weights for fields even
/// and odd across r = 0; those that weigh nothing are left out.
pub(crate) fn nodes(
    across: &Stencil,
    down: &Stencil,
    depths: usize,
    weight: f64,
) -> impl Iterator<Item = (usize, [f64; 2])> {
    let columns = across.nodes().iter().zip(across.even()).zip(across.odd());
    columns.flat_map(move |((&i, &even), &odd)| {
        let rows = down.nodes().iter().zip(down.even());
        rows.filter_map(move |(&k, &own)| {
            let row = weight * own;
            let weights = [even * row, odd * row];
            (weights != [0.0; 2]).then_some((i * depths + k, weights))
        })
    })
}

/// Adds the first `used` of `length` numbers of each field of the nodes to `sums`, of shape (field, used).
pub(crate) fn gather(
    values: &[f32],
    length: usize,
    nodes: &[(usize, [f64; 2])],
    used: usize,
    sums: &mut [f64],
) {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has the feature that the function is compiled for.
        #[allow(unsafe_code)]
        unsafe {
            gather_wide(values, length, nodes, used, sums);
        }
        return;
    }
    gather_rows(values, length, nodes, used, sums);
}

/// [`gather_rows`] for wide registers, without fused operations: the results are the same to the last bit.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn gather_wide(
    values: &[f32],
    length: usize,
    nodes: &[(usize, [f64; 2])],
    used: usize,
    sums: &mut [f64],
) {
    gather_rows(values, length, nodes, used, sums);
}

#[inline(always)]
fn gather_rows(
    values: &[f32],
    length: usize,
    nodes: &[(usize, [f64; 2])],
    used: usize,
    sums: &mut [f64],
) {
    if used == 0 {
        return;
    }
    for (index, group) in nodes.chunks(ROWS).enumerate() {
        let next = nodes.get((index + 1) * ROWS..).unwrap_or_default();
        for (field, sum) in sums.chunks_exact_mut(used).enumerate() {
            // A group that is not full is filled with its first node at no weight.
            let mut weights = [0.0; ROWS];
            let mut rows: [&[f32]; ROWS] = [&[]; ROWS];
            for (slot, (weight, row)) in weights.iter_mut().zip(&mut rows).enumerate() {
                let (node, parity) = group.get(slot).unwrap_or(&group[0]);
                if slot < group.len() {
                    *weight = parity[usize::from(ODD[field])];
                }
                let start = (node * FIELDS + field) * length;
                *row = &values[start..start + used];
            }
            for (node, _) in next.iter().take(ROWS) {
                let start = (node * FIELDS + field) * length;
                fetch(&values[start..start + used]);
            }
            add_rows(weights, rows, sum);
        }
    }
}

/// Asks for numbers that are needed soon, so that the memory works while the processor adds.
#[inline(always)]
fn fetch(row: &[f32]) {
    /// Numbers in a line of the cache.
    #[cfg(target_arch = "x86_64")]
    const LINE: usize = 16;
    #[cfg(target_arch = "x86_64")]
    for line in row.chunks(LINE) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: the address is that of a number in `row`, and a prefetch changes nothing.
        #[allow(unsafe_code)]
        unsafe {
            _mm_prefetch::<_MM_HINT_T0>(line.as_ptr().cast());
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = row;
}

/// `sum[t] += w0 a[t] + w1 b[t] + w2 c[t] + w3 d[t]`.
#[inline(always)]
fn add_rows(weights: [f64; ROWS], [a, b, c, d]: [&[f32]; ROWS], sum: &mut [f64]) {
    let rows = a.iter().zip(b).zip(c).zip(d);
    for (s, (((a, b), c), d)) in sum.iter_mut().zip(rows) {
        *s += (weights[0] * f64::from(*a) + weights[1] * f64::from(*b))
            + (weights[2] * f64::from(*c) + weights[3] * f64::from(*d));
    }
}

/// Whether the field is odd across r = 0, in the order of [`halfspace::FIELDS`].
const ODD: [bool; FIELDS] = {
    let mut odd = [false; FIELDS];
    let mut field = 0;
    while field < FIELDS {
        odd[field] = Field::is_odd_in_r(halfspace::FIELDS[field]);
        field += 1;
    }
    odd
};
