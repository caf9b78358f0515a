//! The source paper redone: its numbers and figures beside those of this program.
//!
//! A copper rod of 12.2 g with a hemispherical end strikes a steel anvil at 100 m/s.
//! [`Numbers`] has every number that the paper prints, each beside ours with the reason where they differ;
//! [`Redone`] adds Figures 4 to 11, what the text says of them, and the report that holds it all.
//!
//! What is drawn as "converged" is the paper's model (a disc of fixed radius that carries Hertz's pressure, its whole
//! deflection added to Hertz's indentation) solved to 1e-6 with Table 1; what is drawn as "the paper's scheme" is the
//! explicit scheme (40)-(44) with a step of 0.164 us and copper of 129 GPa, which give every
//! number that the paper prints of it, to its last digit.
//!
//! Equation, figure and table numbers are the paper's.
#![cfg_attr(doctest, doc = include_str!("../README.md"))]

// From the bottom up: a module uses only those above it.
mod case;
mod figures;
mod numbers;
mod report;

pub use case::{PRINTED_PA, RADIUS_M, TABLE_1_PA, coupled, growing};
pub use figures::{Claim, Redrawn};
pub use numbers::{Numbers, PrintedSection, Row};
pub use report::{Redone, csv_file, drawn};
