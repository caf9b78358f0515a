//! Files of hertzlamb: readers and writers as functions over typed values.
//!
//! It reads scenes, materials and force records and writes results, sections and sweeps; `data-schema/` describes each
//! format.
//!
//! Results and sweeps require the default feature `hdf5`. Without it the crate reads scenes and needs no C library.
//!
//! ```
//! let text = "[target]\nmaterial = \"granite\"\n[striker]\nmaterial = \"steel\"\nmass_kg = 4e-6\n\
//!     tip_radius_m = 5e-4\nvelocity_m_s = 1.0\n";
//! let scene = formats::parse_scene(text, std::path::Path::new("."))?;
//! let outcome = impact::simulate(&scene, &impact::KernelChoice::Direct)?;
//! let report = formats::json_report(&scene, &outcome, 0.0);
//! assert!(report["peak_force_n"].as_f64() > Some(1.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(
    not(feature = "hdf5"),
    allow(
        dead_code,
        unused_imports,
        reason = "results and sweeps use parts of the scene reader that a scene alone does not"
    )
)]
#![cfg_attr(doctest, doc = include_str!("../README.md"))]

// From the bottom up: a module uses only those above it. Modules with a feature write or read HDF5 files.
mod error;
pub mod quantities;
pub mod schema;
pub mod scene;
mod report;
#[cfg(feature = "hdf5")]
mod hdf;
pub mod traces;
#[cfg(feature = "hdf5")]
pub mod sweep;
#[cfg(feature = "hdf5")]
pub mod noise;
#[cfg(feature = "hdf5")]
pub mod stored;
#[cfg(feature = "hdf5")]
pub mod results;
#[cfg(feature = "hdf5")]
pub mod lamb;
#[cfg(feature = "hdf5")]
pub mod parts;

pub use error::SceneError;
pub use output::{Existing, Output, OutputError, write_whole};
pub use quantities::{Kind, QUANTITIES, Quantity};
pub use report::{
    accuracy_report, choices, infer, json_report, kernel_name, material_report, table_report,
};
#[cfg(feature = "hdf5")]
pub use results::{check_results, stage_results, stage_results_csv, write_results};
pub use scene::{
    parse_materials, parse_scene, read_materials, read_record, read_response, read_scene,
    read_with_inputs, resolved,
};
