//! Reading scenes.

use crate::body::{body, with_elastic};
use crate::error::SceneError;
use crate::materials::read_materials;
use crate::record::read_record;
use crate::scene::striker::{KEYS as STRIKER_KEYS, read_strike};
use crate::section::{NOT_NEGATIVE, POSITIVE, Section, TOLERANCE, parse};
use crate::text::read_text;
use contact::{Choice, Conflict, HalfSpace, Library, Settings};
use impact::{Load, Probe, Scene, Section as MeridionalSection, Strike, Treatment};
use std::path::Path;
use toml::Table;

const SECTIONS: [&str; 8] = [
    "target",
    "striker",
    "contact",
    "force",
    "probe",
    "map",
    "output",
    "materials",
];

/// Keys of the half-space but the elastic ones.
const TARGET_KEYS: [&str; 3] = ["material", "thickness_m", "radius_m"];

/// Keys of the section on how the contact is computed.
const CONTACT_KEYS: [&str; 8] = [
    "disc_radius_m",
    "model",
    "scheme",
    "static_share",
    "deflection",
    "tolerance",
    "loss_tolerance",
    "step_s",
];

/// The sections of a contact that have a key of this name.
///
/// ```
/// use formats::scene::sections_of;
/// assert_eq!(sections_of("velocity_m_s"), ["striker"]);
/// assert_eq!(sections_of("poisson_ratio"), ["target", "striker"]);
/// ```
#[must_use]
pub fn sections_of(key: &str) -> Vec<&'static str> {
    let sections = [
        ("target", with_elastic(&TARGET_KEYS)),
        ("striker", with_elastic(&STRIKER_KEYS)),
        ("contact", CONTACT_KEYS.to_vec()),
    ];
    let has = sections.into_iter().filter(|(_, keys)| keys.contains(&key));
    has.map(|(section, _)| section).collect()
}

/// Reads a scene file; other files it names are found beside it.
///
/// # Errors
/// [`SceneError`], with the path of the file at fault.
pub fn read_scene(path: &Path) -> Result<Scene, SceneError> {
    let text = read_text(path)?;
    let directory = path.parent().unwrap_or(Path::new("."));
    parse_scene(&text, directory).map_err(|error| error.in_file(path))
}

/// Reads a scene from text; other files it names are found in `directory`.
///
/// # Errors
/// [`SceneError`].
pub fn parse_scene(text: &str, directory: &Path) -> Result<Scene, SceneError> {
    scene_of(&parse(text)?, directory)
}

/// Reads a scene from a parsed table, as sweeps make them.
///
/// # Errors
/// [`SceneError`].
pub fn scene_of(table: &Table, directory: &Path) -> Result<Scene, SceneError> {
    let root = Section::root(table);
    if let Some(key) = ["product", "list", "random"]
        .into_iter()
        .find(|key| table.contains_key(*key))
    {
        return Err(SceneError::UnknownKey {
            key: key.to_owned(),
            suggestion: None,
            allowed: "this is a sweep, not a scene".to_owned(),
        });
    }
    root.allow(&SECTIONS)?;
    let library = read_library(&root, directory)?;
    scene_with(table, directory, &library)
}

/// Reads a scene whose materials are known already.
pub(crate) fn scene_with(
    table: &Table,
    directory: &Path,
    library: &Library,
) -> Result<Scene, SceneError> {
    let root = Section::root(table);
    root.allow(&SECTIONS)?;
    let target = read_target(&root, library)?;
    let settings = read_settings(root.section("contact")?.as_ref())?;
    let load = read_load(&root, &settings, library, directory)?;
    let (probes, section) = (read_probes(&root)?, read_section(&root)?);
    inside(&target, &probes, section.as_ref())?;
    let output = root.section("output")?;
    let (mut duration_s, mut quantities, mut peaks) = (None, Vec::new(), false);
    if let Some(output) = &output {
        output.allow(&["duration_s", "quantities", "peaks"])?;
        duration_s = output.number("duration_s", POSITIVE)?;
        quantities = output.choices("quantities")?;
        peaks = output.flag("peaks")?;
    }
    Ok(Scene {
        target,
        load,
        settings,
        probes,
        section,
        quantities,
        peaks,
        duration_s,
    })
}

/// The half-space and the striker of a parsed scene; none for a force record, whose file is not read.
///
/// # Errors
/// [`SceneError`].
pub(crate) fn bodies_of(table: &Table) -> Result<(HalfSpace, Option<Strike>), SceneError> {
    let (root, library) = (Section::root(table), Library::built_in());
    let target = read_target(&root, library)?;
    let striker = root.section("striker")?;
    let strike = striker.map(|section| read_strike(&section, library));
    Ok((target, strike.transpose()?))
}

fn read_target(root: &Section<'_>, library: &Library) -> Result<HalfSpace, SceneError> {
    let target = root
        .section("target")?
        .ok_or_else(|| root.missing("target", "describe the half-space in a section [target]"))?;
    target.allow(&with_elastic(&TARGET_KEYS))?;
    let material = body(&target, library)?;
    // the reader has checked the ranges: a density is all that can be missing
    let mut half_space = HalfSpace::new(material).map_err(|_| {
        target.missing(
            "density_kg_m3",
            "the half-space needs a density for its waves",
        )
    })?;
    half_space.thickness_m = target.number("thickness_m", POSITIVE)?;
    half_space.radius_m = target.number("radius_m", POSITIVE)?;
    Ok(half_space)
}

fn read_library(root: &Section<'_>, directory: &Path) -> Result<Library, SceneError> {
    let Some(section) = root.section("materials")? else {
        return Ok(Library::built_in().clone());
    };
    section.allow(&["file"])?;
    let file = section
        .text("file")?
        .ok_or_else(|| section.missing("file", "name a TOML file of materials"))?;
    let own = read_materials(&directory.join(file))?;
    Ok(Library::built_in().extended(&own))
}

fn read_settings(section: Option<&Section<'_>>) -> Result<Settings, SceneError> {
    let mut settings = Settings::default();
    let Some(section) = section else {
        return Ok(settings);
    };
    section.allow(&CONTACT_KEYS)?;
    settings.disc_radius_m = section.number("disc_radius_m", POSITIVE)?;
    settings.step_s = section.number("step_s", POSITIVE)?;
    settings.loss_tolerance = section.number("loss_tolerance", TOLERANCE)?;
    if let Some(tolerance) = section.number("tolerance", TOLERANCE)? {
        settings.tolerance = tolerance;
    }
    if let Some(model) = section.choice("model")? {
        settings.model = model;
    }
    if let Some(scheme) = section.choice("scheme")? {
        settings.scheme = scheme;
    }
    if let Some(share) = section.choice("static_share")? {
        settings.static_share = share;
    }
    if let Some(deflection) = section.choice("deflection")? {
        settings.deflection = deflection;
    }
    match settings.conflict() {
        None => Ok(settings),
        Some(conflict) => Err(in_words(conflict)),
    }
}

/// Settings that exclude each other, in the words of a scene.
fn in_words(conflict: Conflict) -> SceneError {
    let (first, second, reason) = match conflict {
        Conflict::ExplicitDynamic => (
            "contact.scheme = \"explicit\"",
            "static_share = \"dynamic\"".to_owned(),
            "the paper's kernel holds the static deflection",
        ),
        Conflict::ExplicitModel(model) => (
            "contact.scheme = \"explicit\"",
            format!("model = \"{}\"", model.name()),
            "the paper's scheme marches model wave only",
        ),
        Conflict::GrowingDisc => (
            "contact.model = \"growing\"",
            "disc_radius_m".to_owned(),
            "its contact radius follows the load",
        ),
    };
    SceneError::Conflict {
        first: first.to_owned(),
        second,
        reason,
    }
}

fn read_load(
    root: &Section<'_>,
    settings: &Settings,
    library: &Library,
    directory: &Path,
) -> Result<Load, SceneError> {
    match (root.section("striker")?, root.section("force")?) {
        (Some(striker), None) => read_strike(&striker, library).map(Load::Strike),
        (None, Some(force)) => {
            force.allow(&["file", "low_pass_hz", "baseline_s"])?;
            let file = force.text("file")?.ok_or_else(|| {
                force.missing("file", "name a CSV file with columns time_s,force_n or an HDF5 file with /time and /force")
            })?;
            if settings.disc_radius_m.is_none() {
                return Err(SceneError::Missing {
                    key: "contact.disc_radius_m".to_owned(),
                    hint: "a prescribed force needs the radius of the disc that it loads"
                        .to_owned(),
                });
            }
            let treatment = Treatment {
                baseline_s: force.number("baseline_s", POSITIVE)?,
                low_pass_hz: force.number("low_pass_hz", POSITIVE)?,
            };
            let record = read_record(&directory.join(file))?;
            Ok(Load::Record(record.treat(&treatment)?))
        }
        (Some(_), Some(_)) => Err(SceneError::Conflict {
            first: "[striker]".to_owned(),
            second: "[force]".to_owned(),
            reason: "the force is either computed or prescribed",
        }),
        (None, None) => Err(root.missing(
            "striker",
            "give a section [striker], or [force] with a prescribed history",
        )),
    }
}

/// Refuses what lies outside the block.
fn inside(
    block: &HalfSpace,
    probes: &[Probe],
    section: Option<&MeridionalSection>,
) -> Result<(), SceneError> {
    let within = |key: String, value: f64, limit: Option<f64>, range| match limit {
        Some(limit) if value > limit => Err(SceneError::OutOfRange { key, value, range }),
        Some(_) | None => Ok(()),
    };
    let at = |name: &str, [r, z]: [(&str, f64); 2]| {
        let key = |key: &str| format!("{name}.{key}");
        within(key(z.0), z.1, block.thickness_m, "[0, target.thickness_m]")?;
        within(key(r.0), r.1, block.radius_m, "[0, target.radius_m]")
    };
    for (i, probe) in probes.iter().enumerate() {
        let place = [("r_m", probe.r_m), ("z_m", probe.z_m)];
        at(&format!("probe[{}]", i + 1), place)?;
    }
    section.map_or(Ok(()), |section| {
        at(
            "map",
            [("r_max_m", section.r_max_m), ("z_max_m", section.z_max_m)],
        )
    })
}

fn read_probes(root: &Section<'_>) -> Result<Vec<Probe>, SceneError> {
    root.list("probe")?
        .iter()
        .map(|(name, table)| {
            let section = Section::of(name, table);
            section.allow(&["r_m", "z_m"])?;
            Ok(Probe {
                r_m: section.required("r_m", NOT_NEGATIVE, "the distance from the axis")?,
                z_m: section.required("z_m", NOT_NEGATIVE, "the depth below the surface")?,
            })
        })
        .collect()
}

fn read_section(root: &Section<'_>) -> Result<Option<MeridionalSection>, SceneError> {
    let Some(section) = root.section("map")? else {
        return Ok(None);
    };
    section.allow(&["r_max_m", "z_max_m", "points", "frames"])?;
    Ok(Some(MeridionalSection {
        r_max_m: section.required("r_max_m", POSITIVE, "the width of the section")?,
        z_max_m: section.required("z_max_m", POSITIVE, "the depth of the section")?,
        points: section
            .counts("points", 2, 2001, "[2, 2001]")?
            .ok_or_else(|| section.missing("points", "points along r and z, such as [81, 81]"))?,
        frames: section
            .count("frames", 1, 100_000, "[1, 100000]")?
            .ok_or_else(|| section.missing("frames", "the number of frames in time"))?,
    }))
}
