//! Errors as exceptions of `hertzlamb._errors`, with the numbers that their sentences have.

use crate::convert::from_json;
use crate::tables::Fault;
use formats::SceneError;
use halfspace::DomainError;
use impact::{FieldError, FieldsError, ImpactError, SourceError, TooMuch};
use lookup::{LookupError, TableError};
use output::OutputError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};
use std::fmt::Display;
use std::path::Path;
use tabulator::BuildError;

/// An exception of a class of `hertzlamb._errors`.
fn exception(py: Python<'_>, class: &str, message: &str, fields: &Value) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let class = py.import("hertzlamb._errors")?.getattr(class)?;
        let fields = from_json(py, fields)?;
        let made = class.call((message,), Some(fields.cast::<PyDict>()?))?;
        Ok(PyErr::from_value(made))
    };
    made().unwrap_or_else(|error| error)
}

/// What cannot happen.
pub(crate) fn internal(py: Python<'_>, error: &dyn Display) -> PyErr {
    failed(py, &format!("the program is at fault: {error}"))
}

/// Work that failed.
pub(crate) fn failed(py: Python<'_>, message: &str) -> PyErr {
    exception(py, "WorkError", message, &json!({}))
}

/// An argument that is none.
pub(crate) fn bad_input(py: Python<'_>, message: &str) -> PyErr {
    exception(py, "SceneError", message, &json!({}))
}

/// A process that was forked from one that had threads.
pub(crate) fn forked(py: Python<'_>, owner: u32) -> PyErr {
    let message = format!(
        "this process was forked from process {owner} after that one had begun to compute, and the threads of hertzlamb do not survive a fork: start processes with multiprocessing.get_context(\"spawn\") or \"forkserver\""
    );
    exception(py, "ForkError", &message, &json!({}))
}

/// A scene that cannot be run.
pub(crate) fn scene(py: Python<'_>, error: &SceneError) -> PyErr {
    let culprit = error.culprit();
    let fields = json!({
        "key": culprit.key,
        "value": culprit.number.map(Value::from).or(culprit.word.map(Value::from)),
        "suggestion": culprit.suggestion,
        "file": culprit.file.map(Path::to_string_lossy),
    });
    exception(py, "SceneError", &error.to_string(), &fields)
}

/// A question outside a table.
pub(crate) fn of_lookup(py: Python<'_>, error: &LookupError, file: Option<&Path>) -> PyErr {
    lookup_in(py, error, &error.to_string(), file)
}

fn lookup_in(py: Python<'_>, error: &LookupError, message: &str, file: Option<&Path>) -> PyErr {
    let file = file.map(Path::to_string_lossy);
    let outside = |axis: &str, value: f64, low: f64, high: f64| {
        let fields = json!({"axis": axis, "value": value, "low": low, "high": high, "file": file});
        exception(py, "OutsideTable", message, &fields)
    };
    match error {
        LookupError::Outside {
            axis,
            value,
            min,
            max,
        } => outside(axis, *value, *min, *max),
        LookupError::Coarsening { value, max } => {
            outside("coarsening", f64::from(*value), 0.0, f64::from(*max))
        }
        LookupError::PulseLength { value } => outside("pulse_length", *value, 0.0, f64::INFINITY),
        LookupError::Domain(error) => domain_in(py, error, message),
        LookupError::Lengths { .. } => internal(py, error),
    }
}

/// A number outside the physics.
pub(crate) fn domain(py: Python<'_>, error: &DomainError) -> PyErr {
    domain_in(py, error, &error.to_string())
}

fn domain_in(py: Python<'_>, error: &DomainError, message: &str) -> PyErr {
    let fields = match error {
        DomainError::Range {
            argument,
            value,
            range,
        } => json!({"argument": argument, "value": value, "range": range}),
        DomainError::HertzOnly { function, .. } => json!({"argument": function}),
    };
    exception(py, "DomainError", message, &fields)
}

/// The file of a table that is none.
pub(crate) fn table(py: Python<'_>, error: &TableError) -> PyErr {
    use TableError as E;
    let path = match error {
        E::Unreadable { path, .. }
        | E::NotHdf5 { path, .. }
        | E::Damaged { path, .. }
        | E::Foreign { path, .. }
        | E::Version { path, .. }
        | E::Item { path, .. }
        | E::Dimensions { path, .. }
        | E::TooLarge { path, .. }
        | E::Content { path, .. }
        | E::Checksum { path, .. }
        | E::Unwritable { path, .. } => path,
    };
    let fields = json!({"file": path.to_string_lossy()});
    exception(py, "BadTable", &error.to_string(), &fields)
}

/// A table that cannot be had.
pub(crate) fn fault(py: Python<'_>, error: &Fault) -> PyErr {
    match error {
        Fault::Table(error) => table(py, error),
        Fault::Changed(path) => {
            let fields = json!({"file": path.to_string_lossy()});
            exception(py, "BadTable", &error.to_string(), &fields)
        }
    }
}

/// An impact that has no results.
pub(crate) fn of_impact(py: Python<'_>, error: &ImpactError, file: Option<&Path>) -> PyErr {
    use ImpactError as E;
    let message = error.to_string();
    match error {
        E::Fields(FieldsError::Field(FieldError::Table { source, .. })) => {
            lookup_in(py, source, &message, file)
        }
        E::Fields(FieldsError::Field(FieldError::Domain { source, .. }))
        | E::Fields(FieldsError::Domain(source))
        | E::Source(SourceError::Domain(source))
        | E::Domain(source) => domain_in(py, source, &message),
        E::Source(SourceError::Table(fault)) => match fault.downcast_ref::<TableError>() {
            Some(error) => table(py, error),
            None => exception(
                py,
                "BadTable",
                &message,
                &json!({"file": file.map(Path::to_string_lossy)}),
            ),
        },
        E::TooMuch(TooMuch::Memory(_)) => exception(py, "TooMuchMemory", &message, &json!({})),
        E::Contact(_)
        | E::Fields(FieldsError::TooManySamples(_))
        | E::TooManySamples(_)
        | E::TooMuch(_)
        | E::NotFinite(_)
        | E::NoDisc => exception(py, "ImpactError", &message, &json!({})),
    }
}

/// A file that was not written.
pub(crate) fn of_output(py: Python<'_>, error: &OutputError) -> PyErr {
    use OutputError as E;
    let (class, path) = match error {
        E::Exists { path } => ("OutputExists", path),
        E::Unwritable { path, .. }
        | E::Failed { path, .. }
        | E::Full { path, .. }
        | E::Busy { path }
        | E::Ending { path, .. }
        | E::Unbuilt { path, .. }
        | E::Input { output: path, .. }
        | E::Twice { first: path, .. } => ("OutputError", path),
    };
    let mut message = error.to_string();
    if class == "OutputExists" {
        message.push_str("; give overwrite=True to replace it");
    }
    let fields = json!({"file": path.to_string_lossy()});
    exception(py, class, &message, &fields)
}

/// A table that was not built.
pub(crate) fn build(py: Python<'_>, error: &BuildError) -> PyErr {
    match error {
        BuildError::Output(error) => of_output(py, error),
        BuildError::Table(error) => table(py, error),
        BuildError::Domain(error) => domain(py, error),
        BuildError::Lookup(error) => of_lookup(py, error, None),
        BuildError::Setting { key, value, .. } => {
            let fields = json!({"key": key, "value": value});
            exception(py, "SceneError", &error.to_string(), &fields)
        }
        BuildError::Settings { .. } | BuildError::InFile { .. } | BuildError::Shrinks { .. } => {
            exception(py, "SceneError", &error.to_string(), &json!({}))
        }
        BuildError::Unwritable(_)
        | BuildError::TooFine { .. }
        | BuildError::Journal(_)
        | BuildError::NotBlocks { .. }
        | BuildError::NoShards
        | BuildError::Mixed { .. }
        | BuildError::Incomplete { .. }
        | BuildError::File { .. }
        | BuildError::NotFinite { .. }
        | BuildError::Content(_) => failed(py, &error.to_string()),
    }
}

/// A profile, an integral or a deflection that does not exist.
pub(crate) fn unknown(py: Python<'_>, what: &str, found: &str, allowed: &[&str]) -> PyErr {
    let message = format!("{what} = \"{found}\" is not one of {}", allowed.join(", "));
    let fields = json!({"argument": what, "value": found, "range": allowed.join(", ")});
    exception(py, "DomainError", &message, &fields)
}

/// Refuses arrays that the memory does not hold: so many places of so many bytes each.
pub(crate) fn check_memory(py: Python<'_>, places: usize, bytes: usize) -> PyResult<()> {
    let (needed, free) = (places as f64 * bytes as f64, output::free_memory());
    if needed <= free {
        return Ok(());
    }
    let message = format!(
        "{places} places need about {:.3} GB of memory, more than the {:.3} GB there are: ask for fewer at a time",
        1e-9 * needed,
        1e-9 * free
    );
    Err(exception(py, "TooMuchMemory", &message, &json!({})))
}

/// Traces that no memory holds.
pub(crate) fn too_much_memory(py: Python<'_>, points: usize, cells: usize) -> PyErr {
    let message = format!(
        "{points} points of {cells} cells need {:.3} GB of memory, more than there is: ask for fewer points or cells, or for a larger coarsening",
        48e-9 * points as f64 * cells as f64
    );
    exception(py, "TooMuchMemory", &message, &json!({}))
}
