//! The seal, a checksum trailer after the last byte of a finished HDF5 file: a SHA-256 of each 8 KiB.
//!
//! ```text
//! HDF5 bytes | SHA-256 of each 8,192 of them, the last may be fewer | magic 8 | length of the HDF5 bytes u64 | SHA-256 of the seal up to here
//! ```
//! The integer is little-endian. Bytes are verified when they are read, so that reading a part of a file requires only
//! its own pieces. The list is in the order of the pieces, so that exchanged pieces are detected.

use crate::error::HdfError;
use hdf5_reader::error::Error;
use hdf5_reader::{Storage, StorageBuffer};
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// First bytes of the last part of the trailer.
const MAGIC: &[u8; 8] = b"hlseal2\n";
/// Bytes of the last part: magic, length, digest.
const TRAILER: usize = 8 + 8 + DIGEST;
/// Bytes per digest.
const PIECE: usize = 1 << 13;
const DIGEST: usize = 32;
/// Pieces that are read and digested together.
const PIECES_AT_A_TIME: usize = 512;
/// Pieces that stay in memory: the description of a dataset is read in many small reads.
const HELD: usize = 64;

/// Appends the checksum trailer to a finished HDF5 file that is open for reading and writing.
///
/// # Errors
/// An error of the operating system.
pub fn seal(mut file: &std::fs::File) -> io::Result<()> {
    let length = file.metadata()?.len();
    let mut seal = digests(file, length)?.into_flattened();
    seal.extend(MAGIC);
    seal.extend(length.to_le_bytes());
    let sum = Sha256::digest(&seal);
    seal.extend(sum);
    file.write_all(&seal)
}

/// The bytes of an open HDF5 file, verified if it has a checksum trailer.
#[derive(Debug)]
pub(crate) struct Sealed {
    /// Length of the HDF5 part in bytes.
    pub(crate) length: u64,
    /// Digest of each piece.
    pub(crate) digests: Option<Vec<[u8; DIGEST]>>,
    file: Mutex<std::fs::File>,
    /// The pieces that were read last, with their indices.
    held: Mutex<VecDeque<(usize, Vec<u8>)>>,
}

impl Sealed {
    /// Opens a regular file; its bytes are read on request.
    pub(crate) fn open(path: &Path) -> Result<Self, HdfError> {
        // checked before opening: a pipe would block
        if !std::fs::metadata(path)?.is_file() {
            return Err(io::Error::other("it is not a regular file").into());
        }
        let mut file = std::fs::File::open(path)?;
        let whole = file.metadata()?.len();
        let digests = read_seal(&mut file, whole)?;
        let behind = digests
            .as_ref()
            .map_or(0, |list| TRAILER + DIGEST * list.len());
        Ok(Self {
            length: whole - behind as u64,
            digests,
            file: Mutex::new(file),
            held: Mutex::default(),
        })
    }

    /// Verifies all bytes of a file that has a checksum trailer.
    pub(crate) fn check(&self) -> io::Result<()> {
        let Some(stated) = &self.digests else {
            return Ok(());
        };
        let file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let found = digests(&file, self.length)?;
        let differs = found.iter().zip(stated).position(|(a, b)| a != b);
        differs.map_or(Ok(()), |piece| Err(changed(piece)))
    }

    fn fill(&self, mut at: u64, mut into: &mut [u8]) -> io::Result<()> {
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        while !into.is_empty() {
            let (piece, from) = ((at / PIECE as u64) as usize, (at % PIECE as u64) as usize);
            let known = held.iter().position(|(place, _)| *place == piece);
            if known.is_none() {
                held.truncate(HELD - 1);
                held.push_front((piece, self.piece(piece)?));
            }
            let bytes = &held[known.unwrap_or(0)].1;
            let count = into.len().min(bytes.len() - from);
            into[..count].copy_from_slice(&bytes[from..from + count]);
            (at, into) = (at + count as u64, &mut into[count..]);
        }
        Ok(())
    }

    /// The bytes of a piece, verified.
    fn piece(&self, piece: usize) -> io::Result<Vec<u8>> {
        let start = piece as u64 * PIECE as u64;
        let mut bytes = vec![0; (self.length - start).min(PIECE as u64) as usize];
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(start))?;
        file.read_exact(&mut bytes)?;
        match &self.digests {
            Some(digests) if Sha256::digest(&bytes)[..] != digests[piece] => Err(changed(piece)),
            Some(_) | None => Ok(bytes),
        }
    }
}

impl Storage for Sealed {
    fn len(&self) -> u64 {
        self.length
    }

    fn read_range(&self, offset: u64, len: usize) -> Result<StorageBuffer, Error> {
        let end = offset.checked_add(len as u64);
        if end.is_none_or(|end| end > self.length) {
            return Err(Error::OffsetOutOfBounds(offset));
        }
        let mut bytes = vec![0; len];
        self.fill(offset, &mut bytes)?;
        Ok(StorageBuffer::from_vec(bytes))
    }
}

/// The digests of the pieces of a file of `whole` bytes; none if it has no checksum trailer.
fn read_seal(file: &mut std::fs::File, whole: u64) -> Result<Option<Vec<[u8; DIGEST]>>, HdfError> {
    let mut end = [0; TRAILER];
    if whole >= TRAILER as u64 {
        file.seek(SeekFrom::End(-(TRAILER as i64)))?;
        file.read_exact(&mut end)?;
    }
    if !end.starts_with(MAGIC) {
        return Ok(None);
    }
    let broken = || HdfError::Damaged("its checksum trailer is invalid".to_owned());
    let length = u64::from_le_bytes(end.as_chunks().0[1]);
    let pieces = length.div_ceil(PIECE as u64);
    let listed = pieces.saturating_mul(DIGEST as u64);
    if listed.saturating_add(length).saturating_add(TRAILER as u64) != whole {
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
    Ok(Some(digests))
}

fn changed(piece: usize) -> io::Error {
    let (start, end) = (piece * PIECE, (piece + 1) * PIECE);
    let what = format!("its bytes from {start} to {end} were changed after it was written");
    io::Error::new(ErrorKind::InvalidData, what)
}

/// The digests of the first bytes of a file.
fn digests(file: &std::fs::File, length: u64) -> io::Result<Vec<[u8; DIGEST]>> {
    let mut file = file;
    file.rewind()?;
    let mut found = Vec::new();
    let mut bytes = vec![0; (PIECES_AT_A_TIME * PIECE).min(length as usize)];
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
        let open = std::fs::File::options().read(true).write(true).open(&path);
        seal(&open.unwrap()).unwrap();
        std::fs::read(&path).unwrap()
    }

    /// The message about some bytes: none if all is right, and a note for bytes without a trailer.
    fn said(folder: &tempfile::TempDir, bytes: &[u8]) -> Option<String> {
        let path = folder.path().join("tried");
        std::fs::write(&path, bytes).unwrap();
        match Sealed::open(&path) {
            Err(error) => Some(error.to_string()),
            Ok(sealed) if sealed.digests.is_none() => Some("no seal".to_owned()),
            Ok(sealed) => {
                let mut all = vec![0; sealed.length as usize];
                let read = sealed
                    .fill(0, &mut all)
                    .err()
                    .map(|error| error.to_string());
                let checked = sealed.check().err();
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
