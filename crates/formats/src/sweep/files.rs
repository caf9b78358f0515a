//! The files that a sweep names, each read once and before the first row.

use super::axes::{Axis, Values};
use crate::error::SceneError;
use crate::scene::body::parse_materials;
use crate::scene::text::read_text;
use contact::Library;
use output::Role;
use std::collections::BTreeMap;
use std::path::Path;
use toml::Table;

/// What was read: rows are computed from it, whatever becomes of the files.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Files {
    /// Where each file is.
    pub(super) inputs: Vec<Role>,
    /// Materials by the name of their file.
    libraries: BTreeMap<String, Library>,
    /// Text of each materials file, in the order of their names.
    pub(super) texts: Vec<String>,
}

impl Files {
    /// Reads the materials of a base scene, and those that vary.
    pub(super) fn read(scene: &Table, axes: &[Axis], directory: &Path) -> Result<Self, SceneError> {
        let mut files = Self::default();
        let mut names: Vec<&str> = named(scene).into_iter().collect();
        for column in axes.iter().flat_map(|axis| &axis.columns) {
            if let ("materials", "file", Values::Texts(words)) =
                (column.section.as_str(), column.key.as_str(), &column.values)
            {
                names.extend(words.iter().map(String::as_str));
            }
        }
        names.sort_unstable();
        names.dedup();
        for name in names {
            let path = directory.join(name);
            let text = read_text(&path)?;
            let own = parse_materials(&text).map_err(|error| error.in_file(&path))?;
            let library = Library::built_in().clone().extended(&own);
            files.libraries.insert(name.to_owned(), library);
            files.inputs.push(Role::new("a materials file", &path));
            files.texts.push(text);
        }
        Ok(files)
    }

    /// The materials of a scene.
    pub(super) fn library(&self, scene: &Table) -> &Library {
        named(scene)
            .and_then(|name| self.libraries.get(name))
            .unwrap_or(Library::built_in())
    }
}

/// The materials file that a scene names.
fn named(scene: &Table) -> Option<&str> {
    scene.get("materials")?.as_table()?.get("file")?.as_str()
}
