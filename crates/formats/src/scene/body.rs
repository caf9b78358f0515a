//! Bodies as sections of keys: an elastic one, in scenes and in files of materials, and a striker, which is a mass with a
//! tip, a ball or a rod, with its velocity.

use super::keys::keys_of;
use super::section::read_text;
use super::section::{Section, parse};
use crate::error::SceneError;
use contact::{BodyError, Choice, Library, Material, Shape, Striker, choice};
use contact::{fall_velocity_m_s, from_wave_speeds};
use impact::Strike;
use std::path::Path;

/// Relative difference up to which quantities given twice are taken as rounded, not different.
const ROUNDING: f64 = 0.02;

/// Reads a file of materials: one section a material, the keys of a scene's bodies plus `group` and `source`.
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
    let root = Section::root(&table);
    let own = root.names().map(|name| {
        let section = root.subsection(name, "a section")?;
        let allowed = keys_of("body").map(|key| key.name);
        section.allow(allowed.chain(["group", "source"]))?;
        let source = section
            .text("source")?
            .ok_or_else(|| section.missing("source", "say where the numbers come from"))?;
        Ok(Material {
            name: section.name().to_owned(),
            group: section.text("group")?.unwrap_or("other").to_owned(),
            source: source.to_owned(),
            ..elastic(&section, None)?
        })
    });
    own.collect()
}

/// The body of a section that may name a material of a library.
pub(super) fn body(section: &Section<'_>, library: &Library) -> Result<Material, SceneError> {
    let named = section.text("material")?.map(|name| library.find(name));
    let base = named.transpose();
    let base = base.map_err(|unknown| {
        SceneError::unknown_material(section.key("material"), &unknown.name, unknown.suggestion)
    })?;
    elastic(section, base)
}

/// The elastic body of a section: the numbers of `base` with those given replaced.
///
/// E and nu may be given by both wave speeds and the density instead.
fn elastic(section: &Section<'_>, base: Option<&Material>) -> Result<Material, SceneError> {
    let density = section.number("density_kg_m3")?;
    let density = density.or_else(|| base.and_then(|b| b.density_kg_m3));
    let (youngs_modulus_pa, poisson_ratio) = constants(section, base, density)?;
    let strength = |key, known: Option<f64>| -> Result<Option<f64>, SceneError> {
        let strength = section.number(key)?.or(known);
        Ok(strength.filter(|&strength| strength > 0.0))
    };
    Ok(Material {
        name: base.map_or_else(|| "given".to_owned(), |b| b.name.clone()),
        youngs_modulus_pa,
        poisson_ratio,
        density_kg_m3: density,
        yield_strength_pa: strength("yield_strength_pa", base.and_then(|b| b.yield_strength_pa))?,
        tensile_strength_pa: strength(
            "tensile_strength_pa",
            base.and_then(|b| b.tensile_strength_pa),
        )?,
        fracture_toughness_pa_sqrt_m: strength(
            "fracture_toughness_pa_sqrt_m",
            base.and_then(|b| b.fracture_toughness_pa_sqrt_m),
        )?,
        group: base.map_or_else(String::new, |b| b.group.clone()),
        source: base.map_or_else(|| "the scene".to_owned(), |b| b.source.clone()),
    })
}

/// Young's modulus in Pa and Poisson's ratio: as given, from the wave speeds, or those of `base`.
fn constants(
    section: &Section<'_>,
    base: Option<&Material>,
    density: Option<f64>,
) -> Result<(f64, f64), SceneError> {
    let given = (
        section.number("youngs_modulus_pa")?,
        section.number("poisson_ratio")?,
    );
    let speeds = from_speeds(section, density)?;
    if let Some((modulus, ratio)) = speeds {
        let twice = |quantity, key, given: Option<f64>, speeds: f64, size: f64| match given {
            Some(first) if (first - speeds).abs() > ROUNDING * size => {
                let (name, by) = (section.name(), "longitudinal_speed_m_s and shear_speed_m_s");
                let sentence = format!(
                    "[{name}] gives {quantity} twice: {first} from {key} and {speeds} from {by}; leave one pair out"
                );
                Err(SceneError::of_number(by, speeds, sentence))
            }
            Some(_) | None => Ok(()),
        };
        let key = "youngs_modulus_pa";
        twice("Young's modulus", key, given.0, modulus, modulus)?;
        twice("Poisson's ratio", "poisson_ratio", given.1, ratio, 0.5)?;
    }
    let known = speeds.or(base.map(|b| (b.youngs_modulus_pa, b.poisson_ratio)));
    let missing = |key: &str| {
        section.missing(key, "give a material, youngs_modulus_pa and poisson_ratio, or both wave speeds and density_kg_m3")
    };
    Ok((
        (given.0.or(known.map(|k| k.0))).ok_or_else(|| missing("youngs_modulus_pa"))?,
        (given.1.or(known.map(|k| k.1))).ok_or_else(|| missing("poisson_ratio"))?,
    ))
}

/// Young's modulus in Pa and Poisson's ratio from the wave speeds, where they are given.
fn from_speeds(
    section: &Section<'_>,
    density: Option<f64>,
) -> Result<Option<(f64, f64)>, SceneError> {
    let both = "both wave speeds are needed";
    let c1 = section.number("longitudinal_speed_m_s")?;
    let c2 = section.number("shear_speed_m_s")?;
    let (c1, c2) = match (c1, c2) {
        (None, None) => return Ok(None),
        (Some(_), None) => return Err(section.missing("shear_speed_m_s", both)),
        (None, Some(_)) => return Err(section.missing("longitudinal_speed_m_s", both)),
        (Some(c1), Some(c2)) => (c1, c2),
    };
    let hint = "wave speeds give moduli only with a density";
    let density = density.ok_or_else(|| section.missing("density_kg_m3", hint))?;
    // nu in (-1, 1/2) needs c2/c1 < sqrt(3)/2
    if c2 * c2 >= 0.75 * c1 * c1 {
        return Err(SceneError::out_of_range(
            section.key("shear_speed_m_s"),
            c2,
            "(0, sqrt(3)/2) times longitudinal_speed_m_s",
        ));
    }
    Ok(Some(from_wave_speeds(c1, c2, density)))
}

/// What a striker is said to be, where mass and tip follow from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    Ball,
    Rod,
}

choice!(Form: Ball = "ball", Rod = "rod");

impl Form {
    pub(super) fn of(shape: Shape) -> Self {
        match shape {
            Shape::Ball { .. } => Self::Ball,
            Shape::Rod { .. } => Self::Rod,
        }
    }
}

pub(super) fn read_strike(section: &Section<'_>, library: &Library) -> Result<Strike, SceneError> {
    section.allow_keys_of("striker")?;
    let striker = match section.choice("shape")? {
        None => plain(section, library)?,
        Some(form) => of_form(section, library, form)?,
    };
    Ok(Strike {
        striker,
        velocity_m_s: velocity(section)?,
    })
}

/// A mass with a tip.
fn plain(section: &Section<'_>, library: &Library) -> Result<Striker, SceneError> {
    if section.value("diameter_m").is_some() {
        return Err(section.missing("shape", "say whose diameter_m it is: \"ball\" or \"rod\""));
    }
    Ok(Striker {
        material: body(section, library)?,
        mass_kg: section.needed("mass_kg")?,
        tip_radius_m: section.needed("tip_radius_m")?,
        length_m: section.number("length_m")?,
        shape: None,
    })
}

/// A body whose mass follows from lengths and a density.
fn of_form(section: &Section<'_>, library: &Library, form: Form) -> Result<Striker, SceneError> {
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
        return Err(SceneError::superfluous(
            section.key(key),
            &format!("shape = \"{}\"", form.name()),
            reason,
        ));
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
        BodyError::NoDensity { .. } => section.missing("density_kg_m3", hint),
        BodyError::OutOfRange {
            quantity,
            value,
            range,
        } => SceneError::out_of_range(section.key(quantity), value, range),
    })
}

/// Velocity of approach in m/s: as given, or after a fall.
fn velocity(section: &Section<'_>) -> Result<f64, SceneError> {
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
