//! Marching schemes: from the impact equation to a force history.
//!
//! All of them work in [`CollisionUnits`](crate::units::CollisionUnits) and fill a [`History`](history::History).

pub mod budget;
mod dissipation;
mod edge;
pub mod error;
pub mod explicit;
pub(crate) mod fine;
mod flight;
pub mod growing;
pub mod history;
pub mod implicit;
pub mod refine;
mod relaxation;
mod separation;
pub mod weights;
pub mod workspace;
