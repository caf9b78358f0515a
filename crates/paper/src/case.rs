//! The paper's case: bodies, Table 1 and the numbers of section 4, and the solved contacts for numbers and figures.

use contact::{HalfSpace, Material, Model, Scheme, Striker};
use fault::AnyError;
use impact::{Impact, Run};
use std::f64::consts::PI;

/// Mass of the rod in kg.
pub(crate) const MASS_KG: f64 = 0.0122;

/// Radius r0 in m of the rod, of its end, and of the loaded disc.
pub const RADIUS_M: f64 = 0.004;

/// Velocity of the rod in m/s.
pub(crate) const VELOCITY_M_S: f64 = 100.0;

/// Young's modulus of copper in Pa in Table 1.
pub const TABLE_1_PA: f64 = 123e9;

/// Young's modulus of copper in Pa with which the paper's numbers were computed.
pub const PRINTED_PA: f64 = 129e9;

/// Tensile strength Rm of copper in Pa, the denominator of the paper's Kmax.
pub(crate) const STRENGTH_PA: f64 = 227e6;

/// Strength in Pa that the text names with (47); Table 1 lists it as the yield point.
pub(crate) const NAMED_STRENGTH_PA: f64 = 57e6;

/// Step in s with which the explicit scheme reproduces the printed numbers: 1/150 of the printed 24.6 us of (47).
pub(crate) const STEP_S: f64 = 1.64e-7;

/// A coarser step in s, about 1/50 of the same time.
pub(crate) const COARSE_STEP_S: f64 = 5e-7;

/// Relative tolerance of the results called converged.
pub(crate) const TOLERANCE: f64 = 1e-6;

/// Mean pressure in Pa of a force in N on the area S of a circle with a radius in m.
pub(crate) fn mean_pa(force_n: f64, radius_m: f64) -> f64 {
    force_n / (PI * radius_m * radius_m)
}

/// Kmax of a force in N on a circle with a radius in m.
pub(crate) fn kmax(force_n: f64, radius_m: f64) -> f64 {
    mean_pa(force_n, radius_m) / STRENGTH_PA
}

/// The anvil: a half-space of steel from Table 1.
pub(crate) fn anvil() -> Result<HalfSpace, AnyError> {
    Ok(HalfSpace::new(Material::named("steel")?)?)
}

/// The paper's model of the impact, for a Young's modulus of copper and a radius r0 of tip and disc.
pub fn coupled(copper_pa: f64, radius_m: f64) -> Result<Impact, AnyError> {
    let mut copper = Material::named("copper")?;
    copper.youngs_modulus_pa = copper_pa;
    let rod = Striker::new(copper, MASS_KG, radius_m)?;
    let mut impact = Impact::new(anvil()?, rod, VELOCITY_M_S).to_tolerance(TOLERANCE);
    impact.settings.model = Model::Wave;
    impact.settings.disc_radius_m = Some(radius_m);
    Ok(impact)
}

/// The paper's model, solved with the scheme (40)-(44) and a step in s.
pub(crate) fn explicit(copper_pa: f64, step_s: f64) -> Result<Impact, AnyError> {
    let mut impact = coupled(copper_pa, RADIUS_M)?;
    impact.settings.scheme = Scheme::Explicit;
    impact.settings.step_s = Some(step_s);
    Ok(impact)
}

/// Hertz's impact without deflection of the half-space, (45)-(47).
pub(crate) fn hertz(copper_pa: f64, radius_m: f64) -> Result<Impact, AnyError> {
    let mut impact = coupled(copper_pa, radius_m)?;
    impact.settings.model = Model::Hertz;
    impact.settings.disc_radius_m = None;
    Ok(impact)
}

/// A contact whose radius follows the load, with Table 1; it counts the static deflection once.
pub fn growing() -> Result<Impact, AnyError> {
    let mut impact = hertz(TABLE_1_PA, RADIUS_M)?;
    impact.settings.model = Model::Growing;
    Ok(impact)
}

/// The solved contacts.
#[derive(Debug, Clone)]
pub(crate) struct Runs {
    /// The paper's model, converged, with Table 1.
    pub(crate) table_1: Run,
    /// The paper's model, converged, with copper of 129 GPa.
    pub(crate) printed: Run,
    /// The paper's scheme with 129 GPa and a step of 0.164 us.
    pub(crate) scheme: Run,
    /// The paper's scheme with 129 GPa and a step of 0.5 us.
    pub(crate) coarse: Run,
    /// Hertz's impact with Table 1.
    pub(crate) hertz_table_1: Run,
    /// Hertz's impact with 129 GPa.
    pub(crate) hertz_printed: Run,
    /// A contact whose radius follows the load, with Table 1.
    pub(crate) growing: Run,
}

impl Runs {
    pub(crate) fn solve() -> Result<Self, AnyError> {
        Ok(Self {
            table_1: coupled(TABLE_1_PA, RADIUS_M)?.solve()?,
            printed: coupled(PRINTED_PA, RADIUS_M)?.solve()?,
            scheme: explicit(PRINTED_PA, STEP_S)?.solve()?,
            coarse: explicit(PRINTED_PA, COARSE_STEP_S)?.solve()?,
            hertz_table_1: hertz(TABLE_1_PA, RADIUS_M)?.solve()?,
            hertz_printed: hertz(PRINTED_PA, RADIUS_M)?.solve()?,
            growing: growing()?.solve()?,
        })
    }
}
