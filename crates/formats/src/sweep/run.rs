//! Computes the rows of a sweep, block by block.

use super::error::SweepError;
use super::fields::probed_numbers;
use super::journal::Kept;
use super::kernels::Kernels;
use super::rows::{Block, Blocks, Held, NO_MODEL};
use super::shard::BLOCK;
use super::spec::Spec;
use super::template::{Memory, Templates};
use crate::error::SceneError;
use crate::quantities::QUANTITIES;
use contact::{Choice, Model, Outcomes, Solver, Tabulated};
use fault::AnyError;
use impact::sweep::{Observed, collide, observe, outcomes};
use ledger::gaps;
use output::{Existing, OutputFault};
use rayon::prelude::*;
use std::ops::Range;
use std::path::Path;
use std::time::Instant;

/// Rows of the first block of a run without probes; the size of later blocks follows from [`BLOCK_S`].
const FIRST_BLOCK: usize = 64;

/// Target time of a block in s, which is lost if the run is killed.
const BLOCK_S: f64 = 2.0;

/// Largest number of rows that one thread computes at a time.
const GRAIN: usize = 256;
/// Smallest number of portions per thread, if there are enough rows, so that no thread waits long for the last one.
const PORTIONS: usize = 4;

/// Computes the selected rows that the journal at `part` does not contain yet; only one block is in memory.
///
/// `existing` decides whether rows of another sweep are replaced. `watch` is called after each block with the number of
/// completed rows; if it returns false, nothing is returned and the journal keeps the completed rows.
/// Results do not depend on the division of rows into ranges and blocks.
///
/// # Errors
/// [`SweepError`].
pub fn run_rows(
    spec: &Spec,
    part: &Path,
    existing: Existing,
    mut watch: impl FnMut(usize) -> bool,
) -> Result<Option<Kept>, SweepError> {
    let (computer, rows) = (Computer::new(spec)?, spec.selected());
    let mut kept = Kept::open(part, spec, existing == Existing::Replace)?;
    let mut done = kept.resumed;
    if !watch(done) {
        return Ok(None);
    }
    let (mut block, mut size) = (Block::default(), computer.first_block());
    let held: Vec<_> = kept.spans.iter().map(|(rows, _)| rows.clone()).collect();
    for gap in gaps(&held, &rows) {
        let mut start = gap.start;
        while start < gap.end {
            let end = (start + size).min(gap.end);
            block.make_room(start, end - start, spec.fields.width());
            size = computer.fill(&mut block, start..end, BLOCK_S, |row| row)?;
            kept.add(&block)?;
            done += block.len();
            if !watch(done) && done < rows.len() {
                return Ok(None);
            }
            start = end;
        }
    }
    kept.spans.sort_by_key(|(rows, _)| rows.start);
    Ok(Some(kept))
}

/// Shared data for computing rows.
#[derive(Debug)]
struct Computer<'a> {
    spec: &'a Spec,
    templates: Templates<'a>,
    responses: Tabulated,
    outcomes: Outcomes,
}

impl<'a> Computer<'a> {
    fn new(spec: &'a Spec) -> Result<Self, SceneError> {
        let templates = Templates::new(spec)?;
        let responses = match spec.has_many_ratios() {
            true => Tabulated::on_lattice(),
            false => Tabulated::default(),
        };
        let row = |row, memory: &mut Memory| templates.contact(row, memory);
        let outcomes = match spec.kernels {
            Some(_) => Outcomes::default(),
            None => outcomes(spec.rows(), &responses, row),
        };
        Ok(Self {
            spec,
            templates,
            responses,
            outcomes,
        })
    }

    /// Rows of a first block: with probes a row may take seconds.
    fn first_block(&self) -> usize {
        match self.spec.kernels {
            Some(_) => rayon::current_num_threads(),
            None => FIRST_BLOCK,
        }
    }

    /// Fills the rows of a range in a block with the results of `row_of`, which receives the number of the row in the
    /// sweep; returns the size of the next block for a target time.
    fn fill(
        &self,
        block: &mut Block,
        rows: Range<usize>,
        wanted_s: f64,
        row_of: impl Fn(usize) -> usize + Sync,
    ) -> Result<usize, SceneError> {
        let began = Instant::now();
        let grain = (rows.len() / (PORTIONS * rayon::current_num_threads())).clamp(1, GRAIN);
        let (from, to) = (rows.start - block.start, rows.end - block.start);
        let numbers = &mut block.numbers[from * block.width..to * block.width];
        let models = block.models[from..to].par_chunks_mut(grain);
        let portions = numbers.par_chunks_mut(grain * block.width).zip(models);
        let failures: Vec<_> = (portions.enumerate())
            .map(|(i, of)| self.portion(rows.start + i * grain, of, &row_of))
            .collect();
        block.failures.extend(failures.into_iter().flatten());
        self.spec.kernels.as_ref().map_or(Ok(()), Kernels::check)?;
        let took_s = began.elapsed().as_secs_f64();
        Ok(next_size(rows.len(), took_s, wanted_s))
    }

    /// Fills the numbers and models of consecutive rows; returns the failed ones.
    fn portion(
        &self,
        start: usize,
        (numbers, models): (&mut [f64], &mut [u8]),
        row_of: impl Fn(usize) -> usize,
    ) -> Vec<(usize, String)> {
        let mut solver = Solver::sharing(&self.responses, &self.outcomes);
        let (mut memory, mut failures) = (Memory::default(), Vec::new());
        let each = numbers.chunks_exact_mut(self.spec.fields.width());
        for (row, (numbers, model)) in (start..).zip(each.zip(models)) {
            numbers.fill(f64::NAN);
            *model = NO_MODEL;
            let filled = self
                .observed(row_of(row), &mut solver, &mut memory)
                .and_then(|found| fill_row(numbers, model, found));
            failures.extend(filled.err().map(|reason| (row, reason.to_string())));
        }
        failures
    }

    fn observed(
        &self,
        row: usize,
        solver: &mut Solver<'_, Tabulated>,
        memory: &mut Memory,
    ) -> Result<Observed, AnyError> {
        if let Some(kernels) = &self.spec.kernels {
            let scene = self.templates.scene(row, memory)?;
            return Ok(observe(solver, scene, &kernels.choice)?);
        }
        let (collision, settings) = self.templates.contact(row, memory)?;
        Ok(collide(solver, &collision, &settings)?)
    }
}

/// Fills the numbers and the model of a row. If only the fields at the probes failed, the contact is kept.
fn fill_row(numbers: &mut [f64], model: &mut u8, found: Observed) -> Result<(), AnyError> {
    let (of_contact, of_probes) = numbers.split_at_mut(QUANTITIES.len());
    for (number, quantity) in of_contact.iter_mut().zip(QUANTITIES) {
        *number = (quantity.of_contact)(&found.results);
    }
    let index = Model::ALL.iter().position(|m| *m == found.model);
    *model = index.map_or(NO_MODEL, |index| index as u8);
    if let Some(peaks) = found.peaks.transpose()? {
        for (number, found) in of_probes.iter_mut().zip(probed_numbers(&peaks)) {
            *number = found;
        }
    }
    Ok(())
}

/// The selected rows of a sweep, computed when they are visited.
#[derive(Debug)]
pub struct Computed<'a>(Computer<'a>);

impl<'a> Computed<'a> {
    /// Reads the data that all rows share.
    ///
    /// # Errors
    /// [`SceneError`] of the sweep.
    pub fn new(spec: &'a Spec) -> Result<Self, SceneError> {
        Computer::new(spec).map(Self)
    }
}

impl Blocks for Computed<'_> {
    fn each(
        &self,
        visit: &mut dyn FnMut(&Block) -> Result<(), OutputFault>,
    ) -> Result<(), OutputFault> {
        let computer = &self.0;
        let (mut block, mut size) = (Block::default(), computer.first_block());
        let Range { mut start, end } = computer.spec.selected();
        while start < end {
            let until = (start + size).min(end);
            block.make_room(start, until - start, computer.spec.fields.width());
            let filled = computer.fill(&mut block, start..until, BLOCK_S, |row| row);
            size = filled.map_err(|error| OutputFault::from(error.to_string()))?;
            visit(&block)?;
            start = until;
        }
        Ok(())
    }
}

/// Largest number of rows whose fields are forecast before a run.
const FORECAST: usize = 64;

/// Forecast of the memory in bytes for the fields at probes while rows are computed on all threads: the largest of some
/// rows that are spread over the selected ones; 0 without probes.
///
/// # Errors
/// [`SceneError`] of the sweep.
pub fn fields_bytes(spec: &Spec) -> Result<f64, SceneError> {
    if spec.kernels.is_none() {
        return Ok(0.0);
    }
    let (computer, rows) = (Computer::new(spec)?, spec.selected());
    let mut solver = Solver::sharing(&computer.responses, &computer.outcomes);
    let (mut memory, mut most) = (Memory::default(), 0.0_f64);
    for row in rows.clone().step_by(rows.len().div_ceil(FORECAST).max(1)) {
        if let Ok(scene) = computer.templates.scene(row, &mut memory) {
            most = most.max(impact::sweep::fields_bytes(&mut solver, scene).unwrap_or(0.0));
        }
    }
    Ok(most * rayon::current_num_threads().min(rows.len()) as f64)
}

/// Largest number of rows that are held in memory together, with eight bytes per number.
const MOST_AT_ONCE: usize = 10_000_000;

/// Approximate time in s between two calls of the watch of [`compute_rows`].
const WATCH_S: f64 = 0.1;

/// Checks that `count` rows can be held in memory together.
///
/// # Errors
/// [`SceneError`].
pub fn check_at_once(count: usize) -> Result<(), SceneError> {
    if count > MOST_AT_ONCE {
        let (key, range) = ("the number of rows in memory", "[0, 10000000]");
        return Err(SceneError::out_of_range(key, count as f64, range));
    }
    Ok(())
}

/// Computes `count` rows from `start` on, every `step`-th, without a journal; bit-identical to the rows of the whole
/// sweep.
///
/// Rows of the block and of its failures are numbered from the first computed row. `watch` receives the number of
/// completed and of failed rows; if it returns false, nothing is returned.
///
/// # Errors
/// [`SceneError`] of the sweep, or if it does not have these rows.
pub fn compute_rows(
    spec: &Spec,
    start: usize,
    step: usize,
    count: usize,
    mut watch: impl FnMut(usize, usize) -> bool,
) -> Result<Option<Block>, SceneError> {
    let mut all = Block::blank(0, 0, spec.fields.width());
    let done = each_block(spec, [start, step, count], |block| {
        all.numbers.extend_from_slice(&block.numbers);
        all.models.extend_from_slice(&block.models);
        all.failures.extend_from_slice(&block.failures);
        watch(all.len(), all.failures.len())
    })?;
    Ok(done.then_some(all))
}

/// Computes some results only, in the order of results.
///
/// # Errors
/// As [`compute_rows`].
pub fn compute_columns(
    spec: &Spec,
    start: usize,
    step: usize,
    count: usize,
    places: Vec<usize>,
    mut watch: impl FnMut(usize, usize) -> bool,
) -> Result<Option<Held>, SceneError> {
    check_at_once(count)?;
    let mut held = Held::blank(count, spec.fields.width(), places);
    let done = each_block(spec, [start, step, count], |block| {
        held.put(block);
        watch(block.start + block.len(), held.failures.len())
    })?;
    Ok(done.then_some(held))
}

/// Visits computed rows, some at a time; returns whether `visit` accepted all.
fn each_block(
    spec: &Spec,
    [start, step, count]: [usize; 3],
    mut visit: impl FnMut(&Block) -> bool,
) -> Result<bool, SceneError> {
    check_at_once(count)?;
    let last = step.checked_mul(count.saturating_sub(1));
    let last = last.and_then(|way| way.checked_add(start));
    if count > 0 && last.is_none_or(|last| last >= spec.rows()) {
        return Err(SceneError::out_of_range(
            "the last row",
            last.map_or(f64::INFINITY, |last| last as f64),
            "the rows of the sweep, counted from 0",
        ));
    }
    let computer = Computer::new(spec)?;
    let row_of = |index: usize| start + index * step;
    let (mut block, mut done, mut size) = (Block::default(), 0, computer.first_block());
    while done < count {
        let end = (done + size).min(count);
        block.make_room(done, end - done, spec.fields.width());
        size = computer.fill(&mut block, done..end, WATCH_S, row_of)?;
        done = end;
        if !visit(&block) && done < count {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Rows of the next block, after a block of `count` rows that took `took_s`: at most eight times as many.
fn next_size(count: usize, took_s: f64, wanted_s: f64) -> usize {
    let factor = (wanted_s / took_s.max(1e-6)).min(8.0);
    ((count as f64 * factor) as usize).clamp(1, BLOCK)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_last_as_long_as_they_should() {
        // a row of 1 ms, after a first block of 64 of them
        let (mut size, mut longest) = (FIRST_BLOCK, 0.0_f64);
        for _ in 0..10 {
            let took_s = size as f64 * 1e-3;
            longest = longest.max(took_s);
            size = next_size(size, took_s, BLOCK_S);
        }
        assert_eq!((size, longest <= BLOCK_S), (2000, true));
        assert_eq!(next_size(64, 640.0, BLOCK_S), 1);
        assert_eq!(next_size(BLOCK, 1e-3, BLOCK_S), BLOCK);
    }
}
