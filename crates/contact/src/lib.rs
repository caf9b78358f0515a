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

// From the bottom up: a module uses only those above it in this list.

// Values of a choice with their names in files.
mod names;

// Collision units and kernel units.
mod units;

// Materials, striker, half-space, strengths.
mod bodies;

// Quadrature, linear systems, series, roots.
mod numeric;

// Why a contact has no results.
mod error;

// Settings of a contact.
mod settings;

// Results in collision units.
mod summary;

// Accuracy of results, and results with their error.
mod accuracy;

// How a loaded surface answers.
mod waves;

// Contact laws in closed form, laws of flow.
pub mod law;

// Contacts whose radius follows the load.
mod growing;

// Samples or pieces of a contact, read at any time.
mod history;

// Contacts on a disc of fixed radius.
mod disc;

// Two bodies and a velocity: their dimensionless groups.
mod collision;

// Model chosen, scheme run.
mod solve;

// Results in SI units.
mod results;

// Warnings.
mod validity;

// Yield pressure or velocity from a rebound.
mod infer;

// Revision of the numbers.
mod numbers;

pub use accuracy::{Accuracy, Found};
pub use bodies::library::{Library, UnknownMaterial};
pub use bodies::material::{BodyError, Material, from_wave_speeds};
pub use bodies::shape::Shape;
pub use bodies::strength::{Loading, Strength, largest_mises};
pub use bodies::wave_speeds::WaveSpeeds;
pub use bodies::{Echoes, Echoing, GRAVITY_M_S2, HalfSpace, Striker, fall_velocity_m_s};
pub use collision::{CONSTRAINT, Collision};
pub use disc::explicit::march_explicit;
pub use disc::implicit::march_implicit;
pub use disc::refine::{refine, solve_disc};
pub use disc::weights::Weights;
pub use disc::{CENTRE_COUPLING, FixedDisc};
pub use error::{ContactError, MarchError};
pub use growing::solve_growing;
pub use growing::solved::SolvedContact;
pub use growing::surface::SurfaceMotion;
pub use growing::work::work_on_half_space;
pub use history::History;
pub use history::resample::Resampler;
pub use infer::{InferError, Inferred, Measure, Unknown, infer};
pub use law::yielding::{Flow, Yielding};
pub use names::{Choice, nearest};
pub use numbers::NUMBERS_REVISION;
pub use numeric::work::work_until_j;
pub use results::{MOST_ERROR, Plastic, Results};
pub use settings::{Conflict, Memory, Model, Physics, Plasticity, Scheme, Settings, StaticShare};
pub use solve::choose::{Chosen, Regime, fixed_disc_m};
pub use solve::outcome::Outcomes;
pub use solve::{Solved, Solver};
pub use summary::{Estimates, Instant, Summary};
pub use units::{CollisionUnits, KernelUnits};
pub use validity::{doubts, super_seismic, warnings};
pub use waves::cache::{Exact, Responses, Tabulated};
pub use waves::punch::{GrowingContact, PunchWaves};
pub use waves::response::{DiscResponse, ResponseTable};
