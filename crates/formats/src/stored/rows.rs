//! Rows of a sweep, some or all, read back from either format.

use super::error::ReadError;
use super::kind::FileKind;
use super::parquet::{StoredParquet, is_parquet};
use super::part::Part;
use super::part_hdf5::Hdf5Part;
use super::sweep::StoredSweep;
use crate::sweep::{Block, Blocks, Fields};
use output::Fault;
use std::path::Path;

/// An open part; its rows are read a block at a time.
#[derive(Debug, Clone)]
pub struct StoredPart {
    /// What it says of itself.
    pub part: Part,
    rows: Rows,
}

#[derive(Debug, Clone)]
enum Rows {
    Hdf5(Hdf5Part),
    Parquet(StoredParquet),
}

impl StoredPart {
    /// Opens a part and checks that it was not cut short.
    ///
    /// # Errors
    /// [`ReadError`], which says what the file is instead.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        if is_parquet(path) {
            let rows = StoredParquet::open(path)?.of_kind(FileKind::SweepPart)?;
            return Ok(Self {
                part: rows.part.clone(),
                rows: Rows::Parquet(rows),
            });
        }
        let rows = Hdf5Part::open(path)?;
        Ok(Self {
            part: rows.part.clone(),
            rows: Rows::Hdf5(rows),
        })
    }

    /// The same without its results: models and failures alone are read; nothing for a part that is not HDF5.
    pub(crate) fn failures(&self) -> Option<impl Blocks> {
        match &self.rows {
            Rows::Hdf5(rows) => Some(rows.failures()),
            Rows::Parquet(_) => None,
        }
    }

    /// The sweep with its base scene, as TOML.
    ///
    /// # Errors
    /// [`ReadError`] where it is missing.
    pub fn sweep(&self) -> Result<String, ReadError> {
        match &self.rows {
            Rows::Hdf5(rows) => rows.sweep(),
            Rows::Parquet(rows) => Ok(rows.sweep.clone()),
        }
    }
}

impl Blocks for StoredPart {
    fn each(&self, visit: &mut dyn FnMut(&Block) -> Result<(), Fault>) -> Result<(), Fault> {
        match &self.rows {
            Rows::Hdf5(rows) => rows.each(visit),
            Rows::Parquet(rows) => rows.each(visit),
        }
    }
}

/// All rows of a sweep in one file, which was not cut short.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoredWhole {
    /// Which sweep; nothing in HDF5 files of versions before 1.4.
    pub sha256: Option<String>,
    /// Which results it has.
    pub fields: Fields,
}

impl StoredWhole {
    /// Opens it and checks that it was not cut short.
    ///
    /// # Errors
    /// [`ReadError`], which says what the file is instead.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        if is_parquet(path) {
            let found = StoredParquet::open(path)?.of_kind(FileKind::Sweep)?;
            return Ok(Self {
                sha256: Some(found.part.sha256),
                fields: found.part.fields,
            });
        }
        let found = StoredSweep::open(path)?;
        found.check_whole()?;
        Ok(Self {
            sha256: found.sha256(),
            fields: found.fields()?,
        })
    }
}
