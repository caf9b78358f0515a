//! Rows as Parquet, as `data-schema/sweep.md` writes it down: groups of rows, each column of one encoded by itself.

use super::axis::Values;
use super::block::Block;
use super::blocks::Blocks;
use super::cells::{Cells, models, words};
use super::columns::{What, single};
use super::fields::Precision;
use super::footer::Footer;
use super::seal::{KEY, seal};
use super::shard::Selection;
use super::spec::Spec;
use super::table::{RowColumn, row_columns};
use bytes::Bytes;
use output::{Fault, Output, OutputError, Staged};
use parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as Physical, ZstdLevel};
use parquet::column::writer::{ColumnCloseResult, ColumnWriter, get_column_writer};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties, WriterPropertiesPtr};
use parquet::file::writer::{SerializedFileWriter, SerializedPageWriter, TrackedWrite};
use parquet::schema::types::{ColumnDescPtr, ColumnPath, Type, TypePtr};
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::fs::File;
use std::io::BufWriter;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// Rows of a group.
pub(crate) const GROUP: usize = 131_072;

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
        let mut table = Table::begin(path, spec, Footer::of(spec, selection))?;
        blocks.each(&mut |block| table.take(block))?;
        table.finish()?;
        seal(path).map_err(Fault::from)
    })
}

/// A column while a group is filled.
struct Column<'a> {
    what: What,
    values: Option<&'a Values>,
    described: ColumnDescPtr,
    cells: Cells,
}

/// A file that is being written.
struct Table<'a> {
    spec: &'a Spec,
    footer: Footer,
    labels: Vec<(String, &'static str, String)>,
    columns: Vec<Column<'a>>,
    writer: SerializedFileWriter<BufWriter<File>>,
    /// The row behind the last that was taken.
    next: usize,
    /// Rows of the group.
    held: usize,
}

impl<'a> Table<'a> {
    fn begin(path: &Path, spec: &'a Spec, footer: Footer) -> Result<Self, Fault> {
        let described = row_columns(spec);
        let file = BufWriter::with_capacity(1 << 20, File::create(path)?);
        let schema = schema(spec, &described).map_err(fault)?;
        let properties = Arc::new(properties(spec, &described).map_err(fault)?);
        let writer = SerializedFileWriter::new(file, schema, properties).map_err(fault)?;
        let kinds = writer.schema_descr().columns().to_vec();
        let columns = described.iter().zip(kinds).map(|(column, described)| {
            let words = match (column.values, column.what) {
                (Some(Values::Texts(texts)), _) => words(texts),
                (None, What::Model) => models(),
                _ => Vec::new(),
            };
            Column {
                what: column.what,
                values: column.values,
                cells: Cells::new(described.physical_type(), words),
                described,
            }
        });
        let columns = columns.collect();
        let labels = described.into_iter();
        let labels = labels.map(|column| (column.name, column.unit, column.meaning));
        Ok(Self {
            spec,
            next: footer.selection.rows.start,
            footer,
            labels: labels.collect(),
            columns,
            writer,
            held: 0,
        })
    }

    /// Adds the rows of a block.
    fn take(&mut self, block: &Block) -> Result<(), Fault> {
        let count = block.numbers.len();
        let rows = &self.footer.selection.rows;
        if block.start != self.next || block.start + count > rows.end {
            return Err(Fault::from(format!("row {} is not there", self.next)));
        }
        let mut done = 0;
        while done < count {
            let more = (count - done).min(GROUP - self.held);
            let (spec, some) = (self.spec, done..done + more);
            let failures = failures(block, &some);
            let mut filled = Vec::new();
            (self.columns.par_iter_mut())
                .map(|column| column.fill(spec, block, &some, &failures))
                .collect_into_vec(&mut filled);
            filled.into_iter().collect::<Result<(), Fault>>()?;
            done += more;
            self.held += more;
            if self.held == GROUP {
                self.write_group()?;
            }
        }
        self.next += count;
        self.footer.failed += block.failures.len();
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
        self.footer.groups.push(format!("{:x}", hash.finalize()));
        self.held = 0;
        Ok(())
    }

    fn finish(mut self) -> Result<(), Fault> {
        if self.next != self.footer.selection.rows.end {
            return Err(Fault::from(format!("row {} is not there", self.next)));
        }
        if self.held > 0 {
            self.write_group()?;
        }
        self.footer.data_bytes = self.writer.bytes_written() as u64;
        let text = self.footer.json(&self.labels);
        let entry = KeyValue::new(KEY.to_owned(), text);
        self.writer.append_key_value_metadata(entry);
        self.writer.close().map(drop).map_err(fault)
    }
}

impl Column<'_> {
    /// Takes some rows of a block.
    fn fill(
        &mut self,
        spec: &Spec,
        block: &Block,
        some: &Range<usize>,
        failures: &HashMap<usize, &str>,
    ) -> Result<(), Fault> {
        let cells = &mut self.cells;
        let rows = block.start + some.start..block.start + some.end;
        match self.what {
            What::Row => rows.for_each(|row| cells.whole(row as i64)),
            What::Key { stride, axis, .. } => {
                let len = spec.axes[axis].len;
                for place in rows.map(|row| row / stride % len) {
                    match self.values {
                        Some(Values::Numbers(numbers)) => cells.double(numbers[place]),
                        Some(Values::Drawn(drawn)) => cells.double(drawn.at(place)),
                        Some(Values::Texts(_)) => cells.word(Some(place)),
                        None => {}
                    }
                }
            }
            What::Number(k) => {
                for (place, row) in some.clone().zip(rows) {
                    let number = block.number(place, k);
                    match spec.fields.precision {
                        Precision::Double => cells.double(number),
                        Precision::Single => {
                            let name = spec.fields.named(k).name;
                            cells.single(single(number, row, name)?);
                        }
                    }
                }
            }
            What::Model => {
                let known = cells.words();
                for &model in &block.models[some.clone()] {
                    cells.word(Some(usize::from(model)).filter(|&model| model < known));
                }
            }
            What::Failure => rows.for_each(|row| cells.text(failures.get(&row).copied())),
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
        self.cells.write(&mut writer)?;
        let closed = writer.close()?;
        Ok((Bytes::from(sink.into_inner()?), closed))
    }
}

/// Reasons by row of some rows of a block.
fn failures<'b>(block: &'b Block, some: &Range<usize>) -> HashMap<usize, &'b str> {
    let rows = block.start + some.start..block.start + some.end;
    let failures = block.failures.iter();
    failures
        .filter(|(row, _)| rows.contains(row))
        .map(|(row, reason)| (*row, reason.as_str()))
        .collect()
}

/// Names and types.
fn schema(spec: &Spec, columns: &[RowColumn<'_>]) -> Result<TypePtr, ParquetError> {
    let fields = columns.iter().map(|column| {
        let (physical, repetition) = match column.what {
            What::Row => (Physical::INT64, Repetition::REQUIRED),
            What::Key { .. } => match column.values {
                Some(Values::Texts(_)) => (Physical::BYTE_ARRAY, Repetition::REQUIRED),
                Some(Values::Numbers(_) | Values::Drawn(_)) | None => {
                    (Physical::DOUBLE, Repetition::REQUIRED)
                }
            },
            What::Number(_) => match spec.fields.precision {
                Precision::Double => (Physical::DOUBLE, Repetition::OPTIONAL),
                Precision::Single => (Physical::FLOAT, Repetition::OPTIONAL),
            },
            What::Model | What::Failure => (Physical::BYTE_ARRAY, Repetition::OPTIONAL),
        };
        let text = (physical == Physical::BYTE_ARRAY).then_some(LogicalType::String);
        Type::primitive_type_builder(&column.name, physical)
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
fn properties(spec: &Spec, columns: &[RowColumn<'_>]) -> Result<WriterProperties, ParquetError> {
    let mut properties = WriterProperties::builder()
        .set_created_by(format!("hertzlamb version {}", env!("CARGO_PKG_VERSION")))
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(1)?))
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true)
        .set_data_page_row_count_limit(GROUP)
        .set_max_row_group_row_count(Some(GROUP));
    for column in columns {
        let path = ColumnPath::new(vec![column.name.clone()]);
        let (indexed, encoding) = match column.what {
            What::Row => (false, Encoding::DELTA_BINARY_PACKED),
            What::Key { axis, .. } if spec.axes[axis].len <= MOST_INDEXED => {
                (true, Encoding::PLAIN)
            }
            What::Model | What::Failure => (true, Encoding::PLAIN),
            What::Key { .. } if matches!(column.values, Some(Values::Texts(_))) => {
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
