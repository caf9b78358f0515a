//! What a journal, or a shard, keeps of a table: one block a record, and the settings beside them.
//!
//! A block is its slice, kind, row and four lengths as integers of eight bytes, then the numbers. The finished table is
//! made from the blocks in the order of the grid, so its bytes do not depend on the order in which they were recorded.

use crate::block::{Block, Kind, Row};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::numbers::NUMBERS_REVISION;
use ledger::Identity;
use output::{Journal, Output, Records, Title};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// What is done.
const KIND: &str = "kernel table";
/// Bytes before the numbers of a block: seven integers.
const HEADER: usize = 7 * 8;

/// Where the journal of an output is.
pub(crate) fn journal_of(output: &Output) -> PathBuf {
    let mut name = output.real.as_os_str().to_owned();
    name.push(".journal");
    PathBuf::from(name)
}

/// Blocks of a table of some settings or, beyond those of a smaller one with a hash, of an extension of it.
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

/// Opens a journal, or begins one, and gives the finished blocks; one that is of something else is replaced where `drops`
/// says so of its settings.
pub(crate) fn open(
    path: &Path,
    title: &Title,
    drops: impl Fn(&str) -> bool,
) -> Result<(Journal, HashMap<Block, Row>), BuildError> {
    let mut found = Found::of(&title.about);
    let journal = Journal::open(
        path,
        title,
        |other| drops(&other.about),
        |_, kept| found.take(kept),
    )?;
    Ok((journal, found.rows))
}

/// Reads a journal or a shard without changing it: its settings and its whole blocks.
pub(crate) fn read(path: &Path) -> Result<(String, HashMap<Block, Row>), BuildError> {
    let records = Records::open(path, KIND)?;
    let mut records = records
        .filter(|records| records.title == title(&records.title.about, None))
        .ok_or_else(|| {
            let file = path.display();
            let sentence = format!(
                "{file} is not a shard of a kernel table made by this version of the program"
            );
            BuildError::refused(Some(path), sentence)
        })?;
    let mut found = Found::of(&records.title.about);
    records.by_ref().all(|(_, kept)| found.take(&kept));
    Ok((records.title.about, found.rows))
}

/// Blocks that were found, in no more memory than the settings explain.
struct Found {
    rows: HashMap<Block, Row>,
    left: usize,
}

impl Found {
    fn of(grid: &str) -> Self {
        let bytes = Grid::parse(grid).and_then(|grid| grid.memory_bytes());
        Self {
            rows: HashMap::new(),
            left: bytes.map_or(0, |bytes| bytes as usize),
        }
    }

    fn take(&mut self, kept: &[u8]) -> bool {
        match (parsed(kept), self.left.checked_sub(kept.len())) {
            (Some((block, row)), Some(left)) => {
                self.left = left;
                self.rows.insert(block, row);
                true
            }
            (_, _) => false,
        }
    }
}

/// What is kept of a block.
pub(crate) fn kept(block: Block, row: &Row) -> Vec<u8> {
    let lengths = row.each_ref().map(Vec::len);
    let mut bytes = Vec::with_capacity(HEADER + 4 * lengths.iter().sum::<usize>());
    for number in [block.slice, block.kind as usize, block.row]
        .into_iter()
        .chain(lengths)
    {
        bytes.extend_from_slice(&(number as u64).to_le_bytes());
    }
    for value in row.iter().flatten() {
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    bytes
}

fn parsed(kept: &[u8]) -> Option<(Block, Row)> {
    let (header, numbers) = kept.split_at_checked(HEADER)?;
    let (words, _) = header.as_chunks();
    let mut words = words
        .iter()
        .map(|word| usize::try_from(u64::from_le_bytes(*word)).ok());
    let mut next = || words.next().flatten();
    let slice = next()?;
    let kind = *Kind::ALL.get(next()?)?;
    let row = next()?;
    let (values, rest) = numbers.as_chunks();
    let mut values = values.iter().map(|value| f32::from_le_bytes(*value));
    let mut array = || {
        let length = next()?;
        let array: Vec<f32> = values.by_ref().take(length).collect();
        (array.len() == length).then_some(array)
    };
    let found = [array()?, array()?, array()?, array()?];
    let whole = rest.is_empty() && values.next().is_none();
    whole.then_some((Block { slice, kind, row }, found))
}

#[cfg(test)]
mod tests {
    use super::*;
    use output::OutputError;

    fn small() -> String {
        let grid = Grid {
            poisson_ratios: vec![0.3],
            ..Grid::demo()
        };
        grid.to_toml().unwrap()
    }

    #[test]
    fn blocks_are_read_as_they_were_recorded() {
        let block = Block {
            slice: 4,
            kind: Kind::Between,
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

    #[test]
    fn what_is_unfinished_is_kept_until_it_may_go() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.journal");
        let (grid, other) = (small(), small().replace("0.3", "0.25"));
        let (block, row) = (
            Block {
                slice: 0,
                kind: Kind::Nodes,
                row: 0,
            },
            Row::default(),
        );
        let of = |there: &Title, wanted: &Title, goes: &str| {
            let _ = std::fs::remove_file(&path);
            let (mut journal, _) = open(&path, there, |_| false).unwrap();
            journal.append(&kept(block, &row)).unwrap();
            open(&path, wanted, |settings| settings == goes).map(|(_, rows)| rows.len())
        };
        let kept = |found| matches!(found, Err(BuildError::Output(OutputError::Begun(..))));
        let (build, extension) = (title(&grid, None), title(&grid, Some("1")));
        assert_eq!(of(&build, &build, "").unwrap(), 1);
        assert!(kept(of(&build, &title(&other, None), "")));
        assert!(kept(of(&extension, &build, "")));
        assert!(kept(of(&extension, &title(&grid, Some("2")), &other)));
        assert_eq!(of(&extension, &build, &grid).unwrap(), 0);
        assert_eq!(of(&build, &title(&other, Some("1")), &grid).unwrap(), 0);
    }
}
