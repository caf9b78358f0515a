//! `hertzlamb._core`: the compiled part of the Python package `hertzlamb`.
//!
//! Functions return read-only numpy arrays, dictionaries and plain values. The public names, defaults and documentation
//! are in `python/hertzlamb`, the types of this module in `_core.pyi`.
//! Work of more than a millisecond runs without the interpreter's lock ([`work`]).

#![allow(
    clippy::needless_pass_by_value,
    reason = "Python passes arguments by value"
)]
#![allow(clippy::too_many_arguments, reason = "the Python layer names them")]
#![allow(
    missing_docs,
    reason = "python/hertzlamb documents the public interface"
)]

// From the bottom up: a module uses only those above it.
mod values;
mod errors;
mod work;
mod library;
mod scene;
mod kernels;
mod sweep;
mod table;
mod tabulate;
mod response;
mod force;
mod noise;
mod impact_outcome;

use pyo3::prelude::*;

/// The Python module.
#[pymodule]
mod _core {
    #[pymodule_export]
    use crate::{
        force::{Force, infer_force_of},
        impact_outcome::{Outcome, infer, run_impact},
        kernels::{arrivals, kernel, medium, spectrum, static_field, surface, surface_centre},
        library::{describe, materials},
        noise::{Noise, compute_noise},
        response::Response,
        scene::{resolved, sections_of},
        sweep::{Plan, check_at_once, plan, plan_of_columns},
        table::Table,
        tabulate::{extend, tabulate},
    };

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
