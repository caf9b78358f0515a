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
#![cfg_attr(doctest, doc = include_str!("../README.md"))]
#![warn(missing_docs)]

// From the bottom up: a module uses those above it alone.
pub mod response;
mod error;
mod quantity;
mod sampled;
pub mod record;
pub mod kernels;
pub mod excitation;
pub mod scene;
mod grid;
mod face;
mod convolution;
mod cost;
pub mod source;
mod fields;
pub mod energy;
pub mod impact;
pub mod outcome;
pub mod simulate;
pub mod sweep;
pub mod numbers;

pub use contact::{HalfSpace, Material, Settings, Striker};
pub use convolution::Trace;
pub use cost::{Allowance, Forecast, Place, Road};
pub use energy::EnergySeries;
pub use error::ImpactError;
pub use excitation::{Excitation, Motion, PressureRadius};
pub use fields::peaks::Peak;
pub use fields::probes::{EchoArrivals, Peaks, ProbeFields, ProbePeaks, SectionFields};
pub use fields::sensors::{FaceMean, SensorHistory};
pub use fields::{FieldHistory, Fields};
pub use halfspace::Field;
pub use impact::{Impact, Run};
pub use kernels::KernelSource;
pub use outcome::{Cause, FieldsUsed, Outcome, RecordResults, Series, StrikerSeries};
pub use quantity::Quantity;
pub use record::condition::TreatmentError;
pub use record::jump::{Jump, follows};
pub use record::{ASCENDING, ForceRecord, Reading, RecordError, Treated};
pub use sampled::convolve;
pub use scene::{Load, Measured, Probe, Scene, Section, Sensor, SensorResponse, Strike};
pub use simulate::{simulate, simulate_rows, simulate_within};
pub use source::{KernelChoice, Shared, Tables};
