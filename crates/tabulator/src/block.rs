//! Blocks, the units of work: one row of points of one slice each.

use crate::grid::Grid;

/// Kind of the points in a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum PointKind {
    /// Nodes of the grid.
    Nodes,
    /// Centres of the meshes, for the verification.
    Probes,
    /// Places midway between two slices, for the verification of the interpolation in Poisson's ratio.
    Between,
}

impl PointKind {
    /// All kinds, in the order of their numbers in journals.
    pub(crate) const ALL: [Self; 3] = [Self::Nodes, Self::Probes, Self::Between];
}

/// One row of points: all depths at one radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct TableBlock {
    /// Index of the slice, or of the interval between slices.
    pub(crate) slice: usize,
    /// Kind of the points.
    pub(crate) kind: PointKind,
    /// Index of the row.
    pub(crate) row: usize,
}

/// Numbers of a block, as stored: averages, first and second moments of shape (z, field, time), and tails of shape
/// (z, field, term).
///
/// Points whose errors are known already are not computed and contain NaN.
pub(crate) type Row = [Vec<f32>; 4];

/// Radii and depths of the points of a kind.
pub(crate) fn positions(kind: PointKind, grid: &Grid) -> [Vec<f64>; 2] {
    /// Largest number of places between slices along an axis.
    const MOST_PLACES_BETWEEN: usize = 14;
    match kind {
        PointKind::Nodes => grid.nodes(),
        PointKind::Probes => {
            [&grid.r, &grid.z].map(|axis| lookup::centres(&axis.nodes(), axis.end()))
        }
        PointKind::Between => positions(PointKind::Probes, grid).map(|centres| {
            let count = centres.len().min(MOST_PLACES_BETWEEN);
            (0..count)
                .map(|i| centres[i * (centres.len() - 1) / (count - 1).max(1)])
                .collect()
        }),
    }
}
