//! The last step of every build: from rows to the file under its name.

use crate::assemble::assemble;
use crate::block::{Block, Row};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::known::Known;
use crate::progress::Progress;
use lookup::{Accuracy, Content, TableError};
use output::{Fault, Output};
use std::path::Path;

/// What a build did.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Identity of the settings.
    pub id: String,
    /// SHA-256 of the content.
    pub content_sha256: String,
    /// Points of the grid over all slices.
    pub points: usize,
    /// Size of the file.
    pub bytes: u64,
    /// Time taken.
    pub wall_s: f64,
    /// Blocks that an interrupted run had computed already.
    pub resumed_blocks: usize,
    /// Lengths of the verification pulses in r0/c1.
    pub pulse_lengths: Vec<f64>,
    /// 99 % quantile of the relative error of the worst field on slices, for each pulse length.
    pub p99_error: Vec<f64>,
    /// Relative errors by field, on slices and between them, for each pulse length.
    pub accuracy: Vec<Accuracy>,
}

/// From all rows to the file under its name.
pub(crate) fn complete(
    grid: &Grid,
    work: &[Block],
    rows: Vec<Row>,
    output: &Output,
    known: Option<&Known>,
    progress: &dyn Progress,
) -> Result<Summary, BuildError> {
    let content = assemble(grid, work, rows, known, progress)?;
    let bytes = output.write(|part| write_checked(&content, part))?;
    Ok(Summary {
        id: lookup::settings_id(&content.origin.grid),
        content_sha256: lookup::content_hash(&content),
        points: content.r.len() * content.z.len() * content.slices.len(),
        bytes,
        wall_s: 0.0,
        resumed_blocks: 0,
        accuracy: content.accuracy(),
        pulse_lengths: content.pulse_lengths,
        p99_error: content.origin.accuracy_reached,
    })
}

/// Writes a table and reads it back.
fn write_checked(content: &Content, part: &Path) -> Result<(), Fault> {
    let done = lookup::write(part, content).and_then(|()| {
        let back = lookup::read(part)?;
        lookup::check_hash(part, &back)
    });
    done.map_err(|error| match error {
        // its file is the temporary one, of which nobody should hear
        TableError::Unwritable { detail, .. } => Fault::from(detail),
        other => Fault::from(other.to_string()),
    })
}
