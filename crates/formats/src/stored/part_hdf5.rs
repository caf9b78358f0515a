//! Some rows of a sweep in HDF5, read back.

use super::error::ReadError;
use super::kind::FileKind;
use super::open::Stored;
use super::part::Part;
use crate::sweep::schema::{FAILED, FAILURE, FAILURES, MODEL, RESULTS, ROWS, SHA256, part};
use crate::sweep::{BLOCK, Block, Blocks, Precision, Selection};
use output::Fault;
use std::ops::Range;
use std::path::Path;

/// Major version of the parts that are read.
const MAJOR: &str = "1";

/// An open part; its rows are read a block at a time.
#[derive(Debug, Clone)]
pub(super) struct Hdf5Part {
    stored: Stored,
    /// What it says of itself.
    pub(super) part: Part,
    reasons: Vec<String>,
}

impl Hdf5Part {
    /// Opens a part and checks that none of its columns was cut short.
    ///
    /// # Errors
    /// [`ReadError`], which says what the file is instead.
    pub(super) fn open(path: &Path) -> Result<Self, ReadError> {
        let stored = Stored::open(path, FileKind::SweepPart, MAJOR)?;
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
    pub(super) fn failures(&self) -> Self {
        let mut bare = self.clone();
        bare.part.fields.retain(|_| false);
        bare
    }

    /// The sweep with its base scene, as TOML.
    ///
    /// # Errors
    /// [`ReadError`] where it is missing.
    pub(super) fn sweep(&self) -> Result<String, ReadError> {
        self.stored.text("sweep")
    }

    /// Some of its rows, counted from its first.
    fn block(&self, rows: Range<usize>) -> Result<Block, ReadError> {
        let length = self.part.selection.rows.len();
        let path = |name: &str| format!("{RESULTS}/{name}");
        let start = self.part.selection.rows.start + rows.start;
        let mut block = Block::blank(start, rows.len(), self.part.fields.probed.len());
        block.models = self.stored.some(&path(MODEL.0), length, rows.clone())?;
        for (k, quantity) in self.part.fields.quantities() {
            let (path, rows) = (path(quantity.name), rows.clone());
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
            let reason = usize::try_from(index)
                .ok()
                .and_then(|i| self.reasons.get(i));
            let reason = reason.ok_or_else(|| {
                self.stored
                    .damaged(format!("row {row} has no reason number {index}"))
            })?;
            block.failures.push((row, reason.clone()));
        }
        if block.holds() {
            return Ok(block);
        }
        Err(self
            .stored
            .damaged("it has models that are not known, or failures without reasons"))
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
