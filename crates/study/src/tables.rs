//! Small kernel tables of several densities, and the same table read with stencils of several orders.

use crate::StudyError;
use lookup::{Content, Table};
use tabulator::{Axis, Grid, Silent};

/// Extent of the tables in r0.
const EXTENT: f64 = 2.0;

/// A table of one density.
#[derive(Debug)]
pub(crate) struct Density {
    /// Distance of its nodes in r0; none: as in the demo table, which is graded toward the disc's edge and the surface.
    spacing: Option<f64>,
    content: Content,
}

impl Density {
    /// Builds the table at one Poisson ratio.
    pub(crate) fn build(poisson_ratio: f64, spacing: Option<f64>) -> Result<Self, StudyError> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("table.h5");
        let demo = Grid::demo();
        let axis = |own: &Axis| match spacing {
            None => Axis {
                max: EXTENT,
                ..own.clone()
            },
            Some(spacing) => Axis::uniform(EXTENT, spacing),
        };
        let grid = Grid {
            poisson_ratios: vec![poisson_ratio],
            r: axis(&demo.r),
            z: axis(&demo.z),
            ..demo
        };
        tabulator::build(&grid, &path, &Silent)?;
        Ok(Self {
            spacing,
            content: lookup::read(&path)?,
        })
    }

    /// Its density in words.
    pub(crate) fn label(&self) -> String {
        let uniform = |spacing| format!("spacing {spacing} r0");
        self.spacing.map_or("graded".to_owned(), uniform)
    }

    /// Nodes along each axis of the stencils of the program's own tables.
    pub(crate) fn points() -> usize {
        Grid::demo().stencil_points
    }

    /// Whether the program's own tables are like this one when read with `points` nodes along each axis.
    pub(crate) fn is_default(&self, points: usize) -> bool {
        self.spacing.is_none() && points == Self::points()
    }

    /// The table read with `points` nodes along each axis.
    pub(crate) fn with_stencil(&self, points: usize) -> Result<Table, StudyError> {
        let mut content = self.content.clone();
        content.stencil_points = points;
        Ok(Table::new(content).map_err(tabulator::BuildError::from)?)
    }
}
