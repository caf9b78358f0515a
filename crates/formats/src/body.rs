//! An elastic body as a section of keys.

use crate::error::SceneError;
use crate::section::{NOT_NEGATIVE, POISSON, POSITIVE, Section};
use contact::from_wave_speeds;
use contact::{Library, Material};
use toml::Table;

/// Keys that describe an elastic body.
pub(crate) const ELASTIC_KEYS: [&str; 8] = [
    "youngs_modulus_pa",
    "poisson_ratio",
    "density_kg_m3",
    "longitudinal_speed_m_s",
    "shear_speed_m_s",
    "yield_strength_pa",
    "tensile_strength_pa",
    "fracture_toughness_pa_sqrt_m",
];

/// Those keys after others of a section.
pub(crate) fn with_elastic(others: &[&'static str]) -> Vec<&'static str> {
    [others, &ELASTIC_KEYS].concat()
}

/// Relative difference up to which quantities given twice are taken as rounded, not different.
const ROUNDING: f64 = 0.02;

/// The elastic body of a section: the numbers of `base` with those given replaced.
///
/// E and nu may be given by both wave speeds and the density instead.
pub(crate) fn elastic(
    section: &Section<'_>,
    base: Option<&Material>,
) -> Result<Material, SceneError> {
    let density = section.number("density_kg_m3", POSITIVE)?;
    let density = density.or_else(|| base.and_then(|b| b.density_kg_m3));
    let (youngs_modulus_pa, poisson_ratio) = constants(section, base, density)?;
    let strength = |key, base: Option<f64>| -> Result<Option<f64>, SceneError> {
        Ok(section
            .number(key, NOT_NEGATIVE)?
            .or(base)
            .filter(|&s| s > 0.0))
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
    let modulus = section.number("youngs_modulus_pa", POSITIVE)?;
    let ratio = section.number("poisson_ratio", POISSON)?;
    let from_speeds = from_speeds(section, density)?;
    if let Some((speed_modulus, speed_ratio)) = from_speeds {
        let twice = |quantity, key, given: Option<f64>, speeds: f64, size: f64| match given {
            Some(first) if (first - speeds).abs() > ROUNDING * size => {
                Err(SceneError::Inconsistent {
                    section: format!("[{}]", section.name()),
                    quantity,
                    first,
                    first_key: key,
                    second: speeds,
                    second_key: "longitudinal_speed_m_s and shear_speed_m_s",
                })
            }
            Some(_) | None => Ok(()),
        };
        let key = "youngs_modulus_pa";
        twice(
            "Young's modulus",
            key,
            modulus,
            speed_modulus,
            speed_modulus,
        )?;
        twice("Poisson's ratio", "poisson_ratio", ratio, speed_ratio, 0.5)?;
    }
    let hint = "give a material, youngs_modulus_pa and poisson_ratio, or both wave speeds and density_kg_m3";
    let modulus = modulus
        .or(from_speeds.map(|s| s.0))
        .or(base.map(|b| b.youngs_modulus_pa))
        .ok_or_else(|| section.missing("youngs_modulus_pa", hint))?;
    let ratio = ratio
        .or(from_speeds.map(|s| s.1))
        .or(base.map(|b| b.poisson_ratio))
        .ok_or_else(|| section.missing("poisson_ratio", hint))?;
    Ok((modulus, ratio))
}

/// Young's modulus in Pa and Poisson's ratio from the wave speeds, where they are given.
fn from_speeds(
    section: &Section<'_>,
    density: Option<f64>,
) -> Result<Option<(f64, f64)>, SceneError> {
    let both = "both wave speeds are needed";
    let c1 = section.number("longitudinal_speed_m_s", POSITIVE)?;
    let c2 = section.number("shear_speed_m_s", POSITIVE)?;
    let (c1, c2) = match (c1, c2) {
        (None, None) => return Ok(None),
        (Some(_), None) => return Err(section.missing("shear_speed_m_s", both)),
        (None, Some(_)) => return Err(section.missing("longitudinal_speed_m_s", both)),
        (Some(c1), Some(c2)) => (c1, c2),
    };
    let density = density.ok_or_else(|| {
        section.missing(
            "density_kg_m3",
            "wave speeds give moduli only with a density",
        )
    })?;
    // nu in (-1, 1/2) needs c2/c1 < sqrt(3)/2
    if c2 * c2 >= 0.75 * c1 * c1 {
        return Err(SceneError::OutOfRange {
            key: section.key("shear_speed_m_s"),
            value: c2,
            range: "(0, sqrt(3)/2) times longitudinal_speed_m_s",
        });
    }
    Ok(Some(from_wave_speeds(c1, c2, density)))
}

/// The body of a section that may name a material of a library.
pub(crate) fn body(section: &Section<'_>, library: &Library) -> Result<Material, SceneError> {
    let base = match section.text("material")? {
        Some(name) => Some(
            library
                .find(name)
                .map_err(|unknown| SceneError::UnknownMaterial {
                    key: section.key("material"),
                    value: unknown.name,
                    suggestion: unknown.suggestion,
                })?,
        ),
        None => None,
    };
    elastic(section, base)
}

/// A number of a material that may be unknown.
type Own = fn(&Material) -> Option<f64>;

/// The numbers of a material as TOML keys, for the resolved scene.
pub(crate) fn to_table(material: &Material) -> Table {
    let mut table = Table::new();
    // the numbers replace all of it; where one is unknown, 0 says so
    let named = Library::built_in().get(&material.name);
    let known = named.filter(|_| material.density_kg_m3.is_some());
    if known.is_some() {
        table.insert("material".to_owned(), material.name.as_str().into());
    }
    let mut put = |key: &str, value: Option<f64>| {
        if let Some(value) = value {
            table.insert(key.to_owned(), value.into());
        }
    };
    put("youngs_modulus_pa", Some(material.youngs_modulus_pa));
    put("poisson_ratio", Some(material.poisson_ratio));
    put("density_kg_m3", material.density_kg_m3);
    let strengths: [(&str, Own); 3] = [
        ("yield_strength_pa", |m| m.yield_strength_pa),
        ("tensile_strength_pa", |m| m.tensile_strength_pa),
        ("fracture_toughness_pa_sqrt_m", |m| {
            m.fracture_toughness_pa_sqrt_m
        }),
    ];
    for (key, of) in strengths {
        put(
            key,
            of(material).or_else(|| known.and_then(of).map(|_| 0.0)),
        );
    }
    table
}
