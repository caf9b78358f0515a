//! The units of work: one row of points of one slice.

use crate::error::BuildError;
use crate::grid::Grid;
use crate::point::PointPlan;

/// Which points a block holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Kind {
    /// Nodes of the grid.
    Nodes,
    /// Centres of its meshes, for the verification.
    Probes,
}

/// One row: all depths at one radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Block {
    /// Index of the slice.
    pub(crate) slice: usize,
    /// Nodes or probes.
    pub(crate) kind: Kind,
    /// Index of the row.
    pub(crate) row: usize,
}

/// The numbers of a block, as stored: shapes (z, field, time), (z, field, time), (z, field, term).
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Row {
    pub(crate) remainder: Vec<f32>,
    pub(crate) moment: Vec<f32>,
    pub(crate) tail: Vec<f32>,
}

/// All blocks of a grid, in the order in which they are stored.
pub(crate) fn all(grid: &Grid) -> Vec<Block> {
    let rows = grid.r.nodes().len();
    let mut blocks = Vec::new();
    for slice in 0..grid.poisson_ratios.len() {
        for (kind, rows) in [(Kind::Nodes, rows), (Kind::Probes, rows - 1)] {
            blocks.extend((0..rows).map(|row| Block { slice, kind, row }));
        }
    }
    blocks
}

/// Positions of the points of an axis: its nodes or the centres between them.
pub(crate) fn positions(kind: Kind, nodes: &[f64]) -> Vec<f64> {
    match kind {
        Kind::Nodes => nodes.to_vec(),
        Kind::Probes => nodes
            .windows(2)
            .map(|pair| 0.5 * (pair[0] + pair[1]))
            .collect(),
    }
}

/// Computes one row of points (`r`, `depths`).
pub(crate) fn compute(plan: &PointPlan, r: f64, depths: &[f64]) -> Result<Row, BuildError> {
    let mut row = Row::default();
    for &z in depths {
        let point = plan.compute(r, z)?;
        for field in 0..6 {
            row.remainder
                .extend(point.averages.iter().map(|six| six[field] as f32));
            row.moment
                .extend(point.moments.iter().map(|six| six[field] as f32));
            row.tail
                .extend(point.tail.iter().map(|six| six[field] as f32));
        }
    }
    Ok(row)
}
