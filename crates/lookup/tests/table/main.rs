//! Tables filled from an analytic stand-in: the lookup and the file.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod format;
mod interpolation;
mod slices;
mod stand_in;
