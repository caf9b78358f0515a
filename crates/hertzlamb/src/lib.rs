//! Impact of a body on an elastic half-space: Hertz contact on Lamb's half-space.
//!
//! ```
//! use hertzlamb::prelude::*;
//!
//! let block = HalfSpace::new(Material::named("steel")?)?;
//! let ball = Striker::ball(Material::named("copper")?, 0.004)?; // its radius in m
//! let run = Impact::new(block, ball, 1.0).solve()?;
//! let fields = run.excitation().fields(1e-8)?; // tolerance of the kernels
//! let under = fields.at(0.0, 0.004)?;
//! println!("{} N, {} Pa", run.peak_force_n, under[Field::StressZz].peak());
//! # assert!((run.peak_force_n / 269.98 - 1.0).abs() < 1e-3, "{}", run.peak_force_n);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | crate | what it is |
//! |---|---|
//! | [`halfspace`] | exact kernels of the half-space, in reduced units |
//! | [`contact`] | two bodies and a velocity: force history, rebound, loss |
//! | [`impact`] | a force on the half-space: fields at points, sections, many impacts |
//! | [`lookup`] | kernel tables: fields looked up instead of computed |
//! | [`tabulator`] | making kernel tables |
//! | [`formats`] | scenes, materials, records, results and sweeps as files |
//!
//! The programs in `examples/` show the force alone, a point inside, a table made and used, a sweep in memory, and
//! a force that was measured.
#![cfg_attr(doctest, doc = include_str!("../README.md"))]
#![warn(missing_docs)]

pub use {contact, formats, halfspace, impact, lookup, tabulator};

/// What most programs need.
pub mod prelude {
    pub use contact::{Choice, HalfSpace, Library, Material, Model, Results, Settings, Striker};
    pub use formats::{parse_scene, read_scene, write_results};
    pub use halfspace::Field;
    pub use impact::{
        Excitation, ForceRecord, Impact, KernelChoice, KernelSource, Run, Scene, simulate,
    };
    pub use lookup::{Table, TableFile};
}
