//! Consecutive samples of a force.

/// Consecutive samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// Time of the first in s.
    pub start_s: f64,
    /// Force long before it in N.
    pub base_n: f64,
    /// How many.
    pub count: usize,
}
