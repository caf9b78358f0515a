//! Rows as Parquet, as `data-schema/sweep.md` describes them: groups of rows in which each column is encoded
//! independently.

use super::block::{Block, Blocks};
use super::columns::{Cells, Column, What, columns, each_of};
use super::footer::{DIGITS, FORMAT_VERSION, Footer, TAIL, footer_in, seal_in, sum_without};
use crate::schema::sweep::{FILE_TYPE, part};
use crate::sweep::axes::Values;
use crate::sweep::fields::Precision;
use crate::sweep::spec::Spec;
use bytes::Bytes;
use contact::{Choice, Model};
use ledger::sha256_hex;
use output::{Output, OutputError, OutputFault, Staged};
use parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as Physical, ZstdLevel};
use parquet::column::writer::{
    ColumnCloseResult, ColumnWriter, ColumnWriterImpl, get_column_writer,
};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties, WriterPropertiesPtr};
use parquet::file::writer::{SerializedFileWriter, SerializedPageWriter, TrackedWrite};
use parquet::schema::types::{ColumnDescPtr, ColumnPath, Type, TypePtr};
use rayon::prelude::*;
use serde_json::json;
use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::sync::Arc;

/// Rows per group.
const GROUP: usize = 131_072;

/// Largest axis whose numbers are written as indices.
const MOST_INDEXED: usize = 1 << 16;

/// Writes rows, whose blocks must be complete and in order, into an output that was claimed before the work.
///
/// Only one group is in memory, and the bytes depend neither on blocks nor on threads.
///
/// # Errors
/// [`OutputError`].
pub(super) fn stage_parquet<'a>(
    output: &'a Output,
    spec: &Spec,
    blocks: &(impl Blocks + ?Sized),
) -> Result<Staged<'a>, OutputError> {
    output.stage(|made| {
        let columns = columns(spec);
        let file = BufWriter::with_capacity(1 << 20, made);
        let schema = schema(spec, &columns).map_err(fault)?;
        let properties = Arc::new(properties(&columns).map_err(fault)?);
        let mut writer = SerializedFileWriter::new(file, schema, properties).map_err(fault)?;
        let words: Vec<_> = columns.iter().map(words_of).collect();
        let (mut row_groups, mut group) = (Vec::new(), Block::default());
        let mut write = |group: &mut Block| {
            row_groups.push(write_group(&mut writer, spec, &columns, &words, group)?);
            *group = Block::default();
            Ok::<_, OutputFault>(())
        };
        let failed = each_of(spec, blocks, &mut |block| {
            let mut done = 0;
            while done < block.len() {
                let more = (block.len() - done).min(GROUP - group.len());
                group.extend(block, done..done + more);
                done += more;
                if group.len() == GROUP {
                    write(&mut group)?;
                }
            }
            Ok(())
        })?;
        if !group.is_empty() {
            write(&mut group)?;
        }
        let footer = Footer {
            row_groups,
            data_bytes: writer.bytes_written() as u64,
            ..footer(spec, &columns, failed)
        };
        let text = serde_json::to_string(&footer).map_err(|error| error.to_string())?;
        writer.append_key_value_metadata(KeyValue::new("hertzlamb".to_owned(), text));
        writer.close().map_err(fault)?;
        seal(made).map_err(OutputFault::from)
    })
}

/// The words of a column in the order of their indices.
fn words_of(column: &Column<'_>) -> Vec<ByteArray> {
    if let What::Model = column.what {
        return Model::ALL.iter().map(|model| model.name().into()).collect();
    }
    let words = column.what.words().into_iter().flatten();
    words.map(|word| word.as_str().into()).collect()
}

/// Writes a group of rows; returns the SHA-256 of its bytes.
fn write_group(
    writer: &mut SerializedFileWriter<BufWriter<&File>>,
    spec: &Spec,
    columns: &[Column<'_>],
    words: &[Vec<ByteArray>],
    rows: &Block,
) -> Result<String, OutputFault> {
    let (described, properties) = (writer.schema_descr().columns(), writer.properties());
    let columns = columns.par_iter().zip(words).zip(described);
    let encoded: Vec<_> = columns
        .map(|((column, words), described)| {
            let cells = column.what.cells(spec, rows, 0..rows.len())?;
            encode(cells, words, described, properties).map_err(fault)
        })
        .collect();
    let mut group = writer.next_row_group().map_err(fault)?;
    let mut written = Vec::with_capacity(encoded.len());
    for column in encoded {
        let (bytes, closed) = column?;
        group.append_column(&bytes, closed).map_err(fault)?;
        written.push(bytes);
    }
    group.close().map_err(fault)?;
    Ok(sha256_hex(written.iter().map(|bytes| &bytes[..])))
}

/// The footer of the file without the entries of its groups.
fn footer(spec: &Spec, columns: &[Column<'_>], failed: usize) -> Footer {
    let described = columns.iter().map(|Column { described, .. }| {
        let labels = json!({ "units": described.unit, "long_name": described.meaning });
        (described.name.clone(), labels)
    });
    let (rows, selection) = (spec.selected(), spec.selection.as_ref());
    let shard = selection.and_then(|selection| selection.shard);
    Footer {
        file_type: selection.map_or(FILE_TYPE, |_| part::FILE_TYPE).to_owned(),
        seal: "0".repeat(DIGITS),
        format_version: FORMAT_VERSION.to_owned(),
        software_version: env!("CARGO_PKG_VERSION").to_owned(),
        sweep: spec.resolved.clone(),
        sweep_sha256: spec.sha256.clone(),
        shard: shard.map_or_else(String::new, |shard| shard.to_string()),
        sweep_rows: spec.rows(),
        first_row: rows.start,
        rows: rows.len(),
        failed,
        columns: described.collect(),
        bits: spec.fields.precision as usize,
        row_groups: Vec::new(),
        data_bytes: 0,
    }
}

/// Writes the checksum into the footer of a finished file.
fn seal(mut file: &File) -> io::Result<()> {
    let (bytes, length) = footer_in(file)?;
    let placed = bytes.and_then(|bytes| Some((seal_in(&bytes)?, bytes)));
    let (digits, bytes) = placed.ok_or_else(|| io::Error::other("its footer has no seal"))?;
    let place = length - TAIL - bytes.len() as u64 + digits.start as u64;
    file.seek(SeekFrom::Start(place))?;
    file.write_all(sum_without(&bytes, &digits).as_bytes())
}

/// The bytes of a column in a group; NaN is written as a missing value.
fn encode(
    cells: Cells<'_>,
    words: &[ByteArray],
    described: &ColumnDescPtr,
    properties: &WriterPropertiesPtr,
) -> Result<(Bytes, ColumnCloseResult), ParquetError> {
    use ColumnWriter as Of;
    let mut sink = TrackedWrite::new(Vec::new());
    let pages = Box::new(SerializedPageWriter::new(&mut sink));
    let (described, properties) = (Arc::clone(described), Arc::clone(properties));
    let mut writer = get_column_writer(described, properties, pages);
    let word = |place: usize| words.get(place).cloned();
    let written = match (cells, &mut writer) {
        (Cells::Whole(rows), Of::Int64ColumnWriter(to)) => write(to, rows.into_iter().map(Some)),
        (Cells::Double(numbers), Of::DoubleColumnWriter(to)) => {
            let there = |x: f64| (!x.is_nan()).then_some(x);
            write(to, numbers.into_iter().map(there))
        }
        (Cells::Single(numbers), Of::FloatColumnWriter(to)) => {
            let there = |x: f32| (!x.is_nan()).then_some(x);
            write(to, numbers.into_iter().map(there))
        }
        (Cells::Words(places), Of::ByteArrayColumnWriter(to)) => {
            write(to, places.into_iter().map(|place| word(place as usize)))
        }
        (Cells::Models(models), Of::ByteArrayColumnWriter(to)) => {
            write(to, models.iter().map(|&model| word(usize::from(model))))
        }
        (Cells::Reasons(reasons), Of::ByteArrayColumnWriter(to)) => {
            let text = |reason: Option<&str>| reason.map(ByteArray::from);
            write(to, reasons.into_iter().map(text))
        }
        // the type of a column follows from its content
        _ => Err(ParquetError::General("a column of another type".to_owned())),
    };
    written?;
    let closed = writer.close()?;
    Ok((Bytes::from(sink.into_inner()?), closed))
}

/// Writes the values of all rows that have one.
fn write<T: DataType>(
    writer: &mut ColumnWriterImpl<'_, T>,
    found: impl ExactSizeIterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let mut there = Vec::with_capacity(found.len());
    let mut values = Vec::with_capacity(found.len());
    for value in found {
        there.push(i16::from(value.is_some()));
        values.extend(value);
    }
    let optional = writer.get_descriptor().max_def_level() > 0;
    writer.write_batch(&values, optional.then_some(&there[..]), None)?;
    Ok(())
}

/// Names and types of the columns.
fn schema(spec: &Spec, columns: &[Column<'_>]) -> Result<TypePtr, ParquetError> {
    let fields = columns.iter().map(|column| {
        let physical = match (column.what, spec.fields.precision) {
            (What::Row, _) => Physical::INT64,
            (What::Key { .. }, _) if column.what.words().is_none() => Physical::DOUBLE,
            (What::Key { .. } | What::Model | What::Failure, _) => Physical::BYTE_ARRAY,
            (What::Number(_), Precision::Double) => Physical::DOUBLE,
            (What::Number(_), Precision::Single) => Physical::FLOAT,
        };
        let repetition = match column.what {
            What::Row | What::Key { .. } => Repetition::REQUIRED,
            What::Number(_) | What::Model | What::Failure => Repetition::OPTIONAL,
        };
        let text = (physical == Physical::BYTE_ARRAY).then_some(LogicalType::String);
        Type::primitive_type_builder(&column.described.name, physical)
            .with_repetition(repetition)
            .with_logical_type(text)
            .build()
            .map(Arc::new)
    });
    let fields = fields.collect::<Result<Vec<_>, _>>()?;
    let root = Type::group_type_builder("schema").with_fields(fields);
    root.build().map(Arc::new)
}

/// Encodings of the columns.
fn properties(columns: &[Column<'_>]) -> Result<WriterProperties, ParquetError> {
    let mut properties = WriterProperties::builder()
        .set_created_by(format!("hertzlamb version {}", env!("CARGO_PKG_VERSION")))
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(1)?))
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true)
        .set_data_page_row_count_limit(GROUP)
        .set_max_row_group_row_count(Some(GROUP));
    for column in columns {
        let path = ColumnPath::new(vec![column.described.name.clone()]);
        let (indexed, encoding) = match column.what {
            What::Row => (false, Encoding::DELTA_BINARY_PACKED),
            What::Model | What::Failure => (true, Encoding::PLAIN),
            What::Key { values, .. }
                if values.count() <= MOST_INDEXED || matches!(values, Values::Texts(_)) =>
            {
                (true, Encoding::PLAIN)
            }
            // the first bytes of all numbers are similar and are stored together
            What::Key { .. } | What::Number(_) => (false, Encoding::BYTE_STREAM_SPLIT),
        };
        properties = properties.set_column_encoding(path.clone(), encoding);
        properties = properties.set_column_dictionary_enabled(path, indexed);
    }
    Ok(properties.build())
}

fn fault(error: ParquetError) -> OutputFault {
    match error {
        ParquetError::External(error) => OutputFault::from(error.to_string()),
        other => OutputFault::from(other.to_string()),
    }
}
