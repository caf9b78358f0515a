//! Traces of sensors from text: a column of times and one for each sensor.

use super::Traces;
use crate::error::SceneError;
use crate::scene::record::{TIMES, columns, factor, number, separator, unit};
use crate::scene::section::{MOST_OF_RECORD, read_text_up_to};
use std::path::Path;

/// Reads traces from a text with a header: times first, then one column for each sensor in the order of the scene, in the unit of its
/// output. The unit of time is in its name, such as `time_s`, `time_us` or `Time [us]`. Lines above the header are skipped.
///
/// # Errors
/// [`SceneError`] with the file and the line.
pub fn read_traces(path: &Path) -> Result<Traces, SceneError> {
    let found = read_columns(path)?;
    Traces::new(&found.time_s, found.samples).map_err(|error| error.in_file(path))
}

/// Columns of a text.
#[derive(Debug, Default)]
pub(crate) struct Columns {
    /// Names of the columns after the time.
    pub(crate) names: Vec<String>,
    /// Times in s.
    pub(crate) time_s: Vec<f64>,
    /// Samples of each column.
    pub(crate) samples: Vec<Vec<f64>>,
}

/// Reads the columns of a text with a header. The column of times is the first whose name begins with `time` or is `t`, or else the
/// first.
pub(crate) fn read_columns(path: &Path) -> Result<Columns, SceneError> {
    let text = read_text_up_to(path, MOST_OF_RECORD)?;
    of_text(text.trim_start_matches('\u{feff}')).map_err(|(line, reason)| {
        let sentence = format!("{} line {line}: {reason}", path.display());
        SceneError::in_sentence(path, sentence)
    })
}

/// The columns of a text, or the line at fault with the reason.
fn of_text(text: &str) -> Result<Columns, (usize, String)> {
    let lines = (1..).zip(text.lines().map(str::trim));
    let lines = lines.filter(|(_, row)| !row.is_empty());
    let is_row = |row: &str| {
        let by = separator(row);
        let fields = columns(row, by);
        // one that is not finite is a number of the first row, not a name
        let is_number = |field: &&str| number(field, by).is_some() || field.parse::<f64>().is_ok();
        fields.len() >= 2 && fields.iter().all(is_number)
    };
    let mut header: Option<&str> = None;
    let mut found = Columns::default();
    let (mut unit_s, mut time) = (1.0, 0);
    let mut comment = None;
    for (line, row) in lines {
        if let Some(words) = row.strip_prefix('#') {
            comment = Some(words.trim());
            continue;
        }
        let by = separator(row);
        let fields = columns(row, by);
        if found.time_s.is_empty() && !is_row(row) {
            header = Some(row);
            continue;
        }
        if found.time_s.is_empty() {
            // some programs write the header as a comment
            let Some(header) = header.or(comment) else {
                return Err((
                    line,
                    "there is no header: name the columns, such as \"time_us,sensor1\"".to_owned(),
                ));
            };
            let mut names = columns(header, separator(header));
            time = names.iter().position(|name| is_time(name)).unwrap_or(0);
            let named_time = names.remove(time);
            let of_time = named_time.rsplit_once('_');
            let of_time = of_time.map_or(named_time, |(_, unit)| unit);
            let named = unit(named_time, None, "s");
            let of_time = if named.is_empty() { of_time } else { named };
            unit_s = factor(named_time, of_time, &TIMES, "", "name it such as time_us")
                .map_err(|reason| (line, reason))?;
            found.samples = vec![Vec::new(); fields.len() - 1];
            found.names = names.into_iter().map(str::to_owned).collect();
        }
        if fields.len() != found.samples.len() + 1 {
            let (wanted, fields) = (found.samples.len() + 1, fields.len());
            return Err((
                line,
                format!("there are {fields} fields, but the first row has {wanted}"),
            ));
        }
        for (place, field) in fields.iter().enumerate() {
            let value = number(field, by)
                .ok_or_else(|| (line, format!("\"{field}\" is not a finite number")))?;
            match place {
                _ if place == time => found.time_s.push(unit_s * value),
                _ => found.samples[place - usize::from(place > time)].push(value),
            }
        }
    }
    if found.time_s.is_empty() {
        return Err((1, "there are no rows with a time and a sample".to_owned()));
    }
    Ok(found)
}

/// Whether a name is that of times.
fn is_time(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    name.starts_with("time") || name == "t" || name.starts_with("t_") || name.starts_with("t [")
}
