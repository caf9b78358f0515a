//! A prescribed force history from a file, linear between its samples.

use super::error::SceneError;
use super::force_hdf::{from_hdf5, is_hdf5};
use super::read_text;
use std::path::{Path, PathBuf};

/// Samples of a force; zero before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct PrescribedForce {
    /// The file.
    pub path: PathBuf,
    /// Times in s, strictly ascending, the first not negative.
    pub time_s: Vec<f64>,
    /// Forces in N; positive presses.
    pub force_n: Vec<f64>,
}

/// The one header allowed.
const HEADER: &str = "time_s,force_n";

impl PrescribedForce {
    /// Reads a CSV file with the header `time_s,force_n`, lines that begin with # are comments; or an
    /// HDF5 file with the datasets `/time` and `/force`, which a results file has.
    ///
    /// # Errors
    /// [`SceneError::ForceFile`] with the line at fault, [`SceneError::Unreadable`].
    pub fn from_file(path: &Path) -> Result<Self, SceneError> {
        if is_hdf5(path) {
            return from_hdf5(path);
        }
        Self::from_csv(&read_text(path)?, path)
    }

    pub(crate) fn from_csv(text: &str, path: &Path) -> Result<Self, SceneError> {
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
            Some((_, header))
                if header.trim_start_matches('\u{feff}').replace(' ', "") == HEADER => {}
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
        let (mut time_s, mut force_n) = (Vec::new(), Vec::new());
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
            if time < 0.0 {
                return Err(fault(line, format!("time_s = {time} is outside [0, inf)")));
            }
            if let Some(&before) = time_s.last()
                && time <= before
            {
                return Err(fault(
                    line,
                    format!("time_s = {time} does not follow {before}; times must ascend"),
                ));
            }
            time_s.push(time);
            force_n.push(force);
        }
        if time_s.len() < 2 {
            let lines = text.lines().count().max(1);
            return Err(fault(
                lines,
                format!("{} rows of samples, at least 2 are needed", time_s.len()),
            ));
        }
        Ok(Self {
            path: path.to_owned(),
            time_s,
            force_n,
        })
    }

    /// The force at a time: linear between samples, zero outside.
    #[must_use]
    pub fn at(&self, time_s: f64) -> f64 {
        let after = self.time_s.partition_point(|&t| t <= time_s);
        if after == 0 {
            return 0.0;
        }
        if after == self.time_s.len() {
            let last = after - 1;
            return if time_s == self.time_s[last] {
                self.force_n[last]
            } else {
                0.0
            };
        }
        let (t0, t1) = (self.time_s[after - 1], self.time_s[after]);
        let share = (time_s - t0) / (t1 - t0);
        self.force_n[after - 1] + share * (self.force_n[after] - self.force_n[after - 1])
    }

    /// Time of the last sample in s.
    #[must_use]
    pub fn end_s(&self) -> f64 {
        self.time_s.last().copied().unwrap_or(0.0)
    }
}
