//! The rows of a sweep as text.

use super::axis::{Column, Values, place};
use super::block::Block;
use super::blocks::Blocks;
use super::fields::Precision;
use super::schema::{FAILURE, MODEL};
use super::spec::Spec;
use contact::{Choice, Model};
use output::{Existing, Fault, Output, OutputError, Staged};
use rayon::prelude::*;
use std::collections::HashMap;
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
    writeln!(file, "{}", header(spec))?;
    let mut unwritten = None;
    let read = blocks.each(&mut |block| {
        let parts: Vec<String> = (0..block.numbers.len())
            .into_par_iter()
            .step_by(1024)
            .map(|from| lines(spec, block, from))
            .collect();
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

fn header(spec: &Spec) -> String {
    let keys = spec
        .axes
        .iter()
        .flat_map(|axis| axis.columns.iter().map(Column::name));
    let numbers = spec.fields.quantities().map(|(_, q)| q.name.to_owned());
    let rest = [MODEL.0, FAILURE.0].map(str::to_owned);
    keys.chain(numbers)
        .chain(rest)
        .collect::<Vec<_>>()
        .join(",")
}

/// Up to 1024 lines of a block.
fn lines(spec: &Spec, block: &Block, from: usize) -> String {
    let to = (from + 1024).min(block.numbers.len());
    let failures: HashMap<usize, &str> = block
        .failures
        .iter()
        .map(|(row, reason)| (*row, reason.as_str()))
        .collect();
    let mut text = String::with_capacity(300 * (to - from));
    let mut places = Vec::new();
    for i in from..to {
        let row = block.start + i;
        place(&spec.axes, row, &mut places);
        for (axis, &index) in spec.axes.iter().zip(&places) {
            for column in &axis.columns {
                match &column.values {
                    Values::Numbers(numbers) => {
                        let _ = write!(text, "{},", numbers[index]);
                    }
                    Values::Drawn(drawn) => {
                        let _ = write!(text, "{},", drawn.at(index));
                    }
                    Values::Texts(words) => {
                        let _ = write!(text, "{},", quoted(&words[index]));
                    }
                }
            }
        }
        for &k in &spec.fields.places {
            let number = block.number(i, k);
            // a failed scene has empty fields
            if number.is_finite() {
                let _ = match spec.fields.precision {
                    Precision::Double => write!(text, "{number}"),
                    Precision::Single => write!(text, "{}", number as f32),
                };
            }
            text.push(',');
        }
        let model = Model::ALL
            .get(usize::from(block.models[i]))
            .map_or("", |m| m.name());
        let reason = failures.get(&row).copied().unwrap_or("");
        let _ = writeln!(text, "{model},{}", quoted(reason));
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
