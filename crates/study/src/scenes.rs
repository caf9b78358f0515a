//! The impacts of the chart.

use crate::StudyError;
use contact::{Collision, HalfSpace, Material, Striker};
use impact::Impact;

/// Tip radius of the paper's rod, and radius of its disc, in m.
pub(crate) const ROD_RADIUS_M: f64 = 0.004;

/// Radius of the ball in m.
const BALL_RADIUS_M: f64 = 0.005;

/// The collision of the paper: a copper rod of this Young's modulus in Pa on a steel block.
pub(crate) fn paper(copper_pa: f64) -> Result<Collision, StudyError> {
    let block = HalfSpace::new(Material::named("steel")?)?;
    let copper = Material {
        youngs_modulus_pa: copper_pa,
        ..Material::named("copper")?
    };
    let rod = Striker::new(copper, 0.0122, ROD_RADIUS_M)?;
    Ok(Collision::new(&block, &rod, 100.0))
}

/// Young's modulus of copper in Pa in the paper's Table 1.
pub(crate) const TABLE_1_PA: f64 = 123e9;

/// Young's modulus of copper in Pa that the paper's Hertz values are computed with.
pub(crate) const HERTZ_PA: f64 = 129e9;

/// A steel ball of 10 mm on a block of a material of the library.
pub(crate) fn ball(target: &str, velocity_m_s: f64) -> Result<Impact, StudyError> {
    let block = HalfSpace::new(Material::named(target)?)?;
    let mass_kg = 4.0 / 3.0 * std::f64::consts::PI * BALL_RADIUS_M.powi(3) * 7850.0;
    let ball = Striker::new(Material::named("steel")?, mass_kg, BALL_RADIUS_M)?;
    Ok(Impact::new(block, ball, velocity_m_s))
}

/// The collision of an impact.
pub(crate) fn collision(impact: &Impact) -> Collision {
    Collision::new(&impact.half_space, &impact.striker, impact.velocity_m_s)
}
