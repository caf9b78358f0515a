//! Rows a block at a time, wherever they are kept.

use super::block::Block;
use output::Fault;

/// Consecutive rows, of which no more than a block needs to be in memory.
pub trait Blocks {
    /// Shows the blocks in the order of their rows; ends with the first reason to stop.
    ///
    /// # Errors
    /// That of `visit`, or why a block cannot be read.
    fn each(&self, visit: &mut dyn FnMut(&Block) -> Result<(), Fault>) -> Result<(), Fault>;
}

impl<T: AsRef<[Block]> + ?Sized> Blocks for T {
    fn each(&self, visit: &mut dyn FnMut(&Block) -> Result<(), Fault>) -> Result<(), Fault> {
        self.as_ref().iter().try_for_each(visit)
    }
}
