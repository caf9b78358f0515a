//! The seal behind the HDF5 part of a file: a SHA-256 over all of it that no checksum of a chunk covers.
//!
//! The HDF5 library crashes or loops on damaged metadata, so they are compared before it is asked.
//! ```text
//! HDF5 bytes | (offset u64, length u64) of each run of checked chunks | magic 8 | HDF5 length u64 | runs u64 | SHA-256
//! ```
//! All integers are little-endian. The digest is over the HDF5 bytes outside the runs, in their order, then over
//! everything in the seal before it. Chunks in the runs have a Fletcher-32 sum that the HDF5 library compares when it
//! reads them, so that a part of a table costs no more than its own chunks.

use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

/// How the last part of a seal starts.
const MAGIC: &[u8; 8] = b"hlseal1\n";
/// Bytes of the last part: magic, two integers, digest.
const FOOTER: u64 = 8 + 16 + 32;
/// Bytes of one run.
const RUN: u64 = 16;
/// How every HDF5 file starts that has nothing before its HDF5 part.
const SIGNATURE: &[u8; 8] = b"\x89HDF\r\n\x1a\n";
/// Bytes read at a time.
const BUFFER: usize = 1 << 16;

/// What covers the bytes of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cover {
    /// A seal, and the sums of the chunks.
    Sealed,
    /// Only the hash of the whole content, in formats before 2.2.
    ByContent,
}

/// What the bytes of a file say before the HDF5 library is asked.
#[derive(Debug)]
pub(super) enum Verdict {
    /// All bytes outside chunks with a sum of their own are those that were written.
    Right,
    /// A file of a format before 2.2, which has no seal.
    Unsealed,
    /// It does not start as HDF5 files do.
    NotHdf5,
    /// Bytes were changed, lost or added.
    Damaged(&'static str),
}

/// Compares the bytes of a file with its seal.
///
/// A sealed file says so in two places far apart, the version of its superblock and the magic at its end, so that
/// damage to one of them does not make it pass for one of an older format.
///
/// # Errors
/// What the system says.
pub(super) fn check(file: &mut (impl Read + Seek)) -> io::Result<Verdict> {
    let length = file.seek(SeekFrom::End(0))?;
    let mut start = [0; 9];
    file.seek(SeekFrom::Start(0))?;
    if length < 9 {
        return Ok(Verdict::NotHdf5);
    }
    file.read_exact(&mut start)?;
    if start[..8] != *SIGNATURE {
        return Ok(Verdict::NotHdf5);
    }
    let must_have_one = start[8] != 0;
    let Some((footer, runs)) = (if length > FOOTER {
        footer(file, length)?
    } else {
        None
    }) else {
        return Ok(if must_have_one {
            Verdict::Damaged(
                "its seal is gone: it was cut short, or something has written to it since it was made",
            )
        } else {
            Verdict::Unsealed
        });
    };
    let Some(end) = hdf5_end(&footer, &runs, length) else {
        return Ok(Verdict::Damaged("its seal is broken"));
    };
    let Some(covered) = outside(&runs, end) else {
        return Ok(Verdict::Damaged("its seal is broken"));
    };
    let found = digest(file, &covered, &runs, &footer)?;
    Ok(if found[..] == footer[24..] && must_have_one {
        Verdict::Right
    } else {
        Verdict::Damaged("its bytes are not those that were sealed when it was made")
    })
}

/// Appends the seal to the finished HDF5 file at `path`; `chunks` are those with a checksum of their own.
///
/// # Errors
/// What the system says.
pub(super) fn append(path: &Path, chunks: Vec<Range<u64>>) -> io::Result<()> {
    let mut file = File::options().read(true).append(true).open(path)?;
    let end = file.metadata()?.len();
    let merged = merge(chunks);
    let mut runs = Vec::new();
    for run in &merged {
        runs.extend(run.start.to_le_bytes());
        runs.extend((run.end - run.start).to_le_bytes());
    }
    let mut footer = Vec::from(MAGIC);
    footer.extend(end.to_le_bytes());
    footer.extend((merged.len() as u64).to_le_bytes());
    let covered = outside(&runs, end)
        .ok_or_else(|| io::Error::other("the HDF5 library puts chunks outside the file"))?;
    let sum = digest(&mut file, &covered, &runs, &footer)?;
    file.write_all(&[runs, footer, sum.to_vec()].concat())
}

/// The last part and the runs; none where the magic is not there.
fn footer(file: &mut (impl Read + Seek), length: u64) -> io::Result<Option<(Vec<u8>, Vec<u8>)>> {
    let mut footer = vec![0; FOOTER as usize];
    file.seek(SeekFrom::Start(length - FOOTER))?;
    file.read_exact(&mut footer)?;
    if footer[..8] != *MAGIC {
        return Ok(None);
    }
    let count = word(&footer, 16);
    let mut runs = Vec::new();
    if let Some(size) = count
        .checked_mul(RUN)
        .filter(|&size| size <= length - FOOTER)
    {
        file.seek(SeekFrom::Start(length - FOOTER - size))?;
        runs.resize(size as usize, 0);
        file.read_exact(&mut runs)?;
    }
    Ok(Some((footer, runs)))
}

/// Where the HDF5 part ends, if the lengths agree.
fn hdf5_end(footer: &[u8], runs: &[u8], length: u64) -> Option<u64> {
    let (end, count) = (word(footer, 8), word(footer, 16));
    let whole = count
        .checked_mul(RUN)?
        .checked_add(end)?
        .checked_add(FOOTER)?;
    (whole == length && runs.len() as u64 == count * RUN).then_some(end)
}

/// What lies outside the runs; none where they do not ascend within the HDF5 part.
fn outside(runs: &[u8], end: u64) -> Option<Vec<Range<u64>>> {
    let (mut covered, mut place) = (Vec::new(), 0);
    for run in runs.chunks_exact(RUN as usize) {
        let (start, length) = (word(run, 0), word(run, 8));
        if start < place {
            return None;
        }
        covered.push(place..start);
        place = start.checked_add(length).filter(|&next| next <= end)?;
    }
    covered.push(place..end);
    Some(covered)
}

/// The digest over what is covered, the runs and the start of the last part.
fn digest(
    file: &mut (impl Read + Seek),
    covered: &[Range<u64>],
    runs: &[u8],
    footer: &[u8],
) -> io::Result<[u8; 32]> {
    let mut hash = Sha256::new();
    let mut buffer = vec![0; BUFFER];
    for range in covered.iter().filter(|range| !range.is_empty()) {
        file.seek(SeekFrom::Start(range.start))?;
        let mut left = range.end - range.start;
        while left > 0 {
            let part = left.min(BUFFER as u64) as usize;
            file.read_exact(&mut buffer[..part])?;
            hash.update(&buffer[..part]);
            left -= part as u64;
        }
    }
    hash.update(runs);
    hash.update(&footer[..24]);
    Ok(hash.finalize().into())
}

/// Neighbouring chunks as one run, ascending.
fn merge(mut chunks: Vec<Range<u64>>) -> Vec<Range<u64>> {
    chunks.sort_by_key(|chunk| chunk.start);
    let mut runs: Vec<Range<u64>> = Vec::new();
    for chunk in chunks.into_iter().filter(|chunk| !chunk.is_empty()) {
        match runs.last_mut() {
            Some(last) if last.end == chunk.start => last.end = chunk.end,
            Some(_) | None => runs.push(chunk),
        }
    }
    runs
}

/// The integer at a place.
fn word(bytes: &[u8], place: usize) -> u64 {
    let mut word = [0; 8];
    word.copy_from_slice(&bytes[place..place + 8]);
    u64::from_le_bytes(word)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 200 bytes that start like HDF5 with a superblock of version 1, two runs of chunks.
    fn sealed(folder: &tempfile::TempDir) -> std::path::PathBuf {
        let path = folder.path().join("sealed");
        let mut bytes: Vec<u8> = (0..200).map(|i| i as u8).collect();
        bytes[..8].copy_from_slice(SIGNATURE);
        bytes[8] = 1;
        std::fs::write(&path, bytes).unwrap();
        append(&path, vec![120..150, 40..60, 60..80]).unwrap();
        path
    }

    fn verdict(bytes: &[u8]) -> Verdict {
        check(&mut io::Cursor::new(bytes)).unwrap()
    }

    #[test]
    fn every_bit_outside_the_chunks_is_covered() {
        let folder = tempfile::tempdir().unwrap();
        let good = std::fs::read(sealed(&folder)).unwrap();
        assert!(matches!(verdict(&good), Verdict::Right));
        for place in 0..good.len() {
            for bit in 0..8 {
                let mut bad = good.clone();
                bad[place] ^= 1 << bit;
                let chunk = (40..80).contains(&place) || (120..150).contains(&place);
                let right = matches!(verdict(&bad), Verdict::Right);
                assert_eq!(right, chunk, "byte {place}, bit {bit}");
                assert!(!matches!(verdict(&bad), Verdict::Unsealed));
            }
        }
    }

    #[test]
    fn bytes_that_are_lost_or_added_are_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let good = std::fs::read(sealed(&folder)).unwrap();
        for length in 0..good.len() {
            assert!(matches!(
                verdict(&good[..length]),
                Verdict::Damaged(_) | Verdict::NotHdf5
            ));
        }
        let longer = [&good[..], b"x"].concat();
        assert!(matches!(verdict(&longer), Verdict::Damaged(_)));
    }

    #[test]
    fn a_file_without_a_seal_is_one_of_an_older_format() {
        let mut bytes = vec![0; 100];
        bytes[..8].copy_from_slice(SIGNATURE);
        assert!(matches!(verdict(&bytes), Verdict::Unsealed));
        assert!(matches!(verdict(b"time_s,force_n\n"), Verdict::NotHdf5));
    }
}
