//! Outputs that are inputs, or each other.

use crate::error::OutputError;
use crate::place::{behind, folder};
use std::path::{Path, PathBuf};

/// A file that a command reads, with what it is to it, such as "the scene".
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Role {
    /// What it is, with its article.
    pub name: &'static str,
    /// Where it is.
    pub path: PathBuf,
}

impl Role {
    /// An input.
    #[must_use]
    pub fn new(name: &'static str, path: &Path) -> Self {
        Self {
            name,
            path: path.to_owned(),
        }
    }
}

/// Refuses, before any work, an output that is an input of the same command, and two outputs that are one file.
///
/// Files are compared by what they are, not by name: also through links of both kinds.
///
/// # Errors
/// [`OutputError::Input`], [`OutputError::Twice`]; or that an output cannot be written at all.
pub fn apart(outputs: &[&Path], inputs: &[Role]) -> Result<(), OutputError> {
    let mut seen: Vec<(&Path, Identity)> = Vec::new();
    for &output in outputs {
        let this = Identity::of(&behind(output)?);
        if let Some((first, _)) = seen.iter().find(|(_, other)| *other == this) {
            return Err(OutputError::Twice {
                first: (*first).to_owned(),
                second: output.to_owned(),
            });
        }
        for input in inputs {
            if Identity::of(&input.path) == this {
                return Err(OutputError::Input {
                    output: output.to_owned(),
                    role: input.name,
                    input: input.path.clone(),
                });
            }
        }
        seen.push((output, this));
    }
    Ok(())
}

/// What a file is, whatever it is called.
#[derive(Debug, PartialEq, Eq)]
enum Identity {
    /// One that is there: device and number.
    #[cfg(unix)]
    Number(u64, u64),
    /// Elsewhere, and where nothing is yet: the folder with its links followed, and the name.
    Name(PathBuf),
}

impl Identity {
    fn of(path: &Path) -> Self {
        #[cfg(unix)]
        if let Ok(there) = std::fs::metadata(path) {
            use std::os::unix::fs::MetadataExt;
            return Self::Number(there.dev(), there.ino());
        }
        let whole = path.canonicalize().or_else(|_| {
            let folder = folder(path).canonicalize()?;
            Ok::<_, std::io::Error>(folder.join(path.file_name().unwrap_or_default()))
        });
        Self::Name(whole.unwrap_or_else(|_| path.to_owned()))
    }
}
