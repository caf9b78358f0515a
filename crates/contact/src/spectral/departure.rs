//! Where a wave left.

/// Where the wave of delay X that arrives now left: T + X a(T) = t.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Departure {
    /// Index of the piece.
    pub(super) piece: usize,
    /// Place in it.
    pub(super) place: f64,
    pub(super) radius: f64,
    /// Slopes of time and radius with respect to the place.
    pub(super) time_slope: f64,
    pub(super) radius_slope: f64,
}
