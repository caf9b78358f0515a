//! Room for the marches of one thread.

use super::history::History;
use super::weights::Weights;

/// Weights and samples of the latest march: nothing is allocated once they are large enough.
#[derive(Debug, Clone)]
pub struct Workspace {
    pub(crate) weights: Weights,
    pub(crate) history: History,
}

impl Default for Workspace {
    fn default() -> Self {
        Self {
            weights: Weights::default(),
            history: History::at_touch(1.0, 512),
        }
    }
}
