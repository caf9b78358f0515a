//! Reads the description of some noise.

use super::NoiseSpec;
use crate::error::SceneError;
use crate::scene::keys::{FINITE, NOT_NEGATIVE, POSITIVE};
use crate::scene::record::{columns, number, separator};
use crate::scene::section::{MOST_OF_RECORD, TomlSection, parse, read_text, read_text_up_to};
use crate::scene::sections_of;
use crate::schema::noise as schema;
use crate::sweep::{Spec, SweptKey, Values};
use contact::{NUMBERS_REVISION, Settings, choice};
use impact::numbers::FIELDS_REVISION;
use ledger::Identity;
use noise::{Area, Receiver, Recording, Source};
use std::path::Path;
use toml::{Table, Value};

/// Draws of bodies if `[random]` does not state them.
const SAMPLES: i64 = 10_000;

/// Largest number of frequencies, receivers and impacts: all are held in memory.
const MOST_FREQUENCIES: usize = 100_000;
const MOST_RECEIVERS: usize = 10_000;

/// Largest number of spectral values, each with its shares.
const MOST_ROWS: usize = 1_000_000;

/// Shape of an area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Disc,
    Strip,
}

choice!(Shape: Disc = "disc", Strip = "strip");

/// Impacts of a file: times and places, and columns of the striker.
type Listed = (Vec<f64>, Vec<[f64; 2]>, Vec<SweptKey>);

impl NoiseSpec {
    /// Reads a file; relative paths in it start at its folder.
    ///
    /// # Errors
    /// [`SceneError`], with the path of the file at fault.
    pub fn from_file(path: &Path) -> Result<Self, SceneError> {
        let text = read_text(path)?;
        let directory = path.parent().unwrap_or(Path::new("."));
        let read = parse(&text).and_then(|table| Self::from_table(&table, directory));
        let mut spec = read.map_err(|error| error.in_file(path))?;
        spec.inputs.push(("the noise", path.to_owned()));
        Ok(spec)
    }

    /// Reads a parsed table; relative paths in it start at `directory`.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_table(table: &Table, directory: &Path) -> Result<Self, SceneError> {
        let root = TomlSection::root(table);
        root.allow(schema::SCENE.into_iter().chain(schema::SECTIONS))?;
        let hint = "state the frequencies of the spectra in a section [output]";
        let output = root
            .section("output")?
            .ok_or_else(|| root.missing("output", hint))?;
        output.allow(schema::OUTPUT)?;
        let receivers = receivers(&root)?;
        let frequency_hz = frequencies(&output)?;
        let rows = receivers.len() * frequency_hz.len();
        if rows > MOST_ROWS {
            let key = "the number of receivers times that of output.frequencies_hz";
            return Err(SceneError::out_of_range(key, rows as f64, "[1, 1000000]"));
        }
        let duration_s = output.number_in("duration_s", POSITIVE)?;
        let (mut inputs, mut identity) = (Vec::new(), Identity::default());
        let scene = schema::SCENE.into_iter();
        let scene = scene.filter_map(|name| Some((name.to_owned(), table.get(name)?.clone())));
        let scene: Table = scene.collect();
        let (source, bodies) = match (root.section("area")?, root.section("impacts")?) {
            (Some(area), None) => {
                let source = Source::Poisson {
                    area: area_of(&area)?,
                    rate_per_m2_s: area.required(
                        "rate_per_m2_s",
                        POSITIVE,
                        "impacts per m^2 and s",
                    )?,
                };
                (source, drawn(&root, &scene, directory)?)
            }
            (None, Some(impacts)) => {
                impacts.allow(schema::IMPACTS)?;
                let path = directory.join(impacts.needed_text("file", "a table of impacts")?);
                if root.value("random").is_some() {
                    let reason = "the bodies are those of the file";
                    return Err(SceneError::conflict("[random]", "[impacts]", reason));
                }
                let hint = "the power of listed impacts is a mean over this time";
                let duration_s = duration_s.ok_or_else(|| output.missing("duration_s", hint))?;
                let text = read_text_up_to(&path, MOST_OF_RECORD)?;
                identity = identity.with("impacts", &text);
                let (source, keys, rows) = source_of(&path, &text, duration_s)?;
                inputs.push(("the table of impacts", path));
                let keys = constant(keys, &scene, rows);
                (source, Spec::of_columns(&scene, directory, keys)?)
            }
            (Some(_), Some(_)) => {
                let reason = "the impacts are either drawn or listed";
                return Err(SceneError::conflict("[area]", "[impacts]", reason));
            }
            (None, None) => {
                let hint = "describe where impacts fall in a section [area], or name a file of impacts in [impacts]";
                return Err(root.missing("area", hint));
            }
        };
        inputs.extend(bodies.inputs.clone());
        let identity = identity
            .with("software", env!("CARGO_PKG_VERSION"))
            .with("contacts", NUMBERS_REVISION.to_le_bytes())
            .with("fields", FIELDS_REVISION.to_le_bytes())
            .with("noise", table.to_string())
            .with("bodies", &bodies.sha256);
        Ok(Self {
            nearest_m: output.number_in("nearest_m", NOT_NEGATIVE)?.unwrap_or(0.0),
            recording: recording(&output, duration_s, &source)?,
            bodies,
            source,
            receivers,
            frequency_hz,
            text: table.to_string(),
            inputs,
            sha256: identity.hex(),
        })
    }
}

/// The source of the impacts of a file, the columns of the striker, and the number of rows.
fn source_of(
    path: &Path,
    text: &str,
    duration_s: f64,
) -> Result<(Source, Vec<SweptKey>, usize), SceneError> {
    let (times_s, places_m, keys) = listed(text).map_err(|(line, reason)| {
        let sentence = format!("{} line {line}: {reason}", path.display());
        SceneError::in_sentence(path, sentence)
    })?;
    let rows = times_s.len();
    let source = Source::Listed {
        times_s,
        places_m,
        duration_s,
    };
    Ok((source, keys, rows))
}

/// The receivers.
fn receivers(root: &TomlSection<'_>) -> Result<Vec<Receiver>, SceneError> {
    let read = |(i, (section, table)): (usize, &(String, &Table))| -> Result<Receiver, SceneError> {
        let section = TomlSection::of(section, table);
        section.allow(schema::RECEIVER)?;
        let place = |key| section.required(key, FINITE, "the place of the receiver on the surface");
        Ok(Receiver {
            name: section
                .text("name")?
                .map_or_else(|| format!("receiver {}", i + 1), str::to_owned),
            place_m: [place("x_m")?, place("y_m")?],
            depth_m: section.number_in("z_m", NOT_NEGATIVE)?.unwrap_or(0.0),
        })
    };
    let list = root.list("receiver")?;
    let found = list
        .iter()
        .enumerate()
        .map(read)
        .collect::<Result<Vec<_>, _>>()?;
    if !(1..=MOST_RECEIVERS).contains(&found.len()) {
        return Err(SceneError::out_of_range(
            "the number of [[receiver]]",
            found.len() as f64,
            "[1, 10000]",
        ));
    }
    Ok(found)
}

/// The frequencies, ascending.
fn frequencies(output: &TomlSection<'_>) -> Result<Vec<f64>, SceneError> {
    let key = output.key("frequencies_hz");
    let values = Values::read(output, "frequencies_hz")?;
    let count = values.count();
    if count > MOST_FREQUENCIES {
        return Err(SceneError::out_of_range(
            format!("the number of {key}"),
            count as f64,
            "[1, 100000]",
        ));
    }
    let found: Vec<f64> = (0..count).filter_map(|i| values.number(i)).collect();
    let before = std::iter::once(0.0).chain(found.iter().copied());
    match before
        .zip(&found)
        .find(|(before, f)| !(*f > before && f.is_finite()))
    {
        Some((before, f)) => Err(SceneError::out_of_range(
            key,
            *f,
            &format!("({before}, inf): frequencies ascend"),
        )),
        None if found.len() < count => {
            Err(output.missing("frequencies_hz", "a list of numbers in Hz"))
        }
        None => Ok(found),
    }
}

/// The area.
fn area_of(section: &TomlSection<'_>) -> Result<Area, SceneError> {
    let shape: Option<Shape> = section.choice("shape")?;
    let shape = shape.ok_or_else(|| section.missing("shape", "disc or strip"))?;
    let place = |key| section.number_in(key, FINITE).map(|x| x.unwrap_or(0.0));
    let centre_m = [place("x_m")?, place("y_m")?];
    let size = |key| section.required(key, POSITIVE, "the size of the area");
    let other = match shape {
        Shape::Disc => &schema::AREA[6..],
        Shape::Strip => &schema::AREA[4..6],
    };
    section.allow(schema::AREA.into_iter().filter(|key| !other.contains(key)))?;
    match shape {
        Shape::Disc => {
            let (radius_m, inner) = (
                size("radius_m")?,
                section.number_in("inner_radius_m", NOT_NEGATIVE)?,
            );
            let inner_radius_m = inner.unwrap_or(0.0);
            if inner_radius_m >= radius_m {
                let range = format!("[0, {radius_m}), below radius_m");
                return Err(SceneError::out_of_range(
                    "area.inner_radius_m",
                    inner_radius_m,
                    &range,
                ));
            }
            Ok(Area::Disc {
                centre_m,
                radius_m,
                inner_radius_m,
            })
        }
        Shape::Strip => Ok(Area::Strip {
            centre_m,
            length_m: size("length_m")?,
            width_m: size("width_m")?,
            azimuth: place("azimuth_deg")?.to_radians(),
        }),
    }
}

/// The drawn bodies as a sweep; one body without `[random]`.
fn drawn(root: &TomlSection<'_>, scene: &Table, directory: &Path) -> Result<Spec, SceneError> {
    let target = scene.get("target").and_then(Value::as_table);
    let of_plates = ["echoes", "until_s"].into_iter();
    let mut asked = of_plates.filter(|key| target.is_some_and(|own| own.contains_key(*key)));
    if let Some(key) = asked.next() {
        return Err(SceneError::superfluous(
            format!("target.{key}"),
            "noise",
            "the responses are those of a half-space",
        ));
    }
    let Some(random) = root.value("random").and_then(Value::as_table) else {
        return Spec::of_columns(scene, directory, constant(Vec::new(), scene, 1));
    };
    let mut random = random.clone();
    random.entry("samples").or_insert(SAMPLES.into());
    if random.contains_key("target") {
        let what = "all impacts are on the same half-space: draw keys of [striker]";
        return Err(SceneError::unknown_key(
            "random.target".to_owned(),
            None,
            what,
        ));
    }
    let sweep = [("scene", scene.clone()), ("random", random)];
    let sweep = sweep.map(|(key, table)| (key.to_owned(), Value::Table(table)));
    Spec::from_table(&Table::from_iter(sweep), directory)
}

/// The keys that vary; the tolerance of the scene if there are none.
fn constant(keys: Vec<SweptKey>, scene: &Table, rows: usize) -> Vec<SweptKey> {
    if !keys.is_empty() {
        return keys;
    }
    let stated = scene
        .get("contact")
        .and_then(|contact| contact.get("tolerance")?.as_float());
    let tolerance = stated.unwrap_or(Settings::default().tolerance);
    vec![SweptKey {
        section: "contact".to_owned(),
        key: "tolerance".to_owned(),
        values: Values::Numbers(vec![tolerance; rows]),
    }]
}

/// The traces, if a step is given.
fn recording(
    output: &TomlSection<'_>,
    duration_s: Option<f64>,
    source: &Source,
) -> Result<Option<Recording>, SceneError> {
    let step_s = output.number_in("step_s", POSITIVE)?;
    let seed = output
        .count("seed", 0..=usize::MAX, "[0, 2^63)")?
        .unwrap_or(0) as u64;
    match (step_s, duration_s, source) {
        (Some(step_s), Some(duration_s), _) => Ok(Some(Recording {
            duration_s,
            step_s,
            seed,
        })),
        (Some(_), None, _) => Err(output.missing("duration_s", "how long the traces are")),
        (None, Some(_), Source::Poisson { .. }) => {
            Err(output.missing("step_s", "the time between samples of the traces"))
        }
        (None, _, _) => Ok(None),
    }
}

/// The impacts of a text with a header, or the line at fault with the reason.
fn listed(text: &str) -> Result<Listed, (usize, String)> {
    let lines = (1..).zip(text.trim_start_matches('\u{feff}').lines().map(str::trim));
    let mut lines = lines.filter(|(_, row)| !row.is_empty() && !row.starts_with('#'));
    let (line, header) = lines.next().ok_or((1, "the file is empty".to_owned()))?;
    let by = separator(header);
    let names = columns(header, by);
    let mut places = [0; 3];
    for (place, wanted) in places.iter_mut().zip(schema::COLUMNS) {
        let found = names.iter().position(|name| *name == wanted);
        *place = found.ok_or_else(|| (line, format!("there is no column {wanted}")))?;
    }
    let mut keys: Vec<(usize, SweptKey)> = Vec::new();
    for (place, name) in names
        .iter()
        .enumerate()
        .filter(|(place, _)| !places.contains(place))
    {
        let sections =
            sections_of(name, &schema::COLUMNS).map_err(|error| (line, error.to_string()))?;
        if !sections.contains(&"striker") {
            return Err((
                line,
                format!("the column {name} is not a key of the striker"),
            ));
        }
        let (section, key) = ("striker".to_owned(), (*name).to_owned());
        keys.push((
            place,
            SweptKey {
                section,
                key,
                values: Values::Numbers(Vec::new()),
            },
        ));
    }
    let (mut times_s, mut places_m) = (Vec::new(), Vec::new());
    for (line, row) in lines {
        let fields = columns(row, by);
        if fields.len() != names.len() {
            return Err((
                line,
                format!(
                    "there are {} fields, but {} columns",
                    fields.len(),
                    names.len()
                ),
            ));
        }
        let value = |place: usize| {
            number(fields[place], by).ok_or_else(|| {
                (
                    line,
                    format!("\"{}\" is not a finite number", fields[place]),
                )
            })
        };
        times_s.push(value(places[0])?);
        places_m.push([value(places[1])?, value(places[2])?]);
        for (place, key) in &mut keys {
            if let Values::Numbers(numbers) = &mut key.values {
                numbers.push(value(*place)?);
            }
        }
    }
    if times_s.is_empty() {
        return Err((line, "there are no impacts below the header".to_owned()));
    }
    Ok((
        times_s,
        places_m,
        keys.into_iter().map(|(_, key)| key).collect(),
    ))
}
