//! Force records: text with columns of time and force, or HDF5 with `/time` and `/force`, such as a results file.

use super::keys::FINITE;
use super::section::{MOST_OF_RECORD, read_text_up_to};
use crate::error::SceneError;
use crate::schema::results::{FILE_TYPE, SEALED_FROM};
use impact::{ASCENDING, ForceRecord, Reading, RecordError, TreatmentError, follows};
use ledger::{Group, HdfError, HdfFile};
use output::HDF5;
use std::io::ErrorKind;
use std::path::Path;

/// Largest number of samples: several copies are held in memory.
const MOST_RECORD_SAMPLES: usize = 1 << 24;

/// Largest number of samples in a scene. Results files contain their scene, so all readers of results parse the
/// samples; this number needs 5.7 MB of the 8 MB limit for texts (test: tests/python/package/test_numbers.py reads them
/// back).
const MOST_IN_SCENE: usize = 1 << 17;

/// Times in s and forces in N.
type Rows = (Vec<f64>, Vec<f64>);

/// Reads a record; the file extension decides between text and HDF5.
///
/// # Errors
/// [`SceneError`] with the file and the line.
pub fn read_record(path: &Path, reading: Reading) -> Result<ForceRecord, SceneError> {
    let unreadable = |reason: String| SceneError::unreadable(path, reason);
    let (rows, name) = if HDF5.is_of(path) {
        let of_text = [
            reading.columns.is_some() || reading.units.is_some(),
            reading.sensitivity_v_per_n.is_some(),
        ];
        if of_text.contains(&true) {
            let reason = "force.columns, force.units and force.sensitivity_v_per_n apply to text, but this is an HDF5 file";
            return Err(unreadable(reason.to_owned()));
        }
        (from_hdf5(path).map_err(unreadable)?, "/time")
    } else {
        let text = read_text_up_to(path, MOST_OF_RECORD)?;
        let rows = from_text(&text, &reading);
        let rows = rows.map_err(|(line, reason)| {
            let sentence = format!("{} line {line}: {reason}", path.display());
            SceneError::in_sentence(path, sentence)
        })?;
        (rows, "time_s")
    };
    let mut record = record_of(rows, reading, name, unreadable)?;
    record.file = Some(path.to_owned());
    Ok(record)
}

/// The record whose samples are in the scene.
pub(super) fn record_of_samples(
    [time_s, force_n]: [Vec<f64>; 2],
    mut reading: Reading,
) -> Result<ForceRecord, SceneError> {
    let name = "force.time_s";
    let wrong = |sentence: String| SceneError::of(sentence, name);
    let (times, forces) = (time_s.len(), force_n.len());
    if times != forces || times < 2 {
        return Err(wrong(format!(
            "force.time_s has {times} samples and force.force_n {forces}: both need the same number, at least 2"
        )));
    }
    if times > MOST_IN_SCENE {
        return Err(wrong(format!(
            "force.time_s has {times} samples, more than the {MOST_IN_SCENE} allowed in a scene: write them to a file with the columns time_s,force_n and set force.file to its name"
        )));
    }
    let pairs = [(name, &time_s), ("force.force_n", &force_n)];
    for (key, numbers) in pairs {
        let odd = (1..).zip(numbers).find(|(_, number)| !number.is_finite());
        if let Some((place, &number)) = odd {
            let key = format!("{key}[{place}]");
            return Err(SceneError::out_of_range(key, number, FINITE.name));
        }
    }
    if let Some(place) = (1..times).find(|&n| !follows(&time_s[..n], time_s[n])) {
        return Err(wrong(not_ascending(name, time_s[place], time_s[place - 1])));
    }
    reading.samples = Some([time_s.clone(), force_n.clone()]);
    record_of((time_s, force_n), reading, name, wrong)
}

/// Cuts the samples, applies the sign and stores how they were read; `wrong` makes an error of a sentence.
fn record_of(
    rows: Rows,
    reading: Reading,
    name: &str,
    wrong: impl Fn(String) -> SceneError,
) -> Result<ForceRecord, SceneError> {
    let (time_s, mut force_n) = cut(rows, &reading)?;
    if reading.sign == Some(-1.0) {
        force_n.iter_mut().for_each(|force_n| *force_n = -*force_n);
    }
    let mut record = ForceRecord::new(time_s, force_n).map_err(|error| {
        wrong(match error {
            RecordError::Count { times, .. } => too_few(times),
            RecordError::Negative { time_s } => before_zero(name, time_s),
            RecordError::NotAscending {
                time_s, before_s, ..
            } => not_ascending(name, time_s, before_s),
            other => other.to_string(),
        })
    })?;
    let onset_s = reading.onset_s;
    let zero_s = reading.start_s.unwrap_or(0.0);
    record.reading = Box::new(reading);
    match onset_s {
        Some(onset_s) => Ok(record.with_onset(onset_s - zero_s)?),
        None => Ok(record),
    }
}

/// Message about times before zero.
fn before_zero(name: &str, time_s: f64) -> String {
    format!(
        "{name} = {time_s} is outside [0, inf): set force.start_s to the time of the new zero; earlier samples are cut off"
    )
}

fn not_ascending(name: &str, time_s: f64, before_s: f64) -> String {
    format!("{name} = {time_s} does not follow {before_s}: {ASCENDING}")
}

fn too_few(rows: usize) -> String {
    format!("{rows} rows of samples, but at least 2 are required")
}

/// The requested part of a record, shifted to start at time zero; the cuts interpolate between samples.
fn cut((time_s, force_n): Rows, reading: &Reading) -> Result<Rows, SceneError> {
    let (Some(&first_s), Some(&last_s)) = (time_s.first(), time_s.last()) else {
        return Ok((time_s, force_n));
    };
    let zero_s = reading.start_s.unwrap_or(0.0);
    let from_s = reading.start_s.unwrap_or(first_s);
    let to_s = reading.end_s.unwrap_or(last_s);
    let within = |key, value: f64, limits: [f64; 2], brackets| {
        let fits = value >= limits[0] && value <= limits[1];
        let reason = "the times of the record";
        let error = || TreatmentError::new(key, value, limits, brackets, reason);
        fits.then_some(()).ok_or_else(error)
    };
    within("start_s", from_s, [f64::NEG_INFINITY, last_s], ['(', ']'])?;
    within(
        "end_s",
        to_s,
        [from_s.max(first_s), f64::INFINITY],
        ['[', ')'],
    )?;
    let at = |i: usize, t: f64| {
        let part = (t - time_s[i - 1]) / (time_s[i] - time_s[i - 1]);
        force_n[i - 1] + part * (force_n[i] - force_n[i - 1])
    };
    let (begin, end) = (
        time_s.partition_point(|&t| t < from_s),
        time_s.partition_point(|&t| t <= to_s),
    );
    let before = (begin > 0 && time_s[begin] > from_s).then(|| (from_s, at(begin, from_s)));
    let after = (end < time_s.len() && time_s[end - 1] < to_s).then(|| (to_s, at(end, to_s)));
    let inside = (begin..end).map(|i| (time_s[i], force_n[i]));
    let kept = before.into_iter().chain(inside).chain(after);
    Ok(kept.map(|(t, force)| (t - zero_s, force)).unzip())
}

/// Column names of a record that needs no further keys.
const PLAIN_COLUMNS: [&str; 2] = ["time_s", "force_n"];

/// Units of time and force in s and N. The last of each list is another character for the same letter mu.
pub(crate) const TIMES: [(&str, f64); 6] = [
    ("s", 1.0),
    ("ms", 1e-3),
    ("us", 1e-6),
    ("ns", 1e-9),
    ("\u{b5}s", 1e-6),
    ("\u{3bc}s", 1e-6),
];
const FORCES: [(&str, f64); 8] = [
    ("N", 1.0),
    ("mN", 1e-3),
    ("kN", 1e3),
    ("MN", 1e6),
    ("uN", 1e-6),
    ("\u{b5}N", 1e-6),
    ("lbf", 4.448_221_615_260_5),
    ("\u{3bc}N", 1e-6),
];
/// Units in V of a sensor signal, which the sensitivity converts to force.
const SIGNALS: [(&str, f64); 2] = [("V", 1.0), ("mV", 1e-3)];

/// A way out of a missing unit.
const UNITS: &str = "set force.units, such as [\"us\", \"kN\"]";

/// The separator of columns in a line; none for blanks.
pub(crate) fn separator(line: &str) -> Option<char> {
    ['\t', ';', ','].into_iter().find(|&c| line.contains(c))
}

/// The columns of a line, without surrounding blanks and quotes.
pub(crate) fn columns(line: &str, by: Option<char>) -> Vec<&str> {
    let bare = |part| str::trim(part).trim_matches('"').trim();
    match by {
        Some(by) => line.split(by).map(bare).collect(),
        None => line.split_whitespace().map(bare).collect(),
    }
}

/// A finite number; accepts a decimal comma if commas do not separate columns.
pub(crate) fn number(text: &str, by: Option<char>) -> Option<f64> {
    let number = match by {
        Some(',') => text.parse(),
        _ => text.replace(',', ".").parse(),
    };
    number.ok().filter(|x: &f64| x.is_finite())
}

/// The number in a column of a line, if it has one.
fn number_at(fields: &[&str], place: usize, by: Option<char>) -> Option<f64> {
    number(fields.get(place)?, by)
}

/// The unit of a column: given, or the last part of its name, as in `Time [us]` or `F/kN`; empty if there is none.
pub(crate) fn unit<'a>(name: &'a str, given: Option<&'a String>, own: &'static str) -> &'a str {
    let named = || {
        let (_, end) = name.rsplit_once(['[', '(', '/'])?;
        Some(end.trim_end_matches([']', ')']).trim())
    };
    match given {
        Some(unit) => unit,
        None if PLAIN_COLUMNS.contains(&name) => own,
        None => named().unwrap_or(""),
    }
}

/// The factor of the unit of a column.
pub(crate) fn factor(
    name: &str,
    unit: &str,
    known: &[(&str, f64)],
    more: &str,
    remedy: &str,
) -> Result<f64, String> {
    let factor = known.iter().find(|(name, _)| *name == unit);
    factor.map(|(_, factor)| *factor).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        let has = match unit {
            "" => "has no unit".to_owned(),
            unit => format!("has the unit \"{unit}\""),
        };
        format!(
            "the column \"{name}\" {has}, but one of {}{more} is required: {remedy}",
            // the last is another character for mu
            names[..names.len() - 1].join(", ")
        )
    })
}

/// The factor of a column of forces, or of the signal of a sensor.
fn force_factor(name: &str, unit: &str, sensitivity: Option<f64>) -> Result<f64, String> {
    let signal = SIGNALS.iter().find(|(name, _)| *name == unit);
    match (signal, sensitivity) {
        (Some((_, volts)), Some(v_per_n)) => Ok(volts / v_per_n),
        (Some(_), None) => Err(format!(
            "the column \"{name}\" has the unit \"{unit}\": set force.sensitivity_v_per_n, the output of the sensor in V/N"
        )),
        (None, Some(_)) => Err(format!(
            "the column \"{name}\" has the unit \"{unit}\", but force.sensitivity_v_per_n applies to a signal: set force.units, such as [\"s\", \"V\"], or remove the sensitivity"
        )),
        (None, None) => factor(
            name,
            unit,
            &FORCES,
            ", or V, mV with force.sensitivity_v_per_n",
            UNITS,
        ),
    }
}

/// Positions of the columns of time and force in a line that has both.
fn places(line: &str, wanted: &[String; 2]) -> Option<[usize; 2]> {
    let names = columns(line, separator(line));
    let place = |name: &String| {
        let found = names.iter().position(|column| column == name);
        let counted = || name.parse::<usize>().ok()?.checked_sub(1);
        found.or_else(counted).filter(|&place| place < names.len())
    };
    Some([place(&wanted[0])?, place(&wanted[1])?])
}

/// Rows of a text, or the number of the line at fault, from 1, with the reason.
fn from_text(text: &str, reading: &Reading) -> Result<Rows, (usize, String)> {
    let lines = || {
        let lines = text.trim_start_matches('\u{feff}').lines();
        let lines = lines.enumerate().map(|(i, line)| (i + 1, line.trim()));
        lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
    };
    let wanted = (reading.columns.clone()).unwrap_or(PLAIN_COLUMNS.map(str::to_owned));
    if lines().next().is_none() {
        let header = wanted.join(",");
        return Err((1, format!("the file is empty; its header is \"{header}\"")));
    }
    // instruments write lines of their own above the header
    let is_named = reading.columns.is_some();
    let header = lines().find_map(|(line, text)| Some((line, text, places(text, &wanted)?)));
    let Some((line, header, [time, force])) = header else {
        return Err(no_header(lines(), &wanted));
    };
    let by = separator(header);
    let names = columns(header, by);
    let count = names.len();
    let is_number = |fields: &[&str], place| number_at(fields, place, by).is_some();
    let has_header = !(is_number(&names, time) && is_number(&names, force));
    let names = [time, force].map(|place| names[place]);
    let names: [&str; 2] = std::array::from_fn(|i| if has_header { names[i] } else { &wanted[i] });
    let given = |i: usize| reading.units.as_ref().map(|units| &units[i]);
    let [of_time, of_force] = [("s", 0), ("N", 1)].map(|(own, i)| unit(names[i], given(i), own));
    let at_header = |reason: String| (line, reason);
    let factors = [
        factor(names[0], of_time, &TIMES, "", UNITS).map_err(at_header)?,
        force_factor(names[1], of_force, reading.sensitivity_v_per_n).map_err(at_header)?,
    ];
    let (mut time_s, mut force_n): Rows = Default::default();
    // some files have a line of units below it
    let is_row = |row: &str| {
        let fields = columns(row, by);
        is_number(&fields, time) || is_number(&fields, force)
    };
    let words = |&(at, row): &(usize, &str)| {
        at < line || at == line && has_header || is_named && !is_row(row)
    };
    for (line, row) in lines().skip_while(words) {
        let fields = columns(row, by);
        let value = |i: usize, place: usize| {
            let number = number_at(&fields, place, by).map(|x| factors[i] * x);
            number.ok_or_else(|| {
                let (name, field) = (&wanted[i], fields.get(place).unwrap_or(&""));
                (line, format!("{name} = \"{field}\" is not a finite number"))
            })
        };
        let (t, p) = (value(0, time)?, value(1, force)?);
        if let Some(extra) = fields.get(count) {
            let what = if count == 2 { "third" } else { "further" };
            return Err((line, format!("there is a {what} field, \"{extra}\"")));
        }
        if t < 0.0 && time_s.is_empty() && reading.start_s.is_none() {
            return Err((line, before_zero(&wanted[0], t)));
        }
        if let Some(&before) = time_s.last().filter(|_| !follows(&time_s, t)) {
            return Err((line, not_ascending(&wanted[0], t, before)));
        }
        if time_s.len() == MOST_RECORD_SAMPLES {
            let reason = format!(
                "there are more than {MOST_RECORD_SAMPLES} rows: cut or decimate the record"
            );
            return Err((line, reason));
        }
        time_s.push(t);
        force_n.push(p);
    }
    if time_s.len() < 2 {
        return Err((text.lines().count().max(1), too_few(time_s.len())));
    }
    Ok((time_s, force_n))
}

/// Message about a missing header: the probable header, directly above the first row of numbers, and a way out.
///
/// The content of a file without such a row is not shown: it may be any file of the user.
fn no_header<'a>(
    lines: impl Iterator<Item = (usize, &'a str)>,
    wanted: &[String; 2],
) -> (usize, String) {
    let fields = |text: &'a str| columns(text, separator(text));
    let is_row = |text: &'a str| {
        let numbers = fields(text)
            .into_iter()
            .filter_map(|field| number(field, separator(text)));
        numbers.count() >= 2
    };
    let (mut above, mut row) = (None, None);
    for (line, text) in lines {
        if is_row(text) {
            row = Some((line, text));
            break;
        }
        above = Some((line, text));
    }
    let names = wanted.join(",");
    let Some(row) = row else {
        let reason =
            format!("no header \"{names}\", and no row with two numbers: is this a force record?");
        return (1, reason);
    };
    let count = fields(row.1).len();
    if let Some(far) = wanted
        .iter()
        .find(|name| name.parse().is_ok_and(|n: usize| n > count))
    {
        let reason = format!("force.columns has {far}, but the rows have {count} columns");
        return (row.0, reason);
    }
    let Some((line, header)) = above else {
        let reason = format!(
            "the first line is a row of numbers, not the header \"{names}\": set the columns of time and force by number, force.columns = [1, 2] with force.units = [\"s\", \"N\"]"
        );
        return (row.0, reason);
    };
    let way = match fields(header).as_slice() {
        [first, second, ..] => format!("such as force.columns = [\"{first}\", \"{second}\"]"),
        _ => "in force.columns, by name or number".to_owned(),
    };
    let reason = format!(
        "the header is \"{header}\", not \"{names}\": name the columns of time and force, {way}"
    );
    (line, reason)
}

/// Reads the datasets `/time` (s) and `/force` (N) with a reader for untrusted files instead of the HDF5 library.
fn from_hdf5(path: &Path) -> Result<Rows, String> {
    let file = HdfFile::open(path).map_err(|error| match &error {
        HdfError::Io(source) if source.kind() == ErrorKind::NotFound => {
            "the file does not exist".to_owned()
        }
        other => other.to_string(),
    })?;
    if is_unsealed(&file) {
        return Err("it is a results file without its checksum trailer: it was truncated, or changed after it was written".to_owned());
    }
    let (time_s, force_n) = (samples(&file.root, "time")?, samples(&file.root, "force")?);
    let (times, forces) = (time_s.len(), force_n.len());
    if times != forces || times < 2 {
        return Err(format!(
            "/time has {times} samples and /force {forces}; both need the same number, at least 2"
        ));
    }
    if let Some(i) = (1..times).find(|&i| !follows(&time_s[..i], time_s[i])) {
        return Err(not_ascending("/time", time_s[i], time_s[i - 1]));
    }
    Ok((time_s, force_n))
}

/// Whether a file is a results file of the program that has lost its checksum trailer.
fn is_unsealed(file: &HdfFile) -> bool {
    let minor = || {
        let version = file.root.text("format_version").ok()?;
        version.split('.').nth(1)?.parse::<u32>().ok()
    };
    let is_own = file
        .root
        .text("file_type")
        .is_ok_and(|own| own == FILE_TYPE);
    is_own && !file.is_sealed() && minor().is_none_or(|minor| minor >= SEALED_FROM)
}

/// The numbers of a dataset with one dimension.
fn samples(root: &Group, name: &str) -> Result<Vec<f64>, String> {
    let failed = |error: HdfError| match error {
        HdfError::Absent(_) => format!("it has no numeric dataset /{name}"),
        other => format!("/{name}: {other}"),
    };
    let data = root.dataset(name).map_err(failed)?;
    let (dimensions, count) = (data.shape().len(), data.count());
    if dimensions != 1 {
        return Err(format!(
            "/{name} has {dimensions} dimensions, but 1 is required"
        ));
    }
    if count > MOST_RECORD_SAMPLES {
        return Err(format!(
            "/{name} has {count} samples, more than {MOST_RECORD_SAMPLES}: cut or decimate the record"
        ));
    }
    data.as_f64(8 * MOST_RECORD_SAMPLES as u64).map_err(failed)
}
