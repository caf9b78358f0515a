//! Text files.

use crate::error::SceneError;
use std::path::Path;

/// The text of a file.
pub(crate) fn read_text(path: &Path) -> Result<String, SceneError> {
    std::fs::read_to_string(path).map_err(|error| SceneError::Unreadable {
        path: path.to_owned(),
        reason: error.to_string(),
    })
}
