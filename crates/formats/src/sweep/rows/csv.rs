//! The rows of a sweep as text.

use super::block::{Block, Blocks};
use super::columns::{Cells, Column, columns};
use crate::sweep::spec::Spec;
use ::csv::Writer;
use contact::{Choice, Model};
use output::{Output, OutputError, OutputFault, Staged};
use rayon::prelude::*;
use std::fmt::{Display, Write as _};
use std::io::{self, BufWriter, Write};

/// Writes one line per row with the varied keys, the results, the model and the reason of a failure into an output that
/// was claimed before the work; committing it gives the file its name.
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

/// Writes the same text to an open writer.
///
/// # Errors
/// An error of the system, or of reading the rows.
pub fn print_csv(
    file: &mut impl Write,
    spec: &Spec,
    blocks: &(impl Blocks + ?Sized),
) -> io::Result<()> {
    // the order of the lines numbers the rows
    let columns = &columns(spec)[1..];
    let mut head = Writer::from_writer(Vec::new());
    head.write_record(columns.iter().map(|column| &column.described.name))?;
    file.write_all(&finished(head)?)?;
    let mut unwritten = None;
    let read = blocks.each(&mut |block| {
        let rows = (0..block.len()).into_par_iter().step_by(AT_A_TIME);
        let parts = rows.map(|from| lines(spec, columns, block, from));
        let parts: Vec<Vec<u8>> = parts.collect::<Result<_, OutputFault>>()?;
        let written = parts.iter().try_for_each(|part| file.write_all(part));
        written.map_err(|error| {
            let fault = OutputFault::from(error.to_string());
            unwritten = Some(error);
            fault
        })
    });
    let unread = || read.map_err(|fault| io::Error::other(fault.reason));
    unwritten.map_or_else(unread, Err)
}

/// Lines that are formatted together.
const AT_A_TIME: usize = 1024;

/// Some lines of a block.
fn lines(
    spec: &Spec,
    columns: &[Column<'_>],
    block: &Block,
    from: usize,
) -> Result<Vec<u8>, OutputFault> {
    let some = from..(from + AT_A_TIME).min(block.len());
    let cells = columns.iter().map(|column| {
        let cells = column.what.cells(spec, block, some.clone())?;
        Ok((column.what.words(), cells))
    });
    let cells: Vec<_> = cells.collect::<Result<_, OutputFault>>()?;
    let mut writer = Writer::from_writer(Vec::with_capacity(300 * some.len()));
    let mut digits = String::new();
    for i in 0..some.len() {
        for (words, cells) in &cells {
            let field = field(&mut digits, cells, *words, i);
            writer.write_field(field).map_err(io::Error::from)?;
        }
        writer
            .write_record(None::<&[u8]>)
            .map_err(io::Error::from)?;
    }
    Ok(finished(writer)?)
}

/// The text of a cell; numbers are formatted into `digits`. Cells of a failed scene are empty.
fn field<'a>(
    digits: &'a mut String,
    cells: &'a Cells<'_>,
    words: Option<&'a Vec<String>>,
    row: usize,
) -> &'a str {
    match cells {
        Cells::Whole(rows) => shown(digits, rows[row]),
        Cells::Double(numbers) if numbers[row].is_finite() => shown(digits, numbers[row]),
        Cells::Single(numbers) if numbers[row].is_finite() => shown(digits, numbers[row]),
        Cells::Double(_) | Cells::Single(_) => "",
        Cells::Words(places) => words.map_or("", |words| &words[places[row] as usize]),
        Cells::Models(models) => {
            let model = Model::ALL.get(usize::from(models[row]));
            model.map_or("", |model| model.name())
        }
        Cells::Reasons(reasons) => reasons[row].unwrap_or(""),
    }
}

/// A number as text.
fn shown(digits: &mut String, number: impl Display) -> &str {
    digits.clear();
    // writing to a string cannot fail
    let _ = write!(digits, "{number}");
    digits
}

/// The bytes of a writer's lines.
fn finished(writer: Writer<Vec<u8>>) -> io::Result<Vec<u8>> {
    writer
        .into_inner()
        .map_err(::csv::IntoInnerError::into_error)
}
