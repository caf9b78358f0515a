//! What a journal keeps of a sweep: a block of rows a record.
//!
//! A block is its first row, its rows, the numbers that probes bring to one and the length of the failures' text, as
//! integers of eight bytes; then its numbers, those of the probes, the models and the failures.

use super::rows::Block;
use super::spec::Spec;
use crate::quantities::QUANTITIES;
use ledger::{Identity, Journal, JournalError, Record, Records, Title};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// What is done.
const KIND: &str = "sweep";
/// Bytes before the numbers of a block: four integers.
const HEADER: usize = 4 * 8;

/// Rows that a journal keeps.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) rows: Range<usize>,
    pub(super) record: Record,
}

/// The journal of some rows of a sweep.
fn title(spec: &Spec, rows: &Range<usize>) -> Title {
    let (sha256, of) = (&spec.fingerprint, spec.rows());
    let about = format!("{sha256} {of} {} {}", rows.start, rows.end);
    Title {
        kind: KIND,
        identity: Identity::default().with("rows", &about).hex(),
        about,
    }
}

/// Opens or begins a journal and says which rows it keeps, ascending and apart; that of other rows is replaced where it
/// `drops`.
pub(super) fn open(
    path: &Path,
    spec: &Spec,
    rows: &Range<usize>,
    drops: bool,
) -> Result<(Journal, Vec<Span>), JournalError> {
    let mut spans = Vec::new();
    let take = |record, kept: &[u8]| take(&mut spans, rows, record, kept);
    let journal = Journal::open(path, &title(spec, rows), |_| drops, take)?;
    Ok((journal, apart(spans)))
}

/// A run that was interrupted or is at work: what its journal says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unfinished {
    /// The journal.
    pub path: PathBuf,
    /// Which sweep.
    pub sha256: String,
    /// Its rows.
    pub sweep_rows: usize,
    /// Those that the run computes.
    pub rows: Range<usize>,
    /// How many of them are there.
    pub kept: usize,
}

impl Unfinished {
    /// Reads a journal without changing it; nothing where the file is none.
    #[must_use]
    pub fn read(path: &Path) -> Option<Self> {
        let mut records = Records::open(path, KIND).ok()??;
        let mut words = records.title.about.split(' ');
        let sha256 = words.next()?.to_owned();
        let mut count = || words.next()?.parse::<usize>().ok();
        let (sweep_rows, rows) = (count()?, count()?..count()?);
        let mut spans = Vec::new();
        records.all(|(record, kept)| take(&mut spans, &rows, record, &kept));
        let kept = apart(spans).iter().map(|span| span.rows.len()).sum();
        Some(Self {
            path: path.to_owned(),
            sha256,
            sweep_rows,
            rows,
            kept,
        })
    }
}

/// Whether the journal at `part` keeps all these rows of the sweep, so that a run may have begun to write its outputs.
#[must_use]
pub fn is_computed(spec: &Spec, rows: Range<usize>, part: &Path) -> bool {
    Unfinished::read(part).is_some_and(|found| {
        found.sha256 == spec.fingerprint && found.rows == rows && found.kept == rows.len()
    })
}

/// Adds what a record keeps, where that can be rows of a range.
fn take(spans: &mut Vec<Span>, wanted: &Range<usize>, record: Record, kept: &[u8]) -> bool {
    let rows = parsed(kept).map(|block| block.start..block.start + block.numbers.len());
    let rows = rows.filter(|rows| wanted.start <= rows.start && rows.end <= wanted.end);
    spans.extend(rows.clone().map(|rows| Span { rows, record }));
    rows.is_some()
}

/// Each row once, ascending.
fn apart(mut spans: Vec<Span>) -> Vec<Span> {
    spans.sort_by_key(|span| span.rows.start);
    let mut end = 0;
    spans.retain(|span| {
        let apart = span.rows.start >= end;
        end = end.max(span.rows.end);
        apart
    });
    spans
}

/// What is kept of a block.
pub(super) fn kept(block: &Block) -> Vec<u8> {
    let mut text = String::new();
    for (row, reason) in &block.failures {
        text.push_str(&format!("{row} {}\n", reason.replace('\n', " ")));
    }
    let rows = block.numbers.len();
    let numbers = rows * QUANTITIES.len() + block.probed.len();
    let mut bytes = Vec::with_capacity(HEADER + 8 * numbers + rows + text.len());
    for number in [block.start, rows, block.width(), text.len()] {
        bytes.extend((number as u64).to_le_bytes());
    }
    for number in block.numbers.iter().flatten().chain(&block.probed) {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(&block.models);
    bytes.extend(text.as_bytes());
    bytes
}

/// A block that can have been computed.
pub(super) fn parsed(kept: &[u8]) -> Option<Block> {
    const WIDTH: usize = QUANTITIES.len();
    let (header, rest) = kept.split_at_checked(HEADER)?;
    let mut words = header.as_chunks().0.iter().copied();
    let mut count = || usize::try_from(u64::from_le_bytes(words.next()?)).ok();
    let (start, rows, width, text) = (count()?, count()?, count()?, count()?);
    start.checked_add(rows).filter(|_| rows > 0)?;
    let (contacts, rest) = rest.split_at_checked(rows.checked_mul(8 * WIDTH)?)?;
    let (probed, rest) = rest.split_at_checked(rows.checked_mul(width)?.checked_mul(8)?)?;
    let (models, failures) = rest.split_at_checked(rows)?;
    let failures = std::str::from_utf8(failures).ok()?;
    let failures = failures.lines().map(|line| {
        let (row, reason) = line.split_once(' ')?;
        Some((row.parse().ok()?, reason.to_owned()))
    });
    let number = |word: &[u8; 8]| f64::from_le_bytes(*word);
    let row = |words: &[[u8; 8]; WIDTH]| words.each_ref().map(number);
    let block = Block {
        start,
        numbers: (contacts.as_chunks().0.as_chunks().0.iter())
            .map(row)
            .collect(),
        probed: probed.as_chunks().0.iter().map(number).collect(),
        models: models.to_vec(),
        failures: failures.collect::<Option<_>>()?,
    };
    let length = HEADER + 8 * (rows * WIDTH + block.probed.len()) + rows + text;
    (length == kept.len() && block.holds()).then_some(block)
}
