//! What happens to an existing output: one flag, the same in every command.

use clap::Args;
use formats::Existing;

#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct Overwrite {
    /// Replace existing outputs.
    #[arg(long)]
    pub(crate) force: bool,
}

impl Overwrite {
    pub(crate) fn existing(self) -> Existing {
        if self.force {
            Existing::Replace
        } else {
            Existing::Keep
        }
    }

    /// The same for a kernel table.
    pub(crate) fn existing_table(self) -> tabulator::Existing {
        match self.existing() {
            Existing::Replace => tabulator::Existing::Replace,
            Existing::Keep => tabulator::Existing::Keep,
        }
    }
}
