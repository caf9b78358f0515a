//! Numbers that look random and are the same everywhere.

/// Increment of the state (Steele, Lea and Flood 2014, SplitMix64).
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// Number `index` of the SplitMix64 sequence that starts from the state `seed`.
fn split_mix(seed: u64, index: u64) -> u64 {
    let mut x = seed.wrapping_add(index.wrapping_add(1).wrapping_mul(STEP));
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Number `index` of the sequence `seed`, in [0, 1).
pub(crate) fn uniform(seed: u64, index: u64) -> f64 {
    let state = seed.wrapping_mul(0xd1b5_4a32_d192_ed03);
    (split_mix(state, index) >> 11) as f64 / (1_u64 << 53) as f64
}

/// `count` different numbers below `total` in ascending order, all of them if there are no more.
pub(crate) fn picks(total: usize, count: usize, seed: u64) -> Vec<usize> {
    if count >= total {
        return (0..total).collect();
    }
    let mut chosen = std::collections::BTreeSet::new();
    let draws = (0..).map(|index| (split_mix(seed, index) % total as u64) as usize);
    for pick in draws {
        if chosen.len() == count {
            break;
        }
        chosen.insert(pick);
    }
    chosen.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequence_is_that_of_the_reference() {
        // The first numbers of the published generator from the state 0.
        assert_eq!(split_mix(0, 0), 0xe220_a839_7b1d_cdaf);
        assert_eq!(split_mix(0, 1), 0x6e78_9e6a_a1b9_65f4);
    }

    #[test]
    fn picks_are_different_and_repeat() {
        let picked = picks(1000, 50, 3);
        assert_eq!(picked.len(), 50);
        assert!(picked.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(picked, picks(1000, 50, 3));
        assert_ne!(picked, picks(1000, 50, 4));
        assert_eq!(picks(3, 10, 1), [0, 1, 2]);
    }
}
