//! Names and versions on disk, one file per format.

pub mod results;
pub mod sweep;
