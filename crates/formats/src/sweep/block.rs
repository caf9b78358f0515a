//! A run of rows with their results.

use super::axis::place;
use super::spec::Spec;
use super::template::{Scratch, Templates};
use crate::error::SceneError;
use crate::quantities::QUANTITIES;
use contact::{Choice, Collision, Model, Tabulated};
use impact::sweep::{Collided, collide_rows};

/// Results of consecutive rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Block {
    /// First row.
    pub start: usize,
    /// Results in the order of [`QUANTITIES`], NaN for a failed scene.
    pub numbers: Vec<[f64; QUANTITIES.len()]>,
    /// Model of each row as an index into the list of models.
    pub models: Vec<u8>,
    /// Failed rows and why.
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
        let rows = collide_rows(start..end, responses, |row, memory: &mut Memory| {
            place(&spec.axes, row_of(row), &mut memory.place);
            let (target, strike, settings) = templates.scene(&memory.place, &mut memory.scratch)?;
            let collision = Collision::new(target, &strike.striker, strike.velocity_m_s);
            Ok::<_, SceneError>((collision, *settings))
        });
        let mut block = Self {
            start,
            ..Self::default()
        };
        for (row, done) in (start..).zip(rows) {
            block.push(row, done);
        }
        block
    }

    /// Whether it can have been computed: known models, and a reason within the block for each scene that failed.
    pub(crate) fn holds(&self) -> bool {
        let rows = self.start..self.start + self.numbers.len();
        let failed = |model: &u8| *model == NO_MODEL;
        let known = |model: &u8| usize::from(*model) < Model::ALL.len() || failed(model);
        self.models.iter().all(known)
            && self.models.iter().filter(|m| failed(m)).count() == self.failures.len()
            && self.failures.iter().all(|(row, _)| rows.contains(row))
            && self.failures.is_sorted_by(|a, b| a.0 < b.0)
    }

    /// Adds a block that follows.
    pub(super) fn append(&mut self, mut next: Self) {
        self.numbers.append(&mut next.numbers);
        self.models.append(&mut next.models);
        self.failures.append(&mut next.failures);
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
