//! The rows of a sweep as text.

use super::block::{Block, Blocks};
use super::columns::{Column, What, columns, model_name};
use crate::sweep::axes::Values;
use crate::sweep::fields::Precision;
use crate::sweep::spec::Spec;
use output::{Existing, Fault, Output, OutputError, Staged};
use rayon::prelude::*;
use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes one line a row: the varied keys, the results, the model, the reason of a failure.
///
/// # Errors
/// [`OutputError`].
pub fn write_csv(
    path: &Path,
    spec: &Spec,
    blocks: &(impl Blocks + ?Sized),
    existing: Existing,
) -> Result<(), OutputError> {
    let output = Output::claim(path, existing)?;
    stage_csv(&output, spec, blocks)?.commit()
}

/// The same into an output that was claimed before the work, under its name when it is committed.
///
/// # Errors
/// [`OutputError`].
pub fn stage_csv<'a>(
    output: &'a Output,
    spec: &Spec,
    blocks: &(impl Blocks + ?Sized),
) -> Result<Staged<'a>, OutputError> {
    output.stage(|part| {
        let mut file = BufWriter::new(std::fs::File::create(part)?);
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
        let rows = (0..block.numbers.len()).into_par_iter().step_by(AT_A_TIME);
        let parts: Vec<String> = rows.map(|from| lines(spec, columns, block, from)).collect();
        let mut written = parts.iter().map(|part| file.write_all(part.as_bytes()));
        written.find_map(Result::err).map_or(Ok(()), |error| {
            let fault = Fault::from(error.to_string());
            unwritten = Some(error);
            Err(fault)
        })
    });
    match (unwritten, read) {
        (Some(error), _) => Err(error),
        (None, Err(fault)) => Err(io::Error::other(fault.reason)),
        (None, Ok(())) => Ok(()),
    }
}

/// Lines that are made together.
const AT_A_TIME: usize = 1024;

/// Some lines of a block.
fn lines(spec: &Spec, columns: &[Column<'_>], block: &Block, from: usize) -> String {
    let to = (from + AT_A_TIME).min(block.numbers.len());
    let mut failures = block.failures.iter().peekable();
    let mut text = String::with_capacity(300 * (to - from));
    for i in from..to {
        let row = block.start + i;
        for (k, column) in columns.iter().enumerate() {
            if k > 0 {
                text.push(',');
            }
            // writing to a string cannot fail
            let _ = match column.what {
                What::Row => write!(text, "{row}"),
                What::Key { stride, values } => {
                    let place = row / stride % values.len();
                    match values {
                        Values::Numbers(numbers) => write!(text, "{}", numbers[place]),
                        Values::Drawn(drawn) => write!(text, "{}", drawn.at(place)),
                        Values::Texts(words) => write!(text, "{}", quoted(&words[place])),
                    }
                }
                What::Number(k) => match (block.number(i, k), spec.fields.precision) {
                    // a failed scene has empty fields
                    (number, _) if !number.is_finite() => Ok(()),
                    (number, Precision::Double) => write!(text, "{number}"),
                    (number, Precision::Single) => write!(text, "{}", number as f32),
                },
                What::Model => write!(text, "{}", model_name(block.models[i]).unwrap_or("")),
                What::Failure => {
                    while failures.next_if(|(failed, _)| *failed < row).is_some() {}
                    let reason = failures.next_if(|(failed, _)| *failed == row);
                    write!(text, "{}", quoted(reason.map_or("", |(_, reason)| reason)))
                }
            };
        }
        text.push('\n');
    }
    text
}

/// In quotation marks where a comma or one of them would break the line.
fn quoted(word: &str) -> String {
    if word.contains(['"', ',', '\n']) {
        format!("\"{}\"", word.replace('"', "\"\""))
    } else {
        word.to_owned()
    }
}
