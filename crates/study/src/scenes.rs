//! Impacts of the chart, and its small kernel tables: several densities, each read with stencils of several orders.

use contact::{FixedDisc, HalfSpace, Material, StaticShare, Striker};
use fault::AnyError;
use halfspace::{Deflection, Medium, SurfaceResponse};
use impact::Impact;
use lookup::{Content, Table};
use paper::RADIUS_M;
use tabulator::{Axis, Grid, Silent};

/// Radius of the ball in m.
const BALL_RADIUS_M: f64 = 0.005;

/// The paper's disc, for a Young's modulus of copper in Pa.
pub(crate) fn paper_disc(
    copper_pa: f64,
    response: &SurfaceResponse,
) -> Result<FixedDisc<'_>, AnyError> {
    let collision = paper::coupled(copper_pa, RADIUS_M)?.collision();
    Ok(collision.fixed_disc(response, RADIUS_M, StaticShare::Full))
}

/// Response of the steel block under the paper's disc.
pub(crate) fn paper_response() -> Result<SurfaceResponse, AnyError> {
    Ok(SurfaceResponse::new(&Medium::new(0.3)?, Deflection::Centre))
}

/// Impact of a steel ball of 10 mm on a block of a built-in material.
pub(crate) fn ball(target: &str, velocity_m_s: f64) -> Result<Impact, AnyError> {
    let block = HalfSpace::new(Material::named(target)?)?;
    let mass_kg = 4.0 / 3.0 * std::f64::consts::PI * BALL_RADIUS_M.powi(3) * 7850.0;
    let ball = Striker::new(Material::named("steel")?, mass_kg, BALL_RADIUS_M)?;
    Ok(Impact::new(block, ball, velocity_m_s))
}

/// Extent of the tables in r0.
const EXTENT: f64 = 2.0;

/// A table of one density.
pub(crate) struct Density {
    /// Distance of the nodes in r0; none for the nodes of the demo table, which is graded toward the edge of the disc
    /// and the surface.
    spacing: Option<f64>,
    content: Content,
}

impl Density {
    /// Builds the table at one Poisson ratio.
    pub(crate) fn build(poisson_ratio: f64, spacing: Option<f64>) -> Result<Self, AnyError> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("table.h5");
        let most = [Some(EXTENT), Some(EXTENT), None];
        let mut grid = Grid::demo().with(Some(vec![poisson_ratio]), most);
        if let Some(spacing) = spacing {
            let uniform = Axis::uniform(EXTENT, spacing);
            (grid.r, grid.z) = (uniform.clone(), uniform);
        }
        tabulator::build(&grid, &path, &Silent)?;
        Ok(Self {
            spacing,
            content: lookup::read(&path)?,
        })
    }

    /// Description of the density.
    pub(crate) fn label(&self) -> String {
        let uniform = |spacing| format!("spacing {spacing} r0");
        self.spacing.map_or("graded".to_owned(), uniform)
    }

    /// Number of stencil points along each axis in the program's own tables.
    pub(crate) fn points() -> usize {
        Grid::demo().stencil_points
    }

    /// Whether this table, read with `points` nodes along each axis, equals the program's own tables.
    pub(crate) fn is_default(&self, points: usize) -> bool {
        self.spacing.is_none() && points == Self::points()
    }

    /// The table read with `points` nodes along each axis.
    pub(crate) fn with_stencil(&self, points: usize) -> Result<Table, AnyError> {
        let mut content = self.content.clone();
        content.stencil_points = points;
        Ok(Table::new(content).map_err(tabulator::BuildError::from)?)
    }
}
