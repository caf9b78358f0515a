//! The file of some rows of a sweep: HDF5, as `data-schema/sweep.md` writes it down.

use super::axis::Values;
use super::blocks::Blocks;
use super::columns::{Columns, What};
use super::file::{count, finish, models};
use super::schema::{self, part};
use super::shard::Selection;
use super::spec::Spec;
use super::table::row_columns;
use crate::hdf::{attach_scale, new_file, reason, set_scale, text, texts};
use crate::quantities::QUANTITIES;
use crate::results::schema::COORDINATES;
use hdf5::File;
use output::{Fault, Output, OutputError, Staged};
use std::path::Path;

/// Writes some rows, whose blocks are all there in order, into an output that was claimed before the work.
///
/// No more than a block is in memory, and the bytes do not depend on how rows are divided into blocks.
///
/// # Errors
/// [`OutputError`].
pub fn stage_part<'a>(
    output: &'a Output,
    spec: &Spec,
    selection: &Selection,
    blocks: &(impl Blocks + ?Sized),
) -> Result<Staged<'a>, OutputError> {
    output.stage(|path| {
        let (file, columns) = begin(path, spec, selection).map_err(|error| reason(&error))?;
        let failures = columns.fill(path, &selection.rows, blocks)?;
        finish(file, &failures).map_err(|error| Fault::from(reason(&error)))
    })
}

/// Bytes that a row takes in such a file, and in the journal while it is computed.
#[must_use]
pub fn row_bytes(spec: &Spec) -> (usize, usize) {
    let keys = spec.axes.iter().flat_map(|axis| &axis.columns);
    let keys: usize = keys
        .map(|key| match key.values {
            Values::Numbers(_) | Values::Drawn(_) => 8,
            Values::Texts(_) => 4,
        })
        .sum();
    let results = spec.fields.width() * spec.fields.places.len() + 1;
    (
        8 + keys + results + 4,
        8 * (QUANTITIES.len() + spec.fields.probed.len()) + 1,
    )
}

/// Names of the columns of such a file.
#[must_use]
pub fn column_names(spec: &Spec) -> Vec<String> {
    let columns = row_columns(spec).into_iter();
    columns.map(|column| column.name).collect()
}

/// Everything but the rows.
fn begin<'a>(
    path: &Path,
    spec: &'a Spec,
    selection: &Selection,
) -> Result<(File, Columns<'a>), hdf5::Error> {
    let file = new_file().create(path)?;
    let sha256 = spec.sha256();
    let values = [
        part::FILE_TYPE,
        part::version(&spec.fields),
        env!("CARGO_PKG_VERSION"),
        &spec.resolved,
        &sha256,
    ];
    for (name, value) in schema::TEXTS.into_iter().zip(values) {
        text(&file, name, value)?;
    }
    let shard = selection
        .shard
        .map_or_else(String::new, |shard| shard.to_string());
    text(&file, part::SHARD, &shard)?;
    count(&file, part::SWEEP_ROWS, spec.rows())?;
    count(&file, part::FIRST_ROW, selection.rows.start)?;
    count(&file, schema::ROWS, selection.rows.len())?;
    let shape = [selection.rows.len()];
    let group = file.create_group(schema::RESULTS)?;
    let words = file.create_group(part::WORDS)?;
    let mut columns = Columns::new(spec);
    let (mut row, mut keys) = (None, Vec::new());
    for column in row_columns(spec) {
        let name = column.name;
        let meaning = match column.values {
            Some(Values::Texts(values)) => {
                texts(&words, &(&name, "1", "words of a scene key"), values)?;
                format!("index of the {} in /{}/{name}", column.meaning, part::WORDS)
            }
            Some(Values::Numbers(_) | Values::Drawn(_)) | None => column.meaning,
        };
        let described = (name.as_str(), column.unit, meaning.as_str());
        let dataset = columns.add(column.what, &group, &described, &shape)?;
        let Some(row) = &row else {
            set_scale(&dataset, part::ROW.0)?;
            row = Some(dataset);
            continue;
        };
        if let What::Model = column.what {
            text(&dataset, schema::NAMES, &models())?;
        }
        attach_scale(&dataset, row, 0)?;
        if column.values.is_some() {
            keys.push(name);
        } else {
            text(&dataset, COORDINATES, &keys.join(" "))?;
        }
    }
    Ok((file, columns))
}
