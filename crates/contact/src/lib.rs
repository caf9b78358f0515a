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
//! let radiated = solver.radiated(&collision, &settings, &solved)?;
//! let results = Results::new(&collision, &settings, &solved, radiated);
//! // 0.66 % of the kinetic energy leaves as waves
//! assert!((results.loss - 0.00663).abs() < 1e-5, "{}", results.loss);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// in reading order
pub mod bodies;
mod body_error;
pub mod choose;
pub mod collision;
pub mod disc;
pub mod energy;
pub mod error;
pub mod fall;
mod finite;
mod force_balance;
pub mod law;
pub mod library;
mod library_data;
pub mod march;
pub mod material;
mod nearest;
pub mod numbers;
pub mod plan;
mod quadrature;
pub mod resample;
pub mod response;
pub mod results;
mod schemes;
pub mod settings;
pub mod shape;
pub mod solver;
pub mod spectral;
pub mod strength;
pub mod summary;
pub mod surface;
pub mod units;
pub mod validity;
pub mod waves;
mod well_posed;
pub mod work;

pub use bodies::{HalfSpace, Striker};
pub use body_error::BodyError;
pub use collision::Collision;
pub use disc::{ExactDisc, FixedDisc};
pub use error::ContactError;
pub use fall::fall_velocity_m_s;
pub use finite::MOST_ERROR;
pub use library::{Library, UnknownMaterial};
pub use march::error::MarchError;
pub use march::explicit::march_explicit;
pub use march::growing::{GrowingDisc, march_growing};
pub use march::history::History;
pub use march::implicit::march_implicit;
pub use march::refine::{Accuracy, Refined, refine};
pub use march::weights::memory_weights;
pub use march::workspace::Workspace;
pub use material::Material;
pub use nearest::nearest;
pub use response::punch::PunchResponse;
pub use response::shelf::{Exact, Ratios, Responses, Tabulated};
pub use response::table::ResponseTable;
pub use results::Results;
pub use schemes::{Found, solve_disc};
pub use settings::{Choice, Conflict, Model, Scheme, Settings, StaticShare};
pub use shape::Shape;
pub use solver::{Solved, Solver};
pub use spectral::{
    GrowingContact, GrowingError, PunchWaves, SolvedContact, solve_growing, work_on_half_space,
};
pub use strength::{Loading, Strength};
pub use summary::Summary;
pub use waves::WaveSpeeds;

/// The README's program runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
