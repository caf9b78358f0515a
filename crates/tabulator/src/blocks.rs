//! The units of work: one row of points of one slice.

use crate::error::BuildError;
use crate::grid::Grid;
use crate::known::Known;
use crate::point::{PointKernels, PointPlan};
use halfspace::Six;

/// Which points a block holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Kind {
    /// Nodes of the grid.
    Nodes,
    /// Centres of its meshes, for the verification.
    Probes,
    /// Places in the middle between two slices, for the verification across Poisson's ratio.
    Between,
}

/// One row: all depths at one radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Block {
    /// Index of the slice, or of the interval between slices.
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
    pub(crate) curvature: Vec<f32>,
    pub(crate) tail: Vec<f32>,
}

impl Row {
    /// All arrays, in the order in which they are recorded.
    pub(crate) fn arrays(&self) -> [&[f32]; 4] {
        [&self.remainder, &self.moment, &self.curvature, &self.tail]
    }
}

/// All blocks of a grid, in the order in which they are stored.
pub(crate) fn all(grid: &Grid) -> Vec<Block> {
    let rows = |kind| positions(kind, grid)[0].len();
    let mut blocks = Vec::new();
    for slice in 0..grid.slices().len() {
        for kind in [Kind::Nodes, Kind::Probes] {
            blocks.extend((0..rows(kind)).map(|row| Block { slice, kind, row }));
        }
    }
    for slice in 0..grid.poisson_ratios.len() - 1 {
        let kind = Kind::Between;
        blocks.extend((0..rows(kind)).map(|row| Block { slice, kind, row }));
    }
    blocks
}

/// Radii and depths of the points of a kind: nodes, centres of meshes, or some of these.
pub(crate) fn positions(kind: Kind, grid: &Grid) -> [Vec<f64>; 2] {
    /// Places between slices along an axis, at most.
    const PLACES: usize = 14;
    match kind {
        Kind::Nodes => grid.nodes(),
        Kind::Probes => [&grid.r, &grid.z].map(|axis| lookup::centres(&axis.nodes(), axis.end())),
        Kind::Between => positions(Kind::Probes, grid).map(|centres| {
            let count = centres.len().min(PLACES);
            (0..count)
                .map(|i| centres[i * (centres.len() - 1) / (count - 1).max(1)])
                .collect()
        }),
    }
}

/// Computes one row of points (`r`, `depths`), going on from what is known of them.
///
/// Probes whose errors are known are left as zeros.
pub(crate) fn compute(
    plan: &PointPlan,
    kind: Kind,
    r: f64,
    depths: &[f64],
    known: Option<&Known>,
) -> Result<Row, BuildError> {
    let nu = plan.kernel().medium().poisson_ratio();
    let mut row = Row::default();
    for &z in depths {
        let point = match (kind, known) {
            (Kind::Probes | Kind::Between, Some(known))
                if known.measured(kind, nu, [r, z], None) =>
            {
                plan.blank()
            }
            (Kind::Nodes, Some(known)) => plan.go_on(r, z, known.point(nu, r, z).as_ref())?,
            (Kind::Nodes | Kind::Probes | Kind::Between, _) => plan.compute(r, z)?,
        };
        let mut point = point;
        round(&mut point);
        for field in 0..6 {
            for (list, values) in [
                (&mut row.remainder, &point.averages),
                (&mut row.moment, &point.moments),
                (&mut row.curvature, &point.curvatures),
                (&mut row.tail, &point.tail),
            ] {
                list.extend(values.iter().map(|six| six[field] as f32));
            }
        }
    }
    Ok(row)
}

/// Rounds the numbers of a point to what a table holds.
pub(crate) fn round(point: &mut PointKernels) {
    for field in 0..6 {
        let quantum = quantum(&point.averages, field);
        for six in &mut point.averages {
            six[field] = (six[field] / quantum).round() * quantum;
        }
    }
    for values in [
        &mut point.averages,
        &mut point.moments,
        &mut point.curvatures,
        &mut point.tail,
    ] {
        for value in values.iter_mut().flatten() {
            *value = f64::from(*value as f32);
        }
    }
}

/// Step to which averages are stored: that of single precision at the largest of the field in time.
///
/// Smaller ones are as exact as that one, which is what a response is measured by, and take less room.
fn quantum(averages: &[Six], field: usize) -> f64 {
    /// Bits after the leading one.
    const BITS: i32 = 24;
    let most = averages
        .iter()
        .fold(0.0_f64, |most, six| most.max(six[field].abs()));
    most.max(f64::from(f32::MIN_POSITIVE)).log2().floor().exp2() * 0.5_f64.powi(BITS)
}
