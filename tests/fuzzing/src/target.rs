//! Readers, and what is checked of their answers.

use crate::stand_in::content;
use formats::stored::StoredPart;
use formats::sweep::{Block, Blocks, Kept, Spec, SweepError, run_rows};
use formats::{SceneError, json_report, parse_materials, parse_scene, read_record, read_response};
use impact::{Allowance, Forecast, KernelChoice, Load, Reading, simulate_within};
use lookup::{Content, Smoothness, Table, TableError, TableFile};
use output::Existing;
use serde_json::Value;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use tabulator::{Grid, Silent};

/// A reader.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// A scene is parsed, and written out again.
    Scene,
    /// A scene is parsed and computed, where it is short.
    Impact,
    /// A sweep is parsed.
    Sweep,
    /// The settings of a kernel table are parsed.
    Grid,
    /// A materials file is parsed.
    Materials,
    /// A force record as text.
    Record,
    /// The response of a sensor as text.
    Response,
    /// A force record in HDF5.
    Results,
    /// The journal of a sweep.
    Journal,
    /// A part of a sweep, in HDF5 or Parquet.
    Part,
    /// A shard of a kernel table.
    Shard,
    /// A kernel table, sealed anew after damage, or without a seal.
    Table,
    /// A kernel table with its seal as it was: what is read of a damaged one are the numbers that were written.
    Sealed,
}

/// What became of an input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It was read, and what was computed is finite.
    Read,
    /// It was refused with a sentence.
    Refused,
}

/// The sweep whose journal is read: three rows, one of which fails.
const SWEEP: &str = "[scene.striker]\ntip_radius_m = 0.005\nmaterial = \"steel\"\nmass_kg = 0.01\n\
    [scene.target]\nmaterial = \"steel\"\n[scene.contact]\nmodel = \"hertz\"\n\
    [list.striker]\nvelocity_m_s = [1.0, 1e9, 3.0]\n";

/// What it asks for.
pub(crate) fn of_sweep(folder: &Path) -> Result<Spec, SceneError> {
    Spec::from_toml(SWEEP, folder)
}

/// Runs it with the journal at `path`, until so many rows are done.
pub(crate) fn sweep(path: &Path, folder: &Path, rows: usize) -> Result<Option<Kept>, SweepError> {
    let spec = of_sweep(folder)?;
    run_rows(&spec, path, Existing::Replace, |done| done < rows)
}

/// All rows are those of the sweep, wherever they come from.
fn same_rows(blocks: &[Block]) {
    let numbers = || blocks.iter().flat_map(Block::rows);
    let failed = |row: &[f64]| row.iter().all(|x| x.is_nan());
    assert_eq!(numbers().count(), 3);
    let forces: Vec<f64> = numbers().map(|row| row[0]).collect();
    // Hertz's force follows the velocity by a power of 6/5
    let ratio = forces[2] / forces[0] / 3_f64.powf(1.2);
    assert!((ratio - 1.0).abs() < 1e-9, "{forces:?}");
    assert!(numbers().nth(1).is_some_and(failed), "{forces:?}");
}

/// Results that a body without the strength does not have.
const OF_STRENGTHS: [&str; 4] = [
    "yield_onset",
    "pressure_over_yield",
    "pressure_over_tensile",
    "cone_crack_onset",
];

/// A scene that takes longer is not computed.
const MOST_S: f64 = 0.25;
/// Nor one that takes more memory.
const MOST_BYTES: f64 = 2e8;

impl Target {
    /// All of them.
    pub const ALL: [Self; 13] = [
        Self::Scene,
        Self::Impact,
        Self::Sweep,
        Self::Grid,
        Self::Materials,
        Self::Record,
        Self::Response,
        Self::Results,
        Self::Journal,
        Self::Part,
        Self::Shard,
        Self::Table,
        Self::Sealed,
    ];

    /// Name in commands and of the folder of its seeds.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Impact => "impact",
            Self::Sweep => "sweep",
            Self::Grid => "grid",
            Self::Materials => "materials",
            Self::Record => "record",
            Self::Response => "response",
            Self::Results => "results",
            Self::Journal => "journal",
            Self::Part => "part",
            Self::Shard => "shard",
            Self::Table => "table",
            Self::Sealed => "sealed",
        }
    }

    /// The one of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|target| target.name() == name)
    }

    /// Whether its inputs are text.
    #[must_use]
    pub fn is_text(self) -> bool {
        match self {
            Self::Scene
            | Self::Impact
            | Self::Sweep
            | Self::Grid
            | Self::Materials
            | Self::Record
            | Self::Response => true,
            Self::Results
            | Self::Journal
            | Self::Part
            | Self::Shard
            | Self::Table
            | Self::Sealed => false,
        }
    }

    /// Gives it an input; files go into `folder`, which also has what scenes name.
    ///
    /// # Panics
    /// On a fault of the program: that is what is looked for.
    #[must_use]
    pub fn judge(self, input: &[u8], folder: &Path) -> Verdict {
        let text = String::from_utf8_lossy(input);
        let read = match self {
            Self::Scene => match parse_scene(&text, folder) {
                Ok(scene) => {
                    assert!(!formats::resolved(&scene).is_empty());
                    true
                }
                Err(error) => sentence(&error),
            },
            Self::Impact => impact(&text, folder),
            Self::Sweep => match Spec::from_toml(&text, folder) {
                Ok(spec) => {
                    assert!(spec.rows() > 0 && spec.memory_bytes() > 0.0);
                    true
                }
                Err(error) => sentence(&error),
            },
            Self::Grid => match Grid::parse(&text) {
                Ok(grid) => {
                    let [r, z] = grid.nodes();
                    assert!(r.len() > 1 && z.len() > 1 && grid.cells().is_ok());
                    true
                }
                Err(error) => sentence(&error),
            },
            Self::Materials => judged(parse_materials(&text)),
            Self::Record => judged(read_record(
                &file(folder, "x.csv", input),
                Reading::default(),
            )),
            Self::Response => judged(read_response(&file(folder, "x.csv", input))),
            Self::Results => judged(read_record(
                &file(folder, "x.h5", input),
                Reading::default(),
            )),
            Self::Journal => {
                let path = file(folder, "x.part", input);
                match sweep(&path, folder, usize::MAX) {
                    Ok(Some(done)) => {
                        let mut blocks = Vec::new();
                        let read = done.each(&mut |block| {
                            blocks.push(block.clone());
                            Ok(())
                        });
                        same_rows(read.map(|()| blocks.as_slice()).unwrap_or_default());
                        done.resumed > 0
                    }
                    Ok(None) => false,
                    Err(error) => sentence(&error),
                }
            }
            Self::Part => part(input, folder),
            Self::Shard => {
                let path = file(folder, "x.shard", input);
                let out = folder.join("joined.h5");
                let done = tabulator::merge(&[path], &out, Existing::Replace, &Silent);
                judged(done)
            }
            Self::Table => table(input, folder),
            Self::Sealed => sealed(input, folder),
        };
        if read {
            Verdict::Read
        } else {
            Verdict::Refused
        }
    }
}

/// Whether something was read; a refusal is one sentence.
fn judged<T>(answer: Result<T, impl std::error::Error>) -> bool {
    match answer {
        Ok(_) => true,
        Err(error) => sentence(&error),
    }
}

/// Checks the sentence of a refusal.
fn sentence(error: &impl std::error::Error) -> bool {
    let text = error.to_string();
    assert!(!text.is_empty() && !text.contains('\n'), "{text:?}");
    false
}

fn file(folder: &Path, name: &str, input: &[u8]) -> PathBuf {
    let path = folder.join(name);
    if let Err(error) = std::fs::write(&path, input) {
        // a full disk is no fault of a reader
        eprintln!("{}: {error}", path.display());
    }
    path
}

/// A scene computed: all its numbers are finite, and its error says something.
fn impact(text: &str, folder: &Path) -> bool {
    let scene = match parse_scene(text, folder) {
        Ok(scene) => scene,
        Err(error) => return sentence(&error),
    };
    let allowance = Allowance {
        memory_bytes: MOST_BYTES,
        go_on: &|forecast: &Forecast| forecast.seconds <= MOST_S,
        ..Allowance::default()
    };
    let outcome = match simulate_within(&scene, &KernelChoice::Direct, &allowance) {
        Ok(outcome) => outcome,
        Err(error) => return sentence(&error),
    };
    let report = json_report(&scene, &outcome, 0.0);
    let struck = matches!(scene.load, Load::Strike(_));
    for quantity in &formats::QUANTITIES {
        let value = &report[quantity.name];
        let right = match value {
            Value::Number(number) => number.as_f64().is_some_and(f64::is_finite),
            Value::Null if struck => quantity.is_of_flow || OF_STRENGTHS.contains(&quantity.name),
            Value::Null => quantity.of_record.is_none(),
            _ => false,
        };
        assert!(right, "{} = {value}", quantity.name);
    }
    let error = report["relative_error_estimate"].as_f64();
    assert!(
        error.is_some_and(|x| x >= 0.0 && (!struck || x <= 0.5)),
        "{error:?}"
    );
    true
}

/// The bytes before the seal, where there is one.
pub(crate) fn without_seal(bytes: &[u8]) -> &[u8] {
    let length = bytes.len().checked_sub(48).and_then(|end| {
        let stated = bytes[end..].strip_prefix(b"hlseal2\n")?.first_chunk()?;
        usize::try_from(u64::from_le_bytes(*stated)).ok()
    });
    let before = length.and_then(|length| bytes.get(..length));
    before.unwrap_or(bytes)
}

/// Appends a right seal to a file.
fn seal(path: &Path) -> io::Result<()> {
    ledger::seal(&File::options().read(true).write(true).open(path)?)
}

/// A file whose seal is made right again, so that damage behind it is reached; one without a seal as it is.
fn resealed(input: &[u8], folder: &Path) -> PathBuf {
    let bytes = without_seal(input);
    let path = file(folder, "x.h5", bytes);
    if bytes.len() < input.len()
        && let Err(error) = seal(&path)
    {
        eprintln!("{}: {error}", path.display());
    }
    path
}

/// A part: the rows are those that were written; behind a seal that was made right they may be any.
fn part(input: &[u8], folder: &Path) -> bool {
    let as_written = rows(&file(folder, "x.h5", input));
    if let Some(blocks) = &as_written {
        same_rows(blocks);
    }
    let _ = rows(&resealed(input, folder));
    as_written.is_some()
}

/// The rows of a part, where it is one.
fn rows(path: &Path) -> Option<Vec<Block>> {
    let stored = match StoredPart::open(path) {
        Ok(stored) => stored,
        Err(error) => {
            sentence(&error);
            return None;
        }
    };
    let mut blocks = Vec::new();
    let read = stored.each(&mut |block| {
        blocks.push(block.clone());
        Ok(())
    });
    if let Err(fault) = &read {
        assert!(
            !fault.reason.is_empty() && !fault.reason.contains('\n'),
            "{fault:?}"
        );
        return None;
    }
    Some(blocks)
}

/// A table: its seal made right, its whole and a part of it read.
fn table(input: &[u8], folder: &Path) -> bool {
    let path = resealed(input, folder);
    let whole = match Table::open(&path) {
        Ok(table) => {
            let mut cells = [[0.0; 6]; 24];
            let _ = table.trace(Smoothness::Linear, 0.27, 0.4, 0.3, 0, &mut cells);
            true
        }
        Err(error) => sentence(&error),
    };
    judged(corner(&path)) && whole
}

/// A table that may be damaged: refused, or as it was written, as a whole and in a part.
fn sealed(input: &[u8], folder: &Path) -> bool {
    let path = file(folder, "x.h5", input);
    let part = match corner(&path) {
        Ok(part) => {
            static TRUTH: OnceLock<Content> = OnceLock::new();
            let truth = TRUTH.get_or_init(|| {
                let whole = folder.join("truth.h5");
                let written = lookup::write(&whole, &content());
                assert!(written.is_ok(), "{written:?}");
                corner(&whole).map_or_else(|error| panic!("{error}"), Table::into_content)
            });
            assert!(
                part.into_content() == *truth,
                "other numbers than were written"
            );
            true
        }
        Err(error) => sentence(&error),
    };
    match Table::open(&path) {
        Ok(table) => {
            assert!(
                table.into_content() == content(),
                "other numbers than were written"
            );
            part
        }
        Err(error) => sentence(&error),
    }
}

/// A part of a table, between slices.
fn corner(path: &Path) -> Result<Table, TableError> {
    TableFile::open(path)?.part(0.28, [[0.0; 2], [0.5; 2]])
}
