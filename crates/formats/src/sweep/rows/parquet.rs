//! Rows as Parquet, as `data-schema/sweep.md` writes it down: groups of rows, each column of one encoded by itself.

use super::block::{Block, Blocks};
use super::columns::{Cells, Column, What, columns, each_of, model_name};
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
use std::ops::Range;
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
        let mut footer = Footer::of(spec, selection);
        let rows = footer.part.selection.rows.clone();
        footer.part.failed = each_of(&rows, blocks, &mut |block| table.take(block))?;
        table.finish(footer, &columns)?;
        seal(path).map_err(Fault::from)
    })
}

/// A column while a group is filled: the values, without those that are not there, and for each row whether it has one.
struct Filled<'a> {
    what: What<'a>,
    described: ColumnDescPtr,
    values: Kept,
    there: Vec<i16>,
    /// Those that are written by their numbers.
    words: Vec<ByteArray>,
}

enum Kept {
    Whole(Vec<i64>),
    Double(Vec<f64>),
    Single(Vec<f32>),
    Text(Vec<ByteArray>),
}

/// A file that is being written.
struct Table<'a> {
    spec: &'a Spec,
    columns: Vec<Filled<'a>>,
    writer: SerializedFileWriter<BufWriter<File>>,
    /// SHA-256 of each group.
    groups: Vec<String>,
    /// Rows of the group.
    held: usize,
}

impl<'a> Table<'a> {
    fn begin(path: &Path, spec: &'a Spec, columns: &[Column<'a>]) -> Result<Self, Fault> {
        let file = BufWriter::with_capacity(1 << 20, File::create(path)?);
        let schema = schema(spec, columns).map_err(fault)?;
        let properties = Arc::new(properties(columns).map_err(fault)?);
        let writer = SerializedFileWriter::new(file, schema, properties).map_err(fault)?;
        let described = writer.schema_descr().columns().iter();
        let columns = columns.iter().zip(described).map(|(column, described)| {
            let models = (0..u8::MAX).map_while(model_name).map(ByteArray::from);
            Filled {
                what: column.what,
                described: Arc::clone(described),
                values: match described.physical_type() {
                    Physical::INT64 => Kept::Whole(Vec::new()),
                    Physical::FLOAT => Kept::Single(Vec::new()),
                    Physical::BYTE_ARRAY => Kept::Text(Vec::new()),
                    _ => Kept::Double(Vec::new()),
                },
                there: Vec::new(),
                words: match (column.what, column.what.words()) {
                    (What::Model, _) => models.collect(),
                    (_, Some(words)) => words.iter().map(|w| w.as_str().into()).collect(),
                    (_, None) => Vec::new(),
                },
            }
        });
        Ok(Self {
            spec,
            columns: columns.collect(),
            writer,
            groups: Vec::new(),
            held: 0,
        })
    }

    /// Adds the rows of a block.
    fn take(&mut self, block: &Block) -> Result<(), Fault> {
        let (mut done, count, spec) = (0, block.numbers.len(), self.spec);
        while done < count {
            let more = (count - done).min(GROUP - self.held);
            let mut filled = Vec::new();
            (self.columns.par_iter_mut())
                .map(|column| column.fill(spec, block, done..done + more))
                .collect_into_vec(&mut filled);
            filled.into_iter().collect::<Result<(), Fault>>()?;
            done += more;
            self.held += more;
            if self.held == GROUP {
                self.write_group()?;
            }
        }
        Ok(())
    }

    fn write_group(&mut self) -> Result<(), Fault> {
        let properties = self.writer.properties();
        let encoded: Vec<_> = (self.columns.par_iter_mut())
            .map(|column| column.encode(properties))
            .collect();
        let mut group = self.writer.next_row_group().map_err(fault)?;
        let mut hash = Sha256::new();
        for column in encoded {
            let (bytes, closed) = column.map_err(fault)?;
            hash.update(&bytes);
            group.append_column(&bytes, closed).map_err(fault)?;
        }
        group.close().map_err(fault)?;
        self.groups.push(format!("{:x}", hash.finalize()));
        self.held = 0;
        Ok(())
    }

    fn finish(mut self, mut footer: Footer, columns: &[Column<'_>]) -> Result<(), Fault> {
        if self.held > 0 {
            self.write_group()?;
        }
        footer.data_bytes = self.writer.bytes_written() as u64;
        footer.groups = self.groups;
        let text = footer.json(columns.iter().map(|column| &column.described));
        let entry = KeyValue::new(KEY.to_owned(), text);
        self.writer.append_key_value_metadata(entry);
        self.writer.close().map(drop).map_err(fault)
    }
}

impl Filled<'_> {
    /// Takes some rows of a block; NaN is no value.
    fn fill(&mut self, spec: &Spec, block: &Block, some: Range<usize>) -> Result<(), Fault> {
        let word = |index: usize| self.words.get(index).cloned();
        match (self.what.cells(spec, block, some)?, &mut self.values) {
            (Cells::Whole(found), Kept::Whole(kept)) => {
                keep(kept, &mut self.there, found.into_iter().map(Some));
            }
            (Cells::Double(found), Kept::Double(kept)) => {
                let found = found.into_iter().map(|x| Some(x).filter(|x| !x.is_nan()));
                keep(kept, &mut self.there, found);
            }
            (Cells::Single(found), Kept::Single(kept)) => {
                let found = found.into_iter().map(|x| Some(x).filter(|x| !x.is_nan()));
                keep(kept, &mut self.there, found);
            }
            (Cells::Words(found), Kept::Text(kept)) => {
                keep(
                    kept,
                    &mut self.there,
                    found.into_iter().map(|i| word(i as usize)),
                );
            }
            (Cells::Models(found), Kept::Text(kept)) => {
                let found = found.iter().map(|&i| word(usize::from(i)));
                keep(kept, &mut self.there, found);
            }
            (Cells::Reasons(found), Kept::Text(kept)) => {
                let found = found.into_iter().map(|reason| reason.map(ByteArray::from));
                keep(kept, &mut self.there, found);
            }
            // the type of a column follows from what it holds
            (_, _) => {}
        }
        Ok(())
    }

    /// The bytes of the column in a group; it is empty afterwards.
    fn encode(
        &mut self,
        properties: &WriterPropertiesPtr,
    ) -> Result<(Bytes, ColumnCloseResult), ParquetError> {
        let mut sink = TrackedWrite::new(Vec::new());
        let pages = Box::new(SerializedPageWriter::new(&mut sink));
        let (described, properties) = (Arc::clone(&self.described), Arc::clone(properties));
        let mut writer: ColumnWriter<'_> = get_column_writer(described, properties, pages);
        match (&mut self.values, &mut writer) {
            (Kept::Whole(values), ColumnWriter::Int64ColumnWriter(writer)) => {
                write(writer, values, &self.there)?;
            }
            (Kept::Double(values), ColumnWriter::DoubleColumnWriter(writer)) => {
                write(writer, values, &self.there)?;
            }
            (Kept::Single(values), ColumnWriter::FloatColumnWriter(writer)) => {
                write(writer, values, &self.there)?;
            }
            (Kept::Text(values), ColumnWriter::ByteArrayColumnWriter(writer)) => {
                write(writer, values, &self.there)?;
            }
            _ => return Err(ParquetError::General("a column of another type".to_owned())),
        }
        self.there.clear();
        let closed = writer.close()?;
        Ok((Bytes::from(sink.into_inner()?), closed))
    }
}

/// Keeps the values that are there.
fn keep<T>(kept: &mut Vec<T>, there: &mut Vec<i16>, found: impl Iterator<Item = Option<T>>) {
    for value in found {
        there.push(i16::from(value.is_some()));
        kept.extend(value);
    }
}

/// Writes all values; there are none afterwards.
fn write<T: DataType>(
    writer: &mut ColumnWriterImpl<'_, T>,
    values: &mut Vec<T::T>,
    there: &[i16],
) -> Result<(), ParquetError> {
    let optional = writer.get_descriptor().max_def_level() > 0;
    writer.write_batch(values, optional.then_some(there), None)?;
    values.clear();
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
                if values.len() <= MOST_INDEXED || matches!(values, Values::Texts(_)) =>
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
