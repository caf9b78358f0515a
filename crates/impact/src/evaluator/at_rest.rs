//! The static field under the pressure of an instant, and the units of the fields under a disc.

use crate::error::ImpactError;
use crate::excitation::{Excitation, Pressed};
use halfspace::{Profile, Six};

/// Static field in SI units under the pressures of an instant.
pub(crate) fn static_si(
    excitation: &Excitation,
    [r_m, z_m]: [f64; 2],
    pressures: impl IntoIterator<Item = Pressed>,
) -> Result<Six, ImpactError> {
    let (mut sum, medium) = (Six::default(), excitation.medium());
    for one in pressures {
        let over = one.square.sqrt();
        if over == 0.0 {
            continue;
        }
        let radius_m = over * excitation.units().disc_radius_m;
        let fixed = medium.static_field(Profile::Hertz, r_m / radius_m, z_m / radius_m)?;
        let unit = units_si(excitation, over);
        for (f, sum) in sum.iter_mut().enumerate() {
            *sum += one.force_n * unit[f] * fixed[f];
        }
    }
    Ok(sum)
}

/// Units of the fields by a force in N, under a disc of a radius `over` the largest.
pub(crate) fn units_si(excitation: &Excitation, over: f64) -> Six {
    let units = excitation.units();
    let displacement = units.displacement_m_per_n() / over;
    let stress = units.stress_pa_per_n() / (over * over);
    [displacement, displacement, stress, stress, stress, stress]
}
