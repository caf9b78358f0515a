//! The blocks computed so far, kept in a file that survives an interruption at any moment.
//!
//! `NAME.journal`, or a shard, starts with a line that names the settings and with the settings themselves;
//! then follow records that are only ever appended: a header (slice, kind, row, four lengths), the numbers, and a
//! SHA-256 of both. A record that was cut short is dropped on reading and computed again. The finished table is made from the records in
//! the order of the grid, so its bytes do not depend on the order in which they were written.

use crate::block::{Block, Kind, Row};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::numbers::NUMBERS_REVISION;
use output::{Output, OutputError};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// How journals of every version start.
const FAMILY: &str = "hertzlamb kernel blocks ";

/// How every journal starts: version 4 has blanks where a probe was not computed.
fn kind() -> String {
    format!("{FAMILY}4, numbers {NUMBERS_REVISION}, settings ")
}

/// Bytes before the numbers of a record: seven integers.
const HEADER: usize = 7 * 8;
/// Bytes after them.
const SUM: usize = 32;

/// What blocks are computed for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Task<'a> {
    /// A table, or a part of one.
    Build {
        /// Its settings.
        grid: &'a str,
    },
    /// More of a table: the blocks go on from its numbers and leave out what it has.
    Extension {
        /// The settings of the larger table.
        grid: &'a str,
        /// SHA-256 of the content of the smaller one.
        base: &'a str,
    },
}

/// What happens to something unfinished of another task.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Left<'a> {
    /// It is kept and reported.
    Kept,
    /// It is kept unless it became the table that is there, which has these settings.
    Of {
        /// The settings.
        table: &'a str,
    },
    /// It is replaced.
    Replaced,
}

/// Where the journal of an output is.
pub(crate) fn journal_of(output: &Output) -> PathBuf {
    let mut name = output.real().as_os_str().to_owned();
    name.push(".journal");
    PathBuf::from(name)
}

impl<'a> Task<'a> {
    /// The settings.
    fn grid(self) -> &'a str {
        match self {
            Self::Build { grid } | Self::Extension { grid, .. } => grid,
        }
    }
}

/// An open journal; whoever opens it has claimed the output.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    file: File,
}

impl Journal {
    /// Opens the journal at `path` for a task, or starts one, and returns the finished blocks.
    pub(crate) fn open(
        path: &Path,
        task: Task<'_>,
        left: Left<'_>,
    ) -> Result<(Self, HashMap<Block, Row>), BuildError> {
        let failed = |action| file_error(action, path);
        let there = std::fs::symlink_metadata(path);
        if there.as_ref().is_ok_and(|there| !there.is_file()) {
            return Err(BuildError::NotJournal {
                path: path.to_owned(),
            });
        }
        let mut file = OpenOptions::new()
            .read(true)
            .append(true)
            .create(there.is_ok())
            .create_new(there.is_err())
            .open(path)
            .map_err(failed("write"))?;
        file.seek(SeekFrom::Start(0)).map_err(failed("read"))?;
        let bytes = contents(&file, most_bytes(task.grid())).map_err(failed("read"))?;
        let title = title(task);
        let mut journal = Self {
            path: path.to_owned(),
            file,
        };
        if bytes.starts_with(title.as_bytes()) {
            let (rows, good) = records(&bytes, title.len());
            if good < bytes.len() {
                journal.cut(good as u64)?;
            }
            return Ok((journal, rows));
        }
        // New, or cut short in its first line: nothing is in it.
        let empty = bytes.len() < title.len() && title.as_bytes().starts_with(&bytes);
        if !empty {
            dispensable(path, &bytes, left)?;
        }
        journal.cut(0)?;
        journal.append(title.as_bytes())?;
        Ok((journal, HashMap::new()))
    }

    /// Appends a finished block.
    pub(crate) fn record(&mut self, block: Block, row: &Row) -> Result<(), BuildError> {
        let arrays = row.arrays();
        let count: usize = arrays.iter().map(|array| array.len()).sum();
        let mut bytes = Vec::with_capacity(HEADER + SUM + 4 * count);
        let kind = match block.kind {
            Kind::Nodes => 0,
            Kind::Probes => 1,
            Kind::Between => 2,
        };
        let lengths = arrays.map(<[f32]>::len);
        for number in [block.slice, kind, block.row].into_iter().chain(lengths) {
            bytes.extend((number as u64).to_le_bytes());
        }
        for value in arrays.into_iter().flatten() {
            bytes.extend(value.to_le_bytes());
        }
        let sum = Sha256::digest(&bytes);
        bytes.extend(sum);
        self.append(&bytes)
    }

    /// Deletes the journal: the table is complete under its own name.
    pub(crate) fn remove(self) -> Result<(), BuildError> {
        remove(&self.path)
    }

    fn append(&mut self, bytes: &[u8]) -> Result<(), BuildError> {
        self.file
            .write_all(bytes)
            .and_then(|()| self.file.sync_data())
            .map_err(|error| OutputError::writing(&self.path, error).into())
    }

    fn cut(&mut self, length: u64) -> Result<(), BuildError> {
        self.file
            .set_len(length)
            .map_err(file_error("shorten", &self.path))
    }
}

/// Deletes a journal.
pub(crate) fn remove(path: &Path) -> Result<(), BuildError> {
    std::fs::remove_file(path).map_err(file_error("remove", path))
}

/// Refuses to lose what is not of this task and may be wanted.
fn dispensable(path: &Path, bytes: &[u8], left: Left<'_>) -> Result<(), BuildError> {
    let end = bytes.iter().position(|&byte| byte == b'\n');
    let line = String::from_utf8_lossy(&bytes[..end.unwrap_or(bytes.len()).min(400)]);
    if !line.starts_with(FAMILY) {
        return Err(BuildError::NotJournal {
            path: path.to_owned(),
        });
    }
    let unfinished = |what: &str| BuildError::OtherSettings {
        path: path.to_owned(),
        what: what.to_owned(),
    };
    let what = match (line.starts_with(&kind()), line.contains(", extends ")) {
        (false, _) => "an unfinished table of another version of this program",
        (true, false) => "an unfinished table with other settings",
        (true, true) => "an unfinished extension, of another table or with other settings",
    };
    match left {
        Left::Replaced => Ok(()),
        Left::Kept => Err(unfinished(what)),
        Left::Of { table } => {
            let own = lookup::settings_id(table);
            if line.starts_with(&format!("{}{own} ", kind())) {
                Ok(())
            } else {
                Err(unfinished(what))
            }
        }
    }
}

/// The line that names the task, and the settings.
fn title(task: Task<'_>) -> String {
    let (grid, base) = match task {
        Task::Build { grid } => (grid, String::new()),
        Task::Extension { grid, base } => (grid, format!(", extends {base}")),
    };
    let (kind, id) = (kind(), lookup::settings_id(grid));
    format!("{kind}{id} {}{base}\n{grid}", grid.len())
}

/// Reads a journal or a shard without changing it: its settings and its whole records.
pub(crate) fn read(path: &Path) -> Result<(String, HashMap<Block, Row>), BuildError> {
    regular(path)?;
    let failed = || file_error("read", path);
    let file = File::open(path).map_err(failed())?;
    let bytes = contents(&file, MOST_OF_TITLE)
        .or_else(|_| start(&file))
        .map_err(failed())?;
    let foreign = || BuildError::NotBlocks {
        path: path.to_owned(),
    };
    let end = bytes
        .iter()
        .position(|&byte| byte == b'\n')
        .ok_or_else(foreign)?;
    let line = std::str::from_utf8(&bytes[..end])
        .ok()
        .and_then(|line| line.strip_prefix(&kind()));
    let length: usize = line
        .and_then(|line| line.split_once(' ')?.1.parse().ok())
        .ok_or_else(foreign)?;
    let text = bytes
        .get(end + 1..)
        .and_then(|rest| rest.get(..length))
        .ok_or_else(foreign)?;
    let grid = std::str::from_utf8(text).map_err(|_| foreign())?;
    if !bytes.starts_with(title(Task::Build { grid }).as_bytes()) {
        return Err(foreign());
    }
    let whole = contents(&file, most_bytes(grid)).map_err(failed())?;
    let (rows, _) = records(&whole, end + 1 + length);
    Ok((grid.to_owned(), rows))
}

/// Bytes of the line that names the task and of the settings at most.
const MOST_OF_TITLE: u64 = 1 << 20;

/// Bytes that a journal of some settings can have: each block once or twice.
fn most_bytes(grid: &str) -> u64 {
    let numbers = Grid::parse(grid).and_then(|grid| grid.memory_bytes());
    MOST_OF_TITLE + numbers.map_or(0, |bytes| bytes as u64)
}

/// All of a file from its start, which has so many bytes at most.
fn contents(file: &File, most: u64) -> std::io::Result<Vec<u8>> {
    let (length, mut file, mut bytes) = (file.metadata()?.len(), file, Vec::new());
    if length > most {
        let detail = format!("it has {length} bytes, more than its settings explain, {most}");
        return Err(std::io::Error::other(detail));
    }
    file.seek(SeekFrom::Start(0))?;
    file.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The first bytes of a long file.
fn start(file: &File) -> std::io::Result<Vec<u8>> {
    let (mut file, mut bytes) = (file, Vec::new());
    file.seek(SeekFrom::Start(0))?;
    file.take(MOST_OF_TITLE).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Refuses pipes and devices: they wait for their other end, or never end.
fn regular(path: &Path) -> Result<(), BuildError> {
    let data = std::fs::metadata(path).map_err(file_error("read", path))?;
    if data.is_file() {
        return Ok(());
    }
    let source = std::io::Error::other("it is not a file");
    Err(file_error("read", path)(source))
}

fn file_error(action: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> BuildError {
    let path = path.to_owned();
    move |source| BuildError::File {
        action,
        path,
        source,
    }
}

/// All whole records from `start`, and where the last of them ends.
fn records(bytes: &[u8], start: usize) -> (HashMap<Block, Row>, usize) {
    let (mut rows, mut place) = (HashMap::new(), start);
    while let Some((block, row, length)) = record(&bytes[place..]) {
        rows.insert(block, row);
        place += length;
    }
    (rows, place)
}

fn record(bytes: &[u8]) -> Option<(Block, Row, usize)> {
    let header = bytes.get(..HEADER)?;
    let mut numbers = header.chunks_exact(8).map(|b| {
        let mut word = [0; 8];
        word.copy_from_slice(b);
        usize::try_from(u64::from_le_bytes(word)).ok()
    });
    let mut next = || numbers.next().flatten();
    let slice = next()?;
    let kind = match next()? {
        0 => Kind::Nodes,
        1 => Kind::Probes,
        2 => Kind::Between,
        3.. => return None,
    };
    let block = Block {
        slice,
        kind,
        row: next()?,
    };
    let lengths = [next()?, next()?, next()?, next()?];
    let count = lengths
        .iter()
        .try_fold(0_usize, |sum, &length| sum.checked_add(length))?;
    let body = HEADER.checked_add(count.checked_mul(4)?)?;
    let stated = bytes.get(body..body.checked_add(SUM)?)?;
    if Sha256::digest(&bytes[..body]).as_slice() != stated {
        return None;
    }
    let mut values = bytes[HEADER..body].chunks_exact(4).map(|b| {
        let mut word = [0; 4];
        word.copy_from_slice(b);
        f32::from_le_bytes(word)
    });
    let mut take = |n: usize| values.by_ref().take(n).collect();
    let row = Row {
        remainder: take(lengths[0]),
        moment: take(lengths[1]),
        curvature: take(lengths[2]),
        tail: take(lengths[3]),
    };
    Some((block, row, body + SUM))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ABC: Task<'_> = Task::Build { grid: "abc" };

    fn row(seed: f32) -> Row {
        Row {
            remainder: vec![seed; 7],
            moment: vec![2.0 * seed; 7],
            curvature: vec![3.0 * seed; 7],
            tail: vec![seed, -seed],
        }
    }

    fn block(row: usize) -> Block {
        Block {
            slice: 0,
            kind: Kind::Probes,
            row,
        }
    }

    #[test]
    fn a_journal_cut_anywhere_gives_back_its_whole_records() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.journal");
        let (mut journal, found) = Journal::open(&path, ABC, Left::Kept).unwrap();
        assert!(found.is_empty());
        for i in 0..3 {
            journal.record(block(i), &row(i as f32)).unwrap();
        }
        drop(journal);
        let whole = std::fs::read(&path).unwrap();
        let size = (whole.len() - title(ABC).len()) / 3;
        for length in 0..=whole.len() {
            std::fs::write(&path, &whole[..length]).unwrap();
            let (_, found) = Journal::open(&path, ABC, Left::Kept).unwrap();
            let expected = length.saturating_sub(title(ABC).len()) / size;
            assert_eq!(found.len(), expected, "cut at {length}");
            assert!(found.iter().all(|(b, r)| *r == row(b.row as f32)));
        }
    }

    #[test]
    fn what_is_unfinished_is_kept_until_it_may_go_and_a_strange_file_always() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.journal");
        let extension = |base| Task::Extension { grid: "xyz", base };
        let of = |table| Left::Of { table };
        // what is there, what is wanted, what may go, whether it goes
        let cases = [
            (ABC, Task::Build { grid: "xyz" }, Left::Kept, false),
            (ABC, Task::Build { grid: "xyz" }, Left::Replaced, true),
            (ABC, extension("1"), of("abc"), true),
            (ABC, extension("1"), of("abcd"), false),
            (extension("1"), ABC, of("abc"), false),
            (extension("1"), extension("2"), of("abc"), false),
            (extension("1"), ABC, of("xyz"), true),
            (extension("1"), ABC, Left::Replaced, true),
        ];
        for (there, wanted, left, goes) in cases {
            let _ = std::fs::remove_file(&path);
            let (mut journal, _) = Journal::open(&path, there, Left::Kept).unwrap();
            journal.record(block(0), &row(1.0)).unwrap();
            let before = std::fs::read(&path).unwrap();
            match Journal::open(&path, wanted, left) {
                Ok((_, rows)) => assert!(goes && rows.is_empty(), "{there:?} {wanted:?}"),
                Err(BuildError::OtherSettings { .. }) => {
                    assert!(!goes, "{there:?} {wanted:?}");
                    assert_eq!(std::fs::read(&path).unwrap(), before);
                }
                Err(other) => panic!("{other}"),
            }
        }
        std::fs::write(&path, "precious").unwrap();
        for left in [Left::Kept, Left::Replaced, of("abc")] {
            let refused = Journal::open(&path, ABC, left);
            assert!(matches!(refused, Err(BuildError::NotJournal { .. })));
        }
        assert_eq!(std::fs::read(&path).unwrap(), b"precious");
    }
}
