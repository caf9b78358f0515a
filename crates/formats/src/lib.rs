//! Files of hertzlamb: readers and writers as functions over typed values.
//!
//! Scenes, materials and force records come in, results, sections and sweeps go out; `data-schema/` describes each.
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
#![cfg_attr(doctest, doc = include_str!("../README.md"))]

mod error;
mod hdf;
pub mod parts;
pub mod quantities;
mod report;
pub mod results;
pub mod scene;
pub mod stored;
pub mod sweep;

pub use error::SceneError;
pub use output::{Existing, Output, OutputError, write_whole};
pub use quantities::{Kind, QUANTITIES, Quantity};
pub use report::{
    accuracy_report, choices, infer, json_report, kernel_name, material_report, table_report,
};
pub use results::{check_results, stage_results, stage_results_csv, write_results};
pub use scene::{
    parse_materials, parse_scene, read_materials, read_record, read_scene, read_with_inputs,
    resolved,
};
