//! Waves in an elastic half-space under an impact.
//!
//! A contact that is solved ([`Impact`]) or a force that was measured ([`ForceRecord`]) is an [`Excitation`]: a force
//! history on a disc.
//! From it follow the fields at points ([`Excitation::fields`]) and all that a [`Scene`] asks for ([`simulate()`]).
//! Many contacts without fields are [`sweep`]s.
//! Nothing here reads or writes a file; without the default feature `hdf5` there is no C library either.
//!
//! ```
//! use impact::{Field, HalfSpace, Impact, Material, Striker};
//!
//! let steel = HalfSpace::new(Material::named("steel")?)?;
//! let ball = Striker::ball(Material::named("bearing-steel")?, 0.002)?;
//! let run = Impact::new(steel, ball, 1.0).solve()?;
//! let fields = run.excitation().fields(1e-8)?;
//! // half a millimetre below the contact
//! let below = fields.at(0.0, 5e-4)?;
//! assert!(below[Field::StressZz].peak() < -1e7, "compression is negative");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// in reading order
mod condition;
mod cost;
pub mod energy;
mod error;
mod evaluator;
pub mod excitation;
pub mod fields;
mod finite;

pub mod forecast;
pub mod grid;
pub mod impact;
pub mod kernels;
mod low_pass;
pub mod numbers;
pub mod outcome;
pub mod peaks;
mod place;
mod plausible;
pub mod probes;
pub mod quantity;
pub mod record;
mod run;
pub mod scene;
pub mod shared;
pub mod simulate;
pub mod source;
mod stretch;
pub mod sweep;
mod watch;

pub use condition::{Treatment, TreatmentError};
pub use contact::{HalfSpace, Material, Settings, Striker};
pub use energy::EnergySeries;
pub use error::FieldsError;
pub use evaluator::convolve;
pub use excitation::{Excitation, Motion, PressureRadius};
pub use fields::{FieldHistory, Fields, Trace};
pub use finite::NotFinite;
pub use forecast::{Allowance, Forecast, TooMuch, TooMuchMemory};
pub use grid::{Grid, TooManySamples};
pub use halfspace::Field;
pub use impact::{Impact, Run};
pub use kernels::KernelSource;
pub use outcome::{Cause, FieldsUsed, KernelsUsed, Outcome, RecordResults, Series, StrikerSeries};
pub use peaks::{Peak, ProbePeaks};
pub use place::{FieldError, Place};
pub use probes::{Peaks, ProbeFields, ProbeQuantity, SectionFields, SectionQuantity};
pub use quantity::Quantity;
pub use record::{ForceRecord, RecordError, Treated};
pub use scene::{Load, Probe, Scene, Section, Strike};
pub use shared::Shared;
pub use simulate::{ImpactError, simulate, simulate_watched, simulate_within};
pub use source::{KernelChoice, SourceError, Tables};
pub use watch::{Unwatched, Watch};

/// The README's program runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
