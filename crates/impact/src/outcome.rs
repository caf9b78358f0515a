//! Results of a scene; all numbers are finite.

use crate::energy::EnergySeries;
use crate::error::{ImpactError, finite};
use crate::fields::probes::{ProbeFields, SectionFields};
use crate::fields::sensors::SensorHistory;
use crate::quantity::Quantity;
use crate::sampled::convolve::Method;
use contact::{Choice, Model, Results, Scheme};
use lookup::schema::FIELD_NAMES;

/// Load on the half-space, with its results.
#[derive(Debug, Clone, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "a scene has one")]
pub enum Cause {
    /// A striker.
    Contact {
        /// Model, never [`Model::Auto`].
        model: Model,
        /// Scheme; none for a closed form.
        scheme: Option<Scheme>,
        /// Reason for this model.
        reason: String,
        /// Results.
        results: Results,
    },
    /// A record.
    Record(RecordResults),
}

/// Scalar results of a prescribed force, in SI units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RecordResults {
    /// Largest force in N.
    pub peak_force_n: f64,
    /// Time of the largest force in s.
    pub peak_force_time_s: f64,
    /// Duration of the main pulse in s, from its onset to the end of the force.
    pub duration_s: f64,
    /// int P dt in N s.
    pub impulse_n_s: f64,
    /// Largest deflection of the disc in m.
    pub peak_deflection_m: f64,
    /// Radius of the loaded disc in m.
    pub disc_radius_m: f64,
    /// Largest deviation of the force from its samples, relative to the largest force.
    pub relative_error_estimate: f64,
    /// Work on the mean deflection that lags behind the force, in J.
    pub radiated_energy_j: f64,
}

/// Method of computing the fields.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FieldsUsed {
    /// Id of the table of their kernels and version of its file format; none for computed kernels.
    pub table: Option<[String; 2]>,
    /// Reason for these kernels.
    pub reason: String,
    /// Method of convolution with the force.
    pub convolution: Method,
}

impl FieldsUsed {
    /// Name of the kernels in reports and results: "direct" or "table".
    pub fn kernel(&self) -> &'static str {
        self.table.as_ref().map_or("direct", |_| "table")
    }
}

/// Time series in SI units.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Series {
    /// Time in s, uniform.
    pub time_s: Vec<f64>,
    /// Force in N.
    pub force_n: Vec<f64>,
    /// Deflection that enters the contact law in m; that of the disc for a record.
    pub deflection_m: Vec<f64>,
    /// The striker, if there is one.
    pub striker: Option<StrikerSeries>,
    /// Energy over time.
    pub energy: Option<EnergySeries>,
}

/// Motion of the striker over time, in SI units.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StrikerSeries {
    /// Displacement in m.
    pub displacement_m: Vec<f64>,
    /// Velocity in m/s.
    pub velocity_m_s: Vec<f64>,
}

/// Results of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Load on the half-space, with its results.
    pub cause: Cause,
    /// Method of computing the fields; none without fields.
    pub used: Option<FieldsUsed>,
    /// Time series.
    pub series: Series,
    /// Fields at the probes.
    pub probes: Option<ProbeFields>,
    /// Histories of the sensors.
    pub sensors: Vec<SensorHistory>,
    /// Fields on the section.
    pub section: Option<SectionFields>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

impl Outcome {
    /// Step of the output in s; the first gap may be longer for a record with long constant parts.
    pub fn step_s(&self) -> f64 {
        let time_s = &self.series.time_s;
        let first = time_s.get(1).map_or(0.0, |second| second - time_s[0]);
        let mut steps = time_s.windows(2).map(|pair| pair[1] - pair[0]);
        steps.find(|step| *step < 0.5 * first).unwrap_or(first)
    }

    /// The results of a contact; none for a record.
    pub fn results(&self) -> Option<&Results> {
        match &self.cause {
            Cause::Contact { results, .. } => Some(results),
            Cause::Record(_) => None,
        }
    }
}

/// Returns the outcome if all its numbers are finite; those of a contact are checked where it is solved.
pub(crate) fn checked(outcome: Outcome) -> Result<Outcome, ImpactError> {
    if let Cause::Record(results) = &outcome.cause {
        for (name, value) in [
            ("the peak force", results.peak_force_n),
            ("the time of the peak force", results.peak_force_time_s),
            ("the duration", results.duration_s),
            ("the impulse", results.impulse_n_s),
            ("the largest deflection", results.peak_deflection_m),
            ("the disc's radius", results.disc_radius_m),
            ("the error estimate", results.relative_error_estimate),
            ("the radiated energy", results.radiated_energy_j),
        ] {
            finite(|| name.to_owned(), [value])?;
        }
    }
    let series = &outcome.series;
    let (striker, energy) = (series.striker.as_ref(), series.energy.as_ref());
    let kinetic_j = energy.and_then(|e| e.kinetic_j.as_ref());
    let plastic_j = energy.and_then(|e| e.plastic_j.as_ref());
    for (name, samples) in [
        ("the time", Some(&series.time_s)),
        ("the force", Some(&series.force_n)),
        ("the deflection", Some(&series.deflection_m)),
        ("the displacement", striker.map(|s| &s.displacement_m)),
        ("the velocity", striker.map(|s| &s.velocity_m_s)),
        ("the kinetic energy", kinetic_j),
        ("the work", energy.and_then(|e| e.work_j.as_ref())),
        ("the stored energy", energy.map(|e| &e.stored_j)),
        ("the radiated energy", energy.map(|e| &e.radiated_j)),
        ("the plastic work", plastic_j),
    ] {
        let samples = samples.into_iter().flatten().copied();
        finite(|| format!("{name} of a sample"), samples)?;
    }
    if let Some(found) = &outcome.probes {
        let arrivals = found.arrival_s.iter().flat_map(|[p, s, _]| [*p, *s]);
        finite(|| "an arrival at a probe".to_owned(), arrivals)?;
        let values = found.values.iter();
        let values = values.map(|rows| rows.iter().flatten().copied());
        fields("at a probe", &found.quantities, values, &found.errors)?;
    }
    for found in &outcome.sensors {
        let means = found.mean.samples.iter().chain([&found.mean.error]);
        let outputs = found.output.iter().chain(&found.output_error);
        finite(
            || "the mean over the face of a sensor".to_owned(),
            means.copied(),
        )?;
        finite(|| "the output of a sensor".to_owned(), outputs.copied())?;
    }
    if let Some(found) = &outcome.section {
        let arrivals = found.arrival_s[..2].iter().flatten().copied();
        finite(|| "an arrival in the section".to_owned(), arrivals)?;
        let values = found.values.iter();
        let values = values.map(|own| own.iter().copied().map(f64::from));
        fields("in the section", &found.quantities, values, &found.errors)?;
    }
    Ok(outcome)
}

/// The six fields and further quantities at some places, with their errors.
fn fields<V: IntoIterator<Item = f64>>(
    place: &str,
    quantities: &[Quantity],
    values: impl Iterator<Item = V>,
    errors: &[Vec<f64>],
) -> Result<(), ImpactError> {
    let more = quantities.iter().map(|quantity| quantity.name());
    let names = FIELD_NAMES.into_iter().chain(more);
    for ((name, values), errors) in names.zip(values).zip(errors) {
        let name = format!("{name} {place}");
        finite(|| name.clone(), values)?;
        finite(|| format!("the error of {name}"), errors.iter().copied())?;
    }
    Ok(())
}
