//! A run of rows with their results.

use super::axis::place;
use super::probed;
use super::spec::Spec;
use super::template::{Scratch, Templates};
use crate::error::SceneError;
use crate::quantities::QUANTITIES;
use contact::{Choice, Collision, Model, Tabulated};
use impact::sweep::{Collided, Observed, collide_rows, observe_rows};

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
    /// Computes the rows from `start` to `end`, of those that `row_of` gives a number in the sweep.
    pub(super) fn compute(
        spec: &Spec,
        templates: &Templates<'_>,
        responses: &Tabulated,
        (start, end): (usize, usize),
        row_of: impl Fn(usize) -> usize + Sync,
    ) -> Self {
        let mut block = Self {
            start,
            ..Self::default()
        };
        if let Some(kernels) = &spec.kernels {
            let of = (responses, &kernels.choice);
            let rows = observe_rows(start..end, of, |row, memory: &mut Memory| {
                place(&spec.axes, row_of(row), &mut memory.place);
                let scene = templates.scene(&memory.place, &mut memory.scratch)?;
                Ok::<_, SceneError>(scene.clone())
            });
            let width = spec.fields.probed.len();
            for (row, done) in (start..).zip(rows) {
                block.push_observed(row, done, width);
            }
            return block;
        }
        let rows = collide_rows(start..end, responses, |row, memory: &mut Memory| {
            place(&spec.axes, row_of(row), &mut memory.place);
            let (target, strike, settings) =
                templates.contact(&memory.place, &mut memory.scratch)?;
            let collision = Collision::new(target, &strike.striker, strike.velocity_m_s);
            Ok::<_, SceneError>((collision, *settings))
        });
        for (row, done) in (start..).zip(rows) {
            block.push(row, done);
        }
        block
    }

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
    pub(super) fn width(&self) -> usize {
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

    /// Adds a block that follows.
    pub(super) fn append(&mut self, mut next: Self) {
        self.numbers.append(&mut next.numbers);
        self.probed.append(&mut next.probed);
        self.models.append(&mut next.models);
        self.failures.append(&mut next.failures);
    }

    /// Adds a row with what the probes bring to it; where its fields alone failed the contact stays.
    fn push_observed(&mut self, row: usize, done: Result<Observed, String>, width: usize) {
        let missing = self.probed.len() + width;
        match done {
            Ok(found) => {
                self.push(row, Ok(found.collided));
                match found.peaks {
                    Ok(peaks) => self.probed.extend(probed::numbers(&peaks)),
                    Err(reason) => self.failures.push((row, reason)),
                }
            }
            Err(reason) => self.push(row, Err(reason)),
        }
        self.probed.resize(missing, f64::NAN);
    }

    fn push(&mut self, row: usize, done: Result<Collided, String>) {
        match done {
            Ok(found) => {
                let numbers = std::array::from_fn(|k| (QUANTITIES[k].of_contact)(&found.results));
                self.numbers.push(numbers);
                let model = Model::ALL.iter().position(|m| *m == found.model);
                self.models.push(model.map_or(NO_MODEL, |i| i as u8));
            }
            Err(reason) => {
                self.numbers.push([f64::NAN; QUANTITIES.len()]);
                self.models.push(NO_MODEL);
                self.failures.push((row, reason));
            }
        }
    }
}

/// What a thread remembers of the row before.
#[derive(Debug, Default)]
struct Memory {
    place: Vec<usize>,
    scratch: Scratch,
}
