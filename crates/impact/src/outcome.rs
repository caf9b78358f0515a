//! All that a scene gives: numbers, none of which is not finite.

use crate::energy::EnergySeries;
use crate::error::{ImpactError, finite};
use crate::fields::probes::{ProbeFields, SectionFields};
use crate::quantity::Quantity;
use crate::sampled::convolve::Method;
use contact::{Choice, Model, Results, Scheme};
use lookup::schema::FIELD_NAMES;

/// What loaded the half-space, with the results that go with it.
#[derive(Debug, Clone, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "a scene has one")]
pub enum Cause {
    /// A striker.
    Contact {
        /// Model, never [`Model::Auto`].
        model: Model,
        /// Scheme; none where nothing was marched.
        scheme: Option<Scheme>,
        /// Why this model.
        reason: String,
        /// Results.
        results: Results,
    },
    /// A record.
    Record(RecordResults),
}

/// Scalar results of a force that was given, in SI units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RecordResults {
    /// Largest force in N.
    pub peak_force_n: f64,
    /// When it is reached in s.
    pub peak_force_time_s: f64,
    /// Time in s that the blow lasts, from its onset to the end of the force.
    pub duration_s: f64,
    /// int P dt in N s.
    pub impulse_n_s: f64,
    /// Largest deflection of the disc in m.
    pub peak_deflection_m: f64,
    /// Radius of the disc that it loads in m.
    pub disc_radius_m: f64,
    /// The most that the samples leave of the force between them, over the largest force.
    pub relative_error_estimate: f64,
    /// Work on the part of the mean deflection that lags behind the force, in J.
    pub radiated_energy_j: f64,
}

/// How the fields were computed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FieldsUsed {
    /// Id of the table of their kernels and version of its file's format; none of kernels that were computed.
    pub table: Option<[String; 2]>,
    /// Why these kernels.
    pub reason: String,
    /// How the force was convolved with them.
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
    /// The striker, where there is one.
    pub striker: Option<StrikerSeries>,
    /// Where the energy is.
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

/// All that a scene gives.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// What loaded the half-space, and its results.
    pub cause: Cause,
    /// How the fields were computed; none without fields.
    pub used: Option<FieldsUsed>,
    /// Time series.
    pub series: Series,
    /// Fields at the probes.
    pub probes: Option<ProbeFields>,
    /// Fields on the section.
    pub section: Option<SectionFields>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

impl Outcome {
    /// Step of the output in s; a record that is quiet for long begins with a gap.
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

/// Passes on an outcome all numbers of which are finite; those of a contact are checked where it is solved.
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
    if let Some(found) = &outcome.section {
        let arrivals = found.arrival_s[..2].iter().flatten().copied();
        finite(|| "an arrival in the section".to_owned(), arrivals)?;
        let values = found.values.iter();
        let values = values.map(|own| own.iter().copied().map(f64::from));
        fields("in the section", &found.quantities, values, &found.errors)?;
    }
    Ok(outcome)
}

/// The six fields and the quantities beside them, with their errors, somewhere.
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
