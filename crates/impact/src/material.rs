//! Elastic materials: a built-in library that a user's file can extend.

use crate::scene::{SceneError, nearest, reader};
use reader::{NOT_NEGATIVE, POISSON, POSITIVE, Section};
use std::collections::BTreeMap;
use std::sync::LazyLock;
use toml::Table;

/// An isotropic elastic material in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Its name in the library, or "given" when a scene spells out the numbers.
    pub name: String,
    /// Young's modulus E in Pa.
    pub youngs_modulus_pa: f64,
    /// Poisson's ratio nu.
    pub poisson_ratio: f64,
    /// Density in kg/m^3, where it is known.
    pub density_kg_m3: Option<f64>,
    /// Yield strength in Pa, where it is known.
    pub yield_strength_pa: Option<f64>,
    /// Tensile strength in Pa, where it is known.
    pub tensile_strength_pa: Option<f64>,
    /// Group in the library: metal, ceramic, glass, polymer, rock, concrete, soil.
    pub group: String,
    /// Where the numbers come from.
    pub source: String,
}

impl Material {
    /// Shear modulus mu = E/(2 (1 + nu)) in Pa.
    #[must_use]
    pub fn shear_modulus_pa(&self) -> f64 {
        0.5 * self.youngs_modulus_pa / (1.0 + self.poisson_ratio)
    }

    /// Plane modulus E/(1 - nu^2) in Pa.
    #[must_use]
    pub fn plane_modulus_pa(&self) -> f64 {
        self.youngs_modulus_pa / ((1.0 - self.poisson_ratio) * (1.0 + self.poisson_ratio))
    }

    /// Longitudinal wave speed in m/s; needs the density.
    #[must_use]
    pub fn longitudinal_speed_m_s(&self) -> Option<f64> {
        let nu = self.poisson_ratio;
        let modulus = self.shear_modulus_pa() * (2.0 - 2.0 * nu) / (1.0 - 2.0 * nu);
        self.density_kg_m3.map(|density| (modulus / density).sqrt())
    }

    /// Shear wave speed in m/s; needs the density.
    #[must_use]
    pub fn shear_speed_m_s(&self) -> Option<f64> {
        let modulus = self.shear_modulus_pa();
        self.density_kg_m3.map(|density| (modulus / density).sqrt())
    }
}

/// Materials by name.
#[derive(Debug, Clone, PartialEq)]
pub struct Library {
    materials: BTreeMap<String, Material>,
}

impl Library {
    /// The library that comes with the program.
    ///
    /// # Panics
    /// Never: a test reads it.
    #[must_use]
    pub fn built_in() -> &'static Self {
        static LIBRARY: LazyLock<Library> = LazyLock::new(|| {
            Library::from_toml(include_str!("materials.toml")).expect("a test reads this file")
        });
        &LIBRARY
    }

    /// Reads a library: one section a material, the keys of a scene's bodies plus `group` and `source`.
    ///
    /// # Errors
    /// [`SceneError`] with the section and key at fault.
    pub fn from_toml(text: &str) -> Result<Self, SceneError> {
        let table = reader::parse(text)?;
        let root = Section::root(&table);
        let mut materials = BTreeMap::new();
        for name in table.keys() {
            let Some(section) = root.section(name)? else {
                continue;
            };
            let mut allowed = ELASTIC_KEYS.to_vec();
            allowed.extend(["group", "source"]);
            section.allow(&allowed)?;
            let mut material = elastic(&section, None)?;
            material.name.clone_from(name);
            section
                .text("group")?
                .unwrap_or("other")
                .clone_into(&mut material.group);
            section
                .text("source")?
                .ok_or_else(|| section.missing("source", "say where the numbers come from"))?
                .clone_into(&mut material.source);
            materials.insert(name.clone(), material);
        }
        Ok(Self { materials })
    }

    /// This library with the materials of another added; equal names are replaced.
    #[must_use]
    pub fn extended(&self, other: &Self) -> Self {
        let mut materials = self.materials.clone();
        materials.extend(other.materials.clone());
        Self { materials }
    }

    /// A material by its exact name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Material> {
        self.materials.get(name)
    }

    /// All materials, by name.
    pub fn iter(&self) -> impl Iterator<Item = &Material> {
        self.materials.values()
    }

    /// Materials whose name, group or source contains `word`, in any case.
    pub fn search<'a>(&'a self, word: &str) -> impl Iterator<Item = &'a Material> {
        let word = word.to_lowercase();
        self.iter().filter(move |m| {
            [&m.name, &m.group, &m.source]
                .iter()
                .any(|text| text.to_lowercase().contains(&word))
        })
    }

    pub(crate) fn find(&self, key: String, name: &str) -> Result<&Material, SceneError> {
        self.get(name).ok_or_else(|| SceneError::UnknownMaterial {
            key,
            value: name.to_owned(),
            suggestion: nearest(name, self.materials.keys().map(String::as_str)),
        })
    }
}

/// Keys that describe an elastic body.
pub(crate) const ELASTIC_KEYS: [&str; 7] = [
    "youngs_modulus_pa",
    "poisson_ratio",
    "density_kg_m3",
    "longitudinal_speed_m_s",
    "shear_speed_m_s",
    "yield_strength_pa",
    "tensile_strength_pa",
];

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
    let modulus = section.number("youngs_modulus_pa", POSITIVE)?;
    let ratio = section.number("poisson_ratio", POISSON)?;
    let (c1, c2) = (
        section.number("longitudinal_speed_m_s", POSITIVE)?,
        section.number("shear_speed_m_s", POSITIVE)?,
    );
    let from_speeds = match (c1, c2) {
        (None, None) => None,
        (Some(_), None) => Some(Err(("shear_speed_m_s", "both wave speeds are needed"))),
        (None, Some(_)) => Some(Err((
            "longitudinal_speed_m_s",
            "both wave speeds are needed",
        ))),
        (Some(c1), Some(c2)) => Some(Ok((c1, c2))),
    };
    let from_speeds = match from_speeds {
        None => None,
        Some(Err((key, hint))) => return Err(section.missing(key, hint)),
        Some(Ok((c1, c2))) => {
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
            let k = (c2 / c1).powi(2);
            let nu = (1.0 - 2.0 * k) / (2.0 - 2.0 * k);
            Some((2.0 * density * c2 * c2 * (1.0 + nu), nu))
        }
    };
    if let Some((speed_modulus, speed_ratio)) = from_speeds {
        let twice = |quantity, first_key, given: Option<f64>, second: f64, size: f64| match given {
            Some(first) if (first - second).abs() > ROUNDING * size => {
                Err(SceneError::Inconsistent {
                    section: format!("[{}]", section.name()),
                    quantity,
                    first,
                    first_key,
                    second,
                    second_key: "longitudinal_speed_m_s and shear_speed_m_s",
                })
            }
            Some(_) | None => Ok(()),
        };
        twice(
            "Young's modulus",
            "youngs_modulus_pa",
            modulus,
            speed_modulus,
            speed_modulus,
        )?;
        twice("Poisson's ratio", "poisson_ratio", ratio, speed_ratio, 0.5)?;
    }
    let hint = "give a material, youngs_modulus_pa and poisson_ratio, or both wave speeds and density_kg_m3";
    let youngs_modulus_pa = modulus
        .or(from_speeds.map(|s| s.0))
        .or(base.map(|b| b.youngs_modulus_pa))
        .ok_or_else(|| section.missing("youngs_modulus_pa", hint))?;
    let poisson_ratio = ratio
        .or(from_speeds.map(|s| s.1))
        .or(base.map(|b| b.poisson_ratio))
        .ok_or_else(|| section.missing("poisson_ratio", hint))?;
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
        group: base.map_or_else(String::new, |b| b.group.clone()),
        source: base.map_or_else(|| "the scene".to_owned(), |b| b.source.clone()),
    })
}

/// The numbers of a material as TOML keys, for the resolved scene.
pub(crate) fn to_table(material: &Material) -> Table {
    let mut table = Table::new();
    let mut put = |key: &str, value: Option<f64>| {
        if let Some(value) = value {
            table.insert(key.to_owned(), value.into());
        }
    };
    put("youngs_modulus_pa", Some(material.youngs_modulus_pa));
    put("poisson_ratio", Some(material.poisson_ratio));
    put("density_kg_m3", material.density_kg_m3);
    put("yield_strength_pa", material.yield_strength_pa);
    put("tensile_strength_pa", material.tensile_strength_pa);
    table
}
