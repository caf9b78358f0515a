//! Materials by name: the built-in library, which a user's materials can extend.

use crate::bodies::material::{Material, from_wave_speeds};
use crate::names::nearest;
use std::collections::BTreeMap;
use std::sync::LazyLock;
use thiserror::Error;

/// The built-in materials, a line each, with elastic constants or both wave speeds.
///
/// "typical" marks a class whose members scatter; replace it by measured values where they matter.
/// "quoted after" marks numbers that were found in other people's tables under that name, and not in the work itself:
/// Farmer's ranges stand so in tables of rock strengths, those of toughness were not found in a text that is open to
/// read. Of Petrovic the abstract was read; Gercek's abstract says that ranges are given. Handbooks and standards are
/// cited for the kind of value, not page by page.
const BUILT_IN: &str = include_str!("materials.tsv");

/// A name that no material has.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "\"{name}\" is not in the materials library{}",
    suggestion.as_ref().map_or_else(String::new, |near| format!("; did you mean {near}?"))
)]
pub struct UnknownMaterial {
    /// The name.
    pub name: String,
    /// The nearest one that exists.
    pub suggestion: Option<String>,
}

/// Materials by name.
#[derive(Debug, Clone, PartialEq)]
pub struct Library {
    materials: BTreeMap<String, Material>,
}

impl Library {
    /// The library that comes with the program.
    pub fn built_in() -> &'static Self {
        static LIBRARY: LazyLock<Library> =
            LazyLock::new(|| BUILT_IN.lines().skip(1).filter_map(material).collect());
        &LIBRARY
    }

    /// This library with the materials of another added; equal names are replaced.
    #[must_use]
    pub fn extended(&self, other: &Self) -> Self {
        let mut materials = self.materials.clone();
        materials.extend(other.materials.clone());
        Self { materials }
    }

    /// A material by its exact name.
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
            let mut texts = [&m.name, &m.group, &m.source].into_iter();
            texts.any(|text| text.to_lowercase().contains(&word))
        })
    }

    /// A material by its name, or the error that suggests another: the nearest name, or up to four that contain this one.
    pub fn find(&self, name: &str) -> Result<&Material, UnknownMaterial> {
        let names = || self.materials.keys().map(String::as_str);
        let named_like = || {
            let word = name.to_lowercase();
            let holds = |name: &&str| !word.is_empty() && name.to_lowercase().contains(&word);
            let like: Vec<&str> = names().filter(holds).take(4).collect();
            (!like.is_empty()).then(|| like.join(" or "))
        };
        self.get(name).ok_or_else(|| UnknownMaterial {
            name: name.to_owned(),
            suggestion: nearest(name, names()).or_else(named_like),
        })
    }
}

/// A material from its line.
fn material(line: &str) -> Option<Material> {
    let mut parts = line.split('\t');
    let [name, group] = [parts.next()?, parts.next()?].map(str::to_owned);
    let mut number = |_| parts.next()?.parse().ok();
    let [modulus, ratio, longitudinal, shear] = std::array::from_fn(&mut number);
    let [density, yield_strength_pa, tensile, toughness] = std::array::from_fn(&mut number);
    let (youngs_modulus_pa, poisson_ratio) = match (longitudinal, shear) {
        (Some(longitudinal), Some(shear)) => from_wave_speeds(longitudinal, shear, density?),
        _ => (modulus?, ratio?),
    };
    Some(Material {
        name,
        youngs_modulus_pa,
        poisson_ratio,
        density_kg_m3: density,
        yield_strength_pa,
        tensile_strength_pa: tensile,
        fracture_toughness_pa_sqrt_m: toughness,
        group,
        source: parts.next()?.to_owned(),
    })
}

impl FromIterator<Material> for Library {
    fn from_iter<I: IntoIterator<Item = Material>>(materials: I) -> Self {
        let named = materials.into_iter().map(|m| (m.name.clone(), m));
        Self {
            materials: named.collect(),
        }
    }
}

impl Material {
    /// A material of the built-in library.
    ///
    /// ```
    /// let steel = contact::Material::named("steel")?;
    /// assert_eq!(steel.poisson_ratio, 0.3);
    /// # Ok::<(), contact::UnknownMaterial>(())
    /// ```
    pub fn named(name: &str) -> Result<Self, UnknownMaterial> {
        Library::built_in().find(name).cloned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_a_material() {
        let lines = BUILT_IN.lines().skip(1);
        for line in lines.clone() {
            let found = material(line).ok_or(line).unwrap();
            assert_eq!(line.split('\t').count(), 11, "{line}");
            assert!(
                found.check().is_ok() && found.density_kg_m3.is_some(),
                "{line}"
            );
            assert!(!found.source.is_empty(), "{line}");
        }
        assert_eq!(Library::built_in().iter().count(), lines.count());
    }
}
