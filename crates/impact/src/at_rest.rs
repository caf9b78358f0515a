//! The static field under the pressure of an instant.

use crate::error::FieldsError;
use crate::excitation::Excitation;
use halfspace::{Kernel, Six};

/// Static field in SI units under a force in N whose pressure has the radius of the instant.
pub(crate) fn static_si(
    excitation: &Excitation,
    kernel: &Kernel,
    [r_m, z_m]: [f64; 2],
    force_n: f64,
) -> Result<Six, FieldsError> {
    let units = excitation.units();
    let over = excitation.radius().square(force_n).sqrt();
    if over <= 0.0 {
        return Ok(Six::default());
    }
    let radius_m = over * units.disc_radius_m;
    let fixed = kernel.static_field(r_m / radius_m, z_m / radius_m)?;
    Ok(std::array::from_fn(|f| {
        let unit = if f < 2 {
            units.displacement_m_per_n() / over
        } else {
            units.stress_pa_per_n() / (over * over)
        };
        force_n * unit * fixed[f]
    }))
}
