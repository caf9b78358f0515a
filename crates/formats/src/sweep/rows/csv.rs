//! The rows of a sweep as text.

use super::block::{Block, Blocks};
use super::columns::{Cells, Column, columns};
use crate::sweep::spec::Spec;
use contact::{Choice, Model};
use output::{Fault, Output, OutputError, Staged};
use rayon::prelude::*;
use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};

/// Writes one line a row: the varied keys, the results, the model, the reason of a failure; into an output that was claimed
/// before the work, under its name when it is committed.
///
/// # Errors
/// [`OutputError`].
pub fn stage_csv<'a>(
    output: &'a Output,
    spec: &Spec,
    blocks: &(impl Blocks + ?Sized),
) -> Result<Staged<'a>, OutputError> {
    output.stage(|file| {
        let mut file = BufWriter::new(file);
        print_csv(&mut file, spec, blocks)?;
        file.flush()
    })
}

/// The same to something that is open.
///
/// # Errors
/// What the system says, or why the rows cannot be read.
pub fn print_csv(
    file: &mut impl Write,
    spec: &Spec,
    blocks: &(impl Blocks + ?Sized),
) -> io::Result<()> {
    // the lines are numbered by their order
    let columns = &columns(spec)[1..];
    let names: Vec<&str> = columns.iter().map(|c| c.described.name.as_str()).collect();
    writeln!(file, "{}", names.join(","))?;
    let mut unwritten = None;
    let read = blocks.each(&mut |block| {
        let rows = (0..block.len()).into_par_iter().step_by(AT_A_TIME);
        let parts = rows.map(|from| lines(spec, columns, block, from));
        let parts: Vec<String> = parts.collect::<Result<_, Fault>>()?;
        let written = (parts.iter()).try_for_each(|part| file.write_all(part.as_bytes()));
        written.map_err(|error| {
            let fault = Fault::from(error.to_string());
            unwritten = Some(error);
            fault
        })
    });
    let unread = || read.map_err(|fault| io::Error::other(fault.reason));
    unwritten.map_or_else(unread, Err)
}

/// Lines that are made together.
const AT_A_TIME: usize = 1024;

/// Some lines of a block.
fn lines(spec: &Spec, columns: &[Column<'_>], block: &Block, from: usize) -> Result<String, Fault> {
    let some = from..(from + AT_A_TIME).min(block.len());
    let cells = columns.iter().map(|column| {
        let cells = column.what.cells(spec, block, some.clone())?;
        Ok((column.what.words(), cells))
    });
    let cells: Vec<_> = cells.collect::<Result<_, Fault>>()?;
    let mut text = String::with_capacity(300 * some.len());
    for i in 0..some.len() {
        for (k, (words, cells)) in cells.iter().enumerate() {
            if k > 0 {
                text.push(',');
            }
            // writing to a string cannot fail
            let _ = match cells {
                Cells::Whole(rows) => write!(text, "{}", rows[i]),
                // a failed scene has empty fields
                Cells::Double(numbers) if !numbers[i].is_finite() => Ok(()),
                Cells::Double(numbers) => write!(text, "{}", numbers[i]),
                Cells::Single(numbers) if !numbers[i].is_finite() => Ok(()),
                Cells::Single(numbers) => write!(text, "{}", numbers[i]),
                Cells::Words(places) => {
                    let word = words.map_or("", |words| &words[places[i] as usize]);
                    write!(text, "{}", quoted(word))
                }
                Cells::Models(models) => {
                    let model = Model::ALL.get(usize::from(models[i]));
                    text.write_str(model.map_or("", |model| model.name()))
                }
                Cells::Reasons(reasons) => write!(text, "{}", quoted(reasons[i].unwrap_or(""))),
            };
        }
        text.push('\n');
    }
    Ok(text)
}

/// In quotation marks where a comma or one of them would break the line.
fn quoted(word: &str) -> String {
    if word.contains(['"', ',', '\n']) {
        format!("\"{}\"", word.replace('"', "\"\""))
    } else {
        word.to_owned()
    }
}
