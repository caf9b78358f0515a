//! A finished table from which another takes the numbers that it already has.

use crate::blocks::{Block, Kind, Row};
use crate::grid::Grid;
use halfspace::Six;
use lookup::{Content, Role, Slice, Verification};

/// The content of the older table.
pub(crate) struct Known {
    content: Content,
}

/// The numbers of a point, as far in time as they go.
pub(crate) struct KnownPoint {
    pub(crate) averages: Vec<Six>,
    pub(crate) moments: Vec<Six>,
    pub(crate) curvatures: Vec<Six>,
}

impl Known {
    pub(crate) fn new(content: Content) -> Self {
        Self { content }
    }

    fn slice(&self, poisson_ratio: f64) -> Option<&Slice> {
        let mut slices = self.content.slices.iter();
        slices.find(|slice| slice.poisson_ratio == poisson_ratio)
    }

    /// The row of a block of nodes of `grid` that is there as a whole.
    pub(crate) fn row(&self, grid: &Grid, cells: usize, block: Block) -> Option<Row> {
        let content = &self.content;
        let [r, z] = grid.nodes();
        let slice = self.slice(grid.slices()[block.slice].0)?;
        if block.kind != Kind::Nodes || z != content.z || slice.cells != cells {
            return None;
        }
        let index = content.r.iter().position(|&x| x == r[block.row])?;
        let part = |values: &[f32]| {
            let size = values.len() / content.r.len();
            values[index * size..(index + 1) * size].to_vec()
        };
        Some(Row {
            remainder: part(&slice.remainder),
            moment: part(&slice.moment),
            curvature: part(&slice.curvature),
            tail: part(&slice.tail),
        })
    }

    /// The numbers of a node, if it is there.
    pub(crate) fn point(&self, poisson_ratio: f64, r: f64, z: f64) -> Option<KnownPoint> {
        let content = &self.content;
        let slice = self.slice(poisson_ratio)?;
        let i = content.r.iter().position(|&x| x == r)?;
        let k = content.z.iter().position(|&x| x == z)?;
        let node = i * content.z.len() + k;
        let part = |values: &[f32]| -> Vec<Six> {
            let stored = &values[node * 6 * slice.cells..(node + 1) * 6 * slice.cells];
            (0..slice.cells)
                .map(|j| std::array::from_fn(|f| f64::from(stored[f * slice.cells + j])))
                .collect()
        };
        Some(KnownPoint {
            averages: part(&slice.remainder),
            moments: part(&slice.moment),
            curvatures: part(&slice.curvature),
        })
    }

    /// What was measured at a probe of a slice or between slices, appended to `out`; whether there is such a probe.
    ///
    /// Its stencil is that of the new table: nodes are only ever added beyond the old ones.
    pub(crate) fn measured(
        &self,
        kind: Kind,
        poisson_ratio: f64,
        [r, z]: [f64; 2],
        out: Option<&mut Verification>,
    ) -> bool {
        let content = &self.content;
        let (places, verification) = match kind {
            Kind::Nodes => return false,
            Kind::Probes => (
                content.probes(),
                self.slice(poisson_ratio).map(|slice| &slice.verification),
            ),
            Kind::Between => (
                [content.between_r.clone(), content.between_z.clone()],
                content
                    .between
                    .iter()
                    .find(|between| between.poisson_ratio == poisson_ratio)
                    .map(|between| &between.verification),
            ),
        };
        let i = places[0].iter().position(|&x| x == r);
        let k = places[1].iter().position(|&x| x == z);
        let (Some(i), Some(k), Some(verification)) = (i, k, verification) else {
            return false;
        };
        let size = content.pulse_lengths.len() * 6;
        let start = (i * places[1].len() + k) * size;
        if let Some(out) = out {
            for (list, values) in [
                (&mut out.direct, &verification.direct),
                (&mut out.looked_up, &verification.looked_up),
                (&mut out.error, &verification.error),
            ] {
                list.extend_from_slice(&values[start..start + size]);
            }
        }
        true
    }

    /// Whether a ratio has a slice, and of what role.
    pub(crate) fn role(&self, poisson_ratio: f64) -> Option<Role> {
        self.slice(poisson_ratio).map(|slice| slice.role)
    }
}
