//! Compares the columns of two texts.

use crate::error::SceneError;
use crate::traces::{Columns, read_columns};
use oracle::{Comparison, Limits, Record, compare};
use std::path::Path;

/// Two columns and their comparison.
#[derive(Debug, Clone)]
pub struct Compared {
    /// Name of the column in the other file.
    pub theirs: String,
    /// Name of the reference.
    pub ours: String,
    /// The comparison.
    pub found: Comparison,
}

/// Compares each column of `theirs` with the column of `ours` that has its name, or the name that `map` (theirs, ours) sets.
/// Upper and lower case are the same; columns of errors are ignored. Also returns the columns of theirs that have no partner.
///
/// # Errors
/// [`SceneError`] with the file and the column at fault.
pub fn compare_files(
    [theirs, ours]: [&Path; 2],
    map: &[(String, String)],
    limits: Limits,
) -> Result<(Vec<Compared>, Vec<String>), SceneError> {
    let [a, b] = [read_columns(theirs)?, read_columns(ours)?];
    let same = |x: &str, y: &str| x.eq_ignore_ascii_case(y);
    let place =
        |columns: &Columns, name: &str| columns.names.iter().position(|own| same(own, name));
    for (own, other) in map {
        for (columns, path, name) in [(&a, theirs, own), (&b, ours, other)] {
            place(columns, name)
                .ok_or_else(|| no_column(path, &format!("no column \"{name}\""), columns))?;
        }
    }
    for (columns, path) in [(&a, theirs), (&b, ours)] {
        let (names, samples) = (columns.names.len(), columns.samples.len());
        if names != samples {
            return Err(SceneError::is(
                path,
                format!("has {names} names and {samples} columns after the time: name each column"),
            ));
        }
    }
    let (mut found, mut alone) = (Vec::new(), Vec::new());
    for (name, samples) in a.names.iter().zip(&a.samples) {
        if name.to_ascii_lowercase().ends_with("_error") {
            continue;
        }
        let mapped = map.iter().find(|(own, _)| same(own, name));
        let Some(partner) = place(&b, mapped.map_or(name, |(_, other)| other)) else {
            alone.push(name.clone());
            continue;
        };
        let of_a = Record {
            time_s: &a.time_s,
            values: samples,
        };
        let of_b = Record {
            time_s: &b.time_s,
            values: &b.samples[partner],
        };
        let compared = compare(of_a, of_b, limits).map_err(|error| {
            let paths = format!("theirs {}, ours {}", theirs.display(), ours.display());
            SceneError::of(format!("column \"{name}\": {error} ({paths})"), name)
        })?;
        found.push(Compared {
            theirs: name.clone(),
            ours: b.names[partner].clone(),
            found: compared,
        });
    }
    if found.is_empty() {
        let names = a.names.join(", ");
        let sentence = format!(
            "no column of {} ({names}) is in it: name them with --map theirs=ours",
            theirs.display()
        );
        return Err(no_column(ours, &sentence, &b));
    }
    Ok((found, alone))
}

fn no_column(path: &Path, what: &str, columns: &Columns) -> SceneError {
    let known: Vec<&str> = columns
        .names
        .iter()
        .map(String::as_str)
        .filter(|name| !name.ends_with("_error"))
        .collect();
    SceneError::is(
        path,
        format!("has the columns {}: {what}", known.join(", ")),
    )
}
