//! The source paper reproduced: its numbers and figures, compared with those of this program.
//!
//! A copper rod of 12.2 g with a hemispherical end strikes a steel anvil at 100 m/s.
//! [`Numbers`] contains every number that the paper prints, our result, and the reason for each difference. [`Redone`] adds
//! Figures 4 to 11, the paper's statements about them, and a report.
//!
//! "Converged" means the paper's model (a disc of fixed radius under Hertz's pressure, whose whole deflection is added
//! to Hertz's indentation), solved to 1e-6 with Table 1. "The paper's scheme" means the explicit scheme (40)-(44) with
//! a step of 0.164 us and copper of 129 GPa, which reproduces every printed number of the scheme to its last digit.
//!
//! Equation, figure and table numbers are those of the paper.
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
