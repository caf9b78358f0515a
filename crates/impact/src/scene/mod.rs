//! Scenes: what hits what, and what is asked, read from TOML in SI units.
//!
//! The format is written down in `data-schema/scene.md`.

mod error;
pub(crate) mod force_file;
mod force_hdf;
pub(crate) mod reader;

pub use error::SceneError;
pub use force_file::PrescribedForce;

pub(crate) use error::nearest;

use crate::march::StaticShare;
use crate::material::{ELASTIC_KEYS, Library, Material, elastic, to_table};
use halfspace::Deflection;
use reader::{NOT_NEGATIVE, POSITIVE, Section, TOLERANCE};
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// The contact model asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Model {
    /// Closed form, no waves.
    Hertz,
    /// First-order radiated loss.
    Radiation,
    /// Hertz's spring in series with the disc's static one, no waves.
    QuasiStatic,
    /// The same with the first-order radiated loss.
    QuasiStaticRadiation,
    /// Full retarded deflection of a disc of fixed radius: the paper.
    Wave,
    /// Contact radius that follows the load.
    Growing,
    /// The cheapest of these that meets the tolerance.
    Auto,
}

/// The marching scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Scheme {
    /// Product integration, any step.
    Implicit,
    /// The paper's (40)-(44).
    Explicit,
}

/// Names of the models in scenes and results.
pub const MODELS: [(&str, Model); 7] = [
    ("hertz", Model::Hertz),
    ("radiation", Model::Radiation),
    ("quasi_static", Model::QuasiStatic),
    ("quasi_static_radiation", Model::QuasiStaticRadiation),
    ("wave", Model::Wave),
    ("growing", Model::Growing),
    ("auto", Model::Auto),
];
/// Names of the schemes.
pub const SCHEMES: [(&str, Scheme); 2] = [
    ("implicit", Scheme::Implicit),
    ("explicit", Scheme::Explicit),
];
/// Names of the static shares.
pub const SHARES: [(&str, StaticShare); 2] = [
    ("full", StaticShare::Full),
    ("dynamic", StaticShare::Dynamic),
];
/// Names of the deflections.
pub const DEFLECTIONS: [(&str, Deflection); 2] =
    [("centre", Deflection::Centre), ("mean", Deflection::Mean)];

/// The name of a choice in one of the lists above.
#[must_use]
pub fn name_of<T: PartialEq + Copy>(choices: &[(&'static str, T)], choice: T) -> &'static str {
    choices
        .iter()
        .find(|(_, c)| *c == choice)
        .map_or("", |(name, _)| name)
}

/// The body that strikes.
#[derive(Debug, Clone, PartialEq)]
pub struct Striker {
    /// What it is made of.
    pub material: Material,
    /// Mass in kg.
    pub mass_kg: f64,
    /// Radius of its tip in m.
    pub tip_radius_m: f64,
    /// Velocity of approach in m/s.
    pub velocity_m_s: f64,
    /// Length in m of a rod, for the check of its free oscillations.
    pub length_m: Option<f64>,
}

/// How the contact is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Radius of the loaded disc in m, if the scene fixes it.
    pub disc_radius_m: Option<f64>,
    /// Model.
    pub model: Model,
    /// Marching scheme.
    pub scheme: Scheme,
    /// Static share.
    pub static_share: StaticShare,
    /// Deflection.
    pub deflection: Deflection,
    /// Relative tolerance on the results.
    pub tolerance: f64,
    /// Relative tolerance on the loss 1 - e^2, if it is asked for.
    pub loss_tolerance: Option<f64>,
    /// Fixed step in s.
    pub step_s: Option<f64>,
}

/// What loads the half-space.
#[derive(Debug, Clone, PartialEq)]
pub enum Load {
    /// A striker.
    Strike(Striker),
    /// A prescribed force on a disc.
    Prescribed(PrescribedForce),
}

/// A point of the half-space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probe {
    /// Distance from the axis in m.
    pub r_m: f64,
    /// Depth in m.
    pub z_m: f64,
}

/// A meridional section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Map {
    /// Largest distance from the axis in m.
    pub r_max_m: f64,
    /// Largest depth in m.
    pub z_max_m: f64,
    /// Points along r and z.
    pub points: [usize; 2],
    /// Frames in time.
    pub frames: usize,
}

/// A scene, validated.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The half-space.
    pub target: Material,
    /// Density of the half-space in kg/m^3.
    pub target_density_kg_m3: f64,
    /// Thickness of the block in m, for the check of reflections.
    pub target_thickness_m: Option<f64>,
    /// What loads it.
    pub load: Load,
    /// How the contact is computed.
    pub contact: Contact,
    /// Where fields are asked for.
    pub probes: Vec<Probe>,
    /// Section of the field asked for.
    pub map: Option<Map>,
    /// Time in s that the output covers, if the scene says so.
    pub duration_s: Option<f64>,
}

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

impl Scene {
    /// Reads a scene file; other files it names are found beside it.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_file(path: &Path) -> Result<Self, SceneError> {
        let text = read_text(path)?;
        Self::from_toml(&text, path.parent().unwrap_or(Path::new(".")))
    }

    /// Reads a scene; other files it names are found in `directory`.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_toml(text: &str, directory: &Path) -> Result<Self, SceneError> {
        Self::from_table(&reader::parse(text)?, directory)
    }

    /// Reads a scene from a parsed table, as sweeps make them.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_table(table: &Table, directory: &Path) -> Result<Self, SceneError> {
        let root = Section::root(table);
        root.allow(&SECTIONS)?;
        let library = read_library(&root, directory)?;
        let target = root.section("target")?.ok_or_else(|| {
            root.missing("target", "describe the half-space in a section [target]")
        })?;
        target.allow(&with(&ELASTIC_KEYS, &["material", "thickness_m"]))?;
        let target_material = body(&target, &library)?;
        let target_density_kg_m3 = target_material.density_kg_m3.ok_or_else(|| {
            target.missing(
                "density_kg_m3",
                "the half-space needs a density for its waves",
            )
        })?;
        let contact_section = root.section("contact")?;
        let contact = read_contact(contact_section.as_ref())?;
        let load = read_load(&root, &contact, &library, directory)?;
        let (probes, map) = (read_probes(&root)?, read_map(&root)?);
        let output = root.section("output")?;
        if let Some(output) = &output {
            output.allow(&["duration_s"])?;
        }
        let duration_s = match &output {
            Some(output) => output.number("duration_s", POSITIVE)?,
            None => None,
        };
        Ok(Self {
            target: target_material,
            target_density_kg_m3,
            target_thickness_m: target.number("thickness_m", POSITIVE)?,
            load,
            contact,
            probes,
            map,
            duration_s,
        })
    }

    /// The scene with every default and material spelled out, as TOML.
    #[must_use]
    pub fn resolved(&self) -> String {
        let mut root = Table::new();
        let mut target = to_table(&self.target);
        put(&mut target, "thickness_m", self.target_thickness_m);
        root.insert("target".into(), Value::Table(target));
        match &self.load {
            Load::Strike(striker) => {
                let mut table = to_table(&striker.material);
                put(&mut table, "mass_kg", Some(striker.mass_kg));
                put(&mut table, "tip_radius_m", Some(striker.tip_radius_m));
                put(&mut table, "velocity_m_s", Some(striker.velocity_m_s));
                put(&mut table, "length_m", striker.length_m);
                root.insert("striker".into(), Value::Table(table));
            }
            Load::Prescribed(force) => {
                let mut table = Table::new();
                table.insert("file".into(), force.path.display().to_string().into());
                root.insert("force".into(), Value::Table(table));
            }
        }
        root.insert("contact".into(), Value::Table(self.contact.to_table()));
        let probes = self.probes.iter().map(|probe| {
            let mut table = Table::new();
            put(&mut table, "r_m", Some(probe.r_m));
            put(&mut table, "z_m", Some(probe.z_m));
            Value::Table(table)
        });
        if !self.probes.is_empty() {
            root.insert("probe".into(), Value::Array(probes.collect()));
        }
        if let Some(map) = self.map {
            let mut table = Table::new();
            put(&mut table, "r_max_m", Some(map.r_max_m));
            put(&mut table, "z_max_m", Some(map.z_max_m));
            let points = map.points.map(|n| Value::Integer(n as i64));
            table.insert("points".into(), Value::Array(points.to_vec()));
            table.insert("frames".into(), Value::Integer(map.frames as i64));
            root.insert("map".into(), Value::Table(table));
        }
        if self.duration_s.is_some() {
            let mut table = Table::new();
            put(&mut table, "duration_s", self.duration_s);
            root.insert("output".into(), Value::Table(table));
        }
        root.to_string()
    }
}

impl Contact {
    fn to_table(self) -> Table {
        let mut table = Table::new();
        let mut word = |key: &str, value: &str| {
            table.insert(key.to_owned(), value.into());
        };
        word("model", name_of(&MODELS, self.model));
        word("scheme", name_of(&SCHEMES, self.scheme));
        word("static_share", name_of(&SHARES, self.static_share));
        word("deflection", name_of(&DEFLECTIONS, self.deflection));
        put(&mut table, "disc_radius_m", self.disc_radius_m);
        put(&mut table, "tolerance", Some(self.tolerance));
        put(&mut table, "loss_tolerance", self.loss_tolerance);
        put(&mut table, "step_s", self.step_s);
        table
    }
}

fn put(table: &mut Table, key: &str, value: Option<f64>) {
    if let Some(value) = value {
        table.insert(key.to_owned(), value.into());
    }
}

fn with(keys: &[&'static str], more: &[&'static str]) -> Vec<&'static str> {
    [more, keys].concat()
}

pub(crate) fn read_text(path: &Path) -> Result<String, SceneError> {
    std::fs::read_to_string(path).map_err(|error| SceneError::Unreadable {
        path: path.to_owned(),
        reason: error.to_string(),
    })
}

fn beside(directory: &Path, file: &str) -> PathBuf {
    directory.join(file)
}

fn read_library(root: &Section<'_>, directory: &Path) -> Result<Library, SceneError> {
    let Some(section) = root.section("materials")? else {
        return Ok(Library::built_in().clone());
    };
    section.allow(&["file"])?;
    let file = section
        .text("file")?
        .ok_or_else(|| section.missing("file", "name a TOML file of materials"))?;
    let own = Library::from_toml(&read_text(&beside(directory, file))?)?;
    Ok(Library::built_in().extended(&own))
}

fn body(section: &Section<'_>, library: &Library) -> Result<Material, SceneError> {
    let base = match section.text("material")? {
        Some(name) => Some(library.find(section.key("material"), name)?),
        None => None,
    };
    elastic(section, base)
}

fn read_contact(section: Option<&Section<'_>>) -> Result<Contact, SceneError> {
    let mut contact = Contact {
        disc_radius_m: None,
        model: Model::Auto,
        scheme: Scheme::Implicit,
        static_share: StaticShare::Full,
        deflection: Deflection::Centre,
        tolerance: 1e-4,
        loss_tolerance: None,
        step_s: None,
    };
    let Some(section) = section else {
        return Ok(contact);
    };
    section.allow(&[
        "disc_radius_m",
        "model",
        "scheme",
        "static_share",
        "deflection",
        "tolerance",
        "loss_tolerance",
        "step_s",
    ])?;
    contact.disc_radius_m = section.number("disc_radius_m", POSITIVE)?;
    contact.step_s = section.number("step_s", POSITIVE)?;
    contact.loss_tolerance = section.number("loss_tolerance", TOLERANCE)?;
    if let Some(tolerance) = section.number("tolerance", TOLERANCE)? {
        contact.tolerance = tolerance;
    }
    if let Some(model) = section.choice("model", &MODELS)? {
        contact.model = model;
    }
    if let Some(scheme) = section.choice("scheme", &SCHEMES)? {
        contact.scheme = scheme;
    }
    if let Some(share) = section.choice("static_share", &SHARES)? {
        contact.static_share = share;
    }
    if let Some(deflection) = section.choice("deflection", &DEFLECTIONS)? {
        contact.deflection = deflection;
    }
    check_choices(&contact)?;
    Ok(contact)
}

/// Choices that exclude each other.
fn check_choices(contact: &Contact) -> Result<(), SceneError> {
    let conflict = |first: &str, second: &str, reason| {
        Err(SceneError::Conflict {
            first: first.to_owned(),
            second: second.to_owned(),
            reason,
        })
    };
    if contact.scheme == Scheme::Explicit {
        if contact.static_share == StaticShare::Dynamic {
            return conflict(
                "contact.scheme = \"explicit\"",
                "static_share = \"dynamic\"",
                "the paper's kernel holds the static deflection",
            );
        }
        if !matches!(contact.model, Model::Wave | Model::Auto) {
            return conflict(
                "contact.scheme = \"explicit\"",
                &format!("model = \"{}\"", name_of(&MODELS, contact.model)),
                "the paper's scheme marches model wave only",
            );
        }
    }
    if contact.model == Model::Growing && contact.disc_radius_m.is_some() {
        return conflict(
            "contact.model = \"growing\"",
            "disc_radius_m",
            "its contact radius follows the load",
        );
    }
    Ok(())
}

fn read_load(
    root: &Section<'_>,
    contact: &Contact,
    library: &Library,
    directory: &Path,
) -> Result<Load, SceneError> {
    match (root.section("striker")?, root.section("force")?) {
        (Some(striker), None) => read_striker(&striker, library).map(Load::Strike),
        (None, Some(force)) => {
            force.allow(&["file"])?;
            let file = force.text("file")?.ok_or_else(|| {
                force.missing("file", "name a CSV file with columns time_s,force_n or an HDF5 file with /time and /force")
            })?;
            if contact.disc_radius_m.is_none() {
                return Err(SceneError::Missing {
                    key: "contact.disc_radius_m".to_owned(),
                    hint: "a prescribed force needs the radius of the disc that it loads"
                        .to_owned(),
                });
            }
            PrescribedForce::from_file(&beside(directory, file)).map(Load::Prescribed)
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

fn read_striker(section: &Section<'_>, library: &Library) -> Result<Striker, SceneError> {
    section.allow(&with(
        &ELASTIC_KEYS,
        &[
            "material",
            "mass_kg",
            "tip_radius_m",
            "velocity_m_s",
            "length_m",
        ],
    ))?;
    Ok(Striker {
        material: body(section, library)?,
        mass_kg: section.required("mass_kg", POSITIVE, "the mass of the striker")?,
        tip_radius_m: section.required(
            "tip_radius_m",
            POSITIVE,
            "the radius of the striker's tip",
        )?,
        velocity_m_s: section.required("velocity_m_s", POSITIVE, "the velocity of approach")?,
        length_m: section.number("length_m", POSITIVE)?,
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

fn read_map(root: &Section<'_>) -> Result<Option<Map>, SceneError> {
    let Some(section) = root.section("map")? else {
        return Ok(None);
    };
    section.allow(&["r_max_m", "z_max_m", "points", "frames"])?;
    Ok(Some(Map {
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
