//! Rows of a sweep, some or all, read back from either format.

use super::error::{FileKind, ReadError};
use super::open::{Stored, is_parquet, parquet_of_kind};
use super::sweep::StoredSweep;
use crate::sweep::schema::{FAILED, FAILURE, FAILURES, MODEL, RESULTS, ROWS, SHA256, part};
use crate::sweep::{BLOCK, Block, Blocks, Fields, Footer, Part, Precision, Selection};
use output::Fault;
use std::ops::Range;
use std::path::Path;

/// What is wrong with a block that cannot have been computed.
pub(super) const NOT_HELD: &str = "it has models that are not known, or failures without reasons";

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
    Parquet(Footer),
}

impl StoredPart {
    /// Opens a part and checks that it was not cut short.
    ///
    /// # Errors
    /// [`ReadError`], which says what the file is instead.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        if is_parquet(path) {
            let rows = parquet_of_kind(path, FileKind::SweepPart)?;
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
            Rows::Hdf5(rows) => rows.stored.text("sweep"),
            Rows::Parquet(rows) => Ok(rows.sweep.clone()),
        }
    }
}

impl Blocks for StoredPart {
    fn each(&self, visit: &mut dyn FnMut(&Block) -> Result<(), Fault>) -> Result<(), Fault> {
        match &self.rows {
            Rows::Hdf5(rows) => rows.each(visit),
            #[cfg(feature = "parquet")]
            Rows::Parquet(rows) => super::groups::each(&rows.part, &rows.groups, visit),
            #[cfg(not(feature = "parquet"))]
            Rows::Parquet(rows) => Err(Fault::from(format!(
                "{} is a Parquet file, the {} groups of which this program was built without reading",
                rows.part.path.display(),
                rows.groups.len()
            ))),
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
            let found = parquet_of_kind(path, FileKind::Sweep)?;
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

/// An open part in HDF5.
#[derive(Debug, Clone)]
struct Hdf5Part {
    stored: Stored,
    part: Part,
    reasons: Vec<String>,
}

impl Hdf5Part {
    /// Opens a part and checks that none of its columns was cut short.
    fn open(path: &Path) -> Result<Self, ReadError> {
        let stored = Stored::open(path, FileKind::SweepPart)?;
        let count = |name: &str| {
            let found = stored.number(name).map(|number| number as usize);
            found.ok_or_else(|| stored.damaged(format!("the number {name} is missing")))
        };
        let (sweep_rows, start) = (count(part::SWEEP_ROWS)?, count(part::FIRST_ROW)?);
        let end = start.checked_add(count(ROWS)?);
        let Some(end) = end.filter(|&end| end <= sweep_rows) else {
            return Err(stored.damaged("it has rows beyond those of its sweep"));
        };
        let shard = match stored.text(part::SHARD)?.as_str() {
            "" => None,
            text => {
                let shard = text.parse();
                Some(shard.map_err(|_| stored.damaged(format!("there is no shard {text}")))?)
            }
        };
        let rows = start..end;
        let fields = stored.fields(RESULTS, &[rows.len()])?;
        for (_, quantity) in fields.quantities() {
            stored.check_end(&format!("{RESULTS}/{}", quantity.name), &[rows.len()])?;
        }
        let part = Part {
            path: path.to_owned(),
            sha256: stored.text(SHA256)?,
            failed: count(FAILED)?,
            selection: Selection { rows, shard },
            sweep_rows,
            fields,
        };
        Ok(Self {
            reasons: stored.texts(FAILURES.0)?,
            part,
            stored,
        })
    }

    /// The same without its results: models and failures alone are read.
    fn failures(&self) -> Self {
        let mut bare = self.clone();
        bare.part.fields.retain(|_| false);
        bare
    }

    /// Some of its rows, counted from its first.
    fn block(&self, rows: Range<usize>) -> Result<Block, ReadError> {
        let length = self.part.selection.rows.len();
        let path = |name: &str| format!("{RESULTS}/{name}");
        let start = self.part.selection.rows.start + rows.start;
        let mut block = Block::blank(start, rows.len(), self.part.fields.probed());
        block.models = self.stored.some(&path(MODEL.0), length, rows.clone())?;
        for (k, quantity) in self.part.fields.quantities() {
            let (path, rows) = (path(&quantity.name), rows.clone());
            let column: Vec<f64> = match self.part.fields.precision {
                Precision::Double => self.stored.some(&path, length, rows)?,
                Precision::Single => {
                    let column = self.stored.some::<f32>(&path, length, rows)?;
                    column.into_iter().map(f64::from).collect()
                }
            };
            for (row, number) in column.into_iter().enumerate() {
                block.set(row, k, number);
            }
        }
        let indices = self.stored.some::<i32>(&path(FAILURE.0), length, rows)?;
        for (row, index) in (block.start..).zip(indices) {
            if index == -1 {
                continue;
            }
            let reason = usize::try_from(index).ok();
            let reason = reason.and_then(|i| self.reasons.get(i));
            let what = || format!("row {row} has no reason number {index}");
            let reason = reason.ok_or_else(|| self.stored.damaged(what()))?;
            block.failures.push((row, reason.clone()));
        }
        if block.holds() {
            return Ok(block);
        }
        Err(self.stored.damaged(NOT_HELD))
    }
}

impl Blocks for Hdf5Part {
    fn each(&self, visit: &mut dyn FnMut(&Block) -> Result<(), Fault>) -> Result<(), Fault> {
        let rows = self.part.selection.rows.len();
        for start in (0..rows).step_by(BLOCK) {
            let block = self.block(start..(start + BLOCK).min(rows));
            visit(&block.map_err(|error| Fault::from(error.to_string()))?)?;
        }
        Ok(())
    }
}
