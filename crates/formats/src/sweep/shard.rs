//! Some rows of a sweep.

use super::fields::Fields;
use crate::error::SceneError;
use std::fmt;
use std::ops::Range;
use std::path::PathBuf;
use std::str::FromStr;

/// Rows of a block at most.
pub const BLOCK: usize = 32_768;

/// The I-th of N shards, written I/N.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 1.
    pub index: usize,
    /// Of how many.
    pub count: usize,
}

/// Rows that are computed into one file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Selection {
    /// The rows.
    pub rows: Range<usize>,
    /// The shard that they are.
    pub shard: Option<Shard>,
}

/// What a file of some rows of a sweep says of itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// Where it lies.
    pub path: PathBuf,
    /// Which sweep it is of.
    pub sha256: String,
    /// Which rows it has.
    pub selection: Selection,
    /// Rows of the whole sweep.
    pub sweep_rows: usize,
    /// Failed rows.
    pub failed: usize,
    /// Which results it has.
    pub fields: Fields,
}

impl Shard {
    /// Its rows, of a sweep of so many; none where there are more shards than blocks.
    ///
    /// Bounds are multiples of [`BLOCK`], but for the last row; shards differ by a block at most.
    #[must_use]
    pub fn rows(self, rows: usize) -> Range<usize> {
        let blocks = rows.div_ceil(BLOCK) as u128;
        let bound = |index: usize| {
            let block = blocks * index as u128 / self.count as u128;
            (block as usize * BLOCK).min(rows)
        };
        bound(self.index - 1)..bound(self.index)
    }

    /// The rows of a sweep of so many.
    #[must_use]
    pub fn selection(self, rows: usize) -> Selection {
        Selection {
            rows: self.rows(rows),
            shard: Some(self),
        }
    }
}

impl Selection {
    /// Rows from one on up to another, which is not among them, of a sweep of `rows`.
    ///
    /// # Errors
    /// [`SceneError::OutOfRange`] beyond the end.
    pub fn of_rows(asked: Range<usize>, rows: usize) -> Result<Self, SceneError> {
        if asked.end > rows {
            return Err(SceneError::OutOfRange {
                key: format!("the end of the rows, of a sweep of {rows},"),
                value: asked.end as f64,
                range: "the rows of the sweep, which count from 0",
            });
        }
        let (rows, shard) = (asked, None);
        Ok(Self { rows, shard })
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl FromStr for Shard {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parts = text.split_once('/');
        let numbers = parts.and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        let (index, count) = numbers.ok_or("give I/N with whole numbers, as in 2/4")?;
        if index < 1 || index > count {
            return Err("I of I/N is outside [1, N]");
        }
        Ok(Self { index, count })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_all_rows_once_in_whole_blocks() {
        for rows in [
            0,
            1,
            BLOCK - 1,
            BLOCK,
            BLOCK + 1,
            10 * BLOCK + 7,
            1_000_000_000_000,
        ] {
            for count in [1, 2, 3, 7, 239, 1000] {
                let shards = (1..=count).map(|index| Shard { index, count }.rows(rows));
                let (mut next, mut sizes) = (0, Vec::new());
                for shard in shards {
                    assert_eq!(shard.start, next);
                    assert!(shard.start % BLOCK == 0 || shard.start == rows);
                    next = shard.end;
                    sizes.push(shard.len().div_ceil(BLOCK));
                }
                assert_eq!(next, rows);
                let ends = (sizes.iter().min(), sizes.iter().max());
                assert!(ends.0.unwrap() + 1 >= *ends.1.unwrap(), "{rows} {count}");
            }
        }
    }

    #[test]
    fn a_shard_is_one_of_them() {
        let shard = Shard { index: 2, count: 4 };
        assert_eq!("2/4".parse(), Ok(shard));
        assert_eq!(shard.to_string(), "2/4");
        for wrong in ["0/4", "5/4", "0/0", "1", "a/b", "1/-3", "", "1/2/3"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
