//! Scalar results and fields: one table each, the source for all files, reports and documents.

use contact::{Choice, Results};
use impact::{Cause, Outcome, Quantity as FieldQuantity, RecordResults};

/// Type of a number, for files that distinguish integers from real numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A real number.
    Real,
    /// A count.
    Count,
}

/// A scalar result: name, unit, meaning and source.
pub struct Quantity {
    /// Name in JSON, HDF5 and CSV; the last part is the unit.
    pub name: &'static str,
    /// Unit as written in files.
    pub unit: &'static str,
    /// Meaning in a few words.
    pub meaning: &'static str,
    /// Real number or count.
    pub kind: Kind,
    /// Whether only contacts that yield have this result.
    pub is_of_flow: bool,
    /// Value for a contact; NaN if a required strength is unknown.
    pub of_contact: fn(&Results) -> f64,
    /// Value for a force record, which has no striker; none if it does not apply.
    pub of_record: Option<fn(&RecordResults) -> f64>,
}

impl Quantity {
    /// The value in the results of a scene; none if it does not exist.
    pub fn of(&self, outcome: &Outcome) -> Option<f64> {
        match &outcome.cause {
            Cause::Contact { results, .. } => {
                Some((self.of_contact)(results)).filter(|value| !value.is_nan())
            }
            Cause::Record(results) => self.of_record.map(|value| value(results)),
        }
    }
}

macro_rules! quantities {
    ($($name:ident: $kind:ident $unit:literal of $($contact:ident).+ $(, $record:ident)? => $meaning:literal;)*) => {
        [$(Quantity {
            name: stringify!($name),
            unit: $unit,
            meaning: $meaning,
            kind: Kind::$kind,
            is_of_flow: quantities!(@flow $($contact)+),
            of_contact: |r| quantities!(@$kind r.$($contact).+),
            of_record: quantities!(@record $($record)?),
        },)*]
    };
    (@Real $field:expr) => { Option::<f64>::from($field).unwrap_or(f64::NAN) };
    (@Count $field:expr) => { $field as f64 };
    (@flow plastic $field:ident) => { true };
    (@flow $($other:ident)+) => { false };
    (@record) => { None };
    (@record $field:ident) => { Some(|r| r.$field) };
}

/// All scalar results in the order of files and reports. Each row: name, kind, unit, field in the results of a contact,
/// field in the results of a record if it exists, meaning.
pub const QUANTITIES: [Quantity; 31] = quantities! {
    peak_force_n: Real "N" of peak_force_n, peak_force_n => "largest contact force";
    peak_force_time_s: Real "s" of peak_force_time_s, peak_force_time_s => "time of the largest contact force";
    contact_time_s: Real "s" of contact_time_s, duration_s => "duration of the first contact; for a force record, from its onset to its end";
    rebound_velocity_m_s: Real "m/s" of rebound_velocity_m_s => "velocity of departure, positive away from the half-space";
    restitution: Real "1" of restitution => "velocity of departure over velocity of approach";
    loss: Real "1" of loss => "kinetic energy lost over kinetic energy before, 1 - restitution^2";
    peak_displacement_m: Real "m" of peak_displacement_m => "largest displacement of the striker";
    peak_deflection_m: Real "m" of peak_deflection_m, peak_deflection_m => "largest deflection of the half-space in the contact law";
    impulse_n_s: Real "N s" of impulse_n_s, impulse_n_s => "integral of the force over time, the momentum given to the striker";
    initial_energy_j: Real "J" of initial_energy_j => "kinetic energy before";
    radiated_energy_j: Real "J" of radiated_energy_j, radiated_energy_j => "work that the force leaves in the half-space as waves";
    energy_residual: Real "1" of energy_residual => "(initial - rebound - radiated)/initial energy, the rebound by the impulse";
    contact_radius_m: Real "m" of contact_radius_m => "contact radius of Hertz's law at the largest force";
    disc_radius_m: Real "m" of disc_radius_m, disc_radius_m => "radius of the disc that loads the half-space";
    mean_pressure_pa: Real "Pa" of loading.mean_pressure_pa => "largest contact force over the area of the loaded disc";
    yield_onset: Real "1" of loading.yield_onset => "mean_pressure_pa over the pressure at which the first body begins to yield, by von Mises under Hertz's pressure";
    pressure_over_yield: Real "1" of loading.pressure_over_yield => "mean_pressure_pa over the lower of both yield strengths";
    pressure_over_tensile: Real "1" of loading.pressure_over_tensile => "mean_pressure_pa over the lower of both tensile strengths, Kmax of the paper";
    cone_crack_onset: Real "1" of loading.cone_crack_onset => "largest force over that at which a cone crack is expected in the first body, by Auerbach's law";
    yield_pressure_pa: Real "Pa" of plastic.yield_pressure_pa => "largest mean pressure of the yielding contact; for jackson_green, mean pressure at the onset of yield under the surface";
    yield_velocity_m_s: Real "m/s" of plastic.yield_velocity_m_s => "velocity of approach at the onset of yield in the plasticity law";
    velocity_over_yield: Real "1" of plastic.velocity_over_yield => "velocity of approach over the velocity at the onset of yield in the plasticity law";
    velocity_over_trusted: Real "1" of plastic.velocity_over_trusted => "velocity of approach over the largest velocity at which the plasticity law is valid; absent for laws without such a limit";
    plastic_work_j: Real "J" of plastic.plastic_work_j => "work of plastic flow";
    peak_indentation_m: Real "m" of plastic.peak_indentation_m => "largest indentation";
    residual_indentation_m: Real "m" of plastic.residual_indentation_m => "permanent indentation";
    dent_radius_m: Real "m" of plastic.dent_radius_m => "effective radius of the striker in its dent: of the sphere that touches a plane in the same way";
    contacts: Count "1" of contacts => "number of contacts";
    march_steps: Count "1" of march_steps => "number of time steps over the contact, 0 if they are not uniform";
    march_step_s: Real "s" of march_step_s => "time step over the contact, 0 if it is not uniform";
    relative_error_estimate: Real "1" of relative_error_estimate, relative_error_estimate => "estimated relative error of peak force, contact time, restitution and displacement";
};

macro_rules! labels {
    ($($name:expr, $unit:literal, $meaning:literal;)*) => { [$(($name, $unit, $meaning)),*] };
}
pub(crate) use labels;

/// Fields at every point, in the order of the kernels: name, unit and meaning.
pub const FIELDS: [(&str, &str, &str); 6] = labels! {
    "displacement_r", "m", "radial displacement, positive outwards";
    "displacement_z", "m", "axial displacement, positive into the half-space";
    "stress_rr", "Pa", "radial stress, negative in compression";
    "stress_tt", "Pa", "hoop stress, negative in compression";
    "stress_zz", "Pa", "axial stress, negative in compression";
    "stress_rz", "Pa", "shear stress";
};

/// Further field quantities that a scene may request, with unit and meaning; the quantity has its own name.
pub const FIELD_QUANTITIES: [(FieldQuantity, &str, &str); 14] = labels! {
    FieldQuantity::VelocityR, "m/s", "radial velocity of the particles, positive outwards";
    FieldQuantity::VelocityZ, "m/s", "axial velocity of the particles, positive into the half-space";
    FieldQuantity::AccelerationR, "m/s^2", "radial acceleration of the particles, mean over one step of the output";
    FieldQuantity::AccelerationZ, "m/s^2", "axial acceleration of the particles, mean over one step of the output";
    FieldQuantity::StrainRr, "1", "radial strain, negative in compression";
    FieldQuantity::StrainTt, "1", "hoop strain, negative in compression";
    FieldQuantity::StrainZz, "1", "axial strain, negative in compression";
    FieldQuantity::StrainRz, "1", "shear strain of the tensor, half of the change of angle";
    FieldQuantity::VonMises, "Pa", "von Mises' equivalent stress, sqrt(((s1 - s2)^2 + (s2 - s3)^2 + (s3 - s1)^2)/2)";
    FieldQuantity::Tresca, "Pa", "Tresca's equivalent stress, s1 - s3";
    FieldQuantity::MaxShear, "Pa", "largest shear stress, (s1 - s3)/2";
    FieldQuantity::Principal1, "Pa", "largest principal stress, negative in compression";
    FieldQuantity::Principal2, "Pa", "middle principal stress, negative in compression";
    FieldQuantity::Principal3, "Pa", "smallest principal stress, negative in compression";
};

/// Name, unit and meaning.
pub type Labels<'a> = (&'a str, &'a str, &'a str);

/// Labels of the six fields, followed by those of further quantities, in the order of the results.
pub fn labels_of(quantities: &[FieldQuantity]) -> impl Iterator<Item = Labels<'static>> {
    let more = quantities.iter().filter_map(|quantity| {
        let row = FIELD_QUANTITIES.iter().find(|row| row.0 == *quantity)?;
        Some((quantity.name(), row.1, row.2))
    });
    FIELDS.into_iter().chain(more)
}

/// A column of a file: name, unit and meaning.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Described {
    /// Name in the file.
    pub name: String,
    /// Unit; `1` if dimensionless.
    pub unit: String,
    /// Meaning in a few words.
    pub meaning: String,
}

impl From<Labels<'_>> for Described {
    fn from((name, unit, meaning): Labels<'_>) -> Self {
        let [name, unit, meaning] = [name, unit, meaning].map(str::to_owned);
        Self {
            name,
            unit,
            meaning,
        }
    }
}

impl Described {
    pub(crate) fn labels(&self) -> Labels<'_> {
        (&self.name, &self.unit, &self.meaning)
    }
}
