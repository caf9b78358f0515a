//! Work in parts.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// The I-th of N shards, written I/N.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 1.
    pub index: usize,
    /// Of how many.
    pub count: usize,
}

impl Shard {
    /// Shards at most: each is looked at.
    pub const MOST: usize = 1_000_000;

    /// Its units, of so many; shards differ by one unit at most.
    #[must_use]
    pub fn range(self, units: usize) -> Range<usize> {
        let bound = |index: usize| (units as u128 * index as u128 / self.count as u128) as usize;
        bound(self.index - 1)..bound(self.index)
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
        if count > Self::MOST {
            return Err("N of I/N is outside [1, 1000000]");
        }
        if index < 1 || index > count {
            return Err("I of I/N is outside [1, N]");
        }
        Ok(Self { index, count })
    }
}

/// What of a range is not held, ascending; what is held ascends.
#[must_use]
pub fn gaps(held: &[Range<usize>], all: &Range<usize>) -> Vec<Range<usize>> {
    let (mut found, mut place) = (Vec::new(), all.start);
    for held in held {
        let start = held.start.min(all.end);
        if place < start {
            found.push(place..start);
        }
        place = place.max(held.end);
    }
    if place < all.end {
        found.push(place..all.end);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_all_units_once_and_of_one_size() {
        for (units, count) in [
            (0, 3),
            (1, 1),
            (40, 2),
            (7, 3),
            (5, 9),
            (1_000_000_000_000, 7),
        ] {
            let mut next = 0;
            for index in 1..=count {
                let range = Shard { index, count }.range(units);
                assert_eq!(range.start, next);
                let even = units / count;
                assert!(
                    (even..=even + 1).contains(&range.len()),
                    "{units} in {count}"
                );
                next = range.end;
            }
            assert_eq!(next, units);
        }
    }

    #[test]
    fn what_is_no_shard_is_told() {
        assert_eq!("2/4".parse(), Ok(Shard { index: 2, count: 4 }));
        for text in [
            "",
            "2",
            "0/4",
            "5/4",
            "a/b",
            "1/-1",
            "1/1000001",
            "1/18446744073709551615",
        ] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }

    #[test]
    fn gaps_are_what_is_not_held() {
        assert_eq!(gaps(&[], &(0..3)), [0..3]);
        assert_eq!(gaps(&[0..2, 3..5], &(0..6)), [2..3, 5..6]);
        assert_eq!(gaps(&[0..4, 2..3], &(1..4)), []);
        assert_eq!(gaps(&[9..12], &(0..3)), [0..3]);
    }
}
