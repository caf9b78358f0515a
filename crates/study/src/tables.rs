//! Small kernel tables of several densities, and the same table read with stencils of several orders.

use crate::StudyError;
use lookup::{Content, Table};
use tabulator::{Axis, Grid, Silent};

/// Extent of the tables in r0.
const EXTENT: f64 = 2.0;

/// A table of one density.
#[derive(Debug)]
pub(crate) struct Density {
    /// Distance between nodes in r0.
    pub(crate) spacing: f64,
    content: Content,
}

/// Stencil of the program's own tables.
pub(crate) const DEFAULT_POINTS: usize = 6;

/// Node distance of the program's own tables.
pub(crate) const DEFAULT_SPACING: f64 = 0.125;

impl Density {
    /// Builds the table of `spacing` at one Poisson ratio.
    pub(crate) fn build(poisson_ratio: f64, spacing: f64) -> Result<Self, StudyError> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("table.h5");
        let grid = Grid {
            poisson_ratios: vec![poisson_ratio],
            r: Axis::uniform(EXTENT, spacing),
            z: Axis::uniform(EXTENT, spacing),
            ..Grid::demo()
        };
        tabulator::build(&grid, &path, &Silent)?;
        Ok(Self {
            spacing,
            content: lookup::read(&path)?,
        })
    }

    /// The table read with `points` nodes along each axis.
    pub(crate) fn with_stencil(&self, points: usize) -> Result<Table, StudyError> {
        let mut content = self.content.clone();
        content.stencil_points = points;
        Ok(Table::new(content)?)
    }
}
