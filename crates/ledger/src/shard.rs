//! Division of work into shards.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// The I-th of N shards, written I/N.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// I, from 1.
    pub index: usize,
    /// N.
    pub count: usize,
}

impl Shard {
    /// Largest number of shards; operations visit each.
    pub const MOST: usize = 1_000_000;

    /// Range of the shard out of `units`, which are not split within a grain; the sizes of shards differ by one grain
    /// at most.
    pub fn range(self, units: usize, grain: usize) -> Range<usize> {
        let grains = units.div_ceil(grain) as u128;
        let bound = |index: usize| {
            let grain_of = grains * index as u128 / self.count as u128;
            (grain_of as usize * grain).min(units)
        };
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
        let (index, count) = numbers.ok_or("use I/N with whole numbers, as in 2/4")?;
        if count > Self::MOST {
            return Err("N of I/N is outside [1, 1000000]");
        }
        if index < 1 || index > count {
            return Err("I of I/N is outside [1, N]");
        }
        Ok(Self { index, count })
    }
}

/// Missing ranges of `all`, ascending; `held` must be ascending.
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
    fn shards_are_all_units_once_in_whole_grains() {
        for units in [0, 1, 7, 40, 32_767, 32_769, 327_687, 1_000_000_000_000] {
            for (count, grain) in [
                (1, 1),
                (2, 1),
                (3, 32_768),
                (7, 1),
                (239, 32_768),
                (1000, 5),
            ] {
                let (mut next, mut sizes) = (0, Vec::new());
                for index in 1..=count {
                    let range = Shard { index, count }.range(units, grain);
                    assert_eq!(range.start, next);
                    assert!(range.start.is_multiple_of(grain) || range.start == units);
                    next = range.end;
                    sizes.push(range.len().div_ceil(grain));
                }
                assert_eq!(next, units);
                let ends = (sizes.iter().min(), sizes.iter().max());
                assert!(
                    ends.0.unwrap() + 1 >= *ends.1.unwrap(),
                    "{units} in {count}"
                );
            }
        }
    }

    #[test]
    fn what_is_no_shard_is_told() {
        for (index, count) in [(1, 1), (1, 4), (2, 4), (4, 4), (Shard::MOST, Shard::MOST)] {
            let shard = Shard { index, count };
            assert_eq!(shard.to_string(), format!("{index}/{count}"));
            assert_eq!(shard.to_string().parse(), Ok(shard));
        }
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
        let of = |held: &[Range<usize>], all| {
            let found = gaps(held, &all);
            let pairs = found.into_iter().map(|gap| (gap.start, gap.end));
            pairs.collect::<Vec<_>>()
        };
        assert_eq!(of(&[], 0..3), [(0, 3)]);
        assert_eq!(of(&[0..2, 3..5], 0..6), [(2, 3), (5, 6)]);
        assert_eq!(of(&[0..4, 2..3], 1..4), []);
        assert_eq!(of(&[9..12, 20..21], 0..3), [(0, 3)]);
    }
}
