//! Names and versions on disk, a file for each format.

pub mod results;
pub mod sweep;
