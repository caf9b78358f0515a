//! Journals and shards of a table: the settings, and one record for each finished block.
//!
//! A record contains slice, kind, row and four lengths as integers of eight bytes, then the numbers. The finished table
//! is made from the blocks in the order of the grid, so its bytes do not depend on the order of the records.

use crate::block::{PointKind, Row, TableBlock};
use crate::error::BuildError;
use crate::numbers::NUMBERS_REVISION;
use ledger::Identity;
use output::{Output, Records, Title, packed, unpacked};
use std::path::{Path, PathBuf};

/// Kind of work in the title of a journal.
const KIND: &str = "kernel table";

/// Path of the journal of an output.
pub(crate) fn journal_of(output: &Output) -> PathBuf {
    let mut name = output.real.as_os_str().to_owned();
    name.push(".journal");
    PathBuf::from(name)
}

/// Title of a journal for a table with the settings `grid`, or for an extension of the table with the hash `extends`.
pub(crate) fn title(grid: &str, extends: Option<&str>) -> Title {
    let identity = Identity::default()
        .with("numbers", NUMBERS_REVISION.to_le_bytes())
        .with("grid", grid)
        .with("extends", extends.unwrap_or_default());
    Title {
        kind: KIND,
        identity: identity.hex(),
        about: grid.to_owned(),
    }
}

/// Opens a journal or a shard without changing it, to read its settings and its blocks.
pub(crate) fn records(path: &Path) -> Result<Records, BuildError> {
    let records = Records::open(path, KIND)?;
    records
        .filter(|records| records.title == title(&records.title.about, None))
        .ok_or_else(|| {
            let file = path.display();
            let sentence = format!(
                "{file} is not a shard of a kernel table made by this version of the program"
            );
            BuildError::refused(Some(path), sentence)
        })
}

/// The record of a block.
pub(crate) fn kept(block: TableBlock, row: &Row) -> Vec<u8> {
    let [a, b, c, d] = row.each_ref().map(Vec::len);
    let mut bytes = packed([block.slice, block.kind as usize, block.row, a, b, c, d]);
    bytes.reserve(4 * (a + b + c + d));
    for value in row.iter().flatten() {
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    bytes
}

/// The block and the numbers of a record; none if the record is invalid.
pub(crate) fn parsed(kept: &[u8]) -> Option<(TableBlock, Row)> {
    let ([slice, kind, row, lengths @ ..], numbers) = unpacked::<7>(kept)?;
    let kind = *PointKind::ALL.get(kind)?;
    let (values, rest) = numbers.as_chunks();
    let mut values = values.iter().map(|value| f32::from_le_bytes(*value));
    let found: Row = lengths.map(|length| values.by_ref().take(length).collect());
    let whole =
        found.each_ref().map(Vec::len) == lengths && rest.is_empty() && values.next().is_none();
    whole.then_some((TableBlock { slice, kind, row }, found))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_read_as_they_were_recorded() {
        let block = TableBlock {
            slice: 4,
            kind: PointKind::Between,
            row: 7,
        };
        let row = [vec![1.0; 7], vec![f32::NAN; 7], Vec::new(), vec![-0.0, 3.0]];
        let bytes = kept(block, &row);
        let (same, read) = parsed(&bytes).unwrap();
        assert_eq!((same, kept(same, &read)), (block, bytes.clone()));
        for length in 0..bytes.len() {
            assert!(parsed(&bytes[..length]).is_none(), "{length} bytes");
        }
        assert!(parsed(&[&bytes[..], &[0; 4]].concat()).is_none());
    }
}
