//! Bytes of a file, and a cursor that never reads beyond them.

use crate::error::{HdfError, damaged};
use std::fmt;
use std::io::{self, Read, Seek, SeekFrom};
use std::sync::{Mutex, PoisonError};

/// Bytes that can be read at any place.
pub trait Bytes: Send + Sync {
    /// How many.
    fn length(&self) -> u64;

    /// Fills a slice with those from a place on.
    ///
    /// # Errors
    /// What the system says, also where they end before.
    fn fill(&self, at: u64, into: &mut [u8]) -> io::Result<()>;
}

impl Bytes for Vec<u8> {
    fn length(&self) -> u64 {
        self.len() as u64
    }

    fn fill(&self, at: u64, into: &mut [u8]) -> io::Result<()> {
        let from = usize::try_from(at).ok();
        let part = from.and_then(|from| self.get(from..from.checked_add(into.len())?));
        match part {
            Some(part) => {
                into.copy_from_slice(part);
                Ok(())
            }
            None => Err(io::ErrorKind::UnexpectedEof.into()),
        }
    }
}

/// An open file.
#[derive(Debug)]
pub(crate) struct OnDisk {
    file: Mutex<std::fs::File>,
    length: u64,
}

impl OnDisk {
    /// A regular file; it is looked at before it is opened, since a pipe would wait for its other end.
    pub(crate) fn open(path: &std::path::Path) -> Result<Self, HdfError> {
        if !std::fs::metadata(path)?.is_file() {
            return Err(HdfError::NotAFile);
        }
        let file = std::fs::File::open(path)?;
        let length = file.metadata()?.len();
        Ok(Self {
            file: Mutex::new(file),
            length,
        })
    }
}

impl Bytes for OnDisk {
    fn length(&self) -> u64 {
        self.length
    }

    fn fill(&self, at: u64, into: &mut [u8]) -> io::Result<()> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(at))?;
        file.read_exact(into)
    }
}

impl fmt::Debug for dyn Bytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes", self.length())
    }
}

/// Reads little-endian numbers one after the other; where the bytes end, that is damage of `what`.
#[derive(Debug, Clone)]
pub(crate) struct Cursor<'a> {
    bytes: &'a [u8],
    what: &'static str,
}

impl<'a> Cursor<'a> {
    pub(crate) fn new(bytes: &'a [u8], what: &'static str) -> Self {
        Self { bytes, what }
    }

    /// What is left.
    pub(crate) fn rest(&self) -> &'a [u8] {
        self.bytes
    }

    pub(crate) fn take(&mut self, count: usize) -> Result<&'a [u8], HdfError> {
        match self.bytes.split_at_checked(count) {
            Some((taken, rest)) => {
                self.bytes = rest;
                Ok(taken)
            }
            None => Err(damaged(format!("{} ends too soon", self.what))),
        }
    }

    pub(crate) fn skip(&mut self, count: usize) -> Result<(), HdfError> {
        self.take(count).map(drop)
    }

    /// A number of `count` bytes, at most eight.
    pub(crate) fn number(&mut self, count: usize) -> Result<u64, HdfError> {
        let mut word = [0; 8];
        let taken = self.take(count)?;
        match word.get_mut(..count) {
            Some(low) => low.copy_from_slice(taken),
            None => {
                return Err(damaged(format!(
                    "{} has a number of {count} bytes",
                    self.what
                )));
            }
        }
        Ok(u64::from_le_bytes(word))
    }

    pub(crate) fn u8(&mut self) -> Result<u8, HdfError> {
        Ok(self.take(1)?[0])
    }

    pub(crate) fn u16(&mut self) -> Result<u16, HdfError> {
        Ok(self.number(2)? as u16)
    }

    pub(crate) fn u32(&mut self) -> Result<u32, HdfError> {
        Ok(self.number(4)? as u32)
    }

    pub(crate) fn u64(&mut self) -> Result<u64, HdfError> {
        self.number(8)
    }

    /// A length in memory.
    pub(crate) fn size(&mut self) -> Result<usize, HdfError> {
        let size = self.u64()?;
        usize::try_from(size).map_err(|_| damaged(format!("{} has a length of {size}", self.what)))
    }

    /// A signature or a version, of which there is one.
    pub(crate) fn expect(&mut self, wanted: &[u8]) -> Result<(), HdfError> {
        if self.take(wanted.len())? == wanted {
            Ok(())
        } else {
            Err(damaged(format!("{} does not start as one", self.what)))
        }
    }

    /// A text of `count` bytes that ends at its first NUL.
    pub(crate) fn name(&mut self, count: usize) -> Result<&'a str, HdfError> {
        name(self.take(count)?)
    }
}

/// A text up to its first NUL.
pub(crate) fn name(bytes: &[u8]) -> Result<&str, HdfError> {
    let end = bytes.iter().position(|&b| b == 0).unwrap_or(bytes.len());
    std::str::from_utf8(&bytes[..end]).map_err(|_| damaged("a name is not UTF-8"))
}
