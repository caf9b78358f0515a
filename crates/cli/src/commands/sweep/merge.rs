//! `hertzlamb sweep merge`: all parts of a folder in one file.

use super::failure;
use crate::arguments::{Overwrite, check_rows};
use crate::failure::{Failure, lines, say, show};
use clap::Args;
use formats::parts::Parts;
use serde_json::json;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The folder of the parts.
    folder: PathBuf,
    /// Results file: HDF5, or Parquet where the name ends with .parquet, whatever the parts are.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Copy no results: the output (HDF5) refers to the parts (HDF5), which have to stay where they are, seen from it.
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
    // with --force the output itself may be a merged sweep of before
    let there = claimed.real.canonicalize().ok();
    let is_there = |path: &Path| there.is_some() && path.canonicalize().ok() == there;
    if let Some(part) = parts.parts.iter().find(|part| is_there(&part.path)) {
        let part = part.path.display();
        return Err(Failure::input(format!(
            "{part} is a part that this command reads: give the output another name"
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
    let output = output.display().to_string();
    let (rows, count) = (parts.sweep_rows, parts.parts.len());
    let value = json!({
        "output": output,
        "rows": rows,
        "parts": count,
        "sweep_sha256": parts.sha256,
    });
    let text = lines([("written", format!("{output}, {rows} rows of {count} parts"))]);
    show(arguments.json, &value, text)
}
