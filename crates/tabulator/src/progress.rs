//! Progress of a build, as reported to its caller.

/// Receiver of the progress of a build; called from several threads.
pub trait Progress: Sync {
    /// The stage `stage` begins, with `total` units of work.
    fn total(&self, stage: &str, total: u64);
    /// Another `done` units of work are finished.
    fn advance(&self, done: u64);
    /// The work on the slice of this Poisson ratio begins.
    fn slice(&self, _poisson_ratio: f64) {}
}

/// Receiver that ignores all reports.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {
    fn total(&self, _stage: &str, _total: u64) {}
    fn advance(&self, _done: u64) {}
}
