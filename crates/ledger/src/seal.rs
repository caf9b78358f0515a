//! The seal behind the last byte of a finished HDF5 file: a SHA-256 of every 8 KiB of it.
//!
//! ```text
//! HDF5 bytes | SHA-256 of each 8,192 of them, the last may be fewer | magic 8 | length of the HDF5 bytes u64 | SHA-256 of the seal up to here
//! ```
//! The integer is little-endian. Bytes are compared when they are read, so that a part of a file costs no more than its
//! own pieces; a piece has its place in the list, so that pieces which were exchanged are seen too.

use hdfread::{Bytes, File, HdfError};
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// How the last part of a seal starts.
const MAGIC: &[u8; 8] = b"hlseal2\n";
/// Bytes of the last part: magic, length, digest.
const END: usize = 8 + 8 + DIGEST;
/// Bytes with a digest of their own.
const PIECE: usize = 1 << 13;
const DIGEST: usize = 32;
/// Pieces that are read and digested together.
const TOGETHER: usize = 512;
/// Pieces that stay in memory: what describes a dataset is read bit by bit.
const HELD: usize = 64;

/// Appends its seal to a finished HDF5 file.
///
/// # Errors
/// What the system says.
pub fn seal(path: &Path) -> io::Result<()> {
    let mut file = std::fs::File::options()
        .read(true)
        .append(true)
        .open(path)?;
    let length = file.metadata()?.len();
    let mut seal = digests(&file, length)?.into_flattened();
    seal.extend(MAGIC);
    seal.extend(length.to_le_bytes());
    let sum = Sha256::digest(&seal);
    seal.extend(sum);
    file.write_all(&seal)
}

/// Opens an HDF5 file, with its seal where it has one: bytes are compared when they are read.
///
/// # Errors
/// [`HdfError`].
pub fn open(path: &Path) -> Result<(File, Option<Seal>), HdfError> {
    // looked at before it is opened: a pipe would wait for its other end
    if !std::fs::metadata(path)?.is_file() {
        return Err(HdfError::NotAFile);
    }
    match sealed(path)?.map(Arc::new) {
        None => Ok((File::open(path)?, None)),
        Some(sealed) => {
            let file = File::from_bytes(Arc::clone(&sealed) as _);
            let file = file.map_err(|error| match error {
                HdfError::Io(error) if error.kind() == ErrorKind::InvalidData => {
                    let what = error.to_string();
                    HdfError::Damaged { what }
                }
                other => other,
            });
            Ok((file?, Some(Seal(sealed))))
        }
    }
}

/// The bytes of a file that ends with a seal.
fn sealed(path: &Path) -> Result<Option<Sealed>, HdfError> {
    let mut file = std::fs::File::open(path)?;
    let whole = file.metadata()?.len();
    let mut end = [0; END];
    if whole >= END as u64 {
        file.seek(SeekFrom::End(-(END as i64)))?;
        file.read_exact(&mut end)?;
    }
    if !end.starts_with(MAGIC) {
        return Ok(None);
    }
    let broken = || HdfError::Damaged {
        what: "its seal is broken".to_owned(),
    };
    let mut length = [0; 8];
    length.copy_from_slice(&end[8..16]);
    let length = u64::from_le_bytes(length);
    let pieces = length.div_ceil(PIECE as u64);
    let listed = pieces.saturating_mul(DIGEST as u64);
    if listed.saturating_add(length).saturating_add(END as u64) != whole {
        return Err(broken());
    }
    file.seek(SeekFrom::Start(length))?;
    let mut digests = vec![[0; DIGEST]; pieces as usize];
    file.read_exact(digests.as_flattened_mut())?;
    let sum = Sha256::new()
        .chain_update(digests.as_flattened())
        .chain_update(&end[..16])
        .finalize();
    if sum[..] != end[16..] {
        return Err(broken());
    }
    Ok(Some(Sealed {
        length,
        digests,
        file: Mutex::new(file),
        held: Mutex::default(),
    }))
}

/// The seal of an open file.
#[derive(Debug, Clone)]
pub struct Seal(Arc<Sealed>);

impl Seal {
    /// Compares every byte of the file.
    ///
    /// # Errors
    /// What the system says, or where bytes are not those that were sealed.
    pub fn check(&self) -> io::Result<()> {
        let sealed = &self.0;
        let file = sealed.file.lock().unwrap_or_else(PoisonError::into_inner);
        let found = digests(&file, sealed.length)?;
        match found.iter().zip(&sealed.digests).position(|(a, b)| a != b) {
            Some(piece) => Err(changed(piece)),
            None => Ok(()),
        }
    }
}

#[derive(Debug)]
struct Sealed {
    /// Bytes of the HDF5 part.
    length: u64,
    digests: Vec<[u8; DIGEST]>,
    file: Mutex<std::fs::File>,
    /// The pieces that were read last, each with its place.
    held: Mutex<VecDeque<(usize, Vec<u8>)>>,
}

impl Bytes for Sealed {
    fn length(&self) -> u64 {
        self.length
    }

    fn fill(&self, mut at: u64, mut into: &mut [u8]) -> io::Result<()> {
        let end = at.checked_add(into.len() as u64);
        if end.is_none_or(|end| end > self.length) {
            return Err(ErrorKind::UnexpectedEof.into());
        }
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        while !into.is_empty() {
            let (piece, from) = ((at / PIECE as u64) as usize, (at % PIECE as u64) as usize);
            let known = held.iter().position(|(place, _)| *place == piece);
            let bytes = match known {
                Some(known) => &held[known].1,
                None => {
                    held.truncate(HELD - 1);
                    held.push_front((piece, self.piece(piece)?));
                    &held[0].1
                }
            };
            let count = into.len().min(bytes.len() - from);
            into[..count].copy_from_slice(&bytes[from..from + count]);
            (at, into) = (at + count as u64, &mut into[count..]);
        }
        Ok(())
    }
}

impl Sealed {
    /// The bytes of a piece, compared.
    fn piece(&self, piece: usize) -> io::Result<Vec<u8>> {
        let start = piece as u64 * PIECE as u64;
        let mut bytes = vec![0; (self.length - start).min(PIECE as u64) as usize];
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(start))?;
        file.read_exact(&mut bytes)?;
        if Sha256::digest(&bytes)[..] == self.digests[piece] {
            Ok(bytes)
        } else {
            Err(changed(piece))
        }
    }
}

fn changed(piece: usize) -> io::Error {
    let (start, end) = (piece * PIECE, (piece + 1) * PIECE);
    let what =
        format!("its bytes from {start} to {end} are not those that were sealed when it was made");
    io::Error::new(ErrorKind::InvalidData, what)
}

/// The digests of the first bytes of a file.
fn digests(file: &std::fs::File, length: u64) -> io::Result<Vec<[u8; DIGEST]>> {
    let mut file = file;
    file.rewind()?;
    let mut found = Vec::new();
    let mut bytes = vec![0; (TOGETHER * PIECE).min(length as usize)];
    let mut left = length;
    while left > 0 {
        let count = bytes.len().min(left as usize);
        file.read_exact(&mut bytes[..count])?;
        let pieces = bytes[..count].par_chunks(PIECE);
        found.par_extend(pieces.map(|piece| <[u8; DIGEST]>::from(Sha256::digest(piece))));
        left -= count as u64;
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three pieces and a bit, sealed.
    fn good(folder: &tempfile::TempDir) -> Vec<u8> {
        let path = folder.path().join("good");
        let bytes: Vec<u8> = (0..3 * PIECE + 100).map(|i| (i * i / 7) as u8).collect();
        std::fs::write(&path, bytes).unwrap();
        seal(&path).unwrap();
        std::fs::read(&path).unwrap()
    }

    /// What is said of bytes: nothing where all is right, and of those without a seal that they have none.
    fn said(folder: &tempfile::TempDir, bytes: &[u8]) -> Option<String> {
        let path = folder.path().join("tried");
        std::fs::write(&path, bytes).unwrap();
        match sealed(&path) {
            Ok(None) => Some("no seal".to_owned()),
            Err(error) => Some(error.to_string()),
            Ok(Some(sealed)) => {
                let mut all = vec![0; sealed.length as usize];
                let read = sealed
                    .fill(0, &mut all)
                    .err()
                    .map(|error| error.to_string());
                let checked = Seal(Arc::new(sealed)).check().err();
                assert_eq!(read, checked.map(|error| error.to_string()));
                assert!(read.is_some() || all == bytes[..all.len()]);
                read
            }
        }
    }

    #[test]
    fn every_byte_is_covered() {
        let folder = tempfile::tempdir().unwrap();
        let good = good(&folder);
        assert_eq!(said(&folder, &good), None);
        let sealed = 3 * PIECE + 100;
        for place in (0..sealed).step_by(9973).chain(sealed - 3..good.len()) {
            let mut bad = good.clone();
            bad[place] ^= 1 << (place % 8);
            assert!(said(&folder, &bad).is_some(), "byte {place}");
        }
    }

    #[test]
    fn bytes_that_are_lost_added_or_exchanged_are_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let good = good(&folder);
        for length in (0..good.len())
            .step_by(7919)
            .chain(good.len() - 60..good.len())
        {
            assert!(said(&folder, &good[..length]).is_some(), "{length} bytes");
        }
        assert!(said(&folder, &[&good[..], b"x"].concat()).is_some());
        let (mut bad, piece) = (good.clone(), PIECE);
        let (first, second) = bad.split_at_mut(piece);
        first.swap_with_slice(&mut second[..piece]);
        assert!(said(&folder, &bad).unwrap().contains("from 0 to 8192"));
    }
}
