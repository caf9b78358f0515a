//! What happens to an existing output: one flag, the same in every command.

use crate::failure::{Failure, lines, show};
use clap::Args;
use formats::{Existing, Output, OutputError};
use output::{Ending, Role, apart};
use serde_json::json;
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

/// Whether a name is that of a file of rows that this program can write.
pub(crate) fn check_rows(path: &Path) -> Result<(), Failure> {
    formats::sweep::check_rows(path).map_err(|error| {
        let unbuilt = matches!(error, OutputError::Unbuilt { .. });
        let failure = Failure::from(error);
        if unbuilt {
            failure.hint(": build it with `cargo build --release --package hertzlamb-cli --features parquet`")
        } else {
            failure
        }
    })
}

/// What `--skip-complete` says where nothing is left to do.
pub(crate) fn say_complete(output: &Path, json: bool) -> Result<(), Failure> {
    let output = output.display().to_string();
    let text = lines([("complete", format!("{output}, nothing to do"))]);
    show(json, &json!({ "output": output, "complete": true }), text)
}
