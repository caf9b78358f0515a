//! Force records: text with columns of time and force, or HDF5 with `/time` and `/force`, which a results file has.

use super::section::{MOST_OF_RECORD, read_text_up_to};
use crate::error::SceneError;
use impact::{ForceRecord, Reading, RecordError, TreatmentError};
use ledger::{Group, HdfError, HdfFile};
use output::HDF5;
use std::io::ErrorKind;
use std::path::Path;

/// Samples at most: they are held in memory several times.
const MOST_SAMPLES: usize = 1 << 24;

/// Times in s and forces in N.
type Rows = (Vec<f64>, Vec<f64>);

/// Reads a record; the ending of its name says which of both it is.
///
/// # Errors
/// [`SceneError`] with the file, and the line at fault.
pub fn read_record(path: &Path, reading: Reading) -> Result<ForceRecord, SceneError> {
    let unreadable = |reason: String| SceneError::unreadable(path, reason);
    let (rows, name) = if HDF5.is_of(path) {
        if reading.columns.is_some() || reading.units.is_some() {
            let reason = "force.columns and force.units are for text, and it is an HDF5 file";
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
    let (time_s, mut force_n) = cut(rows, &reading)?;
    if reading.sign == Some(-1.0) {
        force_n.iter_mut().for_each(|force_n| *force_n = -*force_n);
    }
    let mut record = ForceRecord::new(time_s, force_n).map_err(|error| {
        unreadable(match error {
            RecordError::Count { times, .. } => too_few(times),
            RecordError::Negative { time_s } => before_zero(name, time_s),
            RecordError::NotAscending {
                time_s, before_s, ..
            } => not_ascending(name, time_s, before_s),
            other => other.to_string(),
        })
    })?;
    record.file = Some(path.to_owned());
    record.reading = Box::new(reading);
    Ok(record)
}

/// What is said of times before zero, with what to do.
fn before_zero(name: &str, time_s: f64) -> String {
    format!(
        "{name} = {time_s} is outside [0, inf): give force.start_s, the time that is to be zero; what was before is cut off"
    )
}

fn not_ascending(name: &str, time_s: f64, before_s: f64) -> String {
    format!("{name} = {time_s} does not follow {before_s}; times must ascend")
}

fn too_few(rows: usize) -> String {
    format!("{rows} rows of samples, at least 2 are needed")
}

/// What is asked for of a record, from the time zero on: lines between the samples end at the cuts.
fn cut((time_s, force_n): Rows, reading: &Reading) -> Result<Rows, SceneError> {
    let (Some(&first_s), Some(&last_s)) = (time_s.first(), time_s.last()) else {
        return Ok((time_s, force_n));
    };
    let zero_s = reading.start_s.unwrap_or(0.0);
    let from_s = reading.start_s.unwrap_or(first_s);
    let to_s = reading.end_s.unwrap_or(last_s);
    let within = |key, value, least: f64, most: f64| {
        let fits = value >= least && value <= most;
        fits.then_some(()).ok_or(TreatmentError {
            key,
            value,
            limits: [least, most],
            reason: "the times of the record",
        })
    };
    within("start_s", from_s, f64::NEG_INFINITY, last_s)?;
    within("end_s", to_s, from_s.max(first_s), f64::INFINITY)?;
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

/// The columns of a record that is one as it stands.
const COLUMNS: [&str; 2] = ["time_s", "force_n"];

/// Units of time and force in s and N; the last of each are three ways to write the same letter.
const TIMES: [(&str, f64); 6] = [
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

/// What divides the columns of a line; blanks where nothing else does.
fn separator(line: &str) -> Option<char> {
    ['\t', ';', ','].into_iter().find(|&c| line.contains(c))
}

/// The columns of a line, without blanks and quotes around them.
fn columns(line: &str, by: Option<char>) -> Vec<&str> {
    let bare = |part| str::trim(part).trim_matches('"').trim();
    match by {
        Some(by) => line.split(by).map(bare).collect(),
        None => line.split_whitespace().map(bare).collect(),
    }
}

/// A finite number; with a decimal comma where commas do not divide columns.
fn number(text: &str, by: Option<char>) -> Option<f64> {
    let number = match by {
        Some(',') => text.parse(),
        _ => text.replace(',', ".").parse(),
    };
    number.ok().filter(|x: &f64| x.is_finite())
}

/// The number in a column of a line that has one.
fn number_at(fields: &[&str], place: usize, by: Option<char>) -> Option<f64> {
    number(fields.get(place)?, by)
}

/// The factor of the unit of a column: that given, or the one that its name ends with, such as `Time [us]` or `F/kN`.
fn factor(name: &str, given: Option<&String>, known: &[(&str, f64)]) -> Result<f64, String> {
    let own = || {
        let (_, end) = name.rsplit_once(['[', '(', '/'])?;
        Some(end.trim_end_matches([']', ')']).trim())
    };
    let unit = match (given, COLUMNS.contains(&name)) {
        (Some(unit), _) => unit.as_str(),
        (None, true) => return Ok(1.0),
        (None, false) => own().unwrap_or(""),
    };
    let factor = known.iter().find(|(name, _)| *name == unit);
    factor.map(|(_, factor)| *factor).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        let has = match unit {
            "" => "names no unit".to_owned(),
            unit => format!("has the unit \"{unit}\""),
        };
        format!(
            "the column \"{name}\" {has}, needed one of {}: give force.units, such as [\"us\", \"kN\"]",
            // the last is another letter mu
            names[..names.len() - 1].join(", ")
        )
    })
}

/// Where the columns of time and force are in a line that has them all.
fn places(line: &str, wanted: &[String; 2]) -> Option<[usize; 2]> {
    let names = columns(line, separator(line));
    let place = |name: &String| {
        let found = names.iter().position(|column| column == name);
        let counted = || name.parse::<usize>().ok()?.checked_sub(1);
        found.or_else(counted).filter(|&place| place < names.len())
    };
    Some([place(&wanted[0])?, place(&wanted[1])?])
}

/// Rows of a text, or the line at fault, from 1, with what is wrong.
fn from_text(text: &str, reading: &Reading) -> Result<Rows, (usize, String)> {
    let lines = || {
        let lines = text.trim_start_matches('\u{feff}').lines();
        let lines = lines.enumerate().map(|(i, line)| (i + 1, line.trim()));
        lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
    };
    let wanted = (reading.columns.clone()).unwrap_or(COLUMNS.map(str::to_owned));
    if lines().next().is_none() {
        let header = wanted.join(",");
        return Err((1, format!("the file is empty; its header is \"{header}\"")));
    }
    // instruments write lines of their own above the header
    let is_named = reading.columns.is_some();
    let mut above = lines().take(if is_named { usize::MAX } else { 1 });
    let header = above.find_map(|(line, text)| Some((line, text, places(text, &wanted)?)));
    let Some((line, header, [time, force])) = header else {
        return Err(no_header(lines(), &wanted));
    };
    let by = separator(header);
    let names = columns(header, by);
    let is_number = |fields: &[&str], place| number_at(fields, place, by).is_some();
    let has_header = !(is_number(&names, time) && is_number(&names, force));
    let factor_of = |i: usize, place: usize, known: &[(&str, f64)]| {
        let name = if has_header { names[place] } else { &wanted[i] };
        let given = reading.units.as_ref().map(|units| &units[i]);
        factor(name, given, known).map_err(|reason| (line, reason))
    };
    let factors = [factor_of(0, time, &TIMES)?, factor_of(1, force, &FORCES)?];
    let (mut time_s, mut force_n): Rows = Default::default();
    // some have a line of units below it
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
        if let Some(extra) = fields.get(names.len()) {
            let what = if names.len() == 2 { "third" } else { "further" };
            return Err((line, format!("there is a {what} field, \"{extra}\"")));
        }
        if t < 0.0 && time_s.is_empty() && reading.start_s.is_none() {
            return Err((line, before_zero(&wanted[0], t)));
        }
        if let Some(&before) = time_s.last().filter(|&&before| t <= before) {
            return Err((line, not_ascending(&wanted[0], t, before)));
        }
        if time_s.len() == MOST_SAMPLES {
            let reason = format!("there are more than {MOST_SAMPLES} rows: cut or thin the record");
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

/// Where the header seems to be, above the first row of numbers, and what to do with it.
fn no_header<'a>(
    lines: impl Iterator<Item = (usize, &'a str)>,
    wanted: &[String; 2],
) -> (usize, String) {
    let is_row = |text: &str| {
        let by = separator(text);
        let fields = columns(text, by);
        (0..2).all(|place| number_at(&fields, place, by).is_some())
    };
    let (mut line, mut text) = (1, "");
    for (at, found) in lines {
        let is_row = is_row(found);
        if !is_row || text.is_empty() {
            (line, text) = (at, found);
        }
        if is_row {
            break;
        }
    }
    let by = separator(text);
    let way = match columns(text, by).as_slice() {
        [first, ..] if number(first, by).is_some() => {
            "force.columns = [1, 2] with force.units = [\"s\", \"N\"], by place".to_owned()
        }
        [first, second, ..] => format!("such as force.columns = [\"{first}\", \"{second}\"]"),
        _ => "in force.columns".to_owned(),
    };
    let wanted = wanted.join(",");
    let reason = format!(
        "the header is \"{text}\", not \"{wanted}\": name the columns of time and force, {way}"
    );
    (line, reason)
}

/// Reads the datasets `/time` (s) and `/force` (N) without the HDF5 library, which trusts what it reads.
fn from_hdf5(path: &Path) -> Result<Rows, String> {
    let file = HdfFile::open(path).map_err(|error| match &error {
        HdfError::Io(source) if source.kind() == ErrorKind::NotFound => {
            "there is no such file".to_owned()
        }
        other => other.to_string(),
    })?;
    let (time_s, force_n) = (samples(&file.root, "time")?, samples(&file.root, "force")?);
    let (times, forces) = (time_s.len(), force_n.len());
    if times != forces || times < 2 {
        return Err(format!(
            "/time has {times} samples and /force {forces}; at least 2 and as many of each are needed"
        ));
    }
    if let Some(pair) = time_s.windows(2).find(|pair| pair[1] <= pair[0]) {
        return Err(not_ascending("/time", pair[1], pair[0]));
    }
    Ok((time_s, force_n))
}

/// The numbers of a dataset of one dimension.
fn samples(root: &Group, name: &str) -> Result<Vec<f64>, String> {
    let failed = |error: HdfError| match error {
        HdfError::Absent(_) => format!("it has no dataset /{name} of numbers"),
        other => format!("/{name}: {other}"),
    };
    let data = root.dataset(name).map_err(failed)?;
    let (dimensions, count) = (data.shape().len(), data.count());
    if dimensions != 1 {
        return Err(format!("/{name} has {dimensions} dimensions, needed 1"));
    }
    if count > MOST_SAMPLES {
        return Err(format!(
            "/{name} has {count} samples, more than {MOST_SAMPLES}: cut or thin the record"
        ));
    }
    data.as_f64(8 * MOST_SAMPLES as u64).map_err(failed)
}
