//! Whether a results file is the whole result of a scene.

use crate::results::scene_sha256;
use crate::stored::{ReadError, StoredImpact};
use impact::Scene;
use std::path::Path;

/// Which kernels the fields of a scene may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Allowed<'a> {
    /// Computed ones.
    Direct,
    /// Those of the table with this id.
    Table(&'a str),
    /// Either.
    Either(&'a str),
}

/// Why the file at `path` is not the whole result of a scene.
///
/// # Errors
/// One sentence.
pub fn check_results(path: &Path, scene: &Scene, allowed: Allowed<'_>) -> Result<(), String> {
    let told = |error: ReadError| error.to_string();
    let found = StoredImpact::open(path).map_err(told)?;
    if found.scene_sha256() != Some(scene_sha256(scene)) {
        return Err(format!(
            "{} is of another scene, or of this one before its files or the program changed",
            path.display()
        ));
    }
    found.check_whole().map_err(told)?;
    let (kernel, table) = found.kernels().map_err(told)?;
    let same = match (kernel.as_str(), allowed) {
        // no fields, no kernels
        ("none", _) | ("direct", Allowed::Direct | Allowed::Either(_)) => true,
        ("table", Allowed::Table(id) | Allowed::Either(id)) => id == table,
        (_, _) => false,
    };
    if same {
        return Ok(());
    }
    let of_table = if table.is_empty() {
        String::new()
    } else {
        format!(" of the table {table}")
    };
    Err(format!(
        "{} has fields with other kernels than are asked for: {kernel}{of_table}",
        path.display()
    ))
}
