//! Finished blocks on disk, so that an interrupted sweep goes on where it stopped.
//!
//! A header (magic number, fingerprint of the sweep, rows) and one record a block: first row, rows,
//! length of the failures' text, the numbers, the models, the failures, and a hash of all that.
//! A record that is cut short or damaged ends the journal; what comes after is computed anew.

use super::block::Block;
use crate::quantities::QUANTITIES;
use std::fs::{File, OpenOptions};
use std::io::{BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// First bytes of a journal; the last is its version.
const MAGIC: &[u8; 8] = b"hlsweep2";

/// A journal open for appending.
#[derive(Debug)]
pub struct Journal {
    file: File,
    path: PathBuf,
}

/// Why a journal cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// It was begun by another sweep.
    #[error(
        "{} holds the beginning of another sweep: finish that one, or remove the file",
        path.display()
    )]
    Other {
        /// The file.
        path: PathBuf,
    },
    /// The system refuses.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: std::io::Error,
    },
}

impl Journal {
    /// Opens or begins the journal of a sweep and gives the blocks that it holds.
    ///
    /// # Errors
    /// [`JournalError`].
    pub fn open(
        path: &Path,
        fingerprint: u64,
        rows: usize,
    ) -> Result<(Self, Vec<Block>), JournalError> {
        let io = |source| JournalError::Io {
            path: path.to_owned(),
            source,
        };
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(io)?;
        let mut header = MAGIC.to_vec();
        header.extend(fingerprint.to_le_bytes());
        header.extend((rows as u64).to_le_bytes());
        let mut blocks = Vec::new();
        let mut good = header.len() as u64;
        let mut found = vec![0; header.len()];
        let length = file.metadata().map_err(io)?.len();
        let mut reader = BufReader::new(&file);
        match reader.read_exact(&mut found) {
            Ok(()) if found == header => {
                while let Some((block, size)) = read_block(&mut reader, rows, length - good) {
                    good += size;
                    blocks.push(block);
                }
                drop(reader);
                file.set_len(good).map_err(io)?;
                file.seek(SeekFrom::End(0)).map_err(io)?;
            }
            Ok(()) => {
                return Err(JournalError::Other {
                    path: path.to_owned(),
                });
            }
            // shorter than a header: nothing was done yet
            Err(_) => {
                drop(reader);
                file.set_len(0).map_err(io)?;
                file.rewind().map_err(io)?;
                file.write_all(&header).map_err(io)?;
            }
        }
        Ok((
            Self {
                file,
                path: path.to_owned(),
            },
            blocks,
        ))
    }

    /// Appends a finished block.
    ///
    /// # Errors
    /// [`JournalError::Io`].
    pub fn append(&mut self, block: &Block) -> Result<(), JournalError> {
        self.file
            .write_all(&record(block))
            .map_err(|source| JournalError::Io {
                path: self.path.clone(),
                source,
            })
    }

    /// Removes the file once the sweep is written elsewhere.
    pub fn remove(self) {
        let _ = std::fs::remove_file(&self.path);
    }
}

fn record(block: &Block) -> Vec<u8> {
    let mut text = String::new();
    for (row, reason) in &block.failures {
        text.push_str(&format!("{row} {}\n", reason.replace('\n', " ")));
    }
    let rows = block.numbers.len();
    let mut bytes = Vec::with_capacity(32 + rows * (8 * QUANTITIES.len() + 1) + text.len());
    for number in [block.start, rows, text.len()] {
        bytes.extend((number as u64).to_le_bytes());
    }
    for number in block.numbers.iter().flatten() {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(&block.models);
    bytes.extend(text.as_bytes());
    bytes.extend(fingerprint(&bytes).to_le_bytes());
    bytes
}

/// The next block and the length of its record; nothing at the end and after damage.
///
/// Memory is taken for a record of at most `left` bytes, which the file has, of a sweep of `all` rows.
fn read_block(reader: &mut impl Read, all: usize, left: u64) -> Option<(Block, u64)> {
    let mut bytes = vec![0; 24];
    reader.read_exact(&mut bytes).ok()?;
    let word = |bytes: &[u8], i: usize| {
        let eight: [u8; 8] = bytes[8 * i..8 * i + 8].try_into().ok()?;
        Some(u64::from_le_bytes(eight))
    };
    let (start, rows, text) = (word(&bytes, 0)?, word(&bytes, 1)?, word(&bytes, 2)?);
    let numbers = (rows as usize).checked_mul(8 * QUANTITIES.len())?;
    let length = numbers
        .checked_add(rows as usize)?
        .checked_add(text as usize)?;
    let end = (start as usize).checked_add(rows as usize)?;
    if length as u64 > left.checked_sub(32)? || rows == 0 || end > all {
        return None;
    }
    bytes.resize(24 + length, 0);
    reader.read_exact(&mut bytes[24..]).ok()?;
    let mut hash = [0; 8];
    reader.read_exact(&mut hash).ok()?;
    if fingerprint(&bytes) != u64::from_le_bytes(hash) {
        return None;
    }
    let body = &bytes[24..];
    let row_numbers = body[..numbers].chunks_exact(8 * QUANTITIES.len());
    let read = |chunk: &[u8], k: usize| word(chunk, k).map_or(f64::NAN, f64::from_bits);
    let failures = std::str::from_utf8(&body[numbers + rows as usize..]).ok()?;
    let block = Block {
        start: start as usize,
        numbers: row_numbers
            .map(|chunk| std::array::from_fn(|k| read(chunk, k)))
            .collect(),
        models: body[numbers..numbers + rows as usize].to_vec(),
        failures: failures
            .lines()
            .map(|line| {
                let (row, reason) = line.split_once(' ')?;
                Some((row.parse().ok()?, reason.to_owned()))
            })
            .collect::<Option<_>>()?,
    };
    block.holds().then_some((block, 32 + length as u64))
}

/// Fowler, Noll and Vo's hash over words of eight bytes.
pub(crate) fn fingerprint(bytes: &[u8]) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for chunk in bytes.chunks(8) {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        hash = (hash ^ u64::from_le_bytes(word)).wrapping_mul(0x0100_0000_01b3);
        hash ^= hash >> 29;
    }
    hash
}
