//! A force record as text: the columns time_s and force_n.

use super::size::MOST_SAMPLES;
use crate::error::SceneError;
use impact::{ForceRecord, RecordError};
use std::path::Path;

/// The one header allowed.
const HEADER: &str = "time_s,force_n";

pub(super) fn from_csv(text: &str, path: &Path) -> Result<ForceRecord, SceneError> {
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
