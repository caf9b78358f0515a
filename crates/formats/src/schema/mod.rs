//! Names and versions on disk, one file per format.

pub mod force;
pub mod lamb;
pub mod noise;
pub mod results;
pub mod sweep;
