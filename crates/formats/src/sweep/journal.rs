//! The journal of a sweep: one record per block of rows.
//!
//! A block begins with integers of eight bytes: first row, number of rows, a bit mask of its results, number of probe
//! columns, and length of the text of failures. The numbers, the probe numbers, the models and the failures follow. It
//! contains the results that are written and those that are counted. Rows kept without one of them are computed again.

use super::fields::WrittenResults;
use super::rows::{Block, Blocks};
use super::shard::BLOCK;
use super::spec::Spec;
use crate::quantities::QUANTITIES;
use crate::schema::sweep::COUNTED;
use ledger::Identity;
use output::{Journal, OutputError, OutputFault, Record, Records, Title, packed, unpacked};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Kind of work in the journal's title.
const KIND: &str = "sweep";

/// The title of the journal for the selected rows of a sweep.
fn title(spec: &Spec) -> Title {
    let (sha256, of, rows) = (&spec.sha256, spec.rows(), spec.selected());
    let about = format!("{sha256} {of} {} {}", rows.start, rows.end);
    Title {
        kind: KIND,
        identity: Identity::default().with("rows", &about).hex(),
        about,
    }
}

/// Computed rows of a sweep, kept in their journal.
#[derive(Debug)]
pub struct Kept {
    /// Blocks in the order of their rows.
    pub(super) spans: Vec<(Range<usize>, Record)>,
    /// Rows that an earlier run had computed.
    pub resumed: usize,
    journal: Journal,
    /// Bit mask of the contact results that it contains.
    results: u64,
}

impl Kept {
    /// Opens or begins a journal; with `drops` a journal of other rows is replaced.
    pub(super) fn open(path: &Path, spec: &Spec, drops: bool) -> Result<Self, OutputError> {
        let (rows, results, mut spans) = (spec.selected(), results(&spec.fields), Vec::new());
        if !drops && lacks(path, spec, results)? {
            return Err(OutputError::Begun(path.to_owned(), KIND));
        }
        let take = |record, kept: &[u8]| take(&mut spans, &rows, results, record, kept);
        let journal = Journal::open(path, &title(spec), |_| drops, take)?;
        Ok(Self {
            resumed: apart(&mut spans),
            spans,
            journal,
            results,
        })
    }

    /// Adds a block.
    pub(super) fn add(&mut self, block: &Block) -> Result<(), OutputError> {
        let record = self.journal.append(&kept(block, self.results))?;
        self.spans.push((block.range(), record));
        Ok(())
    }

    /// Removes the journal, once the results are written.
    pub fn remove(self) {
        self.journal.remove();
    }
}

impl Blocks for Kept {
    fn each(
        &self,
        visit: &mut dyn FnMut(&Block) -> Result<(), OutputFault>,
    ) -> Result<(), OutputFault> {
        let mut kept = Vec::new();
        for (_, record) in &self.spans {
            self.journal.read(*record, &mut kept)?;
            let changed =
                || OutputFault::from("its journal was changed while it was read".to_owned());
            let (block, _) = parsed(&kept).ok_or_else(changed)?;
            visit(&block)?;
        }
        Ok(())
    }
}

/// A run that was interrupted or is in progress, as its journal describes it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unfinished {
    /// The journal.
    pub path: PathBuf,
    /// SHA-256 that identifies the sweep.
    pub sha256: String,
    /// Number of rows of the sweep.
    pub sweep_rows: usize,
    /// Rows that the run computes.
    pub rows: Range<usize>,
    /// Number of rows that are computed.
    pub kept: usize,
}

impl Unfinished {
    /// Reads a journal without changing it; none if the file is not a journal.
    pub fn read(path: &Path) -> Option<Self> {
        let mut records = Records::open(path, KIND).ok()??;
        let mut words = records.title.about.split(' ');
        let sha256 = words.next()?.to_owned();
        let mut count = || words.next()?.parse::<usize>().ok();
        let (sweep_rows, rows) = (count()?, count()?..count()?);
        let mut spans = Vec::new();
        records.all(|(record, kept)| take(&mut spans, &rows, 0, record, &kept));
        Some(Self {
            path: path.to_owned(),
            sha256,
            sweep_rows,
            rows,
            kept: apart(&mut spans),
        })
    }
}

/// Whether a journal keeps selected rows without some of these results.
fn lacks(path: &Path, spec: &Spec, results: u64) -> Result<bool, OutputError> {
    if !path.exists() {
        return Ok(false);
    }
    let Some(mut records) = Records::open(path, KIND)? else {
        return Ok(false);
    };
    let own = records.title == title(spec);
    let held = |(_, kept): (_, Vec<u8>)| parsed(&kept).map(|(_, held)| held);
    Ok(own
        && records
            .by_ref()
            .map_while(held)
            .any(|held| held & results != results))
}

/// Whether the journal at `part` has all selected rows, so that a run may have begun to write its outputs.
pub fn is_computed(spec: &Spec, part: &Path) -> bool {
    let rows = spec.selected();
    Unfinished::read(part).is_some_and(|found| {
        found.sha256 == spec.sha256 && found.rows == rows && found.kept == rows.len()
    })
}

/// Adds the rows of a record, if they can be rows of the range with these results.
fn take(
    spans: &mut Vec<(Range<usize>, Record)>,
    wanted: &Range<usize>,
    results: u64,
    record: Record,
    kept: &[u8],
) -> bool {
    let block = parsed(kept).filter(|(_, held)| held & results == results);
    let rows = block.map(|(block, _)| block.range());
    let rows = rows.filter(|rows| wanted.start <= rows.start && rows.end <= wanted.end);
    spans.extend(rows.clone().map(|rows| (rows, record)));
    rows.is_some()
}

/// Removes duplicate rows and sorts the rest; returns the number of rows.
fn apart(spans: &mut Vec<(Range<usize>, Record)>) -> usize {
    spans.sort_by_key(|(rows, _)| rows.start);
    let mut end = 0;
    spans.retain(|(rows, _)| {
        let apart = rows.start >= end;
        end = end.max(rows.end);
        apart
    });
    spans.iter().map(|(rows, _)| rows.len()).sum()
}

/// Bit mask of the contact results that are kept: those that are written or counted.
pub(super) fn results(fields: &WrittenResults) -> u64 {
    let written = |place: &usize| fields.places.contains(place);
    let counted = |place: &usize| COUNTED.contains(&QUANTITIES[*place].name);
    let places = (0..QUANTITIES.len()).filter(|place| written(place) || counted(place));
    places.fold(0, |kept, place| kept | 1 << place)
}

/// Indices of the numbers of a row that its file requires, which the journal keeps.
pub fn kept_places(spec: &Spec) -> Vec<usize> {
    places(results(&spec.fields), spec.fields.width())
}

/// Indices of the kept numbers of a row: the contact results of a mask, and all probe columns.
fn places(results: u64, width: usize) -> Vec<usize> {
    let is_kept = |place: &usize| *place >= QUANTITIES.len() || results >> place & 1 == 1;
    (0..width).filter(is_kept).collect()
}

/// The record of a block with these results.
fn kept(block: &Block, results: u64) -> Vec<u8> {
    let failures = block.failures.iter();
    let text: String = failures
        .map(|(row, reason)| format!("{row} {}\n", reason.replace('\n', " ")))
        .collect();
    let (rows, places) = (block.len(), places(results, block.width));
    let probed = block.width - QUANTITIES.len();
    let numbers = rows * places.len();
    let mut bytes = packed([block.start, rows, results as usize, probed, text.len()]);
    bytes.reserve(8 * numbers + rows + text.len());
    for row in block.rows() {
        for &place in &places {
            bytes.extend(row[place].to_le_bytes());
        }
    }
    bytes.extend(&block.models);
    bytes.extend(text.as_bytes());
    bytes
}

/// A block that can have been computed, with NaN for results that were not kept, and the bit mask of its results.
fn parsed(kept: &[u8]) -> Option<(Block, u64)> {
    let ([start, rows, results, probed, text], rest) = unpacked(kept)?;
    let results = results as u64;
    start
        .checked_add(rows)
        .filter(|_| (1..=BLOCK).contains(&rows) && probed <= rest.len())?;
    let places = places(results, QUANTITIES.len() + probed);
    let (numbers, rest) = rest.split_at_checked(8 * rows.checked_mul(places.len())?)?;
    let (models, failures) = rest.split_at_checked(rows)?;
    if results >> QUANTITIES.len() != 0 || failures.len() != text {
        return None;
    }
    let failures = std::str::from_utf8(failures).ok()?;
    let failures = failures.lines().map(|line| {
        let (row, reason) = line.split_once(' ')?;
        Some((row.parse().ok()?, reason.to_owned()))
    });
    let mut block = Block::blank(start, rows, QUANTITIES.len() + probed);
    let numbers = numbers.as_chunks().0.iter();
    let mut numbers = numbers.map(|bytes| f64::from_le_bytes(*bytes));
    for row in block.numbers.chunks_exact_mut(block.width) {
        for (&place, number) in places.iter().zip(&mut numbers) {
            row[place] = number;
        }
    }
    block.models = models.to_vec();
    block.failures = failures.collect::<Option<_>>()?;
    block.holds().then_some((block, results))
}
