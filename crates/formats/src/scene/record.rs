//! Force records: text with the columns `time_s,force_n`, or HDF5 with `/time` and `/force`, which a results file has.

use super::text::{MOST_OF_RECORD, read_text_up_to};
use crate::error::SceneError;
use hdfread::{Group, HdfError};
use impact::{ForceRecord, RecordError};
use output::HDF5;
use std::io::ErrorKind;
use std::path::Path;

/// Samples at most: they are held in memory several times.
const MOST_SAMPLES: usize = 1 << 24;

/// Reads a record; the ending of its name says which of both it is.
///
/// # Errors
/// [`SceneError::ForceFile`] with the line at fault, [`SceneError::Unreadable`].
pub fn read_record(path: &Path) -> Result<ForceRecord, SceneError> {
    let mut record = if HDF5.is_of(path) {
        from_hdf5(path)?
    } else {
        from_csv(&read_text_up_to(path, MOST_OF_RECORD)?, path)?
    };
    record.file = Some(path.to_owned());
    Ok(record)
}

/// The one header allowed.
const HEADER: &str = "time_s,force_n";

fn from_csv(text: &str, path: &Path) -> Result<ForceRecord, SceneError> {
    let fault = |line: usize, reason: String| SceneError::ForceFile {
        path: path.to_owned(),
        line,
        reason,
    };
    let mut rows = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.trim()))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    match rows.next() {
        Some((_, header)) if header.trim_start_matches('\u{feff}').replace(' ', "") == HEADER => {}
        Some((line, other)) => {
            return Err(fault(
                line,
                format!("the header is \"{other}\", not \"{HEADER}\""),
            ));
        }
        None => {
            return Err(fault(
                1,
                format!("the file is empty; its header is \"{HEADER}\""),
            ));
        }
    }
    let (mut lines, mut time_s, mut force_n) = (Vec::new(), Vec::new(), Vec::new());
    for (line, row) in rows {
        let mut fields = row.split(',').map(str::trim);
        let mut number = |name: &str| -> Result<f64, SceneError> {
            let field = fields.next().unwrap_or("");
            match field.parse::<f64>() {
                Ok(x) if x.is_finite() => Ok(x),
                Ok(_) | Err(_) => Err(fault(
                    line,
                    format!("{name} = \"{field}\" is not a finite number"),
                )),
            }
        };
        let (time, force) = (number("time_s")?, number("force_n")?);
        if let Some(extra) = fields.next() {
            return Err(fault(line, format!("there is a third field, \"{extra}\"")));
        }
        if lines.len() == MOST_SAMPLES {
            let reason = format!("there are more than {MOST_SAMPLES} rows: cut or thin the record");
            return Err(fault(line, reason));
        }
        lines.push(line);
        time_s.push(time);
        force_n.push(force);
    }
    ForceRecord::new(time_s, force_n).map_err(|error| match error {
        RecordError::Count { times, .. } => fault(
            text.lines().count().max(1),
            format!("{times} rows of samples, at least 2 are needed"),
        ),
        RecordError::NotFinite { sample } => fault(lines[sample], error.to_string()),
        RecordError::NotAscending {
            sample,
            time_s,
            before_s,
        } => fault(
            lines[sample],
            format!("time_s = {time_s} does not follow {before_s}; times must ascend"),
        ),
        RecordError::Negative { time_s } => {
            fault(lines[0], format!("time_s = {time_s} is outside [0, inf)"))
        }
    })
}

/// Reads the datasets `/time` (s) and `/force` (N) without the HDF5 library, which trusts what it reads.
fn from_hdf5(path: &Path) -> Result<ForceRecord, SceneError> {
    let fault = |reason: String| SceneError::Unreadable {
        path: path.to_owned(),
        reason,
    };
    let root = ledger::open(path).and_then(|(file, _)| file.root());
    let root = root.map_err(|error| {
        fault(match &error {
            HdfError::Io(source) if source.kind() == ErrorKind::NotFound => {
                "there is no such file".to_owned()
            }
            other => other.to_string(),
        })
    })?;
    let time_s = samples(&root, "time").map_err(fault)?;
    let force_n = samples(&root, "force").map_err(fault)?;
    ForceRecord::new(time_s, force_n).map_err(|error| {
        fault(match error {
            RecordError::Count { times, forces } => format!(
                "/time has {times} samples and /force {forces}; at least 2 and as many of each are needed"
            ),
            RecordError::Negative { time_s } => {
                format!("/time begins at {time_s}, outside [0, inf)")
            }
            RecordError::NotAscending {
                time_s, before_s, ..
            } => format!("/time = {time_s} does not follow {before_s}; times must ascend"),
            RecordError::NotFinite { .. } => error.to_string(),
        })
    })
}

/// The numbers of a dataset of one dimension.
fn samples(root: &Group, name: &str) -> Result<Vec<f64>, String> {
    let failed = |error: HdfError| match error {
        HdfError::Absent { .. } => format!("it has no dataset /{name} of numbers"),
        other => format!("/{name}: {other}"),
    };
    let data = root.dataset(name).map_err(failed)?;
    if !data.kind().is_number() {
        return Err(format!(
            "/{name} holds values of the type {}, no numbers",
            data.kind()
        ));
    }
    if data.shape().len() != 1 {
        return Err(format!(
            "/{name} has {} dimensions, needed 1",
            data.shape().len()
        ));
    }
    if data.count() > MOST_SAMPLES {
        return Err(format!(
            "/{name} has {} samples, more than {MOST_SAMPLES}: cut or thin the record",
            data.count()
        ));
    }
    data.as_f64(8 * MOST_SAMPLES as u64).map_err(failed)
}
