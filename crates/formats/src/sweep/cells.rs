//! The values of a column of Parquet while a group of rows is filled.

use contact::{Choice, Model};
use parquet::basic::Type as Physical;
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;

/// The values, without those that are not there, and for each row whether it has one.
#[derive(Debug)]
pub(super) struct Cells {
    kept: Kept,
    there: Vec<i16>,
    words: Vec<ByteArray>,
}

#[derive(Debug)]
enum Kept {
    Whole(Vec<i64>),
    Double(Vec<f64>),
    Single(Vec<f32>),
    Text(Vec<ByteArray>),
}

impl Cells {
    /// None yet; `words` are those that are written by their numbers.
    pub(super) fn new(physical: Physical, words: Vec<ByteArray>) -> Self {
        let kept = match physical {
            Physical::INT64 => Kept::Whole(Vec::new()),
            Physical::FLOAT => Kept::Single(Vec::new()),
            Physical::BYTE_ARRAY => Kept::Text(Vec::new()),
            _ => Kept::Double(Vec::new()),
        };
        Self {
            kept,
            there: Vec::new(),
            words,
        }
    }

    /// How many words there are.
    pub(super) fn words(&self) -> usize {
        self.words.len()
    }

    pub(super) fn whole(&mut self, value: i64) {
        if let Kept::Whole(kept) = &mut self.kept {
            kept.push(value);
            self.there.push(1);
        }
    }

    /// NaN is no value.
    pub(super) fn double(&mut self, value: f64) {
        if let Kept::Double(kept) = &mut self.kept {
            let there = !value.is_nan();
            kept.extend(there.then_some(value));
            self.there.push(i16::from(there));
        }
    }

    /// NaN is no value.
    pub(super) fn single(&mut self, value: f32) {
        if let Kept::Single(kept) = &mut self.kept {
            let there = !value.is_nan();
            kept.extend(there.then_some(value));
            self.there.push(i16::from(there));
        }
    }

    /// A word by its number.
    pub(super) fn word(&mut self, word: Option<usize>) {
        let word = word.and_then(|word| self.words.get(word).cloned());
        self.push(word);
    }

    pub(super) fn text(&mut self, text: Option<&str>) {
        self.push(text.map(ByteArray::from));
    }

    fn push(&mut self, text: Option<ByteArray>) {
        if let Kept::Text(kept) = &mut self.kept {
            self.there.push(i16::from(text.is_some()));
            kept.extend(text);
        }
    }

    /// Writes all of them; there are none afterwards.
    pub(super) fn write(&mut self, writer: &mut ColumnWriter<'_>) -> Result<(), ParquetError> {
        let there = |least: i16| (least > 0).then_some(self.there.as_slice());
        match (&mut self.kept, writer) {
            (Kept::Whole(kept), ColumnWriter::Int64ColumnWriter(writer)) => {
                let there = there(writer.get_descriptor().max_def_level());
                writer.write_batch(kept, there, None)?;
                kept.clear();
            }
            (Kept::Double(kept), ColumnWriter::DoubleColumnWriter(writer)) => {
                let there = there(writer.get_descriptor().max_def_level());
                writer.write_batch(kept, there, None)?;
                kept.clear();
            }
            (Kept::Single(kept), ColumnWriter::FloatColumnWriter(writer)) => {
                let there = there(writer.get_descriptor().max_def_level());
                writer.write_batch(kept, there, None)?;
                kept.clear();
            }
            (Kept::Text(kept), ColumnWriter::ByteArrayColumnWriter(writer)) => {
                let there = there(writer.get_descriptor().max_def_level());
                writer.write_batch(kept, there, None)?;
                kept.clear();
            }
            _ => return Err(ParquetError::General("a column of another type".to_owned())),
        }
        self.there.clear();
        Ok(())
    }
}

/// Words of a key.
pub(super) fn words(texts: &[String]) -> Vec<ByteArray> {
    let texts = texts.iter().map(String::as_str);
    texts.map(ByteArray::from).collect()
}

/// The names of the models, by their indices.
pub(super) fn models() -> Vec<ByteArray> {
    let names = Model::ALL.iter().map(|model| model.name());
    names.map(ByteArray::from).collect()
}
