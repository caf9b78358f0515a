//! Row groups of a Parquet file; the hash of a group is checked before it is decoded.

use crate::schema::sweep::{FAILURE, MODEL};
use crate::sweep::{Block, Footer, NO_MODEL, NOT_HELD, Part, Precision};
use bytes::Bytes;
use contact::{Choice, Model};
use ledger::sha256_hex;
use output::OutputFault;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl, get_column_reader};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::metadata::{
    ColumnChunkMetaData, ParquetMetaData, ParquetMetaDataReader, RowGroupMetaData,
};
use parquet::file::serialized_reader::SerializedPageReader;
use rayon::prelude::*;
use std::collections::HashMap;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::sync::Arc;

/// Visits the rows of a file whose groups have these hashes.
pub(super) fn each(
    part: &Part,
    hashes: &[String],
    visit: &mut dyn FnMut(&Block) -> Result<(), OutputFault>,
) -> Result<(), OutputFault> {
    let damaged = |what: String| OutputFault::from(format!("{}: {what}", part.path.display()));
    let metadata = metadata(part).map_err(damaged)?;
    let places = places(part, &metadata).map_err(damaged)?;
    let mut next = part.selection.rows.start;
    let read = each_group(part, hashes, &metadata, |group, bytes| {
        let block = block(part, &places, group, bytes, next);
        let block = block.map_err(|error| error.to_string())?;
        next += block.len();
        if !block.holds() || next > part.selection.rows.end {
            return Err(NOT_HELD.to_owned().into());
        }
        visit(&block)
    });
    read.map_err(|fault| damaged(fault.reason))?;
    if next == part.selection.rows.end {
        return Ok(());
    }
    Err(damaged(format!("row {next} is missing")))
}

/// Checks the rows of a file against the hashes of their groups.
pub(super) fn check(part: &Part, hashes: &[String]) -> Result<(), OutputFault> {
    each_group(part, hashes, &metadata(part)?, |_, _| Ok(()))
}

fn metadata(part: &Part) -> Result<ParquetMetaData, String> {
    let footer = Footer::bytes(&part.path).map_err(|error| error.to_string())?;
    ParquetMetaDataReader::decode_metadata(&footer).map_err(|error| error.to_string())
}

/// Visits the groups after checking their hashes.
fn each_group(
    part: &Part,
    hashes: &[String],
    metadata: &ParquetMetaData,
    mut visit: impl FnMut(&RowGroupMetaData, &Arc<Bytes>) -> Result<(), OutputFault>,
) -> Result<(), OutputFault> {
    let mut file = File::open(&part.path)?;
    if metadata.num_row_groups() != hashes.len() {
        return Err(OutputFault::from(
            "its row groups are not those of its footer".to_owned(),
        ));
    }
    let mut next = part.selection.rows.start;
    for (group, hash) in metadata.row_groups().iter().zip(hashes) {
        let (start, end) = span(group);
        file.seek(SeekFrom::Start(start))?;
        let mut bytes = Vec::new();
        (&file).take(end - start).read_to_end(&mut bytes)?;
        if sha256_hex([&bytes[..]]) != *hash {
            return Err(OutputFault::from(format!(
                "the rows from {next} on were changed"
            )));
        }
        next += usize::try_from(group.num_rows()).unwrap_or(0);
        visit(group, &Arc::new(bytes.into()))?;
    }
    Ok(())
}

/// Byte range of a group, whose columns are contiguous.
fn span(group: &RowGroupMetaData) -> (u64, u64) {
    let mut ranges = (group.columns().iter()).map(ColumnChunkMetaData::byte_range);
    let first = ranges.next().unwrap_or_default();
    let (begin, length) = ranges.next_back().unwrap_or(first);
    (first.0, begin.saturating_add(length).max(first.0))
}

/// Positions of the columns of a file, by name.
fn places(part: &Part, metadata: &ParquetMetaData) -> Result<HashMap<String, usize>, String> {
    let columns = metadata.file_metadata().schema_descr().columns();
    let places: HashMap<_, _> = (columns.iter().enumerate())
        .map(|(place, column)| (column.name().to_owned(), place))
        .collect();
    let names = part.fields.quantities();
    let names = names.map(|(_, quantity)| quantity.name.as_str());
    let mut wanted = names.chain([MODEL.0, FAILURE.0]);
    match wanted.find(|name| !places.contains_key(*name)) {
        Some(name) => Err(format!("the column {name} is missing")),
        None => Ok(places),
    }
}

/// The rows of a group.
fn block(
    part: &Part,
    places: &HashMap<String, usize>,
    group: &RowGroupMetaData,
    bytes: &Arc<Bytes>,
    start: usize,
) -> Result<Block, ParquetError> {
    let rows = usize::try_from(group.num_rows()).unwrap_or(0);
    let read = |name: &str| pages(group, places[name], bytes, rows);
    let quantities: Vec<_> = part.fields.quantities().collect();
    let columns: Vec<_> = (quantities.par_iter())
        .map(|(_, quantity)| numbers(read(&quantity.name)?, rows, part.fields.precision))
        .collect::<Result<_, _>>()?;
    let mut block = Block::blank(start, rows, part.fields.width());
    for ((k, _), column) in quantities.into_iter().zip(columns) {
        block.fill(k, column);
    }
    let model = |name: ByteArray| {
        let mut known = Model::ALL.iter();
        let found = known.position(|model| model.name().as_bytes() == name.data());
        found.ok_or_else(|| wrong("it has an unknown model"))
    };
    for (index, name) in block.models.iter_mut().zip(texts(read(MODEL.0)?, rows)?) {
        let model = name.map(model).transpose()?;
        *index = model.map_or(NO_MODEL, |model| model as u8);
    }
    for (row, reason) in (start..).zip(texts(read(FAILURE.0)?, rows)?) {
        if let Some(reason) = reason {
            block.failures.push((row, reason.as_utf8()?.to_owned()));
        }
    }
    Ok(block)
}

/// The pages of a column of a group, from its bytes.
fn pages(
    group: &RowGroupMetaData,
    place: usize,
    bytes: &Arc<Bytes>,
    rows: usize,
) -> Result<ColumnReader, ParquetError> {
    let (chunk, start) = (group.column(place), span(group).0);
    let (first, length) = chunk.byte_range();
    if first < start || first - start + length > bytes.len() as u64 {
        return Err(wrong("a column lies outside its group"));
    }
    let inside = |offset: i64| offset.wrapping_sub(start as i64);
    let moved = (chunk.clone().into_builder())
        .set_data_page_offset(inside(chunk.data_page_offset()))
        .set_dictionary_page_offset(chunk.dictionary_page_offset().map(inside))
        .build()?;
    let pages = SerializedPageReader::new(Arc::clone(bytes), &moved, rows, None)?;
    Ok(get_column_reader(chunk.column_descr_ptr(), Box::new(pages)))
}

/// The numbers of a column, NaN for missing ones.
fn numbers(
    pages: ColumnReader,
    rows: usize,
    precision: Precision,
) -> Result<Vec<f64>, ParquetError> {
    let or_nan = |x: Option<f64>| x.unwrap_or(f64::NAN);
    match (pages, precision) {
        (ColumnReader::DoubleColumnReader(pages), Precision::Double) => {
            Ok(all(pages, rows)?.into_iter().map(or_nan).collect())
        }
        (ColumnReader::FloatColumnReader(pages), Precision::Single) => {
            let found = all(pages, rows)?.into_iter();
            Ok(found.map(|x| or_nan(x.map(f64::from))).collect())
        }
        _ => Err(wrong("its results differ in precision")),
    }
}

fn texts(pages: ColumnReader, rows: usize) -> Result<Vec<Option<ByteArray>>, ParquetError> {
    match pages {
        ColumnReader::ByteArrayColumnReader(pages) => all(pages, rows),
        _ => Err(wrong("a column of words has another type")),
    }
}

/// The value of each row, if it has one.
fn all<T: DataType>(
    mut pages: ColumnReaderImpl<T>,
    rows: usize,
) -> Result<Vec<Option<T::T>>, ParquetError> {
    let (mut there, mut values) = (Vec::new(), Vec::new());
    let found = pages.read_records(rows, Some(&mut there), None, &mut values)?;
    if found.0 != rows || there.len() != rows {
        return Err(wrong("a column lacks rows"));
    }
    let mut values = values.into_iter();
    let value = |one: i16| match one {
        0 => Ok(None),
        _ => (values.next().map(Some)).ok_or_else(|| wrong("a column lacks values")),
    };
    there.into_iter().map(value).collect()
}

fn wrong(what: &str) -> ParquetError {
    ParquetError::General(what.to_owned())
}
