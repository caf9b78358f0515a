//! Exact histories of Lamb's problem for the tests of wave codes, and the comparison of histories.
//!
//! [`histories`] has displacements, velocities and stresses at a place of a half-space after a vertical force on its surface: a point
//! force, Hertz's or a uniform pressure on a disc, with a function of time. [`compare`] measures how far two histories differ in
//! amplitude, time and spectrum. Nothing here reads a file.
#![cfg_attr(doctest, doc = include_str!("../README.md"))]
#![warn(missing_docs)]

// From the bottom up: a module uses only those above it in this list.
mod error;

// The force.
mod source;

// Step responses.
mod place;
mod panels;

// Histories.
mod lamb;

// Two histories.
mod compare;

pub use compare::{Comparison, Limits, Record, compare};
pub use error::OracleError;
pub use lamb::{COMPONENTS, History, Quantity, histories};
pub use source::{Lines, Load, TimeFunction, Wavelet};
