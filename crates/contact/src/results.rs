//! The results of a contact in SI units: all are finite, and results with too large an error estimate are rejected.

use crate::bodies::strength::Loading;
use crate::collision::Collision;
use crate::error::ContactError;
use crate::law::yielding::Flow;
use crate::settings::Settings;
use crate::solve::Solved;
use crate::solve::choose::fixed_disc_m;
use crate::units::INVERSE_MASS;

/// Estimated relative error above which results are meaningless and rejected.
pub const MOST_ERROR: f64 = 0.5;

/// Scalar results of a contact in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Results {
    /// Largest force in N.
    pub peak_force_n: f64,
    /// When it is reached in s.
    pub peak_force_time_s: f64,
    /// Duration of the first contact in s.
    pub contact_time_s: f64,
    /// Velocity of departure in m/s, positive away from the half-space.
    pub rebound_velocity_m_s: f64,
    /// Velocity of departure over velocity of approach.
    pub restitution: f64,
    /// Kinetic energy lost over kinetic energy before, 1 - restitution^2.
    pub loss: f64,
    /// Largest displacement of the striker in m.
    pub peak_displacement_m: f64,
    /// Largest deflection that enters the contact law in m.
    pub peak_deflection_m: f64,
    /// Momentum given to the striker in N s, from the force alone.
    pub impulse_n_s: f64,
    /// Kinetic energy before in J.
    pub initial_energy_j: f64,
    /// Energy radiated into the half-space in J.
    pub radiated_energy_j: f64,
    /// (initial - rebound - radiated)/initial, rebound the kinetic energy after by the impulse.
    pub energy_residual: f64,
    /// Contact radius of Hertz's law at the largest force in m.
    pub contact_radius_m: f64,
    /// Radius of the disc that loads the half-space in m: that of the settings, or the largest contact radius.
    pub disc_radius_m: f64,
    /// Loading of the bodies over their strengths.
    pub loading: Loading,
    /// Plastic flow.
    pub plastic: Plastic,
    /// Number of contacts.
    pub contacts: usize,
    /// Steps of the march over the contact, 0 without a march.
    pub march_steps: usize,
    /// Step of the march in s, 0 without a march.
    pub march_step_s: f64,
    /// Estimated relative error of peak force, contact time, restitution and displacement.
    pub relative_error_estimate: f64,
}

/// Plastic flow of a contact in SI units; all none without a law of flow.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct Plastic {
    /// Mean pressure that is not exceeded, or at which the fit's contact yields, in Pa.
    pub yield_pressure_pa: Option<f64>,
    /// Velocity of approach in m/s from which the law of flow differs from elasticity.
    pub yield_velocity_m_s: Option<f64>,
    /// Velocity of approach over that.
    pub velocity_over_yield: Option<f64>,
    /// Velocity of approach over the largest one for which the law of flow is trusted; none of a law without such a limit.
    pub velocity_over_trusted: Option<f64>,
    /// Work of the plastic flow in J.
    pub plastic_work_j: Option<f64>,
    /// Largest indentation in m.
    pub peak_indentation_m: Option<f64>,
    /// Indentation that stays in m.
    pub residual_indentation_m: Option<f64>,
    /// Radius in m of the sphere that meets a plane as the striker its dent.
    pub dent_radius_m: Option<f64>,
}

impl Plastic {
    fn new(collision: &Collision, settings: &Settings, solved: &Solved, length_m: f64) -> Self {
        let flow = solved.flow;
        let law = || collision.yielding(settings).ok().flatten();
        let Some(yielding) = flow.map(|flow| flow.yielding).or_else(law) else {
            return Self::default();
        };
        let ratio = yielding.velocity_ratio();
        let elastic = solved.summary.peak_force.cbrt().powi(2);
        let part = |value: fn(&Flow) -> f64, unit: f64| flow.as_ref().map_or(0.0, value) * unit;
        Self {
            yield_pressure_pa: Some(yielding.yield_pressure_pa),
            yield_velocity_m_s: Some(collision.velocity_m_s / ratio),
            velocity_over_yield: Some(ratio),
            velocity_over_trusted: yielding.trusted_ratio(),
            plastic_work_j: Some(part(|flow| flow.plastic_work, collision.energy_j())),
            peak_indentation_m: Some(flow.map_or(elastic, |f| f.peak_indentation) * length_m),
            residual_indentation_m: Some(part(|flow| flow.residual_indentation, length_m)),
            dent_radius_m: Some(collision.tip_radius_m * flow.map_or(1.0, |flow| flow.flatter)),
        }
    }
}

impl Results {
    /// Of a contact solved.
    pub fn new(collision: &Collision, settings: &Settings, solved: &Solved) -> Self {
        let (s, units) = (&solved.summary, collision.units());
        let peak_force_n = s.peak_force * units.force_n;
        let plastic_work = solved.flow.map_or(0.0, |flow| flow.plastic_work);
        let length_m = (collision.tip_radius_m * units.length_m).sqrt();
        let [contact_radius_m, disc_radius_m, loaded_m] = if let Some(flow) = &solved.flow {
            [flow.contact_radius, flow.disc_radius, flow.contact_radius].map(|one| one * length_m)
        } else {
            let radius_m = collision.contact_radius_m(peak_force_n);
            let disc_m = fixed_disc_m(solved.chosen.model, settings, collision).unwrap_or(radius_m);
            [radius_m, disc_m, disc_m]
        };
        // two methods that share only the force: the striker's energy follows from its momentum, the energy of the
        // half-space from the work on the deflection that lags behind
        let rebound = (1.0 - INVERSE_MASS * s.impulse).powi(2);
        let steps = |step: f64| (s.contact_time / step).ceil() as usize;
        Self {
            peak_force_n,
            peak_force_time_s: s.peak_force_time * units.time_s,
            contact_time_s: s.contact_time * units.time_s,
            rebound_velocity_m_s: s.restitution * collision.velocity_m_s,
            restitution: s.restitution,
            loss: s.loss,
            peak_displacement_m: s.peak_displacement * units.length_m,
            peak_deflection_m: s.peak_deflection * units.length_m,
            impulse_n_s: s.impulse * units.force_n * units.time_s,
            initial_energy_j: collision.energy_j(),
            radiated_energy_j: solved.radiated * collision.energy_j(),
            energy_residual: 1.0 - rebound - (solved.radiated + plastic_work),
            contact_radius_m,
            disc_radius_m,
            loading: collision.loading(peak_force_n, loaded_m),
            plastic: Plastic::new(collision, settings, solved, units.length_m),
            contacts: s.contacts,
            march_steps: solved.step.map_or(0, steps),
            march_step_s: solved.step.map_or(0.0, |step| step * units.time_s),
            relative_error_estimate: solved.error,
        }
    }

    /// The same, where all of them are finite and their estimated error is at most [`MOST_ERROR`].
    ///
    /// # Errors
    /// [`ContactError::NotFinite`], [`ContactError::Unreliable`].
    #[inline]
    pub fn checked(self) -> Result<Self, ContactError> {
        let plastic = &self.plastic;
        let numbers = [
            ("peak force", self.peak_force_n),
            ("time of the peak force", self.peak_force_time_s),
            ("contact time", self.contact_time_s),
            ("rebound velocity", self.rebound_velocity_m_s),
            ("restitution", self.restitution),
            ("loss", self.loss),
            ("largest displacement", self.peak_displacement_m),
            ("largest deflection", self.peak_deflection_m),
            ("impulse", self.impulse_n_s),
            ("kinetic energy", self.initial_energy_j),
            ("radiated energy", self.radiated_energy_j),
            ("residual of the energy", self.energy_residual),
            ("contact radius", self.contact_radius_m),
            ("disc's radius", self.disc_radius_m),
            ("mean pressure", self.loading.mean_pressure_pa),
            ("plastic work", plastic.plastic_work_j.unwrap_or(0.0)),
            ("yield velocity", plastic.yield_velocity_m_s.unwrap_or(0.0)),
            ("march's step", self.march_step_s),
            ("error estimate", self.relative_error_estimate),
        ];
        let wrong = numbers.into_iter().find(|(_, x)| !x.is_finite());
        // a force without length or size has left the range of floating-point numbers at its lower end
        let vanished = [numbers[0], numbers[2], numbers[6], numbers[9]];
        let vanished = || vanished.into_iter().find(|(_, x)| *x <= 0.0);
        if let Some((quantity, value)) = wrong.or_else(vanished) {
            return Err(ContactError::NotFinite { quantity, value });
        }
        let error = self.relative_error_estimate;
        if error > MOST_ERROR {
            let change = match self.march_step_s > 0.0 {
                true => "a smaller step_s or tolerance, or another model",
                false => "another model",
            };
            return Err(ContactError::Unreliable { error, change });
        }
        Ok(self)
    }
}
