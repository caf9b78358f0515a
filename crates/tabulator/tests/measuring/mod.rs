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

use halfspace::random;

/// Number `index` of the sequence `seed`, in [0, 1).
fn uniform(seed: u64, index: u64) -> f64 {
    let state = seed.wrapping_mul(0xd1b5_4a32_d192_ed03);
    random::unit(random::number(state, index))
}
