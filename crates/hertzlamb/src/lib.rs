//! Impact of a body on an elastic half-space: Hertz contact on Lamb's half-space.
//!
//! ```
//! use hertzlamb::prelude::*;
//!
//! let block = HalfSpace::new(Material::named("steel")?)?;
//! let ball = Striker::ball(Material::named("copper")?, 0.004)?; // radius in m
//! let run = Impact::new(block, ball, 1.0).solve()?; // velocity in m/s
//! let fields = run.excitation().fields(1e-8)?; // tolerance of the kernels
//! let under = fields.at(0.0, 0.004)?;
//! println!("{} N, {} Pa", run.peak_force_n, under[Field::StressZz].peak());
//! # assert!((run.peak_force_n / 269.98 - 1.0).abs() < 1e-3, "{}", run.peak_force_n);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | crate | contents |
//! |---|---|
//! | [`halfspace`] | exact kernels of the half-space, in reduced units |
//! | [`contact`] | force history, rebound and energy loss of two bodies at a velocity |
//! | [`impact`] | fields at points and on sections under a force on the half-space; many impacts |
//! | [`lookup`] | kernel tables: interpolation instead of computation |
//! | [`tabulator`] | computation of kernel tables |
//! | [`formats`] | files: scenes, materials, force records, results and sweeps |
//!
//! The default feature `hdf5` includes `formats`, `tabulator` and the files of `lookup`. Without it the crate needs no C
//! library and also builds for `wasm32-unknown-unknown`.
//!
//! The programs in `examples/` show the contact force alone, a point in the block, a kernel table, a sweep in memory, and
//! a measured force.
#![cfg_attr(doctest, doc = include_str!("../README.md"))]
#![warn(missing_docs)]

pub use {contact, halfspace, impact, lookup};
#[cfg(feature = "hdf5")]
pub use {formats, tabulator};

/// Types and functions that most programs need.
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
