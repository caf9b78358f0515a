//! Seeded random numbers, the same on every machine: SplitMix64 (Steele, Lea and Flood, 2014).
//!
//! All random numbers of the workspace come from this module: draws of sweeps, samples that check a table, scenes of
//! tests.
//!
//! ```
//! use halfspace::random::{Stream, mix, number};
//! // the first number of the published generator from the state 0
//! assert_eq!(mix(0), 0xe220_a839_7b1d_cdaf);
//! assert_eq!(number(0, 0), mix(0));
//! assert!((Stream::new(0).next() - 0.883_310_809_2).abs() < 1e-9);
//! ```

/// Increment of the state.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// 64 random bits from a state.
pub fn mix(state: u64) -> u64 {
    let mut z = state.wrapping_add(STEP);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Number `index` of the sequence that starts from the state `seed`.
pub fn number(seed: u64, index: u64) -> u64 {
    mix(seed.wrapping_add(index.wrapping_mul(STEP)))
}

/// The upper 53 of 64 random bits as a number in [0, 1).
pub fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// A sequence of numbers.
#[derive(Debug, Clone)]
pub struct Stream(u64);

impl Stream {
    /// The sequence that starts from a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number, in [0, 1).
    #[expect(clippy::should_implement_trait, reason = "it never ends")]
    pub fn next(&mut self) -> f64 {
        let bits = mix(self.0);
        self.0 = self.0.wrapping_add(STEP);
        unit(bits)
    }

    /// The next number, uniform between two numbers.
    pub fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    /// The next number, log-uniform between two positive numbers.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }
}
