//! Results are numbers, and estimates that say nothing are refused.

use crate::collision::Collision;
use crate::error::ContactError;
use crate::law::hertz::CONTACT_TIME;
use crate::results::Results;
use crate::settings::Settings;

/// Estimated relative error from which on results say nothing.
pub const MOST_ERROR: f64 = 0.5;

/// Steps of a march over Hertz's contact at most and at least, from where it cannot be one.
const STEPS: [f64; 2] = [1e-3, 1e9];

impl Collision {
    /// Whether a step that is given can be one of a march over this contact.
    ///
    /// # Errors
    /// [`ContactError::Step`], whatever [`check`](Self::check) refuses.
    pub fn check_step(&self, settings: &Settings) -> Result<(), ContactError> {
        let Some(step_s) = settings.step_s else {
            return Ok(());
        };
        self.check()?;
        let hertz_s = CONTACT_TIME * self.units().time_s;
        if (STEPS[0]..=STEPS[1]).contains(&(hertz_s / step_s)) {
            return Ok(());
        }
        Err(ContactError::Step { step_s, hertz_s })
    }
}

impl Results {
    /// The same, where all of them are finite and their estimated error is at most [`MOST_ERROR`].
    ///
    /// # Errors
    /// [`ContactError::NotFinite`], [`ContactError::Unreliable`].
    pub fn checked(self) -> Result<Self, ContactError> {
        let Self {
            peak_force_n,
            peak_force_time_s,
            contact_time_s,
            rebound_velocity_m_s,
            restitution,
            loss,
            peak_displacement_m,
            peak_deflection_m,
            impulse_n_s,
            initial_energy_j,
            radiated_energy_j,
            energy_residual,
            contact_radius_m,
            disc_radius_m,
            loading,
            contacts: _,
            march_steps: _,
            march_step_s,
            relative_error_estimate,
        } = self;
        let numbers = [
            ("peak force", peak_force_n),
            ("time of the peak force", peak_force_time_s),
            ("contact time", contact_time_s),
            ("rebound velocity", rebound_velocity_m_s),
            ("restitution", restitution),
            ("loss", loss),
            ("largest displacement", peak_displacement_m),
            ("largest deflection", peak_deflection_m),
            ("impulse", impulse_n_s),
            ("kinetic energy", initial_energy_j),
            ("radiated energy", radiated_energy_j),
            ("residual of the energy", energy_residual),
            ("contact radius", contact_radius_m),
            ("disc's radius", disc_radius_m),
            ("mean pressure", loading.mean_pressure_pa),
            ("march's step", march_step_s),
            ("error estimate", relative_error_estimate),
        ];
        if let Some((quantity, value)) = numbers.into_iter().find(|(_, x)| !x.is_finite()) {
            return Err(ContactError::NotFinite { quantity, value });
        }
        // a force without length or size has left the range of floating-point numbers at its lower end
        let vanished = [numbers[0], numbers[2], numbers[6], numbers[9]];
        if let Some((quantity, value)) = vanished.into_iter().find(|(_, x)| *x <= 0.0) {
            return Err(ContactError::NotFinite { quantity, value });
        }
        if relative_error_estimate > MOST_ERROR {
            return Err(ContactError::Unreliable {
                error: relative_error_estimate,
            });
        }
        Ok(self)
    }
}
