//! Finished blocks on disk, so that an interrupted sweep goes on where it stopped.
//!
//! A header (magic number, fingerprint of the sweep, first row and the one behind the last) and one record a block: first row, rows,
//! length of the failures' text, the numbers, those that probes bring, the models, the failures, and a hash of all that.
//! A record that is cut short or damaged ends the journal; what comes after is computed anew.

use super::rows::Block;
use crate::quantities::QUANTITIES;
use output::{Existing, Fault, OutputError};
use std::fs::{File, OpenOptions};
use std::io::{BufReader, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// First bytes of a journal; the last is its version.
const MAGIC: &[u8; 8] = b"hlsweep4";
/// Bytes before the first record.
const HEADER: usize = 8 + 32 + 16;
/// Time between two flushes: what a loss of power costs at most, beside the block in work.
const FLUSH: Duration = Duration::from_secs(10);

/// Which sweep a journal is of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Header {
    /// SHA-256 of everything that is asked and was read.
    pub(super) fingerprint: [u8; 32],
    /// Rows of the sweep that it is to hold.
    pub(super) rows: Range<usize>,
    /// Numbers that probes bring to a row.
    pub(super) width: usize,
}

impl Header {
    fn bytes(&self) -> [u8; HEADER] {
        let mut bytes = [0; HEADER];
        bytes[..8].copy_from_slice(MAGIC);
        bytes[8..40].copy_from_slice(&self.fingerprint);
        bytes[40..48].copy_from_slice(&(self.rows.start as u64).to_le_bytes());
        bytes[48..].copy_from_slice(&(self.rows.end as u64).to_le_bytes());
        bytes
    }
}

/// A journal open for appending.
#[derive(Debug)]
pub struct Journal {
    file: File,
    path: PathBuf,
    flushed: Instant,
    length: u64,
    /// Numbers that probes bring to a row.
    width: usize,
}

/// Where a journal has a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Span {
    /// First row.
    pub(super) start: usize,
    /// Rows.
    pub(super) count: usize,
    /// Where its record begins.
    place: u64,
}

/// Why a journal cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// It was begun by another sweep.
    #[error(
        "{} holds the beginning of another sweep, or of this one before its files or the program changed",
        path.display()
    )]
    Other {
        /// The file.
        path: PathBuf,
    },
    /// It is a file of somebody else.
    #[error("{} is not the beginning of a sweep and is kept: give the output another name", path.display())]
    Strange {
        /// The file.
        path: PathBuf,
    },
    /// It cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: std::io::Error,
    },
    /// It cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl Journal {
    /// Opens or begins the journal of a sweep and says which blocks it holds, ascending and apart.
    ///
    /// Whoever opens it has claimed the output; the beginning of another sweep is replaced where that is asked for.
    pub(super) fn open(
        path: &Path,
        header: &Header,
        existing: Existing,
    ) -> Result<(Self, Vec<Span>), JournalError> {
        let path = path.to_owned();
        let io = |source| JournalError::Io {
            path: path.clone(),
            source,
        };
        let there = std::fs::symlink_metadata(&path);
        if there.as_ref().is_ok_and(|there| !there.is_file()) {
            return Err(JournalError::Strange { path });
        }
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create_new(there.is_err())
            .open(&path)
            .map_err(|error| OutputError::writing(&path, error))?;
        let found = start(&file).map_err(io)?;
        let (mut spans, mut length) = (Vec::new(), HEADER as u64);
        if found == header.bytes() {
            (spans, length) = read_spans(&file, header).map_err(io)?;
            file.set_len(length).map_err(io)?;
            file.seek(SeekFrom::End(0)).map_err(io)?;
        } else {
            let known = found.len().min(MAGIC.len() - 1);
            if found[..known] != MAGIC[..known] {
                return Err(JournalError::Strange { path });
            }
            // one that ends within its header holds nothing
            if found.len() == HEADER && existing != Existing::Replace {
                return Err(JournalError::Other { path });
            }
            file.set_len(0).map_err(io)?;
            file.rewind().map_err(io)?;
            file.write_all(&header.bytes())
                .map_err(|error| OutputError::writing(&path, error))?;
        }
        let journal = Self {
            file,
            path,
            flushed: Instant::now(),
            length,
            width: header.width,
        };
        Ok((journal, spans))
    }

    /// Rows of this sweep that the journal at `path` holds; nothing where there is none of it.
    pub(super) fn rows_in(path: &Path, header: &Header) -> Option<usize> {
        if !std::fs::symlink_metadata(path).ok()?.is_file() {
            return None;
        }
        let file = File::open(path).ok()?;
        if start(&file).ok()? != header.bytes() {
            return None;
        }
        let (spans, _) = read_spans(&file, header).ok()?;
        Some(spans.iter().map(|span| span.count).sum())
    }

    /// Appends a finished block.
    pub(super) fn append(&mut self, block: &Block) -> Result<Span, JournalError> {
        let bytes = record(block);
        let mut done = self.file.write_all(&bytes);
        if done.is_ok() && self.flushed.elapsed() > FLUSH {
            done = self.file.sync_data();
            self.flushed = Instant::now();
        }
        done.map_err(|error| OutputError::writing(&self.path, error))?;
        let place = self.length;
        self.length += bytes.len() as u64;
        Ok(Span {
            start: block.start,
            count: block.numbers.len(),
            place,
        })
    }

    /// A block that it holds.
    pub(super) fn block(&self, span: &Span) -> Result<Block, Fault> {
        let mut file = &self.file;
        file.seek(SeekFrom::Start(span.place))?;
        let found = read_block(&mut file, self.length - span.place, self.width);
        let same = |block: &Block| (block.start, block.numbers.len()) == (span.start, span.count);
        found.map(|(block, _)| block).filter(same).ok_or_else(|| {
            let path = self.path.display();
            Fault::from(format!("{path} was changed while it was read"))
        })
    }

    /// Removes the file once the sweep is written elsewhere.
    pub fn remove(self) {
        let _ = std::fs::remove_file(&self.path);
    }
}

/// The first bytes of a file, as many as a header has or as there are.
fn start(file: &File) -> std::io::Result<Vec<u8>> {
    let mut found = Vec::new();
    let mut file = file;
    file.rewind()?;
    file.take(HEADER as u64).read_to_end(&mut found)?;
    Ok(found)
}

/// The blocks of a journal that stands behind its header, and where the last good record ends.
fn read_spans(file: &File, header: &Header) -> std::io::Result<(Vec<Span>, u64)> {
    let (rows, width) = (&header.rows, header.width);
    let length = file.metadata()?.len();
    let mut reader = BufReader::new(file);
    let mut good = HEADER as u64;
    let mut spans: Vec<Span> = Vec::new();
    while let Some((block, size)) = read_block(&mut reader, length - good, width) {
        let (start, count) = (block.start, block.numbers.len());
        let end = start.checked_add(count);
        if start < rows.start || end.is_none_or(|end| end > rows.end) {
            break;
        }
        spans.push(Span {
            start,
            count,
            place: good,
        });
        good += size;
    }
    spans.sort_by_key(|span| span.start);
    let mut end = 0;
    spans.retain(|span| {
        let apart = span.start >= end;
        if apart {
            end = span.start + span.count;
        }
        apart
    });
    Ok((spans, good))
}

fn record(block: &Block) -> Vec<u8> {
    let mut text = String::new();
    for (row, reason) in &block.failures {
        text.push_str(&format!("{row} {}\n", reason.replace('\n', " ")));
    }
    let rows = block.numbers.len();
    let mut bytes = Vec::with_capacity(
        32 + rows * (8 * QUANTITIES.len() + 1) + 8 * block.probed.len() + text.len(),
    );
    for number in [block.start, rows, text.len()] {
        bytes.extend((number as u64).to_le_bytes());
    }
    for number in block.numbers.iter().flatten().chain(&block.probed) {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(&block.models);
    bytes.extend(text.as_bytes());
    bytes.extend(sum(&bytes).to_le_bytes());
    bytes
}

/// The next block and the length of its record; nothing at the end and after damage.
///
/// `left` is what the file still has: no more memory is taken.
fn read_block(reader: &mut impl Read, left: u64, width: usize) -> Option<(Block, u64)> {
    const WIDTH: usize = QUANTITIES.len();
    let mut bytes = vec![0; 24];
    reader.read_exact(&mut bytes).ok()?;
    let [start, rows, text] = [0, 1, 2].map(|i| word(&bytes[8 * i..]));
    let size = rows
        .checked_mul(8 * (WIDTH + width) as u64 + 1)?
        .checked_add(text)?;
    if rows == 0 || size.checked_add(32)? > left {
        return None;
    }
    let (start, rows) = (usize::try_from(start).ok()?, usize::try_from(rows).ok()?);
    start.checked_add(rows)?;
    bytes.resize(24 + usize::try_from(size).ok()?, 0);
    reader.read_exact(&mut bytes[24..]).ok()?;
    let mut hash = [0; 8];
    reader.read_exact(&mut hash).ok()?;
    if sum(&bytes) != u64::from_le_bytes(hash) {
        return None;
    }
    let (contacts, rest) = bytes[24..].split_at(rows * 8 * WIDTH);
    let (probed, rest) = rest.split_at(rows * 8 * width);
    let (models, failures) = rest.split_at(rows);
    let failures = std::str::from_utf8(failures).ok()?.lines().map(|line| {
        let (row, reason) = line.split_once(' ')?;
        Some((row.parse().ok()?, reason.to_owned()))
    });
    let number = |bytes: &[u8]| f64::from_bits(word(bytes));
    let contacts = contacts.chunks_exact(8 * WIDTH);
    let block = Block {
        start,
        numbers: contacts
            .map(|row| std::array::from_fn(|k| number(&row[8 * k..])))
            .collect(),
        probed: probed.chunks_exact(8).map(number).collect(),
        models: models.to_vec(),
        failures: failures.collect::<Option<_>>()?,
    };
    block.holds().then_some((block, 32 + size))
}

/// The number in the first eight bytes.
fn word(bytes: &[u8]) -> u64 {
    let mut word = [0; 8];
    word.copy_from_slice(&bytes[..8]);
    u64::from_le_bytes(word)
}

/// Fowler, Noll and Vo's hash over words of eight bytes.
fn sum(bytes: &[u8]) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for chunk in bytes.chunks(8) {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        hash = (hash ^ u64::from_le_bytes(word)).wrapping_mul(0x0100_0000_01b3);
        hash ^= hash >> 29;
    }
    hash
}
