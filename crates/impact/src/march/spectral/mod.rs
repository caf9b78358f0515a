//! The growing contact to any accuracy.
pub mod solve;
mod legendre;
mod nodes;
mod piece;
mod step;
mod waves;
pub use waves::PunchWaves;
