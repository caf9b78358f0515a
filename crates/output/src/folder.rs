//! A folder of files that belong together: all of them are written, or none.

use crate::claim::{Existing, Output, Staged};
use crate::error::OutputError;
use std::fs::File;
use std::io::Write;
use std::path::Path;

/// A folder that one run at a time writes into.
#[derive(Debug)]
pub struct Folder {
    /// A name in it that represents the whole folder.
    claim: Output,
}

impl Folder {
    /// Checks, before any work, that files can be written into a folder, which is created if it does not exist.
    ///
    /// # Errors
    /// [`OutputError::Exists`] with a file if the folder contains files that must be kept, [`OutputError::Unwritable`]
    /// if it cannot be created or written, [`OutputError::Busy`] if another run writes into it.
    pub fn claim(path: &Path, existing: Existing) -> Result<Self, OutputError> {
        if path.exists() && !path.is_dir() {
            return Err(OutputError::place(path, "it is not a folder"));
        }
        std::fs::create_dir_all(path).map_err(|error| OutputError::place(path, error))?;
        // a read-only folder is detected now, not after minutes
        let claim = Output::claim(&path.join("folder.lock"), Existing::Replace)?;
        let entries = std::fs::read_dir(path).map_err(|error| OutputError::place(path, error))?;
        let names = entries.filter_map(|entry| Some(entry.ok()?.path()));
        match names.filter(|path| !is_hidden(path)).min() {
            Some(path) if existing != Existing::Replace => Err(OutputError::Exists(path)),
            Some(_) | None => Ok(Self { claim }),
        }
    }

    /// Writes files, each a name and its bytes: all of them, or none if one fails.
    ///
    /// # Errors
    /// [`OutputError`] with the file that failed.
    pub fn write(&self, files: Vec<(String, Vec<u8>)>) -> Result<(), OutputError> {
        self.write_by(files, |mut file, bytes| file.write_all(bytes))
    }

    /// [`Self::write`] with a function that writes one file.
    fn write_by(
        &self,
        files: Vec<(String, Vec<u8>)>,
        write: impl Fn(&File, &[u8]) -> std::io::Result<()>,
    ) -> Result<(), OutputError> {
        let mut claimed = Vec::new();
        for (name, bytes) in files {
            let path = self.claim.path.with_file_name(name);
            let output = Output::claim(&path, Existing::Replace)?;
            claimed.push((output, bytes));
        }
        let mut staged: Vec<Staged<'_>> = Vec::new();
        for (output, bytes) in &claimed {
            staged.push(output.stage(|file| write(file, bytes))?);
        }
        for file in staged {
            file.commit()?;
        }
        Ok(())
    }
}

/// Whether a name begins with a dot: files that a killed run has left are hidden and not needed.
pub fn is_hidden(path: &Path) -> bool {
    path.file_name()
        .is_some_and(|name| name.as_encoded_bytes().starts_with(b"."))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

    use super::*;

    #[test]
    fn a_folder_that_holds_anything_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let inside = folder.path().join("chart");
        drop(Folder::claim(&inside, Existing::Keep).unwrap());
        let precious = inside.join("chart.csv");
        std::fs::write(&precious, "precious").unwrap();
        let refused = Folder::claim(&inside, Existing::Keep).unwrap_err();
        assert_eq!(refused, OutputError::Exists(precious.clone()));
        drop(Folder::claim(&inside, Existing::Replace).unwrap());
        // nothing is changed before there is a replacement
        assert_eq!(std::fs::read_to_string(&precious).unwrap(), "precious");
        let file = folder.path().join("file");
        std::fs::write(&file, "").unwrap();
        let refused = Folder::claim(&file, Existing::Replace).unwrap_err();
        assert!(refused.to_string().contains("not a folder"));
    }

    #[test]
    fn all_files_are_written_or_none() {
        let parent = tempfile::tempdir().unwrap();
        let inside = parent.path().join("report");
        let folder = Folder::claim(&inside, Existing::Keep).unwrap();
        assert!(matches!(
            Folder::claim(&inside, Existing::Keep),
            Err(OutputError::Busy { .. })
        ));
        let file = |name: &str| (name.to_owned(), b"1".to_vec());
        let refused = folder.write(vec![file("a.txt"), file("missing/b.txt")]);
        assert!(matches!(refused, Err(OutputError::Unwritable { .. })));
        assert!(!inside.join("a.txt").exists());
        // the second file fails after the first one was written
        let failing = vec![file("a.txt"), ("b.txt".to_owned(), Vec::new())];
        let refused = folder.write_by(failing, |mut file, bytes| match bytes {
            [] => Err(std::io::Error::other("no")),
            bytes => file.write_all(bytes),
        });
        assert!(matches!(refused, Err(OutputError::Failed { .. })));
        assert!(!inside.join("a.txt").exists());
        folder.write(vec![file("a.txt")]).unwrap();
        assert_eq!(std::fs::read_to_string(inside.join("a.txt")).unwrap(), "1");
    }
}
