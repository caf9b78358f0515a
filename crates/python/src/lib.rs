//! `hertzlamb._core`: the library behind the Python package `hertzlamb`.
//!
//! Functions take what Python has and give read-only numpy arrays, dictionaries and plain values; names, units and
//! defaults for people are in `python/hertzlamb`, with the types in `_core.pyi`.
//! Whatever takes more than a millisecond runs without the interpreter's lock ([`work`]).

#![allow(
    clippy::needless_pass_by_value,
    reason = "Python gives arguments by value"
)]
#![allow(
    clippy::too_many_arguments,
    reason = "the Python layer gives them names"
)]
#![allow(
    missing_docs,
    reason = "the stubs in python/hertzlamb document what Python sees"
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
mod impact_outcome;

use pyo3::prelude::*;

/// What Python sees.
#[pymodule]
mod _core {
    #[pymodule_export]
    use crate::{
        impact_outcome::{Outcome, infer, run_impact},
        kernels::{arrivals, kernel, medium, static_field, surface, surface_centre},
        library::{describe, materials},
        scene::{resolved, sections_of},
        sweep::{Plan, check_at_once, plan, plan_of_columns},
        table::Table,
        tabulate::{extend, tabulate},
    };

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
