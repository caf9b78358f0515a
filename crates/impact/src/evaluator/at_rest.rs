//! The static field under the pressure of an instant, and the units of the fields under a disc.

use crate::error::ImpactError;
use crate::excitation::Excitation;
use halfspace::{Kernel, Six};

/// Static field in SI units under a force in N whose pressure has the radius of the instant.
pub(crate) fn static_si(
    excitation: &Excitation,
    kernel: &Kernel,
    [r_m, z_m]: [f64; 2],
    force_n: f64,
) -> Result<Six, ImpactError> {
    let over = excitation.radius().square(force_n).sqrt();
    if over <= 0.0 {
        return Ok(Six::default());
    }
    let radius_m = over * excitation.units().disc_radius_m;
    let fixed = kernel.static_field(r_m / radius_m, z_m / radius_m)?;
    let unit = units_si(excitation, over);
    Ok(std::array::from_fn(|f| force_n * unit[f] * fixed[f]))
}

/// Units of the fields by a force in N, under a disc of a radius `over` the largest.
pub(crate) fn units_si(excitation: &Excitation, over: f64) -> Six {
    let units = excitation.units();
    let displacement = units.displacement_m_per_n() / over;
    let stress = units.stress_pa_per_n() / (over * over);
    [displacement, displacement, stress, stress, stress, stress]
}
