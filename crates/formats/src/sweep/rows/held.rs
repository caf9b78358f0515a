//! Rows that are held in memory together, by result.

use super::block::{Block, Blocks, NO_MODEL};
use crate::sweep::shard::BLOCK;
use output::OutputFault;
use rayon::prelude::*;

/// Some results of rows, counted from 0.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Held {
    /// Number of results per row of the sweep.
    pub width: usize,
    /// Indices of the held results.
    pub places: Vec<usize>,
    /// All rows of the first result, then of the second, and so on; NaN for failed rows.
    pub numbers: Vec<f64>,
    /// Model of each row, as in [`Block`].
    pub models: Vec<u8>,
    /// Rows that failed, ascending, and the reasons.
    pub failures: Vec<(usize, String)>,
}

impl Held {
    /// `rows` rows without results.
    pub(crate) fn blank(rows: usize, width: usize, places: Vec<usize>) -> Self {
        Self {
            width,
            numbers: vec![f64::NAN; rows * places.len()],
            places,
            models: vec![NO_MODEL; rows],
            failures: Vec::new(),
        }
    }

    /// Copies the rows of a block to their places.
    pub(crate) fn put(&mut self, block: &Block) {
        let rows = block.range();
        let columns = self.numbers.par_chunks_exact_mut(self.models.len().max(1));
        columns.zip(&self.places).for_each(|(column, &place)| {
            for (number, row) in column[rows.clone()].iter_mut().zip(block.rows()) {
                *number = row[place];
            }
        });
        self.models[rows].copy_from_slice(&block.models);
        self.failures.extend_from_slice(&block.failures);
    }
}

impl Blocks for Held {
    fn each(
        &self,
        visit: &mut dyn FnMut(&Block) -> Result<(), OutputFault>,
    ) -> Result<(), OutputFault> {
        let all = self.models.len();
        for start in (0..all).step_by(BLOCK) {
            let rows = start..(start + BLOCK).min(all);
            let mut block = Block::blank(start, rows.len(), self.width);
            let columns = self.numbers.chunks_exact(all);
            for (&place, column) in self.places.iter().zip(columns) {
                block.fill(place, column[rows.clone()].iter().copied());
            }
            block.models.copy_from_slice(&self.models[rows.clone()]);
            let failed = self.failures.iter();
            let failed = failed.filter(|(row, _)| rows.contains(row));
            block.failures = failed.cloned().collect();
            visit(&block)?;
        }
        Ok(())
    }
}
