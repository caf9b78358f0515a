//! How long fields tell their caller where they are.

/// Receives the advance of the fields of a scene; called from several threads.
pub trait Watch: Sync {
    /// Fields at so many points follow.
    fn points(&self, total: usize);
    /// The fields at one more point are computed.
    fn advance(&self);
}

/// Tells nobody.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn points(&self, _total: usize) {}
    fn advance(&self) {}
}
