//! What loads the half-space: a force history with the radius of its pressure and its error.
//!
//! A solved contact, a closed form and a record all become an [`Excitation`]; fields, sections and energy follow from
//! it in one way.
//!
//! Theory: `docs/theory.md` (T55).

use crate::record::ForceRecord;
use crate::stretch::Departure;
use contact::march::weights::Weights;
use contact::resample::{Instant, Resampler};
use contact::units::{CollisionUnits, KernelUnits};
use contact::{HalfSpace, History, StaticShare};
use halfspace::{Deflection, DomainError, Medium, SurfaceResponse};

/// A force on a disc of the surface.
#[derive(Debug, Clone)]
pub struct Excitation {
    medium: Medium,
    units: KernelUnits,
    force: Force,
    relative_error: f64,
}

/// A force history, and the motion that goes with it where a striker has made it.
#[derive(Debug, Clone)]
enum Force {
    /// Of a contact: its samples, their units, and its duration in s.
    Contact {
        samples: Box<Resampler>,
        units: CollisionUnits,
        contact_time_s: f64,
    },
    /// Of a record.
    Record(ForceRecord),
}

/// The striker at one instant, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Displacement in m.
    pub displacement_m: f64,
    /// Velocity in m/s.
    pub velocity_m_s: f64,
    /// Deflection of the half-space that enters the contact law in m.
    pub deflection_m: f64,
}

impl Excitation {
    /// Of a contact: its history in collision units, its duration in s and its relative error; `radius_m` is that of the
    /// pressure.
    ///
    /// # Errors
    /// [`DomainError`] for a Poisson's ratio outside the physics.
    pub fn of_contact(
        half_space: &HalfSpace,
        radius_m: f64,
        history: History,
        units: CollisionUnits,
        contact_time_s: f64,
        relative_error: f64,
    ) -> Result<Self, DomainError> {
        let force = Force::Contact {
            samples: Box::new(Resampler::new(history)),
            units,
            contact_time_s,
        };
        Self::new(half_space, radius_m, force, relative_error)
    }

    /// Of a record on a disc of a radius in m.
    ///
    /// # Errors
    /// [`DomainError`] for a Poisson's ratio outside the physics.
    pub fn of_record(
        half_space: &HalfSpace,
        radius_m: f64,
        record: ForceRecord,
    ) -> Result<Self, DomainError> {
        Self::new(half_space, radius_m, Force::Record(record), 0.0)
    }

    fn new(
        half_space: &HalfSpace,
        radius_m: f64,
        force: Force,
        relative_error: f64,
    ) -> Result<Self, DomainError> {
        Ok(Self {
            medium: Medium::new(half_space.material().poisson_ratio)?,
            units: KernelUnits {
                disc_radius_m: radius_m,
                longitudinal_speed_m_s: half_space.longitudinal_speed_m_s(),
                shear_modulus_pa: half_space.material().shear_modulus_pa(),
            },
            force,
            relative_error,
        })
    }

    /// The half-space's Poisson ratio and what follows from it.
    #[must_use]
    pub fn medium(&self) -> &Medium {
        &self.medium
    }

    /// Units of the kernels: radius of the pressure, wave speed, shear modulus.
    #[must_use]
    pub fn units(&self) -> &KernelUnits {
        &self.units
    }

    /// Estimated relative error of the force.
    #[must_use]
    pub fn relative_error(&self) -> f64 {
        self.relative_error
    }

    /// The force at a time, in N.
    #[must_use]
    pub fn force_n(&self, time_s: f64) -> f64 {
        match &self.force {
            Force::Contact { samples, units, .. } => {
                samples.at(time_s / units.time_s).force * units.force_n
            }
            Force::Record(record) => record.at(time_s),
        }
    }

    /// The striker at a time; none for a record.
    #[must_use]
    pub fn motion(&self, time_s: f64) -> Option<Motion> {
        match &self.force {
            Force::Contact { samples, units, .. } => {
                let Instant {
                    displacement,
                    velocity,
                    deflection,
                    ..
                } = samples.at(time_s / units.time_s);
                Some(Motion {
                    displacement_m: displacement * units.length_m,
                    velocity_m_s: velocity * units.velocity_m_s(),
                    deflection_m: deflection * units.length_m,
                })
            }
            Force::Record(_) => None,
        }
    }

    /// The record that it is, if it is one.
    #[must_use]
    pub fn record(&self) -> Option<&ForceRecord> {
        match &self.force {
            Force::Contact { .. } => None,
            Force::Record(record) => Some(record),
        }
    }

    /// When the force ends, in s.
    #[must_use]
    pub fn end_s(&self) -> f64 {
        match &self.force {
            Force::Contact { contact_time_s, .. } => *contact_time_s,
            Force::Record(record) => record.span_s()[1],
        }
    }

    /// When the last contact has ended in s, and the units of the collision; none for a record.
    pub(crate) fn contacts(&self) -> Option<(f64, &CollisionUnits)> {
        match &self.force {
            Force::Contact { samples, units, .. } => Some((samples.end() * units.time_s, units)),
            Force::Record(_) => None,
        }
    }

    /// Length in s of a pulse that is as steep as the force: its duration for a contact.
    #[must_use]
    pub fn pulse_s(&self) -> f64 {
        match &self.force {
            Force::Contact { contact_time_s, .. } => *contact_time_s,
            Force::Record(record) => record.pulse_s(),
        }
    }

    /// How far the force departs from its samples a step apart from `from_s` to `to_s`, where that is known exactly.
    pub(crate) fn departure(&self, from_s: f64, to_s: f64, step_s: f64) -> Option<Departure> {
        let record = self.record()?;
        Some(record.departure(from_s, to_s, step_s))
    }

    /// Deflection of the disc in m under the force sampled a step apart, with a share of its static part; `base_n` is the
    /// force long before.
    #[must_use]
    pub fn deflection_m(
        &self,
        deflection: Deflection,
        share: StaticShare,
        step_s: f64,
        base_n: f64,
        force_n: &[f64],
    ) -> Vec<f64> {
        let response = SurfaceResponse::new(&self.medium, deflection);
        let weights = Weights::of_samples(&response, step_s, self.units.time_s(), force_n.len());
        let static_m_per_n = response.static_compliance() * self.units.displacement_m_per_n();
        let factor = share.factor();
        let above_n: Vec<f64> = force_n.iter().map(|p| p - base_n).collect();
        (0..force_n.len())
            .map(|n| static_m_per_n * (factor * force_n[n] - weights.delayed(&above_n[..=n])))
            .collect()
    }
}
