//! `hertzlamb sweep merge`: all parts of a folder in one file.

use super::failure;
use crate::arguments::{Overwrite, check_rows};
use crate::failure::{Failure, lines, say, show};
use clap::Args;
use formats::parts::Parts;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folder with the parts.
    folder: PathBuf,
    /// Results file: Parquet if the name ends with .parquet, HDF5 otherwise. The format of the parts does not matter.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Copy no results: the output (HDF5) refers to the parts (HDF5) by their relative paths, so they must not move
    /// relative to it.
    #[arg(long = "virtual")]
    refer: bool,
    #[command(flatten)]
    overwrite: Overwrite,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let output = &arguments.output;
    check_rows(output)?;
    let claimed = arguments.overwrite.claim(output, &[])?;
    let mut parts = Parts::in_folder(&arguments.folder, None).map_err(failure)?;
    // with --force the output itself may be an earlier merged sweep
    let there = claimed.real.canonicalize().ok();
    let is_there = |path: &Path| there.is_some() && path.canonicalize().ok() == there;
    if let Some(part) = parts.parts.iter().find(|part| is_there(&part.path)) {
        let part = part.path.display();
        return Err(Failure::input(format!(
            "{part} is a part that this command reads: choose another name for the output"
        )));
    }
    parts.foreign.retain(|(path, _)| !is_there(path));
    let staged = parts.merge(&claimed, arguments.refer);
    staged.map_err(failure)?.commit()?;
    let selections = parts.parts.iter().map(|part| &part.selection);
    let empty = selections.filter(|some| some.rows.is_empty()).count();
    if empty > 0 {
        say(format!("note: {empty} parts have no rows"));
    }
    let report = Merged {
        output: output.display().to_string(),
        rows: parts.sweep_rows,
        parts: parts.parts.len(),
        sweep_sha256: parts.sha256,
    };
    show(arguments.json, &report)
}

/// Report of the written sweep.
#[derive(Serialize)]
struct Merged {
    output: String,
    rows: usize,
    parts: usize,
    sweep_sha256: String,
}

impl Display for Merged {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            output,
            rows,
            parts,
            ..
        } = self;
        let text = format!("{output}, {rows} rows of {parts} parts");
        f.write_str(&lines([("written", text)]))
    }
}
