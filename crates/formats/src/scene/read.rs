//! Reads scenes.

use super::body::{body, read_materials, read_strike};
use super::keys::{SECTIONS, Set, keys_of};
use super::record::{read_record, record_of_samples};
use super::response::read_response;
use super::section::{TomlSection, as_number, parse, read_standard, read_text};
use crate::error::SceneError;
use contact::{Choice, Conflict, Echoes, HalfSpace, Library, Settings};
use halfspace::{Attenuation, Plate};
use impact::response::{Fir, PolesZeros, Response, ResponseError};
use impact::{Load, Probe, Quantity, Reading, Scene, Section, Sensor, SensorResponse, Strike};
use lookup::schema::FIELD_NAMES;
use output::{Role, is_standard};
use std::path::Path;
use toml::{Table, Value};

/// Sections of a scene with a key `file`, and the kind of that file.
const FILES: [(&str, &str); 2] = [
    ("materials", "the materials file"),
    ("force", "the force record"),
];

/// Reads a scene from a file, or from standard input if the path is `-`. Also returns all input files, the scene itself
/// among them, which must not be overwritten.
///
/// # Errors
/// [`SceneError`], with the path of the file at fault.
pub fn read_with_inputs(path: &Path) -> Result<(Scene, Vec<Role>), SceneError> {
    let (text, named) = if is_standard(path) {
        (read_standard()?, Path::new("standard input"))
    } else {
        (read_text(path)?, path)
    };
    let folder = path.parent().unwrap_or(Path::new("."));
    let table = parse(&text).map_err(|error| error.in_file(named))?;
    let scene = scene_of(&table, folder).map_err(|error| error.in_file(named))?;
    let mut found = Vec::new();
    if !is_standard(path) {
        found.push(("the scene", path.to_owned()));
    }
    for (section, role) in FILES {
        if let Some(Value::String(file)) = table.get(section).and_then(|s| s.get("file")) {
            found.push((role, folder.join(file)));
        }
    }
    let files = scene
        .sensors
        .iter()
        .filter_map(|sensor| sensor.response.as_ref()?.file.clone());
    found.extend(files.map(|file| ("the response of a sensor", file)));
    Ok((scene, found))
}

/// Reads a scene file. Relative paths in it start at its folder.
///
/// # Errors
/// [`SceneError`], with the path of the file at fault.
pub fn read_scene(path: &Path) -> Result<Scene, SceneError> {
    read_with_inputs(path).map(|(scene, _)| scene)
}

/// Reads a scene from TOML text; relative paths of other files in it refer to `directory`.
///
/// # Errors
/// [`SceneError`]: the text is not TOML, a key is unknown, missing or outside its range, or a file that it names cannot be
/// read. The error contains the key, the value, the allowed range and the nearest name, as far as they apply.
pub fn parse_scene(text: &str, directory: &Path) -> Result<Scene, SceneError> {
    scene_of(&parse(text)?, directory)
}

/// Reads a scene from a parsed table, as sweeps do.
pub fn scene_of(table: &Table, directory: &Path) -> Result<Scene, SceneError> {
    let root = TomlSection::root(table);
    let of_sweeps = ["product", "list", "random"];
    if let Some(key) = of_sweeps.iter().find(|&&key| table.contains_key(key)) {
        let what = "this is a sweep, not a scene";
        return Err(SceneError::unknown_key((*key).to_owned(), None, what));
    }
    root.allow(SECTIONS)?;
    let library = read_library(&root, directory)?;
    scene_with(table, directory, &library)
}

/// Reads a scene with a library of materials that was read before.
pub(crate) fn scene_with(
    table: &Table,
    directory: &Path,
    library: &Library,
) -> Result<Scene, SceneError> {
    let root = TomlSection::root(table);
    root.allow(SECTIONS)?;
    let target = read_target(&root, library)?;
    let settings = read_settings(&root)?;
    let load = read_load(&root, &settings, library, directory)?;
    let (probes, section) = (read_probes(&root)?, read_section(&root)?);
    let sensors = read_sensors(&root, directory)?;
    inside(&target, (&probes, &sensors), section.as_ref())?;
    let output = root.section("output")?;
    let none = Table::new();
    let output = output.unwrap_or(TomlSection::of("output", &none));
    output.allow_keys_of("output")?;
    always_there(&output)?;
    let quantities: Vec<Quantity> = output.choices("quantities")?;
    check_strains(&target, &quantities)?;
    Ok(Scene {
        target,
        load,
        settings,
        probes,
        sensors,
        section,
        duration_s: output.number("duration_s")?,
        low_pass_hz: output.number("low_pass_hz")?,
        quantities,
        peaks: output.flag("peaks")?,
    })
}

/// Rejects requests for fields that are always written.
fn always_there(output: &TomlSection<'_>) -> Result<(), SceneError> {
    let asked = output.value("quantities").and_then(Value::as_array);
    let mut words = asked.into_iter().flatten().filter_map(Value::as_str);
    let Some(word) = words.find(|word| FIELD_NAMES.contains(word)) else {
        return Ok(());
    };
    Err(SceneError::superfluous(
        format!("output.quantities = \"{word}\""),
        "the six fields",
        "displacements and stresses are always written: remove it",
    ))
}

/// The half-space and the striker of a parsed scene; no striker for a force record, whose file is not read.
pub(crate) fn bodies_of(table: &Table) -> Result<(HalfSpace, Option<Strike>), SceneError> {
    let (root, library) = (TomlSection::root(table), Library::built_in());
    let target = read_target(&root, library)?;
    let striker = root.section("striker")?;
    let strike = striker.map(|section| read_strike(&section, library));
    Ok((target, strike.transpose()?))
}

pub(crate) fn read_target(
    root: &TomlSection<'_>,
    library: &Library,
) -> Result<HalfSpace, SceneError> {
    let target = root
        .section("target")?
        .ok_or_else(|| root.missing("target", "describe the half-space in a section [target]"))?;
    target.allow_keys_of("target")?;
    let material = body(&target, library)?;
    // the reader has checked the ranges: only the density can be missing
    let hint = "the waves in the half-space depend on its density";
    let made = HalfSpace::new(material);
    let mut half_space = made.map_err(|_| target.missing("density_kg_m3", hint))?;
    half_space.thickness_m = target.number("thickness_m")?;
    half_space.radius_m = target.number("radius_m")?;
    half_space.echoes = read_echoes(&target)?;
    check_echoes(&target, &half_space)?;
    half_space.attenuation = read_attenuation(&target)?;
    Ok(half_space)
}

/// Frequency in Hz at which wave speeds of materials are measured, by ultrasound.
const REFERENCE_HZ: f64 = 1e6;

/// Attenuation of the block, if there is any.
fn read_attenuation(target: &TomlSection<'_>) -> Result<Option<Attenuation>, SceneError> {
    let quality_factor = target.number("quality_factor")?;
    let reference_hz = target.number("reference_frequency_hz")?;
    let Some(quality_factor) = quality_factor else {
        let hint = "a reference frequency is that of a quality factor";
        return match reference_hz {
            Some(_) => Err(target.missing("quality_factor", hint)),
            None => Ok(None),
        };
    };
    let law = Attenuation::new(quality_factor, reference_hz.unwrap_or(REFERENCE_HZ));
    // the reader has checked the ranges
    law.map(Some)
        .map_err(|_| target.missing("quality_factor", "[1, 1e15]"))
}

/// Rejects strains of a block with attenuation, whose moduli depend on the frequency.
fn check_strains(target: &HalfSpace, quantities: &[Quantity]) -> Result<(), SceneError> {
    let strain = quantities
        .iter()
        .find(|quantity| quantity.name().contains("strain"));
    match (strain, &target.attenuation) {
        (Some(strain), Some(_)) => Err(SceneError::conflict(
            "target.quality_factor",
            format!("output.quantities = \"{}\"", strain.name()),
            "strains follow from the stresses of an elastic block only: remove one of them",
        )),
        (Some(_) | None, _) => Ok(()),
    }
}

/// How far the waves of a plate are followed, if a scene asks for that.
fn read_echoes(target: &TomlSection<'_>) -> Result<Option<Echoes>, SceneError> {
    let legs = target.count("echoes", 1..=Plate::MOST_LEGS, "[1, 16]")?;
    let until_s = target.number("until_s")?;
    match (legs, until_s) {
        (None, None) => Ok(None),
        (Some(_), Some(_)) => Err(SceneError::superfluous(
            "target.until_s".to_owned(),
            "echoes",
            "both say how long the echoes of a plate are computed: remove one",
        )),
        (Some(legs), None) => Ok(Some(Echoes::Legs(legs))),
        (None, Some(time_s)) => Ok(Some(Echoes::Until(time_s))),
    }
}

/// Rejects echoes without a thickness, and until a time to which they cannot be computed.
fn check_echoes(target: &TomlSection<'_>, block: &HalfSpace) -> Result<(), SceneError> {
    match (block.echoes, block.echoing()) {
        (Some(_), None) => {
            let hint = "echoes need the thickness of the plate";
            Err(target.missing("thickness_m", hint))
        }
        (Some(Echoes::Until(time_s)), Some(plate)) if time_s > plate.latest_s => {
            Err(SceneError::late_echoes(time_s, plate.latest_s))
        }
        (Some(_) | None, _) => Ok(()),
    }
}

pub(crate) fn read_library(
    root: &TomlSection<'_>,
    directory: &Path,
) -> Result<Library, SceneError> {
    let Some(section) = root.section("materials")? else {
        return Ok(Library::built_in().clone());
    };
    section.allow_keys_of("materials")?;
    let file = section.needed_text("file", "name a TOML file of materials")?;
    let own = read_materials(&directory.join(file))?;
    Ok(Library::built_in().extended(&own))
}

fn read_settings(root: &TomlSection<'_>) -> Result<Settings, SceneError> {
    let (mut settings, none) = (Settings::default(), Table::new());
    let section = root.section("contact")?;
    let section = section.unwrap_or(TomlSection::of("contact", &none));
    section.allow_keys_of("contact")?;
    for key in keys_of("contact") {
        match key.set {
            Some(Set::Settings(set)) => {
                if let Some(number) = section.number(key.name)? {
                    set(&mut settings, number);
                }
            }
            Some(Set::Choice(set)) => {
                if let Some(word) = section.text(key.name)? {
                    section.named(key.name, word, |word| set(&mut settings, word))?;
                }
            }
            Some(Set::Strike(_) | Set::Body(_) | Set::Ball(_)) | None => {}
        }
    }
    settings
        .conflict()
        .map_or(Ok(settings), |conflict| Err(in_words(conflict)))
}

/// Conflicting settings, with the names of the keys in a scene.
fn in_words(conflict: Conflict) -> SceneError {
    let (first, second, reason) = match conflict {
        Conflict::ExplicitDynamic => (
            "contact.scheme = \"explicit\"",
            "static_share = \"dynamic\"".to_owned(),
            "the paper's kernel includes the static deflection",
        ),
        Conflict::ExplicitModel(model) => (
            "contact.scheme = \"explicit\"",
            format!("model = \"{}\"", model.name()),
            "the paper's scheme exists only for model wave",
        ),
        Conflict::GrowingDisc => (
            "contact.model = \"growing\"",
            "disc_radius_m".to_owned(),
            "its contact radius follows the load",
        ),
        Conflict::PlasticDisc => (
            "contact.plasticity",
            "disc_radius_m".to_owned(),
            "the contact radius of a yielding contact follows the load",
        ),
        Conflict::PlasticModel(law, model) => {
            return SceneError::conflict(
                format!("contact.plasticity = \"{}\"", law.name()),
                format!("model = \"{}\"", model.name()),
                "plasticity requires the implicit scheme and model auto, hertz, area_dashpot or growing (jackson_green: not growing)",
            );
        }
        Conflict::PlasticPressure(law) => (
            "contact.yield_pressure_pa",
            format!("plasticity = \"{}\"", law.name()),
            "only thornton and recovery use it",
        ),
    };
    SceneError::conflict(first.to_owned(), second, reason)
}

fn read_load(
    root: &TomlSection<'_>,
    settings: &Settings,
    library: &Library,
    directory: &Path,
) -> Result<Load, SceneError> {
    match (root.section("striker")?, root.section("force")?) {
        (Some(striker), None) => read_strike(&striker, library).map(Load::Strike),
        (None, Some(force)) => {
            force.allow_keys_of("force")?;
            let source = read_source(&force)?;
            if settings.disc_radius_m.is_none() {
                let hint = "a prescribed force requires the radius of the loaded disc";
                return Err(SceneError::missing("contact.disc_radius_m", hint));
            }
            let baseline_s = force.number("baseline_s")?;
            let low_pass_hz = force.number("low_pass_hz")?;
            let reading = Reading {
                columns: force.words("columns", "a pair of words")?,
                units: force.words("units", "a pair of words")?,
                start_s: force.number("start_s")?,
                end_s: force.number("end_s")?,
                onset_s: force.number("onset_s")?,
                sign: force.number("sign")?,
                sensitivity_v_per_n: force.number("sensitivity_v_per_n")?,
                samples: None,
            };
            let record = match source {
                RecordSource::File(file) => read_record(&directory.join(file), reading)?,
                RecordSource::Samples(samples) => record_of_samples(samples, reading)?,
            };
            Ok(Load::Record(record.treat(baseline_s, low_pass_hz)?))
        }
        (Some(_), Some(_)) => Err(SceneError::conflict(
            "[striker]",
            "[force]",
            "the force is either computed or prescribed",
        )),
        (None, None) => Err(root.missing(
            "striker",
            "add a section [striker], or [force] with a prescribed history",
        )),
    }
}

/// Source of the samples of a record.
enum RecordSource<'a> {
    File(&'a str),
    /// In the scene itself: times in s and forces in N.
    Samples([Vec<f64>; 2]),
}

fn read_source<'a>(force: &TomlSection<'a>) -> Result<RecordSource<'a>, SceneError> {
    let (time_s, force_n) = (force.numbers("time_s")?, force.numbers("force_n")?);
    if time_s.is_none() && force_n.is_none() {
        let hint = "name a CSV file with columns time_s,force_n or an HDF5 file with /time and /force, or replace it by the lists time_s and force_n";
        return force.needed_text("file", hint).map(RecordSource::File);
    }
    let of_files = ["file", "columns", "units"];
    let superfluous = |key: &&str| force.value(key).is_some();
    if let Some(key) = of_files.into_iter().find(superfluous) {
        let reason = "the samples, in s and N, are in the scene";
        return Err(SceneError::superfluous(
            force.key(key),
            "time_s and force_n",
            reason,
        ));
    }
    let hint = "time_s and force_n are required together";
    let time_s = time_s.ok_or_else(|| force.missing("time_s", hint))?;
    let force_n = force_n.ok_or_else(|| force.missing("force_n", hint))?;
    Ok(RecordSource::Samples([time_s, force_n]))
}

/// Rejects places outside the block.
fn inside(
    block: &HalfSpace,
    (probes, sensors): (&[Probe], &[Sensor]),
    section: Option<&Section>,
) -> Result<(), SceneError> {
    let probes = (1..).zip(probes).map(|(i, probe)| {
        let name = format!("probe[{i}]");
        (name, [("z_m", probe.z_m), ("r_m", probe.r_m)])
    });
    let sensors = (1..).zip(sensors).map(|(i, sensor)| {
        let name = format!("sensor[{i}]");
        let edge = match sensor.face_radius_m {
            0.0 => "r_m",
            _ => "r_m + face_radius_m",
        };
        let edge_m = sensor.r_m + sensor.face_radius_m;
        (name, [("z_m", sensor.z_m), (edge, edge_m)])
    });
    let corner = section.map(|section| {
        let corner = [("z_max_m", section.z_max_m), ("r_max_m", section.r_max_m)];
        ("map".to_owned(), corner)
    });
    let (thickness, radius) = ("target.thickness_m", "target.radius_m");
    let limits = [(thickness, block.thickness_m), (radius, block.radius_m)];
    for (name, place) in probes.chain(sensors).chain(corner) {
        for ((key, value), (limit_key, limit)) in place.into_iter().zip(limits) {
            if let Some(limit) = limit.filter(|&limit| value > limit) {
                let key = format!("{name}.{key}");
                return Err(SceneError::outside_block(key, value, limit_key, limit));
            }
        }
    }
    Ok(())
}

fn read_probes(root: &TomlSection<'_>) -> Result<Vec<Probe>, SceneError> {
    root.list("probe")?
        .iter()
        .map(|(name, table)| {
            let section = TomlSection::of(name, table);
            section.allow_keys_of("probe")?;
            Ok(Probe {
                r_m: section.needed("r_m")?,
                z_m: section.needed("z_m")?,
            })
        })
        .collect()
}

fn read_sensors(root: &TomlSection<'_>, directory: &Path) -> Result<Vec<Sensor>, SceneError> {
    let read = |(name, table): &(String, &Table)| {
        let section = TomlSection::of(name, table);
        section.allow_keys_of("sensor")?;
        let measured = section.choice("quantity")?.unwrap_or_default();
        Ok(Sensor {
            r_m: section.needed("r_m")?,
            z_m: section.needed("z_m")?,
            face_radius_m: section.number("face_radius_m")?.unwrap_or(0.0),
            measured,
            response: read_sensor_response(name, &section, directory)?,
        })
    };
    root.list("sensor")?.iter().map(read).collect()
}

/// The response of a sensor: of a file, of poles and zeros, or of a digital filter.
fn read_sensor_response(
    name: &str,
    sensor: &TomlSection<'_>,
    directory: &Path,
) -> Result<Option<SensorResponse>, SceneError> {
    let Some(inner) = sensor.section("response")? else {
        return Ok(None);
    };
    let full = format!("{name}.response");
    let section = inner.renamed(&full);
    section.allow_keys_of("response")?;
    let (poles, zeros) = (section.roots("poles")?, section.roots("zeros")?);
    let coefficients = section.numbers("coefficients")?;
    let (gain, rate_hz) = (section.number("gain")?, section.number("rate_hz")?);
    let file = section.text("file")?;
    let has_roots = poles.is_some() || zeros.is_some() || gain.is_some();
    let has_filter = coefficients.is_some() || rate_hz.is_some();
    if u8::from(file.is_some()) + u8::from(has_roots) + u8::from(has_filter) > 1 {
        return Err(SceneError::told(format!(
            "{full} has more than one response: keep file, or poles, zeros and gain, or coefficients and rate_hz"
        )));
    }
    let of = |error: ResponseError| SceneError::from(error).of_section(name);
    let response = match (file, has_filter, has_roots) {
        (Some(file), ..) => read_response(&directory.join(file))?,
        (None, true, _) => {
            let hint = "a digital filter has a list of coefficients";
            let own = coefficients.ok_or_else(|| section.missing("coefficients", hint))?;
            Response::Fir(Fir::new(own, section.needed("rate_hz")?).map_err(of)?)
        }
        (None, false, true) => {
            let made = PolesZeros::new(
                poles.unwrap_or_default(),
                zeros.unwrap_or_default(),
                section.needed("gain")?,
            );
            Response::PolesZeros(made.map_err(of)?)
        }
        (None, false, false) => {
            let hint = "name a file, or list poles, zeros and gain, or coefficients and rate_hz";
            return Err(section.missing("file", hint));
        }
    };
    Ok(Some(SensorResponse {
        response,
        unit: section.text("unit")?.unwrap_or("V").to_owned(),
        file: file.map(|file| directory.join(file)),
    }))
}

fn read_section(root: &TomlSection<'_>) -> Result<Option<Section>, SceneError> {
    let Some(section) = root.section("map")? else {
        return Ok(None);
    };
    section.allow_keys_of("map")?;
    let times_s = frame_times(&section)?;
    let frames = section.count("frames", 1..=MOST_SECTION_FRAMES, "[1, 100000]")?;
    let frames = match (frames, times_s.len()) {
        (Some(_), 1..) => {
            let reason = "times_s has a frame at each of its times";
            return Err(SceneError::conflict(
                "map.frames".to_owned(),
                "map.times_s",
                reason,
            ));
        }
        (Some(frames), 0) => frames,
        (None, 0) => {
            return Err(section.missing("frames", "the number of frames in time, or times_s"));
        }
        (None, times) => times,
    };
    Ok(Some(Section {
        r_max_m: section.needed("r_max_m")?,
        z_max_m: section.needed("z_max_m")?,
        points: section
            .counts("points", 2..=2001, "[2, 2001]")?
            .ok_or_else(|| section.missing("points", "points along r and z, such as [81, 81]"))?,
        frames,
        times_s,
    }))
}

/// Largest number of frames of a section.
const MOST_SECTION_FRAMES: usize = 100_000;

/// The times of the frames of a section, if they are listed.
fn frame_times(section: &TomlSection<'_>) -> Result<Vec<f64>, SceneError> {
    let key = "times_s";
    let expected = "a list of numbers that rise from 0 or later, such as [2e-6, 5e-6]";
    let times = section.typed(key, expected, |value| {
        let items = value.as_array()?;
        let times_s: Vec<f64> = items.iter().map(as_number).collect::<Option<_>>()?;
        let rises = times_s.windows(2).all(|pair| pair[0] < pair[1]);
        let first_s = times_s.first()?;
        let is_list = rises && *first_s >= 0.0 && times_s.iter().all(|t| t.is_finite());
        (is_list && times_s.len() <= MOST_SECTION_FRAMES).then_some(times_s)
    })?;
    Ok(times.unwrap_or_default())
}
