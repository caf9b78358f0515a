//! One contact of many: its results without history or fields.

use super::responses::Responses;
use crate::ImpactError;
use crate::contact::quasi_static::expected_contact_time;
use crate::contact::{Collision, Surface, hertz};
use crate::march::{
    Accuracy, FixedDisc, Found, GrowingDisc, PunchResponse, ResponseTable, StaticShare, Summary,
    TabulatedDisc, Workspace, march_explicit, march_growing, refine,
};
use crate::scene::{Contact, Model, Scene, Scheme, Striker};
use crate::simulate::{Plan, accuracy, disc_radius_m, plan};
use halfspace::{Deflection, Medium, SurfaceResponse};
use std::sync::Arc;

/// Results of a contact in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collided {
    /// The model it was computed with, never [`Model::Auto`].
    pub model: Model,
    /// Results in collision units.
    pub summary: Summary,
    /// Largest force in N.
    pub peak_force_n: f64,
    /// When it is reached in s.
    pub peak_force_time_s: f64,
    /// Duration of the first contact in s.
    pub contact_time_s: f64,
    /// Velocity of departure in m/s.
    pub rebound_velocity_m_s: f64,
    /// Largest displacement of the striker in m.
    pub peak_displacement_m: f64,
    /// Largest deflection that enters the contact law in m.
    pub peak_deflection_m: f64,
    /// Momentum given to the striker in N s.
    pub impulse_n_s: f64,
    /// Kinetic energy before in J.
    pub initial_energy_j: f64,
    /// Largest contact radius of Hertz's law in m.
    pub contact_radius_m: f64,
    /// Steps of the march over the contact, 0 without a march.
    pub march_steps: f64,
    /// Estimated relative error.
    pub relative_error_estimate: f64,
}

/// Computes contacts one after the other; one for each thread.
#[derive(Debug)]
pub struct Collider<'a> {
    responses: &'a Responses,
    workspace: Workspace,
    table: Option<(u64, Arc<ResponseTable>)>,
    punch: Option<(u64, Arc<PunchResponse>)>,
}

impl<'a> Collider<'a> {
    /// With shared responses.
    #[must_use]
    pub fn new(responses: &'a Responses) -> Self {
        Self {
            responses,
            workspace: Workspace::default(),
            table: None,
            punch: None,
        }
    }

    /// The contact of a scene's striker.
    ///
    /// # Errors
    /// [`ImpactError`].
    pub fn collide(&mut self, scene: &Scene, striker: &Striker) -> Result<Collided, ImpactError> {
        let contact = &scene.contact;
        let collision = Collision::new(scene, striker);
        let table = self.table(scene.target.poisson_ratio, contact.deflection)?;
        let plan = plan(contact, striker, &collision, &Surface::from(&*table));
        let found = self.found(scene, striker, &collision, &table, &plan)?;
        Ok(scaled(&plan, &collision, &found))
    }

    fn found(
        &mut self,
        scene: &Scene,
        striker: &Striker,
        collision: &Collision,
        table: &ResponseTable,
        plan: &Plan,
    ) -> Result<Found, ImpactError> {
        let contact = &scene.contact;
        match (plan.model, contact.scheme) {
            (
                Model::Hertz | Model::Radiation | Model::QuasiStatic | Model::QuasiStaticRadiation,
                _,
            ) => {
                let closed = plan.closed_form()?;
                Ok(Found {
                    summary: closed.summary,
                    error: closed.error,
                    step: f64::INFINITY,
                })
            }
            (Model::Wave | Model::Auto, Scheme::Implicit) => {
                let disc = disc_radius_m(contact, striker);
                let (coupling, wave_time) = collision.disc_groups(table.static_compliance(), disc);
                let impact = TabulatedDisc {
                    table,
                    coupling,
                    wave_time,
                    share: contact.static_share,
                };
                let duration = expected_contact_time(match contact.static_share {
                    StaticShare::Full => coupling,
                    StaticShare::Dynamic => 0.0,
                });
                let (step, accuracy) = stepping(contact, collision, duration);
                Ok(self.workspace.solve(&impact, step, &accuracy)?)
            }
            (Model::Wave | Model::Auto, Scheme::Explicit) => {
                let medium = Medium::new(scene.target.poisson_ratio)?;
                let response = SurfaceResponse::new(&medium, contact.deflection);
                let disc = disc_radius_m(contact, striker);
                let impact = collision.fixed_disc(&response, disc, contact.static_share);
                explicit(
                    &impact,
                    contact.step_s.map(|s| s / collision.units().time_s),
                )
            }
            (Model::Growing, _) => {
                let punch = self.punch(scene.target.poisson_ratio)?;
                let impact: GrowingDisc<'_> = collision.growing_disc(&punch);
                let (step, accuracy) = stepping(contact, collision, hertz::CONTACT_TIME);
                let refined = refine(|step| march_growing(&impact, step), step, accuracy)?;
                Ok(Found {
                    summary: refined.summary,
                    error: refined.error,
                    step: refined.history.step,
                })
            }
        }
    }

    fn table(
        &mut self,
        ratio: f64,
        deflection: Deflection,
    ) -> Result<Arc<ResponseTable>, ImpactError> {
        if let Some((bits, table)) = &self.table
            && *bits == ratio.to_bits()
            && table.deflection() == deflection
        {
            return Ok(Arc::clone(table));
        }
        let table = self.responses.table(ratio, deflection)?;
        self.table = Some((ratio.to_bits(), Arc::clone(&table)));
        Ok(table)
    }

    fn punch(&mut self, ratio: f64) -> Result<Arc<PunchResponse>, ImpactError> {
        if let Some((bits, punch)) = &self.punch
            && *bits == ratio.to_bits()
        {
            return Ok(Arc::clone(punch));
        }
        let punch = self.responses.punch(ratio)?;
        self.punch = Some((ratio.to_bits(), Arc::clone(&punch)));
        Ok(punch)
    }
}

/// Steps over a contact of the explicit scheme when the scene gives none: the paper's ts/200.
const EXPLICIT_STEPS: f64 = 200.0;

fn explicit(impact: &FixedDisc<'_>, step: Option<f64>) -> Result<Found, ImpactError> {
    let step = step.unwrap_or_else(|| expected_contact_time(impact.coupling) / EXPLICIT_STEPS);
    let (_, summary) = march_explicit(impact, step)?;
    let (_, finer) = march_explicit(impact, 0.5 * step)?;
    Ok(Found {
        summary,
        error: 2.0 * summary.distance(&finer),
        step,
    })
}

/// First step and what ends its halving: with a fixed step only the march with half of it, for the error.
fn stepping(contact: &Contact, collision: &Collision, duration: f64) -> (f64, Accuracy) {
    match contact.step_s {
        Some(step_s) => (
            2.0 * step_s / collision.units().time_s,
            Accuracy::of_contact(f64::INFINITY, None),
        ),
        None => {
            let accuracy = accuracy(contact);
            (duration / accuracy.first_steps(), accuracy)
        }
    }
}

fn scaled(plan: &Plan, collision: &Collision, found: &Found) -> Collided {
    let (s, units) = (found.summary, collision.units());
    let peak_force_n = s.peak_force * units.force_n;
    Collided {
        model: plan.model,
        summary: s,
        peak_force_n,
        peak_force_time_s: s.peak_force_time * units.time_s,
        contact_time_s: s.contact_time * units.time_s,
        rebound_velocity_m_s: s.restitution * collision.velocity_m_s,
        peak_displacement_m: s.peak_displacement * units.length_m,
        peak_deflection_m: s.peak_deflection * units.length_m,
        impulse_n_s: s.impulse * units.force_n * units.time_s,
        initial_energy_j: collision.energy_j(),
        contact_radius_m: collision.contact_radius_m(peak_force_n),
        march_steps: (s.contact_time / found.step).ceil(),
        relative_error_estimate: found.error,
    }
}
