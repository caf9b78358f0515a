//! What happens to an existing output: one flag, the same in every command.

use crate::failure::{Failure, print};
use clap::Args;
use formats::{Existing, Output};
use output::{Ending, Role, apart};
use std::path::Path;

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

    /// Claims the one output of a command that reads `inputs`, before any work.
    pub(crate) fn claim(
        self,
        path: &Path,
        ending: Ending,
        inputs: &[Role],
    ) -> Result<Output, Failure> {
        ending.check(path)?;
        apart(&[path], inputs)?;
        Ok(Output::claim(path, self.existing())?)
    }
}

/// What `--skip-complete` says where nothing is left to do.
pub(crate) fn say_complete(output: &Path, json: bool) -> Result<(), Failure> {
    if json {
        return print(serde_json::json!({ "output": output, "complete": true }));
    }
    print(format!(
        "complete       {}, nothing to do",
        output.display()
    ))
}
