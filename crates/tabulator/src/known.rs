//! A finished table from which another takes the numbers that it already has.

use crate::block::{Block, Kind, Row, positions};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::point::KnownPoint;
use halfspace::Six;
use lookup::{Content, Role, Slice, Verification};

/// The content of the older table, which is valid.
pub(crate) struct Known {
    content: Content,
}

impl Known {
    pub(crate) fn new(content: Content) -> Self {
        Self { content }
    }

    fn slice(&self, poisson_ratio: f64) -> Option<&Slice> {
        let mut slices = self.content.slices.iter();
        slices.find(|slice| slice.poisson_ratio == poisson_ratio)
    }

    /// The row of a block of `grid` of which nothing needs to be computed: that of nodes that are there as a whole, or an
    /// empty one for probes whose errors are all known.
    pub(crate) fn row(&self, grid: &Grid, block: Block) -> Result<Option<Row>, BuildError> {
        let ratio = grid.ratio_of(block)?;
        match block.kind {
            Kind::Nodes => Ok(self.nodes(grid, grid.cells()?, ratio, block.row)),
            Kind::Probes | Kind::Between => {
                let [r, z] = positions(block.kind, grid);
                let measured = |&z: &f64| self.measured(block.kind, ratio, [r[block.row], z]);
                Ok(z.iter().all(measured).then(Row::default))
            }
        }
    }

    /// The row of nodes of `grid`, if it is there as a whole.
    fn nodes(&self, grid: &Grid, cells: usize, poisson_ratio: f64, row: usize) -> Option<Row> {
        let content = &self.content;
        let [r, z] = grid.nodes();
        let slice = self.slice(poisson_ratio)?;
        if z != content.z || slice.cells != cells {
            return None;
        }
        let index = content.r.iter().position(|&x| x == r[row])?;
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

    /// Whether errors were measured at a probe of a slice or between slices.
    ///
    /// Its stencil is that of the new table: nodes are only ever added beyond the old ones.
    pub(crate) fn measured(&self, kind: Kind, poisson_ratio: f64, place: [f64; 2]) -> bool {
        self.probe(kind, poisson_ratio, place).is_some()
    }

    /// Appends what was measured at a probe to `out`; whether there is such a probe.
    pub(crate) fn copy(
        &self,
        kind: Kind,
        poisson_ratio: f64,
        place: [f64; 2],
        out: &mut Verification,
    ) -> bool {
        let Some((verification, start)) = self.probe(kind, poisson_ratio, place) else {
            return false;
        };
        let size = self.content.pulse_lengths.len() * 6;
        for (list, values) in [
            (&mut out.direct, &verification.direct),
            (&mut out.looked_up, &verification.looked_up),
            (&mut out.error, &verification.error),
        ] {
            list.extend_from_slice(&values[start..start + size]);
        }
        true
    }

    /// What holds a probe, and where in its lists.
    fn probe(
        &self,
        kind: Kind,
        poisson_ratio: f64,
        [r, z]: [f64; 2],
    ) -> Option<(&Verification, usize)> {
        let content = &self.content;
        let (places, verification) = match kind {
            Kind::Nodes => return None,
            Kind::Probes => {
                let slice = self.slice(poisson_ratio)?;
                (content.probes(), &slice.verification)
            }
            Kind::Between => {
                let mut between = content.between.iter();
                let there = between.find(|between| between.poisson_ratio == poisson_ratio)?;
                let places = [content.between_r.clone(), content.between_z.clone()];
                (places, &there.verification)
            }
        };
        let i = places[0].iter().position(|&x| x == r)?;
        let k = places[1].iter().position(|&x| x == z)?;
        let size = content.pulse_lengths.len() * 6;
        Some((verification, (i * places[1].len() + k) * size))
    }

    /// Whether a ratio has a slice, and of what role.
    pub(crate) fn role(&self, poisson_ratio: f64) -> Option<Role> {
        self.slice(poisson_ratio).map(|slice| slice.role)
    }
}
