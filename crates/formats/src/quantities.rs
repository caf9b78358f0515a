//! The scalar results: one table from which every file, report and document takes them.

use contact::Results;
use impact::{Cause, Outcome, RecordResults};

/// What a number is, for files that tell whole numbers from others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A real number.
    Real,
    /// A count.
    Count,
}

/// A scalar result: its name, unit and meaning, and where it is.
pub struct Quantity {
    /// Name in JSON, HDF5 and CSV; it ends with the unit.
    pub name: &'static str,
    /// Unit as files state it.
    pub unit: &'static str,
    /// What it is, in a few words.
    pub meaning: &'static str,
    /// Whether it is a count.
    pub kind: Kind,
    /// Of a contact.
    pub of_contact: fn(&Results) -> f64,
    /// Of a record, which has no striker.
    pub of_record: Option<fn(&RecordResults) -> f64>,
}

impl Quantity {
    /// Its value in all that a scene gives; none where it does not exist.
    #[must_use]
    pub fn of(&self, outcome: &Outcome) -> Option<f64> {
        match &outcome.cause {
            Cause::Contact { results, .. } => Some((self.of_contact)(results)),
            Cause::Record(results) => self.of_record.map(|value| value(results)),
        }
    }
}

/// All of them, in the order of files and reports.
pub const QUANTITIES: [Quantity; 18] = [
    Quantity {
        name: "peak_force_n",
        unit: "N",
        meaning: "largest contact force",
        kind: Kind::Real,
        of_contact: |r| r.peak_force_n,
        of_record: Some(|r| r.peak_force_n),
    },
    Quantity {
        name: "peak_force_time_s",
        unit: "s",
        meaning: "when it is reached",
        kind: Kind::Real,
        of_contact: |r| r.peak_force_time_s,
        of_record: Some(|r| r.peak_force_time_s),
    },
    Quantity {
        name: "contact_time_s",
        unit: "s",
        meaning: "duration of the first contact; of the record",
        kind: Kind::Real,
        of_contact: |r| r.contact_time_s,
        of_record: Some(|r| r.duration_s),
    },
    Quantity {
        name: "rebound_velocity_m_s",
        unit: "m/s",
        meaning: "velocity of departure, positive away from the half-space",
        kind: Kind::Real,
        of_contact: |r| r.rebound_velocity_m_s,
        of_record: None,
    },
    Quantity {
        name: "restitution",
        unit: "1",
        meaning: "velocity of departure over velocity of approach",
        kind: Kind::Real,
        of_contact: |r| r.restitution,
        of_record: None,
    },
    Quantity {
        name: "loss",
        unit: "1",
        meaning: "kinetic energy lost over kinetic energy before, 1 - restitution^2",
        kind: Kind::Real,
        of_contact: |r| r.loss,
        of_record: None,
    },
    Quantity {
        name: "peak_displacement_m",
        unit: "m",
        meaning: "largest displacement of the striker",
        kind: Kind::Real,
        of_contact: |r| r.peak_displacement_m,
        of_record: None,
    },
    Quantity {
        name: "peak_deflection_m",
        unit: "m",
        meaning: "largest deflection of the half-space in the contact law",
        kind: Kind::Real,
        of_contact: |r| r.peak_deflection_m,
        of_record: Some(|r| r.peak_deflection_m),
    },
    Quantity {
        name: "impulse_n_s",
        unit: "N s",
        meaning: "momentum given to the striker; integral of the record",
        kind: Kind::Real,
        of_contact: |r| r.impulse_n_s,
        of_record: Some(|r| r.impulse_n_s),
    },
    Quantity {
        name: "initial_energy_j",
        unit: "J",
        meaning: "kinetic energy before",
        kind: Kind::Real,
        of_contact: |r| r.initial_energy_j,
        of_record: None,
    },
    Quantity {
        name: "radiated_energy_j",
        unit: "J",
        meaning: "work that the force leaves in the half-space as waves",
        kind: Kind::Real,
        of_contact: |r| r.radiated_energy_j,
        of_record: Some(|r| r.radiated_energy_j),
    },
    Quantity {
        name: "energy_residual",
        unit: "1",
        meaning: "(initial - rebound - radiated)/initial energy",
        kind: Kind::Real,
        of_contact: |r| r.energy_residual,
        of_record: None,
    },
    Quantity {
        name: "contact_radius_m",
        unit: "m",
        meaning: "contact radius of Hertz's law at the largest force",
        kind: Kind::Real,
        of_contact: |r| r.contact_radius_m,
        of_record: None,
    },
    Quantity {
        name: "disc_radius_m",
        unit: "m",
        meaning: "radius of the disc that loads the half-space",
        kind: Kind::Real,
        of_contact: |r| r.disc_radius_m,
        of_record: Some(|r| r.disc_radius_m),
    },
    Quantity {
        name: "contacts",
        unit: "1",
        meaning: "number of contacts",
        kind: Kind::Count,
        of_contact: |r| r.contacts as f64,
        of_record: None,
    },
    Quantity {
        name: "march_steps",
        unit: "1",
        meaning: "steps of the march over the contact, 0 where no uniform step is taken",
        kind: Kind::Count,
        of_contact: |r| r.march_steps as f64,
        of_record: None,
    },
    Quantity {
        name: "march_step_s",
        unit: "s",
        meaning: "step of the march, 0 where no uniform step is taken",
        kind: Kind::Real,
        of_contact: |r| r.march_step_s,
        of_record: None,
    },
    Quantity {
        name: "relative_error_estimate",
        unit: "1",
        meaning: "estimated relative error of peak force, contact time, restitution and displacement",
        kind: Kind::Real,
        of_contact: |r| r.relative_error_estimate,
        of_record: Some(|r| r.relative_error_estimate),
    },
];
