//! A file: its superblock, and bounded reading of its bytes.

use crate::bytes::{Bytes, Cursor, OnDisk};
use crate::error::{HdfError, damaged, unsupported};
use std::path::Path;
use std::sync::Arc;

/// How every HDF5 file starts.
const SIGNATURE: &[u8] = b"\x89HDF\r\n\x1a\n";
/// An address of nothing.
pub(crate) const NOWHERE: u64 = u64::MAX;
/// Where a superblock may be: at the start, or behind a block of the user's.
const STARTS: [u64; 5] = [0, 512, 1024, 2048, 4096];

/// An open file.
#[derive(Debug, Clone)]
pub struct File {
    bytes: Arc<dyn Bytes>,
    /// Addresses count from here.
    base: u64,
    /// Nothing lies beyond this address.
    end: u64,
    /// Address of the root's header.
    root: u64,
}

impl File {
    /// Opens the regular file at `path`.
    pub fn open(path: &Path) -> Result<Self, HdfError> {
        Self::from_bytes(Arc::new(OnDisk::open(path)?))
    }

    /// Takes bytes for a file.
    ///
    /// # Errors
    /// [`HdfError::NotHdf5`], [`HdfError::Damaged`], [`HdfError::Unsupported`].
    pub fn from_bytes(bytes: Arc<dyn Bytes>) -> Result<Self, HdfError> {
        let length = bytes.length();
        for start in STARTS {
            let mut block = vec![0; length.saturating_sub(start).min(128) as usize];
            if block.len() < SIGNATURE.len() {
                break;
            }
            bytes.fill(start, &mut block)?;
            if block.starts_with(SIGNATURE) {
                let (base, end, root) = superblock(&block)?;
                if base != start {
                    return Err(damaged("its superblock is not where it says"));
                }
                if end > length - start {
                    return Err(damaged(format!(
                        "it was cut short to {length} bytes, {} were written",
                        end.saturating_add(start)
                    )));
                }
                return Ok(Self {
                    bytes,
                    base,
                    end,
                    root,
                });
            }
        }
        Err(HdfError::NotHdf5)
    }

    /// Bytes of the whole file.
    #[must_use]
    pub fn length(&self) -> u64 {
        self.bytes.length()
    }

    pub(crate) fn root_address(&self) -> u64 {
        self.root
    }

    /// The bytes of `what` at an address; none are taken room for that are not there.
    pub(crate) fn read(
        &self,
        address: u64,
        length: usize,
        what: &'static str,
    ) -> Result<Vec<u8>, HdfError> {
        let inside = address
            .checked_add(length as u64)
            .is_some_and(|end| end <= self.end);
        if !inside {
            return Err(damaged(format!("{what} lies outside the file")));
        }
        let mut found = vec![0; length];
        self.bytes.fill(self.base + address, &mut found)?;
        Ok(found)
    }

    /// The bytes at an address up to a length or the end of the file.
    pub(crate) fn read_up_to(
        &self,
        address: u64,
        most: usize,
        what: &'static str,
    ) -> Result<Vec<u8>, HdfError> {
        let there = self.end.saturating_sub(address).min(most as u64);
        self.read(address, there as usize, what)
    }
}

/// Base address, end and address of the root's header.
fn superblock(block: &[u8]) -> Result<(u64, u64, u64), HdfError> {
    let mut at = Cursor::new(block, "its superblock");
    at.skip(SIGNATURE.len())?;
    let version = at.u8()?;
    let found = match version {
        0 | 1 => {
            at.skip(4)?;
            sizes(&mut at)?;
            at.skip(if version == 0 { 9 } else { 13 })?;
            let (base, _free, end, _driver) = (at.u64()?, at.u64()?, at.u64()?, at.u64()?);
            at.skip(8)?;
            (base, end, at.u64()?)
        }
        2 | 3 => {
            sizes(&mut at)?;
            at.skip(1)?;
            let (base, _extension, end) = (at.u64()?, at.u64()?, at.u64()?);
            let root = at.u64()?;
            (base, end, root)
        }
        4.. => {
            return Err(unsupported(format!(
                "version {version} of HDF5's superblock"
            )));
        }
    };
    // The end counts from the start of the file in some versions: both bounds are checked against its length.
    Ok((found.0, found.1.saturating_sub(found.0), found.2))
}

/// Addresses and lengths of eight bytes, as every library of today writes them.
fn sizes(at: &mut Cursor<'_>) -> Result<(), HdfError> {
    match (at.u8()?, at.u8()?) {
        (8, 8) => Ok(()),
        (offset, length) => Err(unsupported(format!(
            "a file with addresses of {offset} and lengths of {length} bytes"
        ))),
    }
}
