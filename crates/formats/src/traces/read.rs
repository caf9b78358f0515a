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
    let text = read_text_up_to(path, MOST_OF_RECORD)?;
    let found = of_text(text.trim_start_matches('\u{feff}')).map_err(|(line, reason)| {
        let sentence = format!("{} line {line}: {reason}", path.display());
        SceneError::in_sentence(path, sentence)
    })?;
    let (time_s, samples) = found;
    Traces::new(&time_s, samples).map_err(|error| error.in_file(path))
}

/// Times in s and the samples of each column after them.
type Columns = (Vec<f64>, Vec<Vec<f64>>);

/// The columns of a text, or the line at fault with the reason.
fn of_text(text: &str) -> Result<Columns, (usize, String)> {
    let lines = (1..).zip(text.lines().map(str::trim));
    let lines = lines.filter(|(_, row)| !row.is_empty() && !row.starts_with('#'));
    let is_row = |row: &str| {
        let by = separator(row);
        let fields = columns(row, by);
        fields.len() >= 2 && fields.iter().all(|field| number(field, by).is_some())
    };
    let mut header: Option<&str> = None;
    let (mut time_s, mut samples): Columns = Default::default();
    let mut unit_s = 1.0;
    for (line, row) in lines {
        let by = separator(row);
        let fields = columns(row, by);
        if time_s.is_empty() && !is_row(row) {
            header = Some(row);
            continue;
        }
        if time_s.is_empty() {
            let Some(header) = header else {
                return Err((
                    line,
                    "there is no header: name the columns, such as \"time_us,sensor1\"".to_owned(),
                ));
            };
            let names = columns(header, separator(header));
            let of_time = names[0].rsplit_once('_').map_or(names[0], |(_, unit)| unit);
            let named = unit(names[0], None, "s");
            let of_time = if named.is_empty() { of_time } else { named };
            unit_s = factor(names[0], of_time, &TIMES, "", "name it such as time_us")
                .map_err(|reason| (line, reason))?;
            samples = vec![Vec::new(); fields.len() - 1];
        }
        if fields.len() != samples.len() + 1 {
            let (wanted, found) = (samples.len() + 1, fields.len());
            return Err((
                line,
                format!("there are {found} fields, but the first row has {wanted}"),
            ));
        }
        for (place, field) in fields.iter().enumerate() {
            let value = number(field, by)
                .ok_or_else(|| (line, format!("\"{field}\" is not a finite number")))?;
            match place.checked_sub(1) {
                None => time_s.push(unit_s * value),
                Some(sensor) => samples[sensor].push(value),
            }
        }
    }
    if time_s.is_empty() {
        return Err((1, "there are no rows with a time and a sample".to_owned()));
    }
    Ok((time_s, samples))
}
