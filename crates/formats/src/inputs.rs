//! The files that a scene names.

use crate::error::SceneError;
use crate::section::parse;
use crate::text::read_text;
use output::Role;
use std::path::Path;
use toml::Value;

/// Sections of a scene with a key `file`, and what that file is.
const NAMED: [(&str, &str); 2] = [
    ("materials", "the materials file"),
    ("force", "the force record"),
];

/// The scene file at `path` and the files that it names: none of them may be an output.
///
/// # Errors
/// [`SceneError`] when it cannot be read or is not TOML.
pub fn inputs(path: &Path) -> Result<Vec<Role>, SceneError> {
    let table = parse(&read_text(path)?).map_err(|error| error.in_file(path))?;
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut found = vec![Role::new("the scene", path)];
    for (section, role) in NAMED {
        if let Some(Value::String(file)) = table.get(section).and_then(|s| s.get("file")) {
            found.push(Role::new(role, &folder.join(file)));
        }
    }
    Ok(found)
}
