//! The units of work: one row of points of one slice.

use crate::grid::Grid;

/// Which points a block holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum PointKind {
    /// Nodes of the grid.
    Nodes,
    /// Centres of its meshes, for the verification.
    Probes,
    /// Places in the middle between two slices, for the verification across Poisson's ratio.
    Between,
}

impl PointKind {
    /// All, in the order of their numbers in journals.
    pub(crate) const ALL: [Self; 3] = [Self::Nodes, Self::Probes, Self::Between];
}

/// One row: all depths at one radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct TableBlock {
    /// Index of the slice, or of the interval between slices.
    pub(crate) slice: usize,
    /// Nodes or probes.
    pub(crate) kind: PointKind,
    /// Index of the row.
    pub(crate) row: usize,
}

/// The numbers of a block, as stored: averages, first and second moments of shape (z, field, time), tails of shape
/// (z, field, term).
///
/// Points that were not computed because their errors are known are NaN.
pub(crate) type Row = [Vec<f32>; 4];

/// Radii and depths of the points of a kind: nodes, centres of meshes, or some of these.
pub(crate) fn positions(kind: PointKind, grid: &Grid) -> [Vec<f64>; 2] {
    /// Places between slices along an axis, at most.
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
