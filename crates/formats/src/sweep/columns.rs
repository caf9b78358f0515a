//! The datasets of a file that have a value a row: reserved through the library, filled a block at a time.

use super::axis::Values;
use super::block::Block;
use super::blocks::Blocks;
use super::fields::Precision;
use super::spec::Spec;
use crate::hdf::reserve;
use hdf5::{Dataset, Group};
use output::Fault;
use std::collections::HashMap;
use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

/// What a column holds.
#[derive(Debug, Clone, Copy)]
pub(super) enum What {
    /// The number of the row in the sweep, 64-bit.
    Row,
    /// The value of a key that varies, or where that is a word, its 32-bit index.
    Key {
        /// Rows from one value of the axis to the next.
        stride: usize,
        axis: usize,
        column: usize,
    },
    /// A quantity.
    Number(usize),
    /// The model, 8-bit.
    Model,
    /// The reason of a failure, 32-bit.
    Failure,
}

/// Columns of a file, and where it has them.
#[derive(Debug)]
pub(super) struct Columns<'a> {
    spec: &'a Spec,
    places: Vec<(What, Option<u64>)>,
}

/// Failed rows of a file.
#[derive(Debug, Default)]
pub(super) struct Failures {
    /// How many.
    pub(super) failed: usize,
    /// The distinct reasons, in the order in which they come.
    pub(super) reasons: Vec<String>,
    known: HashMap<String, i32>,
}

impl<'a> Columns<'a> {
    pub(super) fn new(spec: &'a Spec) -> Self {
        let places = Vec::new();
        Self { spec, places }
    }

    /// Makes the dataset of a column.
    pub(super) fn add(
        &mut self,
        what: What,
        group: &Group,
        described: &(&str, &str, &str),
        shape: &[usize],
    ) -> Result<Dataset, hdf5::Error> {
        let (dataset, place) = match what {
            What::Row => reserve::<i64>(group, described, shape)?,
            What::Key { axis, column, .. } => match self.values(axis, column) {
                Values::Numbers(_) | Values::Drawn(_) => reserve::<f64>(group, described, shape)?,
                Values::Texts(_) => reserve::<u32>(group, described, shape)?,
            },
            What::Number(_) => match self.spec.fields.precision {
                Precision::Double => reserve::<f64>(group, described, shape)?,
                Precision::Single => reserve::<f32>(group, described, shape)?,
            },
            What::Model => reserve::<u8>(group, described, shape)?,
            What::Failure => reserve::<i32>(group, described, shape)?,
        };
        self.places.push((what, place));
        Ok(dataset)
    }

    /// Writes all rows into the file at `path`, which the library has open: it writes to other places of it.
    pub(super) fn fill(
        &self,
        path: &Path,
        rows: &Range<usize>,
        blocks: &(impl Blocks + ?Sized),
    ) -> Result<Failures, Fault> {
        let mut file = File::options().write(true).open(path)?;
        let mut failures = Failures::default();
        let mut next = rows.start;
        blocks.each(&mut |block| {
            let end = block.start + block.numbers.len();
            if block.start != next || end > rows.end {
                return Err(Fault::from(format!("row {next} is not there")));
            }
            let failed = failures.of(block);
            for (what, place) in &self.places {
                let Some(place) = place else { continue };
                let (bytes, width) = self.bytes(*what, block, &failed)?;
                let before = (block.start - rows.start) * width;
                file.seek(SeekFrom::Start(place + before as u64))?;
                file.write_all(&bytes)?;
            }
            next = end;
            Ok(())
        })?;
        if next != rows.end {
            return Err(Fault::from(format!("row {next} is not there")));
        }
        Ok(failures)
    }

    fn values(&self, axis: usize, column: usize) -> &'a Values {
        &self.spec.axes[axis].columns[column].values
    }

    /// The bytes of a column's rows, and of one of them.
    fn bytes(&self, what: What, block: &Block, failed: &[i32]) -> Result<(Vec<u8>, usize), Fault> {
        let rows = block.start..block.start + block.numbers.len();
        Ok(match what {
            What::Row => (rows.flat_map(|row| (row as i64).to_ne_bytes()).collect(), 8),
            What::Key {
                stride,
                axis,
                column,
            } => {
                let len = self.spec.axes[axis].len;
                let places = rows.map(|row| row / stride % len);
                match self.values(axis, column) {
                    Values::Numbers(numbers) => {
                        (places.flat_map(|i| numbers[i].to_ne_bytes()).collect(), 8)
                    }
                    Values::Drawn(drawn) => {
                        (places.flat_map(|i| drawn.at(i).to_ne_bytes()).collect(), 8)
                    }
                    Values::Texts(_) => {
                        (places.flat_map(|i| (i as u32).to_ne_bytes()).collect(), 4)
                    }
                }
            }
            What::Number(k) => {
                let width = self.spec.fields.width();
                let mut bytes = Vec::with_capacity(width * block.numbers.len());
                for (place, row) in rows.enumerate() {
                    let number = block.number(place, k);
                    match self.spec.fields.precision {
                        Precision::Double => bytes.extend(number.to_ne_bytes()),
                        Precision::Single => {
                            let name = self.spec.fields.named(k).name;
                            bytes.extend(single(number, row, name)?.to_ne_bytes());
                        }
                    }
                }
                (bytes, width)
            }
            What::Model => (block.models.clone(), 1),
            What::Failure => (failed.iter().flat_map(|i| i.to_ne_bytes()).collect(), 4),
        })
    }
}

/// A number in single precision, where it has one.
pub(super) fn single(number: f64, row: usize, name: &str) -> Result<f32, Fault> {
    let rounded = number as f32;
    if rounded.is_infinite() && number.is_finite() {
        return Err(Fault::from(format!(
            "{name} = {number} in row {row} is outside [-3.4e38, 3.4e38] of single precision"
        )));
    }
    Ok(rounded)
}

impl Failures {
    /// Index of the reason of each row, -1 without one.
    fn of(&mut self, block: &Block) -> Vec<i32> {
        let mut indices = vec![-1; block.numbers.len()];
        for (row, reason) in &block.failures {
            let next = self.reasons.len() as i32;
            let index = match self.known.get(reason) {
                Some(&index) => index,
                None => {
                    self.known.insert(reason.clone(), next);
                    self.reasons.push(reason.clone());
                    next
                }
            };
            indices[row - block.start] = index;
        }
        self.failed += block.failures.len();
        indices
    }
}
