//! Consecutive rows with their results.

use crate::quantities::QUANTITIES;
use contact::{Choice, Model};
use output::OutputFault;
use std::ops::Range;

/// Source of consecutive rows that holds only one block in memory.
pub trait Blocks {
    /// Visits the blocks in the order of their rows; stops at the first error.
    ///
    /// # Errors
    /// An error of `visit`, or a block that cannot be read.
    fn each(
        &self,
        visit: &mut dyn FnMut(&Block) -> Result<(), OutputFault>,
    ) -> Result<(), OutputFault>;
}

impl<T: AsRef<[Block]> + ?Sized> Blocks for T {
    fn each(
        &self,
        visit: &mut dyn FnMut(&Block) -> Result<(), OutputFault>,
    ) -> Result<(), OutputFault> {
        self.as_ref().iter().try_for_each(visit)
    }
}

/// Message about a block that cannot have been computed.
pub(crate) const NOT_HELD: &str = "it has unknown models or failures without reasons";

/// Results of consecutive rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Block {
    /// First row.
    pub start: usize,
    /// Numbers per row: those of [`QUANTITIES`], followed by those of the probes.
    pub width: usize,
    /// All numbers, row by row; NaN if a scene or its fields failed.
    pub numbers: Vec<f64>,
    /// Model of each row as an index into the list of models.
    pub models: Vec<u8>,
    /// Rows that failed, or whose fields failed, and the reasons.
    pub failures: Vec<(usize, String)>,
}

/// The model of a failed scene.
pub const NO_MODEL: u8 = u8::MAX;

impl Block {
    /// Rows without results, to be filled.
    pub(crate) fn blank(start: usize, rows: usize, width: usize) -> Self {
        let mut block = Self::default();
        block.make_room(start, rows, width);
        block
    }

    /// Resizes the block for rows; the numbers keep arbitrary old values.
    pub(crate) fn make_room(&mut self, start: usize, rows: usize, width: usize) {
        (self.start, self.width) = (start, width);
        self.numbers.resize(width * rows, f64::NAN);
        self.models.resize(rows, NO_MODEL);
        self.failures.clear();
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.models.len()
    }

    /// Whether the block is empty.
    pub fn is_empty(&self) -> bool {
        self.models.is_empty()
    }

    /// The rows, by their numbers in the sweep.
    pub(crate) fn range(&self) -> Range<usize> {
        self.start..self.start + self.len()
    }

    /// The numbers of each row.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.numbers.chunks_exact(self.width.max(1))
    }

    /// Fills a result in all rows.
    pub(crate) fn fill(&mut self, place: usize, numbers: impl IntoIterator<Item = f64>) {
        let rows = self.numbers.chunks_exact_mut(self.width.max(1));
        for (row, number) in rows.zip(numbers) {
            row[place] = number;
        }
    }

    /// The failures of some rows, counted from the first.
    pub(super) fn failures_of(&self, some: &Range<usize>) -> &[(usize, String)] {
        let before = |end: usize| {
            self.failures
                .partition_point(|(row, _)| *row < self.start + end)
        };
        &self.failures[before(some.start)..before(some.end)]
    }

    /// Appends some rows of another block, counted from its first; they follow the existing rows.
    #[cfg(feature = "parquet")]
    pub(super) fn extend(&mut self, other: &Self, some: Range<usize>) {
        if self.is_empty() {
            (self.start, self.width) = (other.start + some.start, other.width);
        }
        let numbers = some.start * other.width..some.end * other.width;
        self.numbers.extend_from_slice(&other.numbers[numbers]);
        self.models.extend_from_slice(&other.models[some.clone()]);
        self.failures.extend_from_slice(other.failures_of(&some));
    }

    /// Rows whose fields were looked up in a table.
    pub fn looked_up(&self) -> usize {
        let first_of_probes = |row: &&[f64]| row.get(QUANTITIES.len()) == Some(&1.0);
        self.rows().filter(first_of_probes).count()
    }

    /// Whether the block can have been computed: known models, and a reason within the block for each failed scene.
    pub(crate) fn holds(&self) -> bool {
        let rows = self.range();
        let failed = |model: &u8| *model == NO_MODEL;
        let known = |model: &u8| usize::from(*model) < Model::ALL.len() || failed(model);
        self.models.iter().all(known)
            && self.failures.iter().all(|(row, _)| rows.contains(row))
            && self.failures.is_sorted_by(|a, b| a.0 < b.0)
            && self.numbers.len() == self.width * self.len()
            && {
                // each failed contact has a reason; other reasons concern fields only
                let count = self.models.iter().filter(|m| failed(m)).count();
                let of_contact = |row: usize| failed(&self.models[row - self.start]);
                let reasons = self.failures.iter();
                count == reasons.filter(|(row, _)| of_contact(*row)).count()
                    && (count == self.failures.len() || self.width > QUANTITIES.len())
            }
    }
}
