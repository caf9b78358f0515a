//! From a scene to its results: contact, then fields.

mod contact_run;
mod fields;
mod grid;
mod plan;
mod prescribed;
mod source;
mod strike;

pub use fields::{Fields, MapFields};
pub(crate) use plan::{Plan, accuracy, disc_radius_m, plan};

use crate::convolve::FieldError;
use crate::march::MarchError;
use crate::scene::{Load, Scene};
use halfspace::DomainError;
use lookup::{TableError, TableFile};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Where the fields' kernels come from.
#[derive(Debug, Clone)]
pub enum KernelChoice {
    /// Computed for each probe.
    Direct,
    /// A table, of which the part that the scene needs is loaded.
    Table(TableFile),
    /// The table or computed, by the estimated cost and error of both.
    Auto(TableFile),
}

/// Why a scene could not be computed.
#[derive(Debug, Error)]
pub enum ImpactError {
    /// The march failed.
    #[error(transparent)]
    March(#[from] MarchError),
    /// A field failed.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The part of the table could not be loaded.
    #[error("{}", table_text(path, source))]
    Table {
        /// The table.
        path: PathBuf,
        /// What is wrong with it.
        source: TableError,
    },
    /// A material is outside the physics.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// The radiated loss is not small.
    #[error(
        "model \"radiation\" is a first-order law: it gives a loss of {loss:.3} of the kinetic energy, outside [0, 0.5]; use model \"growing\" or \"wave\""
    )]
    LossTooLarge {
        /// The loss 1 - e^2 of the law.
        loss: f64,
    },
    /// More samples than memory should hold.
    #[error(
        "the output needs {samples:.3e} samples of {step_s:.3e} s, more than {limit}: give a larger step_s or a smaller output.duration_s"
    )]
    TooManySamples {
        /// Samples needed.
        samples: f64,
        /// Their step in s.
        step_s: f64,
        /// Samples allowed.
        limit: usize,
    },
}

/// The sentence of a table's error, with the name of the file.
fn table_text(path: &Path, error: &TableError) -> String {
    let (text, name) = (error.to_string(), path.display().to_string());
    if text.contains(&name) {
        text
    } else {
        format!("{name}: {text}")
    }
}

/// Names of the choices made.
#[derive(Debug, Clone, PartialEq)]
pub struct Choices {
    /// Model, never "auto"; "prescribed" for a given force.
    pub model: &'static str,
    /// Scheme; "closed form" where nothing was marched.
    pub scheme: &'static str,
    /// Static share.
    pub static_share: &'static str,
    /// Deflection.
    pub deflection: &'static str,
    /// Why this model.
    pub reason: String,
}

/// Scalar results in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// Largest displacement of the striker in m.
    pub peak_displacement_m: f64,
    /// Largest deflection that enters the contact law in m.
    pub peak_deflection_m: f64,
    /// Momentum given to the striker in N s.
    pub impulse_n_s: f64,
    /// Kinetic energy before in J.
    pub initial_energy_j: f64,
    /// Energy radiated into the half-space in J.
    pub radiated_energy_j: f64,
    /// (initial - rebound - radiated)/initial.
    pub energy_residual: f64,
    /// Number of contacts.
    pub contacts: usize,
}

/// Time series of the impact in SI units.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Series {
    /// Time in s, uniform.
    pub time_s: Vec<f64>,
    /// Contact force in N.
    pub force_n: Vec<f64>,
    /// Displacement of the striker in m.
    pub displacement_m: Vec<f64>,
    /// Velocity of the striker in m/s.
    pub velocity_m_s: Vec<f64>,
    /// Deflection that enters the contact law in m.
    pub deflection_m: Vec<f64>,
}

/// All that a scene gives.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Choices made.
    pub choices: Choices,
    /// Kernel of the fields: "none", "direct" or "table".
    pub kernel: &'static str,
    /// Why this kernel; empty without fields.
    pub kernel_reason: String,
    /// How the fields were convolved: "direct sum", "fast Fourier transform", or empty.
    pub convolution: &'static str,
    /// Id and format version of the table.
    pub table: Option<(String, String)>,
    /// Steps of the march over the contact.
    pub march_steps: usize,
    /// Step of the march in s.
    pub march_step_s: f64,
    /// Scalar results; none of the striker's for a prescribed force.
    pub results: Results,
    /// Time series.
    pub series: Series,
    /// Fields at the probes.
    pub fields: Option<Fields>,
    /// Fields on the section.
    pub map: Option<MapFields>,
    /// Radius of the disc that loads the half-space in the fields, in m.
    pub disc_radius_m: f64,
    /// Estimated relative error of the scalar results.
    pub relative_error_estimate: f64,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// The scene with all defaults.
    pub resolved_scene: String,
}

/// Computes a scene.
///
/// # Errors
/// [`ImpactError`].
pub fn simulate(scene: &Scene, kernels: &KernelChoice) -> Result<Outcome, ImpactError> {
    match &scene.load {
        Load::Strike(striker) => strike::strike(scene, striker, kernels),
        Load::Prescribed(force) => prescribed::prescribed(scene, force, kernels),
    }
}
