//! How many nodes a piece may have.

/// Largest degree of a piece.
pub(super) const LARGEST: usize = 16;
