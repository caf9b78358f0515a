//! Responses of sensors in text: poles and zeros as SAC writes them, or a table over frequency.

use super::record::{columns, number, separator};
use super::section::{MOST_OF_TOML, read_text_up_to};
use crate::error::SceneError;
use impact::response::{MOST_ROWS, PolesZeros, Response, ResponseError, Tabulated};
use num_complex::Complex64;
use std::f64::consts::PI;
use std::path::Path;

/// The reason why a text is no response, with the number of its line, from 1, if it has one.
type Wrong = (Option<usize>, String);

/// Reads a response; a file with a line that begins with `ZEROS`, `POLES` or `CONSTANT` has poles and zeros, any other one a
/// table.
///
/// The poles and zeros of SAC files are in rad/s and refer to displacement in m; [`PolesZeros::of_derivative`] makes them
/// refer to velocity or acceleration.
/// A table has a header with frequency, amplitude and perhaps phase, each with its unit, as in
/// `frequency_hz,amplitude_db,phase_deg` or `f [kHz];amplitude;phase [rad]`. Other columns are skipped.
///
/// # Errors
/// [`SceneError`] with the file, the line and the value.
pub fn read_response(path: &Path) -> Result<Response, SceneError> {
    let text = read_text_up_to(path, MOST_OF_TOML)?;
    let text = text.trim_start_matches('\u{feff}');
    let is_sac = text.lines().any(|line| keyword(line).is_some());
    let found = if is_sac {
        of_sac(text).map(|parts| parts.map(Response::PolesZeros))
    } else {
        of_table(text).map(|parts| parts.map(Response::Tabulated))
    };
    let response = found.map_err(|(line, reason)| {
        let place = line.map_or_else(String::new, |line| format!(" line {line}"));
        let sentence = format!("{}{place}: {reason}", path.display());
        SceneError::in_sentence(path, sentence)
    })?;
    response.map_err(|error| SceneError::from(error).in_file(path))
}

/// Largest number of poles or of zeros of a file.
const MOST_ROOTS: usize = 100;

/// Words that begin a part of a SAC file.
const ZEROS: &str = "ZEROS";
const POLES: &str = "POLES";
const CONSTANT: &str = "CONSTANT";

/// The keyword with which a line begins.
fn keyword(line: &str) -> Option<&'static str> {
    let first = line.split_whitespace().next()?;
    let known = [ZEROS, POLES, CONSTANT];
    known
        .into_iter()
        .find(|known| known.eq_ignore_ascii_case(first))
}

/// A finite number, with an exponent of Fortran or C.
fn sac_number(line: usize, name: &str, text: Option<&str>) -> Result<f64, Wrong> {
    let text = text.unwrap_or("");
    let value = text.replace(['d', 'D'], "e").parse().ok();
    let value = value.filter(|x: &f64| x.is_finite());
    value.ok_or_else(|| {
        (
            Some(line),
            format!("{name} = \"{text}\" is not a finite number"),
        )
    })
}

/// Poles and zeros of a SAC file; roots that are counted, but not listed, are at the origin.
fn of_sac(text: &str) -> Result<Result<PolesZeros, ResponseError>, Wrong> {
    let mut lists: [Option<(usize, Vec<Complex64>)>; 2] = [None, None];
    let (mut gain, mut open) = (None, None);
    let lines = (1..).zip(text.lines().map(str::trim));
    for (line, row) in lines.filter(|(_, row)| !row.is_empty() && !row.starts_with('*')) {
        let mut words = row.split_whitespace();
        let twice = |word: &str| {
            (
                Some(line),
                format!("{word} occurs a second time: keep the response of one channel"),
            )
        };
        match keyword(row) {
            Some(CONSTANT) => {
                words.next();
                let value = sac_number(line, CONSTANT, words.next())?;
                if gain.replace(value).is_some() {
                    return Err(twice(CONSTANT));
                }
                open = None;
            }
            Some(word) => {
                words.next();
                let count = words.next().unwrap_or("");
                let known = count.parse().ok().filter(|&n: &usize| n <= MOST_ROOTS);
                let known = known.ok_or_else(|| {
                    (
                        Some(line),
                        format!("{word} = \"{count}\" is not a whole number in [0, {MOST_ROOTS}]"),
                    )
                })?;
                let place = usize::from(word == ZEROS);
                if lists[place].replace((known, Vec::new())).is_some() {
                    return Err(twice(word));
                }
                open = Some(place);
            }
            None => {
                let Some((place, (count, roots))) =
                    open.and_then(|place: usize| Some((place, lists[place].as_mut()?)))
                else {
                    return Err((
                        Some(line),
                        format!("\"{row}\" belongs to neither {ZEROS} nor {POLES}"),
                    ));
                };
                let name = [POLES, ZEROS][place];
                if roots.len() == *count {
                    return Err((
                        Some(line),
                        format!("{name} {count} is followed by more than {count} rows"),
                    ));
                }
                let real = sac_number(line, name, words.next())?;
                roots.push(Complex64::new(real, sac_number(line, name, words.next())?));
            }
        }
        if let Some(extra) = words.next() {
            return Err((Some(line), format!("there is a further field, \"{extra}\"")));
        }
    }
    let [poles, zeros] = lists.map(|list| {
        let (count, mut roots) = list.unwrap_or_default();
        roots.resize(count, Complex64::default());
        roots
    });
    let Some(gain) = gain else {
        return Err((
            None,
            format!("{CONSTANT} is missing: add the line {CONSTANT} and the gain"),
        ));
    };
    Ok(PolesZeros::new(poles, zeros, gain))
}

/// What a column of a table has, with the factor of its unit.
#[derive(Debug, Clone, Copy)]
enum Column {
    FrequencyHz(f64),
    Amplitude,
    Decibels,
    PhaseRad(f64),
}

/// Places in a row of the columns of frequency, amplitude and phase.
type Places = [Option<(usize, Column)>; 3];

/// The header of a table.
const HEADER: &str = "frequency_hz,amplitude,phase_deg";

/// The column of a name such as `frequency_khz`, `f [kHz]` or `amplitude/dB`; none if it is of another quantity.
fn column(name: &str) -> Result<Option<Column>, String> {
    let name = name.to_lowercase();
    let (stem, unit) = match name.split_once(['[', '(']) {
        Some((stem, unit)) => (stem.trim(), unit.trim_end_matches([']', ')']).trim()),
        None => name.split_once(['/', '_']).unwrap_or((&name, "")),
    };
    let needs = |units: &str| {
        Err(format!(
            "the column \"{name}\" needs a unit, one of {units}: such as \"{HEADER}\""
        ))
    };
    match (stem.trim_end_matches('_'), unit) {
        ("f" | "freq" | "frequency", unit) => match unit {
            "hz" => Ok(Some(Column::FrequencyHz(1.0))),
            "khz" => Ok(Some(Column::FrequencyHz(1e3))),
            "mhz" => Ok(Some(Column::FrequencyHz(1e6))),
            _ => needs("Hz, kHz, MHz"),
        },
        ("amplitude" | "magnitude" | "gain", "db") => Ok(Some(Column::Decibels)),
        ("amplitude" | "magnitude" | "gain", _) => Ok(Some(Column::Amplitude)),
        ("phase", unit) => match unit {
            "deg" | "degree" | "degrees" | "\u{b0}" => Ok(Some(Column::PhaseRad(PI / 180.0))),
            "rad" => Ok(Some(Column::PhaseRad(1.0))),
            _ => needs("deg, rad"),
        },
        _ => Ok(None),
    }
}

/// The columns of frequency, amplitude and phase by their place in a header; none if the line is no header.
fn header(line: &str) -> Result<Option<Places>, String> {
    let mut found = [None; 3];
    for (place, name) in columns(line, separator(line)).into_iter().enumerate() {
        let Some(column) = column(name)? else {
            continue;
        };
        let kind = match column {
            Column::FrequencyHz(_) => 0,
            Column::Amplitude | Column::Decibels => 1,
            Column::PhaseRad(_) => 2,
        };
        if found[kind].replace((place, column)).is_some() {
            return Err(format!(
                "the column \"{name}\" has a quantity that another column has: keep one of them"
            ));
        }
    }
    Ok((found[0].is_some() && found[1].is_some()).then_some(found))
}

/// The table of a text.
fn of_table(text: &str) -> Result<Result<Tabulated, ResponseError>, Wrong> {
    let lines = (1..).zip(text.lines().map(str::trim));
    let mut lines = lines.filter(|(_, row)| !row.is_empty() && !row.starts_with('#'));
    let (by, places) = loop {
        let Some((line, row)) = lines.next() else {
            return Err((
                None,
                format!(
                    "no header with frequency and amplitude: a table begins with \"{HEADER}\" or without the phase"
                ),
            ));
        };
        if let Some(found) = header(row).map_err(|reason| (Some(line), reason))? {
            break (separator(row), found);
        }
    };
    let mut lists: [Vec<f64>; 3] = Default::default();
    for (line, row) in lines {
        let fields = columns(row, by);
        for ((place, column), list) in places
            .into_iter()
            .zip(&mut lists)
            .filter_map(|(p, l)| Some((p?, l)))
        {
            let field = *fields.get(place).unwrap_or(&"");
            let (name, least) = match column {
                Column::FrequencyHz(_) => ("frequency", 0.0),
                Column::Amplitude => ("amplitude", 0.0),
                Column::Decibels => ("amplitude", f64::NEG_INFINITY),
                Column::PhaseRad(_) => ("phase", f64::NEG_INFINITY),
            };
            let wrong = |reason: &str| (Some(line), format!("{name} = \"{field}\" {reason}"));
            let value = number(field, by).ok_or_else(|| wrong("is not a finite number"))?;
            if value < least {
                return Err(wrong("is outside [0, inf)"));
            }
            let value = match column {
                Column::FrequencyHz(factor) | Column::PhaseRad(factor) => factor * value,
                Column::Amplitude => value,
                Column::Decibels => 10_f64.powf(value / 20.0),
            };
            let ascends = list.last().is_none_or(|&before| value > before);
            if matches!(column, Column::FrequencyHz(_)) && !ascends {
                return Err(wrong(
                    "does not follow the one before: frequencies must ascend",
                ));
            }
            if list.len() == MOST_ROWS {
                return Err((
                    Some(line),
                    format!("there are more than {MOST_ROWS} rows: thin them out"),
                ));
            }
            list.push(value);
        }
    }
    let [frequencies_hz, amplitudes, phases_rad] = lists;
    let phases_rad = places[2].map(|_| phases_rad);
    Ok(Tabulated::new(frequencies_hz, amplitudes, phases_rad))
}
