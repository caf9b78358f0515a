//! Whether what a table says of its errors is true: by values of R alone (`judge`), by the way the table was built
//! (`observe`), and for nodes of either precision without a table (`sample`). Shared with the examples.

#![allow(
    dead_code,
    clippy::unwrap_used,
    reason = "each test and example takes its part, and a panic is how a test fails"
)]

pub(crate) mod judge;
pub(crate) mod observe;
pub(crate) mod sample;

/// Number `index` of the SplitMix64 sequence `seed` (Steele, Lea and Flood 2014), in [0, 1).
fn uniform(seed: u64, index: u64) -> f64 {
    let state = seed.wrapping_mul(0xd1b5_4a32_d192_ed03);
    let mut x = state.wrapping_add(index.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}
