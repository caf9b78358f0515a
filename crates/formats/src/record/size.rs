//! How long a record may be.

/// Samples at most: they are held in memory several times.
pub(super) const MOST_SAMPLES: usize = 1 << 24;
