//! Materials by name: the built-in library, which a user's materials can extend.

use crate::bodies::library_data::materials;
use crate::bodies::material::Material;
use crate::names::nearest;
use std::collections::BTreeMap;
use std::sync::LazyLock;
use thiserror::Error;

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
    #[must_use]
    pub fn built_in() -> &'static Self {
        static LIBRARY: LazyLock<Library> = LazyLock::new(|| materials().into_iter().collect());
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

    /// Up to four names that contain a word.
    fn named_like(&self, word: &str) -> Option<String> {
        let word = word.to_lowercase();
        let names = self.materials.keys().map(String::as_str);
        let like: Vec<&str> = names
            .filter(|name| !word.is_empty() && name.to_lowercase().contains(&word))
            .take(4)
            .collect();
        (!like.is_empty()).then(|| like.join(" or "))
    }

    /// A material by its name, or the error that suggests another.
    pub fn find(&self, name: &str) -> Result<&Material, UnknownMaterial> {
        self.get(name).ok_or_else(|| UnknownMaterial {
            name: name.to_owned(),
            suggestion: nearest(name, self.materials.keys().map(String::as_str))
                .or_else(|| self.named_like(name)),
        })
    }
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
