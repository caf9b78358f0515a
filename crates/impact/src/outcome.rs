//! All that a scene gives.

use crate::energy::EnergySeries;
use crate::evaluator::convolve::Method;
use crate::fields::probes::{ProbeFields, SectionFields};
use contact::{Model, Results, Scheme};

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
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecordResults {
    /// Largest force in N.
    pub peak_force_n: f64,
    /// When it is reached in s.
    pub peak_force_time_s: f64,
    /// Time from the first to the last sample in s.
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

/// Kernels that were used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum KernelsUsed {
    /// Computed.
    Direct,
    /// Looked up.
    Table {
        /// Id of the table.
        id: String,
        /// Version of its file's format.
        format_version: String,
    },
}

impl KernelsUsed {
    /// Name in reports and results.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Direct => "direct",
            Self::Table { .. } => "table",
        }
    }
}

/// How the fields were computed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FieldsUsed {
    /// Their kernels.
    pub kernels: KernelsUsed,
    /// Why these kernels.
    pub reason: String,
    /// How the force was convolved with them.
    pub convolution: Method,
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
    #[must_use]
    pub fn step_s(&self) -> f64 {
        let time_s = &self.series.time_s;
        let first = time_s.get(1).map_or(0.0, |second| second - time_s[0]);
        let mut steps = time_s.windows(2).map(|pair| pair[1] - pair[0]);
        steps.find(|step| *step < 0.5 * first).unwrap_or(first)
    }

    /// The results of a contact; none for a record.
    #[must_use]
    pub fn results(&self) -> Option<&Results> {
        match &self.cause {
            Cause::Contact { results, .. } => Some(results),
            Cause::Record(_) => None,
        }
    }

    /// Largest force in N.
    #[must_use]
    pub fn peak_force_n(&self) -> f64 {
        match &self.cause {
            Cause::Contact { results, .. } => results.peak_force_n,
            Cause::Record(results) => results.peak_force_n,
        }
    }
}
