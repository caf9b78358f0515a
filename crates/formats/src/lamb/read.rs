//! Reads cases.

use super::{LambCase, Receiver};
use crate::error::SceneError;
use crate::scene::keys::{FINITE, NOT_NEGATIVE, POSITIVE};
use crate::scene::section::{TomlSection, parse, read_text};
use crate::scene::{read_library, read_record, read_target};
use crate::schema::lamb as schema;
use contact::{Choice, choice};
use impact::Reading;
use oracle::{Lines, Load, Quantity, TimeFunction, Wavelet};
use output::Role;
use std::path::Path;
use toml::Table;

/// Largest number of times, and of times of all receivers: 2 GB of histories.
const MOST_TIMES: usize = 1 << 20;
const MOST_NUMBERS: usize = 1 << 24;

/// Delay of a wavelet in periods 1/f if none is given: the force begins with 1e-8 of its peak.
const DELAY: f64 = 1.5;

/// Names of the time functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Time {
    Step,
    Ricker,
    Gaussian,
    File,
}
choice!(Time: Step = "step", Ricker = "ricker", Gaussian = "gaussian", File = "file");

/// Names of the profiles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ProfileName {
    Point,
    Hertz,
    Uniform,
}
choice!(ProfileName: Point = "point", Hertz = "hertz", Uniform = "uniform");

/// Reads a case from a TOML file. Relative paths in it start at its folder.
///
/// # Errors
/// [`SceneError`] with the file, the key, the value and the allowed range.
pub fn read_lamb(path: &Path) -> Result<LambCase, SceneError> {
    let text = read_text(path)?;
    let folder = path.parent().unwrap_or(Path::new("."));
    let made = parse(&text).and_then(|table| case_of(&table, folder));
    let mut case = made.map_err(|error| error.in_file(path))?;
    case.text = text;
    case.inputs.push(("the case", path.to_owned()));
    Ok(case)
}

fn case_of(table: &Table, folder: &Path) -> Result<LambCase, SceneError> {
    let root = TomlSection::root(table);
    root.allow(schema::SECTIONS)?;
    let target = read_target(&root, &read_library(&root, folder)?)?;
    if target.thickness_m.is_some() {
        return Err(SceneError::superfluous(
            "target.thickness_m".to_owned(),
            "Lamb's problem",
            "the block is a half-space",
        ));
    }
    if target.attenuation.is_some() {
        return Err(SceneError::superfluous(
            "target.quality_factor".to_owned(),
            "Lamb's problem",
            "the half-space is elastic",
        ));
    }
    let part =
        |name: &'static str, hint| root.section(name)?.ok_or_else(|| root.missing(name, hint));
    let source = part("source", "describe the force in a section [source]")?;
    let mut inputs = Vec::new();
    let (load, force) = (
        read_load(&source)?,
        read_force(&source, folder, &mut inputs)?,
    );
    let receivers = read_receivers(&root)?;
    let output = part("output", "set end_s and step_s in a section [output]")?;
    output.allow(schema::OUTPUT)?;
    let end_s = output.required("end_s", POSITIVE, "the last time of the histories")?;
    let step_s = output.required("step_s", POSITIVE, "the time between two samples")?;
    // a quotient of decimal numbers may be just below a whole number
    let count = (end_s / step_s * (1.0 + 1e-12)).floor() + 1.0;
    let most = MOST_TIMES.min(MOST_NUMBERS / receivers.len().max(1));
    if !(2.0..=most as f64).contains(&count) {
        let sentence = format!(
            "output.end_s over output.step_s makes {count} times, but 2 to {most} are allowed"
        );
        return Err(SceneError::of_number("output.step_s", step_s, sentence));
    }
    let mut quantities = output.choices("quantities")?;
    if quantities.is_empty() {
        quantities.push(Quantity::Displacement);
    }
    Ok(LambCase {
        target,
        load,
        force,
        receivers,
        times_s: (0..count as usize).map(|i| i as f64 * step_s).collect(),
        quantities,
        text: String::new(),
        inputs,
    })
}

fn read_load(source: &TomlSection<'_>) -> Result<Load, SceneError> {
    source.allow(schema::SOURCE)?;
    let profile = source
        .choice("profile")?
        .ok_or_else(|| source.missing("profile", "\"point\", \"hertz\" or \"uniform\""))?;
    let radius_m = || source.required("radius_m", POSITIVE, "the radius of the loaded disc");
    Ok(match profile {
        ProfileName::Point => {
            reject(
                source,
                &["radius_m"],
                "profile = \"point\"",
                "a point has no radius",
            )?;
            Load::Point
        }
        ProfileName::Hertz => Load::Hertz {
            radius_m: radius_m()?,
        },
        ProfileName::Uniform => Load::Uniform {
            radius_m: radius_m()?,
        },
    })
}

/// Rejects keys that another key excludes.
fn reject(
    source: &TomlSection<'_>,
    keys: &[&str],
    beside: &str,
    reason: &str,
) -> Result<(), SceneError> {
    let found = keys.iter().find(|key| source.value(key).is_some());
    found.map_or(Ok(()), |key| {
        Err(SceneError::superfluous(source.key(key), beside, reason))
    })
}

fn read_force(
    source: &TomlSection<'_>,
    folder: &Path,
    inputs: &mut Vec<Role>,
) -> Result<TimeFunction, SceneError> {
    let hint = "\"step\", \"ricker\", \"gaussian\" or \"file\"";
    let time: Time = source
        .choice("time_function")?
        .ok_or_else(|| source.missing("time_function", hint))?;
    let beside = format!("time_function = \"{}\"", time.name());
    if time == Time::File {
        reject(
            source,
            &["force_n", "frequency_hz", "delay_s"],
            &beside,
            "the file has times and forces",
        )?;
        let hint = "name a text with columns time_s,force_n or an HDF5 file with /time and /force";
        let file = folder.join(source.needed_text("file", hint)?);
        let reading = Reading {
            columns: source.words("columns", "a pair of words")?,
            units: source.words("units", "a pair of words")?,
            ..Reading::default()
        };
        let record = read_record(&file, reading)?;
        inputs.push(("the force record", file));
        let steps = record
            .jumps()
            .iter()
            .map(|jump| [jump.time_s, jump.rise_n])
            .collect();
        return Ok(TimeFunction::Lines(Lines::of_samples(
            record.time_s(),
            record.force_n(),
            steps,
        )));
    }
    reject(
        source,
        &["file", "columns", "units"],
        &beside,
        "only time_function = \"file\" reads a file",
    )?;
    let force_n = source.number_in("force_n", FINITE)?.unwrap_or(1.0);
    let delay_s = source.number_in("delay_s", FINITE)?;
    let wavelet = match time {
        Time::Ricker => Wavelet::Ricker,
        Time::Gaussian => Wavelet::Gaussian,
        Time::Step | Time::File => {
            reject(
                source,
                &["frequency_hz"],
                &beside,
                "a step has no frequency",
            )?;
            return Ok(TimeFunction::Lines(Lines::step(
                delay_s.unwrap_or(0.0),
                force_n,
            )));
        }
    };
    let frequency_hz = source.required("frequency_hz", POSITIVE, "the frequency of the wavelet")?;
    Ok(TimeFunction::Smooth {
        wavelet,
        frequency_hz,
        delay_s: delay_s.unwrap_or(DELAY / frequency_hz),
        force_n,
    })
}

fn read_receivers(root: &TomlSection<'_>) -> Result<Vec<Receiver>, SceneError> {
    let mut found: Vec<Receiver> = Vec::new();
    for (i, (own, table)) in (1..).zip(root.list("receiver")?) {
        let section = TomlSection::of(&own, table);
        section.allow(schema::RECEIVER)?;
        let name = section
            .text("name")?
            .map_or_else(|| format!("receiver{i}"), str::to_owned);
        let is_plain = |c: char| c.is_ascii_alphanumeric() || ['_', '-', '.'].contains(&c);
        if name.is_empty()
            || name == schema::TIME.0
            || name.starts_with('.')
            || !name.chars().all(is_plain)
        {
            let expected = "letters, digits and _ - . without \"time\"";
            return Err(SceneError::wrong_kind(
                section.key("name"),
                format!("\"{}\"", name.escape_debug()),
                expected,
            ));
        }
        if found.iter().any(|other| other.name == name) {
            return Err(SceneError::conflict(
                section.key("name"),
                format!("\"{name}\""),
                "each receiver needs its own name",
            ));
        }
        let [x, y] = ["x_m", "y_m"].map(|key| section.number_in(key, FINITE));
        let (place, xy_m) = match (section.number_in("r_m", NOT_NEGATIVE)?, x?, y?) {
            (Some(r_m), None, None) => (r_m, None),
            (None, Some(x_m), Some(y_m)) => (x_m.hypot(y_m), Some([x_m, y_m])),
            (Some(_), ..) => {
                return Err(SceneError::superfluous(
                    section.key("r_m"),
                    "x_m and y_m",
                    "both are the place",
                ));
            }
            (None, ..) => {
                return Err(section.missing("r_m", "the distance from the axis, or x_m and y_m"));
            }
        };
        let z_m = section.required("z_m", NOT_NEGATIVE, "the depth: 0 on the surface")?;
        found.push(Receiver {
            name,
            place_m: [place, z_m],
            xy_m,
        });
    }
    if found.is_empty() {
        return Err(root.missing("receiver", "add a section [[receiver]] with r_m and z_m"));
    }
    Ok(found)
}
