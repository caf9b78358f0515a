//! Contact force of a body that strikes an elastic half-space: Hertz contact on Lamb's half-space.
//!
//! Two bodies and a velocity are a [`Collision`]; a [`Solver`] gives its force history and results with the model and
//! scheme of its [`Settings`].
//! Nothing here knows a file format or needs a C library.
//!
//! ```
//! use contact::{Collision, Exact, HalfSpace, Material, Results, Settings, Solver, Striker};
//!
//! let block = HalfSpace::new(Material::named("steel")?)?;
//! let ball = Striker::ball(Material::named("bearing-steel")?, 0.005)?;
//! let (collision, settings) = (Collision::new(&block, &ball, 1.0), Settings::default());
//! let mut solver = Solver::new(&Exact);
//! let solved = solver.solve(&collision, &settings)?;
//! let results = Results::new(&collision, &settings, &solved);
//! // 0.66 % of the kinetic energy leaves as waves
//! assert!((results.loss - 0.00663).abs() < 1e-5, "{}", results.loss);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(doctest, doc = include_str!("../README.md"))]
#![warn(missing_docs)]

pub mod law;

mod bodies;
mod collision;
mod disc;
mod energy;
mod error;
mod growing;
mod model;
mod names;
mod numbers;
mod numeric;
mod outcome;
mod plastic;
mod resample;
mod responses;
mod results;
mod solver;
mod summary;
mod units;
mod validity;

pub use bodies::library::{Library, UnknownMaterial};
pub use bodies::material::{BodyError, Material, from_wave_speeds};
pub use bodies::shape::Shape;
pub use bodies::strength::{Loading, Strength, largest_mises};
pub use bodies::wave_speeds::WaveSpeeds;
pub use bodies::{GRAVITY_M_S2, HalfSpace, Striker, fall_velocity_m_s};
pub use collision::{CONSTRAINT, Collision};
pub use disc::explicit::march_explicit;
pub use disc::history::History;
pub use disc::implicit::march_implicit;
pub use disc::refine::{Accuracy, Found, refine, solve_disc};
pub use disc::response::{DiscResponse, ResponseTable};
pub use disc::weights::Weights;
pub use disc::{CENTRE_COUPLING, FixedDisc};
pub use energy::work_until_j;
pub use error::{ContactError, MarchError};
pub use growing::solve_growing;
pub use growing::solved::SolvedContact;
pub use growing::waves::{GrowingContact, PunchWaves};
pub use growing::work::work_on_half_space;
pub use model::choose::{Family, Groups, Plan, fixed_disc_m};
pub use model::{Conflict, Model, Plasticity, Rung, Scheme, Settings, StaticShare};
pub use names::{Choice, nearest};
pub use numbers::NUMBERS_REVISION;
pub use outcome::Outcomes;
pub use plastic::infer::{InferError, Inferred, Measure, Unknown, infer};
pub use plastic::{Flow, Yielding};
pub use resample::Resampler;
pub use responses::{Exact, Responses, Tabulated};
pub use results::{MOST_ERROR, Plastic, Results};
pub use solver::{Solved, Solver};
pub use summary::{Estimates, Instant, Summary};
pub use units::{CollisionUnits, KernelUnits};
pub use validity::{doubts, super_seismic, warnings};
