//! How a long build tells its caller where it is.

/// Receives the advance of a build; called from several threads.
pub trait Progress: Sync {
    /// `total` units of work follow under the name `stage`.
    fn total(&self, stage: &str, total: u64);
    /// `done` more units are finished.
    fn advance(&self, done: u64);
    /// The work is at this Poisson ratio.
    fn slice(&self, _poisson_ratio: f64) {}
}

/// Tells nobody.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {
    fn total(&self, _stage: &str, _total: u64) {}
    fn advance(&self, _done: u64) {}
}
