//! A finished table whose numbers are reused in another one.

use crate::block::{PointKind, Row};
use lookup::{Content, Numbers, Slice, Verification};
use std::ops::Range;

/// Valid content of the older table.
pub(crate) struct Known {
    pub(crate) content: Content,
}

impl Known {
    pub(crate) fn slice(&self, poisson_ratio: f64) -> Option<&Slice> {
        let mut slices = self.content.slices.iter();
        slices.find(|slice| slice.poisson_ratio == poisson_ratio)
    }

    /// The row of nodes at a radius and these depths, if the table contains all of it.
    pub(crate) fn nodes(&self, poisson_ratio: f64, cells: usize, r: f64, z: &[f64]) -> Option<Row> {
        let content = &self.content;
        let slice = self.slice(poisson_ratio)?;
        if *z != content.z || slice.cells != cells {
            return None;
        }
        let index = content.r.iter().position(|&x| x == r)?;
        let part = |values: &[f32]| {
            let size = values.len() / content.r.len();
            values[index * size..(index + 1) * size].to_vec()
        };
        Some(slice.lists().map(|(_, values)| part(values)))
    }

    /// Replaces the computed cells of a node by the existing ones.
    pub(crate) fn keep(&self, poisson_ratio: f64, [r, z]: [f64; 2], point: &mut Numbers) {
        let content = &self.content;
        let place = |nodes: &[f64], x: f64| nodes.iter().position(|&node| node == x);
        let places = [place(&content.r, r), place(&content.z, z)];
        let (Some(slice), [Some(i), Some(k)]) = (self.slice(poisson_ratio), places) else {
            return;
        };
        let (node, cells) = (i * content.z.len() + k, slice.cells);
        // tails are always computed anew
        for (values, (_, stored)) in point.iter_mut().zip(slice.lists()).take(3) {
            let stored = &stored[node * 6 * cells..][..6 * cells];
            for (f, list) in stored.chunks(cells).enumerate() {
                for (six, &x) in values.iter_mut().zip(list) {
                    six[f] = f64::from(x);
                }
            }
        }
    }

    /// The verification that contains the errors of a probe, on a slice or between slices, and the index of the probe
    /// in it.
    ///
    /// The stencil of the probe is the same in the new table, since nodes are only added beyond the old ones.
    pub(crate) fn probe(
        &self,
        kind: PointKind,
        poisson_ratio: f64,
        [r, z]: [f64; 2],
    ) -> Option<(&Verification, Range<usize>)> {
        let content = &self.content;
        let (places, verification) = match kind {
            PointKind::Nodes => return None,
            PointKind::Probes => {
                let slice = self.slice(poisson_ratio)?;
                (content.probes(), &slice.verification)
            }
            PointKind::Between => {
                let mut between = content.between.iter();
                let there = between.find(|between| between.poisson_ratio == poisson_ratio)?;
                let places = [content.between_r.clone(), content.between_z.clone()];
                (places, &there.verification)
            }
        };
        let i = places[0].iter().position(|&x| x == r)?;
        let k = places[1].iter().position(|&x| x == z)?;
        let size = content.pulse_lengths.len() * 6;
        let start = (i * places[1].len() + k) * size;
        Some((verification, start..start + size))
    }
}
