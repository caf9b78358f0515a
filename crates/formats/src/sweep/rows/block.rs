//! A run of rows with their results.

use crate::quantities::QUANTITIES;
use contact::{Choice, Model};
use output::Fault;

/// Consecutive rows, of which no more than a block needs to be in memory.
pub trait Blocks {
    /// Shows the blocks in the order of their rows; ends with the first reason to stop.
    ///
    /// # Errors
    /// That of `visit`, or why a block cannot be read.
    fn each(&self, visit: &mut dyn FnMut(&Block) -> Result<(), Fault>) -> Result<(), Fault>;
}

impl<T: AsRef<[Block]> + ?Sized> Blocks for T {
    fn each(&self, visit: &mut dyn FnMut(&Block) -> Result<(), Fault>) -> Result<(), Fault> {
        self.as_ref().iter().try_for_each(visit)
    }
}

/// Results of consecutive rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Block {
    /// First row.
    pub start: usize,
    /// Results in the order of [`QUANTITIES`], NaN for a failed scene.
    pub numbers: Vec<[f64; QUANTITIES.len()]>,
    /// What the probes bring to each row, one row behind the other, NaN where fields failed; empty without probes.
    pub probed: Vec<f64>,
    /// Model of each row as an index into the list of models.
    pub models: Vec<u8>,
    /// Rows that failed, or whose fields did, and why.
    pub failures: Vec<(usize, String)>,
}

/// The model of a failed scene.
pub const NO_MODEL: u8 = u8::MAX;

impl Block {
    /// Rows without results, to be filled, with so many that probes bring.
    pub(crate) fn blank(start: usize, rows: usize, width: usize) -> Self {
        Self {
            start,
            numbers: vec![[f64::NAN; QUANTITIES.len()]; rows],
            probed: vec![f64::NAN; width * rows],
            ..Self::default()
        }
    }

    /// Fills a result of a row.
    pub(crate) fn set(&mut self, row: usize, place: usize, number: f64) {
        let width = self.width();
        match place.checked_sub(QUANTITIES.len()) {
            None => self.numbers[row][place] = number,
            Some(place) => self.probed[row * width + place] = number,
        }
    }

    /// A result of a row of it: one of [`QUANTITIES`], or behind them one of what probes bring.
    pub(crate) fn number(&self, row: usize, place: usize) -> f64 {
        match place.checked_sub(QUANTITIES.len()) {
            None => self.numbers[row][place],
            Some(place) => self.probed[row * self.width() + place],
        }
    }

    /// Rows whose fields were looked up in a table.
    #[must_use]
    pub fn looked_up(&self) -> usize {
        let rows = self.probed.chunks_exact(self.width().max(1));
        rows.filter(|row| row[0] == 1.0).count()
    }

    /// Results that probes bring to a row.
    pub(crate) fn width(&self) -> usize {
        self.probed.len() / self.numbers.len().max(1)
    }

    /// Whether it can have been computed: known models, and a reason within the block for each scene that failed.
    pub(crate) fn holds(&self) -> bool {
        let rows = self.start..self.start + self.numbers.len();
        let failed = |model: &u8| *model == NO_MODEL;
        let known = |model: &u8| usize::from(*model) < Model::ALL.len() || failed(model);
        self.models.iter().all(known)
            && self.failures.iter().all(|(row, _)| rows.contains(row))
            && self.failures.is_sorted_by(|a, b| a.0 < b.0)
            && self.probed.len() == self.width() * self.numbers.len()
            && self.has_reasons(failed)
    }

    /// Whether each failed contact has a reason, and nothing else but fields.
    fn has_reasons(&self, failed: impl Fn(&u8) -> bool) -> bool {
        let count = self.models.iter().filter(|m| failed(m)).count();
        let of_contacts = self
            .failures
            .iter()
            .filter(|(row, _)| failed(&self.models[row - self.start]));
        let of_contacts = of_contacts.count();
        count == of_contacts && (of_contacts == self.failures.len() || !self.probed.is_empty())
    }
}
