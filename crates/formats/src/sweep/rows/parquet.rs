//! Rows as Parquet, as `data-schema/sweep.md` writes it down: groups of rows, each column of one encoded by itself.

use super::block::{Block, Blocks};
use super::columns::{Cells, Column, What, columns, each_of, model_name, rows_of};
use super::footer::{Footer, KEY, seal};
use crate::sweep::axes::Values;
use crate::sweep::fields::Precision;
use crate::sweep::shard::Selection;
use crate::sweep::spec::Spec;
use bytes::Bytes;
use output::{Fault, Output, OutputError, Staged};
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
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;

/// Rows of a group.
const GROUP: usize = 131_072;

/// Values of an axis up to which a number among them is written as its index.
const MOST_INDEXED: usize = 1 << 16;

/// Writes rows, whose blocks are all there in order, into an output that was claimed before the work.
///
/// No more than a group is in memory, and the bytes depend neither on blocks nor on threads.
///
/// # Errors
/// [`OutputError`].
pub(super) fn stage_parquet<'a>(
    output: &'a Output,
    spec: &Spec,
    selection: Option<&Selection>,
    blocks: &(impl Blocks + ?Sized),
) -> Result<Staged<'a>, OutputError> {
    output.stage(|path| {
        let columns = columns(spec);
        let mut table = Table::begin(path, spec, &columns)?;
        let failed = each_of(&rows_of(spec, selection), blocks, &mut |block| {
            table.take(block)
        })?;
        table.finish(Footer::of(spec, selection, &columns, failed))?;
        seal(path).map_err(Fault::from)
    })
}

/// A file that is being written.
struct Table<'a> {
    spec: &'a Spec,
    columns: &'a [Column<'a>],
    /// The words that a column has by their numbers.
    words: Vec<Vec<ByteArray>>,
    writer: SerializedFileWriter<BufWriter<File>>,
    /// SHA-256 of each group.
    groups: Vec<String>,
    /// The rows of the group that is being filled.
    group: Block,
}

impl<'a> Table<'a> {
    fn begin(path: &Path, spec: &'a Spec, columns: &'a [Column<'a>]) -> Result<Self, Fault> {
        let file = BufWriter::with_capacity(1 << 20, File::create(path)?);
        let schema = schema(spec, columns).map_err(fault)?;
        let properties = Arc::new(properties(columns).map_err(fault)?);
        let words = columns.iter().map(|column| match column.what {
            What::Model => (0..u8::MAX)
                .map_while(model_name)
                .map(ByteArray::from)
                .collect(),
            what => {
                let words = what.words().into_iter().flatten();
                words.map(|word| word.as_str().into()).collect()
            }
        });
        Ok(Self {
            spec,
            columns,
            words: words.collect(),
            writer: SerializedFileWriter::new(file, schema, properties).map_err(fault)?,
            groups: Vec::new(),
            group: Block::default(),
        })
    }

    /// Adds the rows of a block.
    fn take(&mut self, block: &Block) -> Result<(), Fault> {
        let mut done = 0;
        while done < block.len() {
            let more = (block.len() - done).min(GROUP - self.group.len());
            self.group.extend(block, done..done + more);
            done += more;
            if self.group.len() == GROUP {
                self.write_group()?;
            }
        }
        Ok(())
    }

    fn write_group(&mut self) -> Result<(), Fault> {
        let described = self.writer.schema_descr().columns();
        let properties = self.writer.properties();
        let columns = self.columns.par_iter().zip(&self.words).zip(described);
        let encoded: Vec<_> = columns
            .map(|((column, words), described)| {
                let rows = 0..self.group.len();
                let cells = column.what.cells(self.spec, &self.group, rows)?;
                encode(cells, words, described, properties).map_err(fault)
            })
            .collect();
        let mut group = self.writer.next_row_group().map_err(fault)?;
        let mut hash = Sha256::new();
        for column in encoded {
            let (bytes, closed) = column?;
            hash.update(&bytes);
            group.append_column(&bytes, closed).map_err(fault)?;
        }
        group.close().map_err(fault)?;
        self.groups.push(format!("{:x}", hash.finalize()));
        self.group = Block::default();
        Ok(())
    }

    fn finish(mut self, mut footer: Footer) -> Result<(), Fault> {
        if !self.group.is_empty() {
            self.write_group()?;
        }
        footer.data_bytes = self.writer.bytes_written() as u64;
        footer.row_groups = self.groups;
        let text = serde_json::to_string(&footer).map_err(|error| error.to_string())?;
        let entry = KeyValue::new(KEY.to_owned(), text);
        self.writer.append_key_value_metadata(entry);
        self.writer.close().map(drop).map_err(fault)
    }
}

/// The bytes of a column in a group; NaN is no value.
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
        // the type of a column follows from what it holds
        _ => Err(ParquetError::General("a column of another type".to_owned())),
    };
    written?;
    let closed = writer.close()?;
    Ok((Bytes::from(sink.into_inner()?), closed))
}

/// Writes the values of all rows, those that are there.
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

/// Names and types.
fn schema(spec: &Spec, columns: &[Column<'_>]) -> Result<TypePtr, ParquetError> {
    let fields = columns.iter().map(|column| {
        let (physical, repetition) = match (column.what, spec.fields.precision) {
            (What::Row, _) => (Physical::INT64, Repetition::REQUIRED),
            (What::Key { .. }, _) if column.what.words().is_some() => {
                (Physical::BYTE_ARRAY, Repetition::REQUIRED)
            }
            (What::Key { .. }, _) => (Physical::DOUBLE, Repetition::REQUIRED),
            (What::Number(_), Precision::Double) => (Physical::DOUBLE, Repetition::OPTIONAL),
            (What::Number(_), Precision::Single) => (Physical::FLOAT, Repetition::OPTIONAL),
            (What::Model | What::Failure, _) => (Physical::BYTE_ARRAY, Repetition::OPTIONAL),
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

/// How each column is encoded.
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
            // the first bytes of all numbers, which are alike, stand together
            What::Key { .. } | What::Number(_) => (false, Encoding::BYTE_STREAM_SPLIT),
        };
        properties = properties.set_column_encoding(path.clone(), encoding);
        properties = properties.set_column_dictionary_enabled(path, indexed);
    }
    Ok(properties.build())
}

fn fault(error: ParquetError) -> Fault {
    match error {
        ParquetError::External(error) => Fault::from(error.to_string()),
        other => Fault::from(other.to_string()),
    }
}
