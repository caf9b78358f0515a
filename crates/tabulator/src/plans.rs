//! What is computed at the points of each slice.

use crate::block::{Block, Kind};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::point::PointPlan;

/// What is computed in each slice and between them.
pub(crate) struct Plans {
    slices: Vec<PointPlan>,
    between: Vec<PointPlan>,
}

impl Plans {
    pub(crate) fn new(grid: &Grid) -> Result<Self, BuildError> {
        let slices = grid.slices();
        Ok(Self {
            slices: slices
                .iter()
                .map(|&(nu, _)| plan(grid, nu))
                .collect::<Result<_, _>>()?,
            between: (0..grid.intervals())
                .map(|interval| plan(grid, grid.between(interval)?))
                .collect::<Result<_, _>>()?,
        })
    }

    pub(crate) fn of(&self, block: Block) -> &PointPlan {
        match block.kind {
            Kind::Nodes | Kind::Probes => &self.slices[block.slice],
            Kind::Between => &self.between[block.slice],
        }
    }
}

/// What is computed at every point of one slice.
pub(crate) fn plan(grid: &Grid, poisson_ratio: f64) -> Result<PointPlan, BuildError> {
    let width = grid.cell_width * lookup::cell_scale(poisson_ratio)?;
    PointPlan::new(
        poisson_ratio,
        grid.tolerance,
        width,
        grid.cells()?,
        grid.tail_terms,
    )
}
