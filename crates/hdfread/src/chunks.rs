//! Where the chunks of a dataset are.

use crate::bytes::Cursor;
use crate::error::{HdfError, damaged};
use crate::file::{File, NOWHERE};
use std::collections::HashSet;

/// Levels of a tree of chunks at most.
const MOST_LEVELS: u8 = 16;

/// A chunk in the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Chunk {
    /// Index of its first value along each dimension.
    pub(crate) first: Vec<usize>,
    /// Where it is.
    pub(crate) address: u64,
    /// Bytes stored.
    pub(crate) size: usize,
    /// A bit for each filter that was not applied.
    pub(crate) skipped: u32,
}

/// The chunks of a tree, ascending: as many as the dimensions make, each on its place.
pub(crate) fn of_tree(
    file: &File,
    address: u64,
    shape: &[usize],
    chunk: &[usize],
) -> Result<Vec<Chunk>, HdfError> {
    let needed = count(shape, chunk);
    let mut walk = Walk {
        file,
        rank: shape.len(),
        needed,
        seen: HashSet::new(),
        chunks: Vec::new(),
    };
    if address != NOWHERE {
        walk.node(address, None)?;
    }
    let mut chunks = walk.chunks;
    chunks.sort_by(|a, b| a.first.cmp(&b.first));
    let on_place = |found: &Chunk| {
        let places = found.first.iter().zip(shape).zip(chunk);
        places
            .into_iter()
            .all(|((&at, &whole), &part)| at < whole && at % part == 0)
    };
    let twice = chunks.windows(2).any(|pair| pair[0].first == pair[1].first);
    if twice || !chunks.iter().all(on_place) {
        return Err(damaged("its chunks are not where the dimensions have them"));
    }
    if chunks.len() == needed {
        Ok(chunks)
    } else {
        let found = chunks.len();
        Err(damaged(format!("{found} of its {needed} chunks are there")))
    }
}

/// How many chunks the dimensions make.
pub(crate) fn count(shape: &[usize], chunk: &[usize]) -> usize {
    let along = shape.iter().zip(chunk).map(|(n, c)| n.div_ceil(*c));
    along.fold(1, usize::saturating_mul)
}

/// A walk over a tree of chunks.
struct Walk<'a> {
    file: &'a File,
    rank: usize,
    needed: usize,
    seen: HashSet<u64>,
    chunks: Vec<Chunk>,
}

impl Walk<'_> {
    /// A node, one level below its parent.
    fn node(&mut self, address: u64, parent: Option<u8>) -> Result<(), HdfError> {
        let what = "a dataset's tree of chunks";
        let head = self.file.read(address, 24, what)?;
        let mut at = Cursor::new(&head, what);
        at.expect(b"TREE\x01")?;
        let (level, entries) = (at.u8()?, usize::from(at.u16()?));
        let falls = parent.is_none_or(|above| level + 1 == above);
        if level > MOST_LEVELS || !falls || !self.seen.insert(address) {
            return Err(damaged(format!("{what} goes in a circle")));
        }
        // a key has its offsets and that along the bytes of a value, which is zero
        let key = 8 + 8 * (self.rank + 1);
        let body = self.file.read(address + 24, entries * (key + 8), what)?;
        let mut at = Cursor::new(&body, what);
        for _ in 0..entries {
            let (size, skipped) = (at.u32()? as usize, at.u32()?);
            let mut first = Vec::with_capacity(self.rank);
            for _ in 0..self.rank {
                first.push(at.size()?);
            }
            at.skip(8)?;
            let address = at.u64()?;
            if level > 0 {
                self.node(address, Some(level))?;
                continue;
            }
            if self.chunks.len() >= self.needed {
                let needed = self.needed;
                return Err(damaged(format!("it has more than its {needed} chunks")));
            }
            self.chunks.push(Chunk {
                first,
                address,
                size,
                skipped,
            });
        }
        Ok(())
    }
}
