//! Materials files: one section a material, the keys of a scene's bodies plus `group` and `source`.

use crate::body::{ELASTIC_KEYS, elastic};
use crate::error::SceneError;
use crate::section::{Section, parse};
use crate::text::read_text;
use contact::{Library, Material};
use std::path::Path;

/// Reads a materials file.
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
    let mut found = Vec::new();
    for name in table.keys() {
        if let Some(section) = root.section(name)? {
            found.push(material(name, &section)?);
        }
    }
    Ok(found.into_iter().collect())
}

fn material(name: &str, section: &Section<'_>) -> Result<Material, SceneError> {
    let mut allowed = ELASTIC_KEYS.to_vec();
    allowed.extend(["group", "source"]);
    section.allow(&allowed)?;
    let source = section
        .text("source")?
        .ok_or_else(|| section.missing("source", "say where the numbers come from"))?;
    Ok(Material {
        name: name.to_owned(),
        group: section.text("group")?.unwrap_or("other").to_owned(),
        source: source.to_owned(),
        ..elastic(section, None)?
    })
}
