//! Sections with the keys of a body: an elastic material, in scenes and in materials files, and a striker with its
//! velocity, which is a mass with a tip, a ball or a rod.

use super::keys::{Form, Set, keys_of};
use super::section::read_text;
use super::section::{TomlSection, parse};
use crate::error::SceneError;
use contact::{BodyError, Choice, Library, Material, Shape, Striker};
use contact::{fall_velocity_m_s, from_wave_speeds};
use halfspace::DomainError;
use impact::Strike;
use std::path::Path;

/// Relative difference up to which two values of the same quantity count as equal but rounded.
const ROUNDED_DIFFERENCE: f64 = 0.02;

/// Reads a materials file: one section per material, with the keys of a scene's bodies plus `group` and `source`.
///
/// # Errors
/// [`SceneError`] with the file, the section and the key at fault.
pub fn read_materials(path: &Path) -> Result<Library, SceneError> {
    parse_materials(&read_text(path)?).map_err(|error| error.in_file(path))
}

/// Reads materials from text.
///
/// # Errors
/// [`SceneError`] with the section and the key at fault.
pub fn parse_materials(text: &str) -> Result<Library, SceneError> {
    let table = parse(text)?;
    let root = TomlSection::root(&table);
    let own = root.names().map(|name| {
        if name.is_empty() || name.contains(char::is_control) {
            let key = "the name of a material".to_owned();
            let shown = format!("\"{}\"", name.escape_default());
            let expected = "one or more printable characters";
            return Err(SceneError::wrong_kind(key, shown, expected));
        }
        let section = root.subsection(name, "a section")?;
        let allowed = keys_of("body").map(|key| key.name);
        section.allow(allowed.chain(["group", "source"]))?;
        let source = section.needed_text("source", "add the source of the numbers")?;
        let mut material = elastic(&section, None)?;
        material.name = section.name.to_owned();
        material.group = section.text("group")?.unwrap_or("other").to_owned();
        material.source = source.to_owned();
        Ok(material)
    });
    own.collect()
}

/// The material of a section that may name a material of a library.
pub(super) fn body(section: &TomlSection<'_>, library: &Library) -> Result<Material, SceneError> {
    let named = section.text("material")?.map(|name| library.find(name));
    let unknown = |unknown| SceneError::unknown_material(section.key("material"), unknown);
    elastic(section, named.transpose().map_err(unknown)?)
}

/// The elastic material of a section: the numbers of `base`, replaced by the given ones.
///
/// E and nu may be replaced by both wave speeds and the density.
fn elastic(section: &TomlSection<'_>, base: Option<&Material>) -> Result<Material, SceneError> {
    let mut material = base.cloned().unwrap_or_else(|| {
        let mut given = Material::given(f64::NAN, f64::NAN);
        given.source = "the scene".to_owned();
        given
    });
    for key in keys_of("body") {
        let number = section.number(key.name)?;
        if let (Some(Set::Body(set) | Set::Ball(set)), Some(number)) = (key.set, number) {
            set(&mut material, None, number);
        }
    }
    let speeds = from_speeds(section, material.density_kg_m3)?;
    let (modulus, ratio) = (&mut material.youngs_modulus_pa, &mut material.poisson_ratio);
    let constants = [
        ("youngs_modulus_pa", "Young's modulus", modulus),
        ("poisson_ratio", "Poisson's ratio", ratio),
    ];
    for (i, (key, quantity, own)) in constants.into_iter().enumerate() {
        match speeds.map(|found| found[i]) {
            Some((value, _)) if section.value(key).is_none() => *own = value,
            Some((value, size)) if (*own - value).abs() > ROUNDED_DIFFERENCE * size => {
                let (name, by) = (section.name, "longitudinal_speed_m_s and shear_speed_m_s");
                let sentence = format!(
                    "[{name}] defines {quantity} twice: {own} from {key} and {value} from {by}; remove one of them"
                );
                return Err(SceneError::of_number(by, value, sentence));
            }
            None if own.is_nan() => {
                return Err(section.missing(key, "add a material, youngs_modulus_pa and poisson_ratio, or both wave speeds and density_kg_m3"));
            }
            Some(_) | None => {}
        }
    }
    Ok(material)
}

/// Young's modulus in Pa and Poisson's ratio from the wave speeds, if given, each with the scale for comparing
/// differences.
fn from_speeds(
    section: &TomlSection<'_>,
    density: Option<f64>,
) -> Result<Option<[(f64, f64); 2]>, SceneError> {
    let both = "both wave speeds are required";
    let c1 = section.number("longitudinal_speed_m_s")?;
    let c2 = section.number("shear_speed_m_s")?;
    let (c1, c2) = match (c1, c2) {
        (None, None) => return Ok(None),
        (Some(_), None) => return Err(section.missing("shear_speed_m_s", both)),
        (None, Some(_)) => return Err(section.missing("longitudinal_speed_m_s", both)),
        (Some(c1), Some(c2)) => (c1, c2),
    };
    let hint = "wave speeds determine the moduli only with a density";
    let density = density.ok_or_else(|| section.missing("density_kg_m3", hint))?;
    // nu in (-1, 1/2) requires c2/c1 < sqrt(3)/2
    if c2 * c2 >= 0.75 * c1 * c1 {
        let key = section.key("shear_speed_m_s");
        let range = "(0, sqrt(3)/2) times longitudinal_speed_m_s";
        return Err(SceneError::out_of_range(key, c2, range));
    }
    let (modulus, ratio) = from_wave_speeds(c1, c2, density);
    Ok(Some([(modulus, modulus), (ratio, 0.5)]))
}

/// A striker with its velocity: a mass with a tip, or a body of a shape.
pub(super) fn read_strike(
    section: &TomlSection<'_>,
    library: &Library,
) -> Result<Strike, SceneError> {
    section.allow_keys_of("striker")?;
    let striker = match section.choice("shape")? {
        Some(form) => of_form(section, library, form)?,
        None if section.value("diameter_m").is_some() => {
            let hint = "diameter_m requires the shape \"ball\" or \"rod\"";
            return Err(section.missing("shape", hint));
        }
        None => Striker {
            material: body(section, library)?,
            mass_kg: section.needed("mass_kg")?,
            tip_radius_m: section.needed("tip_radius_m")?,
            length_m: section.number("length_m")?,
            shape: None,
        },
    };
    Ok(Strike {
        striker,
        velocity_m_s: velocity(section)?,
    })
}

/// A striker whose mass follows from its lengths and density.
fn of_form(
    section: &TomlSection<'_>,
    library: &Library,
    form: Form,
) -> Result<Striker, SceneError> {
    let (superfluous, reason): (&[&str], _) = match form {
        Form::Ball => (
            &["mass_kg", "tip_radius_m", "length_m"],
            "mass and tip of a ball follow from diameter_m and the density",
        ),
        Form::Rod => (
            &["mass_kg"],
            "the mass of a rod follows from length_m, diameter_m, tip_radius_m and the density",
        ),
    };
    if let Some(key) = superfluous.iter().find(|key| section.value(key).is_some()) {
        let beside = format!("shape = \"{}\"", form.name());
        return Err(SceneError::superfluous(section.key(key), &beside, reason));
    }
    let diameter_m = section.needed("diameter_m")?;
    let shape = match form {
        Form::Ball => Shape::Ball { diameter_m },
        Form::Rod => Shape::Rod {
            length_m: section.needed("length_m")?,
            diameter_m,
            tip_radius_m: section.number("tip_radius_m")?,
        },
    };
    let hint = "the mass of a shape follows from its density";
    Striker::of_shape(body(section, library)?, shape).map_err(|error| match error {
        BodyError::OutOfRange(DomainError::Range {
            argument,
            value,
            range,
        }) => SceneError::out_of_range(section.key(argument), value, range),
        _ => section.missing("density_kg_m3", hint),
    })
}

/// Velocity of approach in m/s, given directly or by the height of a fall.
fn velocity(section: &TomlSection<'_>) -> Result<f64, SceneError> {
    match section.number("drop_height_m")? {
        None => section.needed("velocity_m_s"),
        Some(_) if section.value("velocity_m_s").is_some() => Err(SceneError::superfluous(
            section.key("velocity_m_s"),
            &section.key("drop_height_m"),
            "the velocity follows from the height of the fall",
        )),
        Some(height_m) => Ok(fall_velocity_m_s(height_m)),
    }
}
