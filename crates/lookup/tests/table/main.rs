//! Tables filled from an analytic stand-in: the lookup and the file.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

#[cfg(feature = "hdf5")]
mod damage;
#[cfg(feature = "hdf5")]
mod format;
mod interpolation;
#[cfg(feature = "hdf5")]
mod older;
#[cfg(feature = "hdf5")]
mod part;
mod slices;
mod stand_in;
