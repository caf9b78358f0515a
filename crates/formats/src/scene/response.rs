//! Responses of sensors in text: poles and zeros as SAC writes them, or a table over frequency.

use super::record::{columns, number, separator};
use super::section::{MOST_OF_TOML, read_text_up_to};
use crate::error::SceneError;
use impact::response::{PolesZeros, Response, Tabulated};
use num_complex::Complex64;
use std::path::Path;

/// Reads a response; a file with a line that begins with `ZEROS`, `POLES` or `CONSTANT` has poles and zeros, any other one a
/// table.
///
/// The poles and zeros of SAC files are in rad/s and refer to displacement in m; one zero at the origin less makes them
/// refer to velocity, two to acceleration.
/// A table has a header with frequency, amplitude and perhaps phase, each with its unit, as in
/// `frequency_hz,amplitude_db,phase_deg` or `f [kHz];amplitude;phase [rad]`. Other columns are skipped.
///
/// # Errors
/// [`SceneError`] with the file and the value, and with the line of a text that is no number.
pub fn read_response(path: &Path) -> Result<Response, SceneError> {
    let text = read_text_up_to(path, MOST_OF_TOML)?;
    let text = text.trim_start_matches('\u{feff}');
    let wrong = |reason| SceneError::in_sentence(path, format!("{}{reason}", path.display()));
    let found = if text.lines().any(|line| keyword(line).is_some()) {
        let (poles, zeros, gain) = of_sac(text).map_err(wrong)?;
        PolesZeros::new(poles, zeros, gain).map(Response::PolesZeros)
    } else {
        let [frequencies_hz, amplitudes, phases_rad] = of_table(text).map_err(wrong)?;
        let phases_rad = (!phases_rad.is_empty()).then_some(phases_rad);
        Tabulated::new(frequencies_hz, amplitudes, phases_rad).map(Response::Tabulated)
    };
    found.map_err(|error| SceneError::from(error).in_file(path))
}

/// The rows of a text with their numbers from 1, without comments and empty ones.
fn rows(text: &str, comment: char) -> impl Iterator<Item = (usize, &str)> {
    let lines = (1..).zip(text.lines().map(str::trim));
    lines.filter(move |(_, row)| !row.is_empty() && !row.starts_with(comment))
}

/// The reason why a line is wrong, to follow the name of the file.
fn in_line(line: usize) -> impl Fn(String) -> String {
    move |reason| format!(" line {line}: {reason}")
}

/// Largest number of poles or of zeros of a file.
const MOST_ROOTS: f64 = 100.0;

/// Words that begin a part of a SAC file.
const KEYWORDS: [&str; 3] = ["POLES", "ZEROS", "CONSTANT"];

/// The place among the keywords of the one with which a line begins.
fn keyword(line: &str) -> Option<usize> {
    let first = line.split_whitespace().next()?;
    KEYWORDS
        .iter()
        .position(|known| known.eq_ignore_ascii_case(first))
}

/// The number after each keyword and the roots that follow it, and the part that is being read.
#[derive(Default)]
struct Sac {
    parts: [Option<(f64, Vec<Complex64>)>; 3],
    open: Option<usize>,
}

impl Sac {
    fn read(&mut self, row: &str) -> Result<(), String> {
        let mut words = row.split_whitespace();
        if let Some(place) = keyword(row) {
            let name = KEYWORDS[place];
            let value = sac_number(name, words.nth(1))?;
            let is_count = (0.0..=MOST_ROOTS).contains(&value) && value.fract() == 0.0;
            if name != "CONSTANT" && !is_count {
                return Err(format!(
                    "{name} = {value} is not a whole number in [0, {MOST_ROOTS}]"
                ));
            }
            if self.parts[place].replace((value, Vec::new())).is_some() {
                return Err(format!(
                    "{name} occurs a second time: keep the response of one channel"
                ));
            }
            self.open = (name != "CONSTANT").then_some(place);
        } else {
            let open = self
                .open
                .and_then(|place| Some((KEYWORDS[place], self.parts[place].as_mut()?)));
            let (name, (count, roots)) =
                open.ok_or_else(|| format!("\"{row}\" belongs to neither ZEROS nor POLES"))?;
            if roots.len() as f64 == *count {
                return Err(format!(
                    "{name} {count} is followed by more than {count} rows"
                ));
            }
            let real = sac_number(name, words.next())?;
            roots.push(Complex64::new(real, sac_number(name, words.next())?));
        }
        words.next().map_or(Ok(()), |extra| {
            Err(format!("there is a further field, \"{extra}\""))
        })
    }
}

/// A finite number, with an exponent of Fortran or C.
fn sac_number(name: &str, text: Option<&str>) -> Result<f64, String> {
    let text = text.unwrap_or("");
    let value = number(&text.replace(['d', 'D'], "e"), Some(','));
    value.ok_or_else(|| format!("{name} = \"{text}\" is not a finite number"))
}

/// Poles, zeros and gain of a SAC file; roots that are counted, but not listed, are at the origin.
fn of_sac(text: &str) -> Result<(Vec<Complex64>, Vec<Complex64>, f64), String> {
    let mut found = Sac::default();
    for (line, row) in rows(text, '*') {
        found.read(row).map_err(in_line(line))?;
    }
    let [poles, zeros, gain] = found.parts;
    let (gain, _) = gain.ok_or(": CONSTANT is missing: add the line CONSTANT and the gain")?;
    let [poles, zeros] = [poles, zeros].map(|part| {
        let (count, mut roots) = part.unwrap_or_default();
        roots.resize(count as usize, Complex64::default());
        roots
    });
    Ok((poles, zeros, gain))
}

/// The quantities of a table.
const QUANTITIES: [&str; 3] = ["frequency", "amplitude", "phase"];

/// The conversion of a value into Hz, a factor or rad.
type Convert = fn(f64) -> f64;

/// Places of the columns of frequency, amplitude and phase.
type Places = [Option<(usize, Convert)>; 3];

/// The header of a table.
const HEADER: &str = "frequency_hz,amplitude,phase_deg";

/// The quantity of a column with a name such as `frequency_khz`, `f [kHz]` or `amplitude/dB`; none if it is another one.
fn column(name: &str) -> Result<Option<(usize, Convert)>, String> {
    let name = name.to_lowercase();
    let (stem, unit) = match name.split_once(['[', '(']) {
        Some((stem, unit)) => (stem.trim(), unit.trim_end_matches([']', ')']).trim()),
        None => name.split_once(['/', '_']).unwrap_or((&name, "")),
    };
    let quantity = match stem.trim_end_matches('_') {
        "f" | "freq" | "frequency" => 0,
        "amplitude" | "magnitude" | "gain" => 1,
        "phase" => 2,
        _ => return Ok(None),
    };
    let convert: Convert = match (quantity, unit) {
        (0, "khz") => |f| 1e3 * f,
        (0, "mhz") => |f| 1e6 * f,
        (1, "db") => |decibels| 10_f64.powf(decibels / 20.0),
        (2, "deg" | "degree" | "degrees" | "\u{b0}") => f64::to_radians,
        (0, "hz") | (1, _) | (2, "rad") => |value| value,
        _ => {
            let units = ["Hz, kHz, MHz", "dB", "deg, rad"][quantity];
            return Err(format!(
                "the column \"{name}\" needs a unit, one of {units}: such as \"{HEADER}\""
            ));
        }
    };
    Ok(Some((quantity, convert)))
}

/// The columns of a header; none if the line has no frequency or no amplitude.
fn header(line: &str) -> Result<Option<Places>, String> {
    let mut found = Places::default();
    for (place, name) in columns(line, separator(line)).into_iter().enumerate() {
        let Some((quantity, convert)) = column(name)? else {
            continue;
        };
        if found[quantity].replace((place, convert)).is_some() {
            let quantity = QUANTITIES[quantity];
            return Err(format!(
                "\"{name}\" is a second {quantity}: keep one of them"
            ));
        }
    }
    Ok((found[0].is_some() && found[1].is_some()).then_some(found))
}

/// The frequencies, amplitudes and phases of a text; no phases without their column.
fn of_table(text: &str) -> Result<[Vec<f64>; 3], String> {
    let mut lines = rows(text, '#');
    let (by, places) = loop {
        let (line, row) = lines.next().ok_or_else(|| format!(": no header with frequency and amplitude: a table begins with \"{HEADER}\" or without the phase"))?;
        if let Some(found) = header(row).map_err(in_line(line))? {
            break (separator(row), found);
        }
    };
    let mut lists: [Vec<f64>; 3] = Default::default();
    for (line, row) in lines {
        let fields = columns(row, by);
        for (quantity, list) in lists.iter_mut().enumerate() {
            let Some((place, convert)) = places[quantity] else {
                continue;
            };
            let (name, field) = (QUANTITIES[quantity], fields.get(place).unwrap_or(&""));
            let value = number(field, by);
            let value = value.ok_or_else(|| format!("{name} = \"{field}\" is not a finite number"));
            list.push(convert(value.map_err(in_line(line))?));
        }
    }
    Ok(lists)
}
