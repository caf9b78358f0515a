//! Groups of rows of a Parquet file: nothing is decoded before its hash was compared.

use super::rows::NOT_HELD;
use crate::sweep::schema::{FAILURE, MODEL};
use crate::sweep::{Block, Footer, NO_MODEL, Part, Precision};
use bytes::{Buf, Bytes};
use contact::{Choice, Model};
use output::Fault;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl, get_column_reader};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::metadata::{
    ColumnChunkMetaData, ParquetMetaData, ParquetMetaDataReader, RowGroupMetaData,
};
use parquet::file::reader::{ChunkReader, Length};
use parquet::file::serialized_reader::SerializedPageReader;
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::sync::Arc;

/// Shows the rows of a file, whose groups have these hashes.
pub(super) fn each(
    part: &Part,
    hashes: &[String],
    visit: &mut dyn FnMut(&Block) -> Result<(), Fault>,
) -> Result<(), Fault> {
    let damaged = |what: String| Fault::from(format!("{}: {what}", part.path.display()));
    let metadata = metadata(part).map_err(damaged)?;
    let places = places(part, &metadata).map_err(damaged)?;
    let mut next = part.selection.rows.start;
    let read = each_group(part, hashes, &metadata, &mut |group, bytes| {
        let block = block(part, &places, group, &Arc::new(bytes), next);
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

/// Compares the rows of a file with the hashes of their groups.
pub(super) fn check(part: &Part, hashes: &[String]) -> Result<(), Fault> {
    each_group(part, hashes, &metadata(part)?, &mut |_, _| Ok(()))
}

fn metadata(part: &Part) -> Result<ParquetMetaData, String> {
    let footer = Footer::bytes(&part.path).map_err(|error| error.to_string())?;
    ParquetMetaDataReader::decode_metadata(&footer).map_err(|error| error.to_string())
}

/// Shows the groups, each compared with its hash.
fn each_group(
    part: &Part,
    hashes: &[String],
    metadata: &ParquetMetaData,
    visit: &mut dyn FnMut(&RowGroupMetaData, Group) -> Result<(), Fault>,
) -> Result<(), Fault> {
    let mut file = File::open(&part.path)?;
    if metadata.num_row_groups() != hashes.len() {
        return Err(Fault::from("it has other groups of rows".to_owned()));
    }
    let mut next = part.selection.rows.start;
    for (group, hash) in metadata.row_groups().iter().zip(hashes) {
        let bytes = Group::read(&mut file, group)?;
        if format!("{:x}", Sha256::digest(&bytes.bytes)) != *hash {
            return Err(Fault::from(format!("the rows from {next} on were changed")));
        }
        next += usize::try_from(group.num_rows()).unwrap_or(0);
        visit(group, bytes)?;
    }
    Ok(())
}

/// Where the columns of a file are, by name.
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
    bytes: &Arc<Group>,
    start: usize,
) -> Result<Block, ParquetError> {
    let rows = usize::try_from(group.num_rows()).unwrap_or(0);
    let read = |name: &str| Column::read(group, places[name], bytes, rows);
    let quantities: Vec<_> = part.fields.quantities().collect();
    let columns: Vec<_> = (quantities.par_iter())
        .map(|(_, quantity)| read(&quantity.name)?.numbers(part.fields.precision))
        .collect::<Result<_, _>>()?;
    let mut block = Block::blank(start, rows, part.fields.width());
    for ((k, _), column) in quantities.into_iter().zip(columns) {
        block.fill(k, column);
    }
    let models = read(MODEL.0)?.texts()?.into_iter().map(|name| {
        let Some(name) = name else {
            return Ok(NO_MODEL);
        };
        let known = Model::ALL
            .iter()
            .position(|model| model.name().as_bytes() == name.data());
        known
            .map(|model| model as u8)
            .ok_or_else(|| wrong("a model is not known"))
    });
    block.models = models.collect::<Result<_, _>>()?;
    let reasons = read(FAILURE.0)?.texts()?.into_iter();
    for (row, reason) in (start..).zip(reasons) {
        if let Some(reason) = reason {
            let reason = reason.as_utf8()?.to_owned();
            block.failures.push((row, reason));
        }
    }
    Ok(block)
}

/// A column of a group: for each row, whether it has a value, and these.
struct Column {
    there: Vec<i16>,
    values: Values,
}

enum Values {
    Double(Vec<f64>),
    Single(Vec<f32>),
    Text(Vec<ByteArray>),
}

impl Column {
    fn read(
        group: &RowGroupMetaData,
        place: usize,
        bytes: &Arc<Group>,
        rows: usize,
    ) -> Result<Self, ParquetError> {
        let chunk = group.column(place);
        let pages = SerializedPageReader::new(Arc::clone(bytes), chunk, rows, None)?;
        let mut there = Vec::new();
        let values = match get_column_reader(chunk.column_descr_ptr(), Box::new(pages)) {
            ColumnReader::DoubleColumnReader(reader) => {
                Values::Double(read_all(reader, rows, &mut there)?)
            }
            ColumnReader::FloatColumnReader(reader) => {
                Values::Single(read_all(reader, rows, &mut there)?)
            }
            ColumnReader::ByteArrayColumnReader(reader) => {
                Values::Text(read_all(reader, rows, &mut there)?)
            }
            _ => return Err(wrong("a column has another type")),
        };
        Ok(Self { there, values })
    }

    /// Numbers, NaN where there is none.
    fn numbers(self, precision: Precision) -> Result<Vec<f64>, ParquetError> {
        let values: Vec<f64> = match (self.values, precision) {
            (Values::Double(values), Precision::Double) => values,
            (Values::Single(values), Precision::Single) => {
                values.into_iter().map(f64::from).collect()
            }
            _ => return Err(wrong("its results are not of one precision")),
        };
        let mut values = values.into_iter();
        let spread = self.there.iter().map(|&one| match one {
            0 => Some(f64::NAN),
            _ => values.next(),
        });
        let spread: Option<Vec<f64>> = spread.collect();
        spread.ok_or_else(|| wrong("a column has not all values"))
    }

    fn texts(self) -> Result<Vec<Option<ByteArray>>, ParquetError> {
        let Values::Text(values) = self.values else {
            return Err(wrong("a column of words has another type"));
        };
        let mut values = values.into_iter();
        let text = |one: &i16| if *one == 0 { None } else { values.next() };
        Ok(self.there.iter().map(text).collect())
    }
}

/// The values of all rows.
fn read_all<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
    there: &mut Vec<i16>,
) -> Result<Vec<T::T>, ParquetError> {
    let mut values = Vec::new();
    let found = reader.read_records(rows, Some(there), None, &mut values)?;
    if found.0 != rows || there.len() != rows {
        return Err(wrong("a column has not all rows"));
    }
    Ok(values)
}

fn wrong(what: &str) -> ParquetError {
    ParquetError::General(what.to_owned())
}

/// The bytes of a group, at the places that they have in the file.
struct Group {
    start: u64,
    bytes: Bytes,
}

impl Group {
    /// Reads it: its columns follow each other.
    fn read(file: &mut File, group: &RowGroupMetaData) -> Result<Self, Fault> {
        let ranges = group.columns().iter().map(ColumnChunkMetaData::byte_range);
        let (mut start, mut end) = (None, 0);
        for (first, length) in ranges {
            let begin = *start.get_or_insert(first);
            end = first.saturating_add(length).max(begin);
        }
        let start = start.unwrap_or(0);
        file.seek(SeekFrom::Start(start))?;
        let mut bytes = Vec::new();
        file.take(end - start).read_to_end(&mut bytes)?;
        Ok(Self {
            start,
            bytes: bytes.into(),
        })
    }

    /// Some of them.
    fn some(&self, start: u64, length: Option<usize>) -> Result<Bytes, ParquetError> {
        let all = self.bytes.len();
        let range = || {
            let from = usize::try_from(start.checked_sub(self.start)?).ok()?;
            let to = length.map_or(Some(all), |length| from.checked_add(length))?;
            (from <= all && to <= all).then_some(from..to)
        };
        let range = range().ok_or_else(|| wrong("a column lies outside its group"))?;
        Ok(self.bytes.slice(range))
    }
}

impl Length for Group {
    fn len(&self) -> u64 {
        self.start + self.bytes.len() as u64
    }
}

impl ChunkReader for Group {
    type T = bytes::buf::Reader<Bytes>;

    fn get_read(&self, start: u64) -> Result<Self::T, ParquetError> {
        Ok(self.some(start, None)?.reader())
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes, ParquetError> {
        self.some(start, Some(length))
    }
}
