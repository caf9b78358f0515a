//! Rows of a sweep in Parquet, read back.

use super::error::ReadError;
use super::kind::FileKind;
use super::part::Part;
use crate::sweep::{Block, Blocks, Footer, MAGIC};
use output::Fault;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Major version of the files that are read.
const MAJOR: &str = "1";

/// An open file of rows: what it says of itself; rows are read a group at a time.
#[derive(Debug, Clone)]
pub struct StoredParquet {
    /// What it says of itself.
    pub part: Part,
    /// The sweep with its base scene, as TOML.
    pub sweep: String,
    kind: FileKind,
    /// SHA-256 of each group.
    groups: Vec<String>,
}

/// Whether a file begins as Parquet.
pub(super) fn is_parquet(path: &Path) -> bool {
    let mut head = [0; MAGIC.len()];
    // looked at before it is opened: a pipe would wait for its other end
    std::fs::metadata(path).is_ok_and(|there| there.is_file())
        && File::open(path).is_ok_and(|mut file| file.read_exact(&mut head).is_ok())
        && head == *MAGIC
}

impl StoredParquet {
    /// Opens a file of rows, all or some, and checks its seal and its length.
    ///
    /// # Errors
    /// [`ReadError`], which says what the file is instead.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let path = path.to_owned();
        let damaged = |what: String| ReadError::Damaged {
            path: path.clone(),
            what,
        };
        let Some(found) = Footer::read(&path).map_err(damaged)? else {
            return Err(ReadError::ForeignParquet { path });
        };
        if found.version.split('.').next() != Some(MAJOR) {
            return Err(ReadError::Version {
                found: found.version,
                major: MAJOR,
                path,
            });
        }
        let mut kinds = [FileKind::Sweep, FileKind::SweepPart].into_iter();
        let kind = kinds.find(|kind| kind.file_type() == found.file_type);
        let Some(kind) = kind else {
            return Err(ReadError::ForeignParquet { path });
        };
        Ok(Self {
            part: Part {
                path,
                sha256: found.sha256,
                selection: found.selection,
                sweep_rows: found.sweep_rows,
                failed: found.failed,
                fields: found.fields,
            },
            sweep: found.sweep,
            kind,
            groups: found.groups,
        })
    }

    /// What it is.
    #[must_use]
    pub fn kind(&self) -> FileKind {
        self.kind
    }

    /// Fails where it is of another kind.
    pub(super) fn of_kind(self, wanted: FileKind) -> Result<Self, ReadError> {
        if self.kind == wanted {
            return Ok(self);
        }
        Err(ReadError::Kind {
            path: self.part.path,
            found: self.kind,
            wanted,
        })
    }
}

#[cfg(not(feature = "parquet"))]
impl Blocks for StoredParquet {
    fn each(&self, _: &mut dyn FnMut(&Block) -> Result<(), Fault>) -> Result<(), Fault> {
        let (path, groups) = (self.part.path.display(), self.groups.len());
        Err(Fault::from(format!(
            "{path} is a Parquet file, the {groups} groups of which this program was built without reading"
        )))
    }
}

#[cfg(feature = "parquet")]
impl Blocks for StoredParquet {
    fn each(&self, visit: &mut dyn FnMut(&Block) -> Result<(), Fault>) -> Result<(), Fault> {
        super::groups::each(&self.part, &self.groups, visit)
    }
}
