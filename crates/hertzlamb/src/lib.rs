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
//! `formats`, `tabulator` and the files of `lookup` come with the default feature `hdf5`; without it no C library is needed, and
//! the rest builds for `wasm32-unknown-unknown`.
//!
//! The programs in `examples/` show the force alone, a point inside, a table made and used, a sweep in memory, and
//! a force that was measured.
#![cfg_attr(doctest, doc = include_str!("../README.md"))]
#![warn(missing_docs)]

pub use {contact, halfspace, impact, lookup};
#[cfg(feature = "hdf5")]
pub use {formats, tabulator};

/// What most programs need.
pub mod prelude {
    pub use contact::{Choice, HalfSpace, Library, Material, Model, Results, Settings, Striker};
    #[cfg(feature = "hdf5")]
    pub use formats::{parse_scene, read_scene, write_results};
    pub use halfspace::Field;
    pub use impact::{
        Excitation, ForceRecord, Impact, KernelChoice, KernelSource, Run, Scene, simulate,
    };
    pub use lookup::Table;
    #[cfg(feature = "hdf5")]
    pub use lookup::TableFile;
}
