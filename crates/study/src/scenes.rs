//! The impacts of the chart.

use crate::StudyError;
use impact::Scene;
use impact::contact::Collision;
use impact::scene::{Load, Striker};
use std::path::Path;

/// The paper's case: a copper rod on a steel block, table values.
pub(crate) const PAPER: &str = "\
[target]
youngs_modulus_pa = 209e9
poisson_ratio = 0.3
density_kg_m3 = 7830
[striker]
youngs_modulus_pa = 123e9
poisson_ratio = 0.34
mass_kg = 0.0122
tip_radius_m = 0.004
velocity_m_s = 100.0
[contact]
disc_radius_m = 0.004
model = \"wave\"
";

/// Tip radius of the ball in m.
pub(crate) const BALL_RADIUS_M: f64 = 0.005;

/// A steel ball of 10 mm on a block of a material of the library.
pub(crate) fn ball(target: &str, velocity_m_s: f64, contact: &str) -> String {
    let mass_kg = 4.0 / 3.0 * std::f64::consts::PI * BALL_RADIUS_M.powi(3) * 7850.0;
    format!(
        "[target]\nmaterial = \"{target}\"\n[striker]\nmaterial = \"steel\"\nmass_kg = {mass_kg}\n\
         tip_radius_m = {BALL_RADIUS_M}\nvelocity_m_s = {velocity_m_s:?}\n{contact}"
    )
}

/// A scene from text, and its collision.
pub(crate) fn read(text: &str) -> Result<(Scene, Striker, Collision), StudyError> {
    let scene = Scene::from_toml(text, Path::new("."))?;
    let striker = match &scene.load {
        Load::Strike(striker) => striker.clone(),
        Load::Prescribed(_) => return Err(StudyError::NoStriker),
    };
    let collision = Collision::new(&scene, &striker);
    Ok((scene, striker, collision))
}
