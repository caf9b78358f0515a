//! The sum over the nodes of a stencil: where the time of a lookup goes.

use crate::content::FIELDS;
use crate::series::stencil::Stencil;
use halfspace::Field;
use pulp::{Simd, WithSimd};

/// Rows of numbers that are added at a time, so that the sums are loaded and stored an eighth as often.
const ROWS: usize = 8;

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

/// What is added of the nodes: the first numbers of each field, in vector registers; the same bits on every machine.
pub(crate) struct Rows<'a> {
    /// Of all nodes, `length` for each field.
    pub(crate) values: &'a [f32],
    pub(crate) length: usize,
    pub(crate) nodes: &'a [(usize, [f64; 2])],
    /// Of shape (field, time).
    pub(crate) sums: &'a mut [f64],
}

impl WithSimd for Rows<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let used = (self.sums.len() / FIELDS).max(1);
        for group in self.nodes.chunks(ROWS) {
            for (field, sums) in self.sums.chunks_exact_mut(used).enumerate() {
                // a group that is not full is filled with its first node at no weight
                let node = |slot: usize| group.get(slot).unwrap_or(&group[0]);
                let start = |slot| (node(slot).0 * FIELDS + field) * self.length;
                let weight = |slot: usize| match group.get(slot) {
                    Some((_, weights)) => weights[usize::from(ODD[field])],
                    None => 0.0,
                };
                let weights: [f64; ROWS] = std::array::from_fn(weight);
                let rows: [_; ROWS] =
                    std::array::from_fn(|slot| &self.values[start(slot)..][..sums.len()]);
                for (t, sum) in sums.iter_mut().enumerate() {
                    let [a, b, c, d, e, f, g, h]: [f64; ROWS] =
                        std::array::from_fn(|i| weights[i] * f64::from(rows[i][t]));
                    *sum += ((a + b) + (c + d)) + ((e + f) + (g + h));
                }
            }
        }
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
