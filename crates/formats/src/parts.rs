//! Parts of a sweep in several files: present and missing rows of a folder, and their merge into one file.

use crate::error::SceneError;
use crate::stored::{FileKind, Part, StoredPart, file_kind, whole_sweep};
use crate::sweep::{
    Block, Blocks, Shard, Spec, SweepError, Unfinished, grain, stage_hdf5, stage_rows,
};
use ledger::gaps;
use output::{HDF5, Output, OutputFault, ROWS, Staged, folder, is_hidden};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Description of a file that does not belong to the sweep.
const OTHER: &str = "another sweep, or of this sweep before its files or the program changed";

/// The parts of one sweep in a folder.
#[derive(Debug)]
pub struct Parts {
    /// SHA-256 that identifies the sweep.
    pub sha256: String,
    /// Number of rows of the sweep.
    pub sweep_rows: usize,
    /// Number of rows that a shard never splits.
    grain: usize,
    /// The parts in the order of their first rows.
    pub parts: Vec<Part>,
    /// Other files with the extension of HDF5 or Parquet, each with a sentence about it.
    pub foreign: Vec<(PathBuf, String)>,
    /// Journals of runs that are in progress or were interrupted.
    pub unfinished: Vec<Unfinished>,
}

impl Parts {
    /// Opens the parts in a folder: of the sweep `wanted`, or else of the sweep of most parts.
    ///
    /// # Errors
    /// [`SweepError`] for a folder that cannot be read, or has no parts while no sweep is wanted.
    pub fn in_folder(folder: &Path, wanted: Option<&Spec>) -> Result<Self, SweepError> {
        let (mut all, mut foreign) = (Vec::new(), Vec::new());
        for path in files(folder, |path| ROWS.is_of(path))? {
            match undamaged(&path) {
                Ok(part) => all.push(part),
                Err(error) => foreign.push((path, error.to_string())),
            }
        }
        let is_journal = |path: &Path| path.extension().is_some_and(|end| end == "part");
        let journals = files(folder, is_journal)?.into_iter();
        let mut unfinished: Vec<_> = journals
            .filter_map(|path| Unfinished::read(&path))
            .collect();
        let (sha256, sweep_rows) = match wanted {
            Some(spec) => (spec.sha256.clone(), spec.rows()),
            None => most(&all, &unfinished).ok_or_else(|| none(folder))?,
        };
        unfinished.retain(|run| run.sha256 == sha256 && run.sweep_rows == sweep_rows);
        let (mut parts, others): (Vec<_>, Vec<_>) = all
            .into_iter()
            .partition(|part| part.sha256 == sha256 && part.sweep_rows == sweep_rows);
        parts.sort_by_key(|part| (part.selection.rows.start, part.selection.rows.end));
        foreign.extend(others.into_iter().map(|Part { path, .. }| {
            let reason = format!("{} is a part of {OTHER}", path.display());
            (path, reason)
        }));
        let fields = wanted.map(|spec| &spec.fields);
        let fields = fields.or_else(|| parts.first().map(|part| &part.fields));
        Ok(Self {
            grain: fields.map_or(1, grain),
            sha256,
            sweep_rows,
            parts,
            foreign,
            unfinished,
        })
    }

    /// Rows of the sweep that are in no part.
    pub fn missing(&self) -> Vec<Range<usize>> {
        let held = self.full().map(|part| part.selection.rows.clone());
        gaps(&held.collect::<Vec<_>>(), &(0..self.sweep_rows))
    }

    /// Number of shards of the sweep, if the parts agree on it.
    pub fn shards(&self) -> Option<usize> {
        let parts = self.parts.iter();
        let mut counts = parts.map(|part| Some(part.selection.shard?.count));
        let first = counts.next()??;
        counts.all(|count| count == Some(first)).then_some(first)
    }

    /// The shards, out of `count`, with rows that are in no part.
    pub fn missing_shards(&self, count: usize) -> Vec<usize> {
        let missing = self.missing();
        let lacks = |&index: &usize| {
            let rows = Shard { index, count }.range(self.sweep_rows, self.grain);
            let next = missing.partition_point(|gap| gap.end <= rows.start);
            missing.get(next).is_some_and(|gap| gap.start < rows.end)
        };
        (1..=count).filter(lacks).collect()
    }

    /// The first rows that are in two parts, if any.
    pub fn overlap(&self) -> Option<SceneError> {
        let full: Vec<&Part> = self.full().collect();
        full.windows(2).find_map(|pair| {
            let [first, second] = [pair[0], pair[1]];
            let (before, rows) = (&first.selection.rows, &second.selection.rows);
            (before.end > rows.start).then(|| {
                let (from, to) = (rows.start, rows.end.min(before.end) - 1);
                let [one, two] = [first, second].map(|part| part.path.display());
                let sentence =
                    format!("rows {from} to {to} are both in {one} and in {two}: remove one of the two files");
                SceneError::in_sentence(&first.path, sentence)
            })
        })
    }

    /// Writes the whole sweep into an output that was claimed before; byte for byte as one run would have written it,
    /// in the format of the output's name.
    ///
    /// With `refers` the output is an HDF5 file whose results remain in the parts; these must not move relative to it.
    ///
    /// # Errors
    /// [`SweepError`] if rows are missing or duplicate, if a file is not a part of the sweep, or if it cannot be
    /// referred to.
    pub fn merge<'a>(&self, output: &'a Output, refers: bool) -> Result<Staged<'a>, SweepError> {
        if refers {
            HDF5.check(&output.path)?;
        }
        let spec = self.whole(output)?;
        let rows = Checked {
            parts: self,
            spec: &spec,
            all: !refers,
        };
        if !refers {
            return Ok(stage_rows(output, &spec, &rows)?);
        }
        let sources = self.full().map(|part| {
            let unreferred = |reason: &str| {
                SceneError::is(&part.path, format!("cannot be referred to: {reason}"))
            };
            let named_so = HDF5.check(&part.path).is_ok();
            if !named_so || StoredPart::open(&part.path)?.failures().is_none() {
                return Err(unreferred("it is not an HDF5 file"));
            }
            let path = seen_from(&output.real, &part.path);
            let path = path.ok_or_else(|| unreferred("its path is not valid text"))?;
            Ok((path, part.selection.rows.clone()))
        });
        let sources = sources.collect::<Result<Vec<_>, SceneError>>()?;
        Ok(stage_hdf5(output, &spec, Some(&sources), &rows)?)
    }

    /// The sweep, if each of its rows is present exactly once.
    fn whole(&self, output: &Output) -> Result<Spec, SweepError> {
        // an earlier merged sweep may lie next to the parts
        let merged = |path: &Path| file_kind(path) == Ok(FileKind::Sweep);
        if let Some((path, reason)) = self.foreign.iter().find(|(path, _)| !merged(path)) {
            return Err(SceneError::in_sentence(path, reason.clone()).into());
        }
        if let Some(overlap) = self.overlap() {
            return Err(overlap.into());
        }
        let missing = self.missing();
        if let Some(rows) = missing.first() {
            return Err(SweepError::Missing(rows.clone(), missing.len() - 1));
        }
        let Some(first) = self.parts.first() else {
            return Err(none(&output.path).into());
        };
        let sweep = StoredPart::open(&first.path)?.sweep()?;
        let mut spec = Spec::of_stored(&sweep, self.sha256.clone())?;
        spec.fields = first.fields.clone();
        if let Some(other) = self.parts.iter().find(|part| part.fields != spec.fields) {
            let other = other.path.display();
            let sentence = format!("and {other} differ in their columns or precision");
            return Err(SceneError::is(&first.path, sentence).into());
        }
        Ok(spec)
    }

    /// The parts that have rows.
    fn full(&self) -> impl Iterator<Item = &Part> {
        let parts = self.parts.iter();
        parts.filter(|part| !part.selection.rows.is_empty())
    }
}

/// The rows of the parts, with the keys of their sweep; all rows, or failures only.
struct Checked<'a> {
    parts: &'a Parts,
    spec: &'a Spec,
    all: bool,
}

impl Blocks for Checked<'_> {
    /// Only one part is open at a time: a process may open fewer files than there are parts.
    fn each(
        &self,
        visit: &mut dyn FnMut(&Block) -> Result<(), OutputFault>,
    ) -> Result<(), OutputFault> {
        self.parts.parts.iter().try_for_each(|part| {
            let told = |error: SceneError| OutputFault::from(error.to_string());
            let open = StoredPart::open(&part.path).map_err(told)?;
            if open.part != *part {
                let path = part.path.display();
                return Err(OutputFault::from(format!(
                    "{path} was changed while it was read"
                )));
            }
            open.check_keys(self.spec).map_err(told)?;
            match open.failures() {
                Some(rows) if !self.all => rows.each(visit),
                Some(_) | None => open.each(visit),
            }
        })
    }
}

/// The path of one file relative to the folder of another, if it is valid text.
fn seen_from(file: &Path, other: &Path) -> Option<String> {
    let (folder, other) = (
        folder(file).canonicalize().ok()?,
        other.canonicalize().ok()?,
    );
    let common = folder.ancestors().find(|above| other.starts_with(above))?;
    let up = folder.strip_prefix(common).ok()?.components();
    let up = up.map(|_| Path::new(".."));
    let path: PathBuf = up.chain(other.strip_prefix(common).ok()).collect();
    path.to_str().map(str::to_owned)
}

/// The description of a part whose checksums are correct.
fn undamaged(path: &Path) -> Result<Part, SceneError> {
    let open = StoredPart::open(path)?;
    open.check().map(|()| open.part)
}

/// Checks that the file at `path` is the complete result of a sweep or of its selected rows.
///
/// # Errors
/// One sentence with the reason.
pub fn check_complete(path: &Path, spec: &Spec) -> Result<(), String> {
    let found = match spec.selection {
        None => whole_sweep(path).map(|(sha256, fields)| (sha256, fields, 0..spec.rows())),
        Some(_) => {
            undamaged(path).map(|part| (Some(part.sha256), part.fields, part.selection.rows))
        }
    };
    let (sha256, fields, rows) = found.map_err(|error| error.to_string())?;
    let asked = spec.selected();
    let wrong = if sha256.as_ref() != Some(&spec.sha256) {
        format!("is of {OTHER}")
    } else if rows != asked {
        let [[a, b], [c, d]] = [rows, asked].map(|rows| [rows.start, rows.end]);
        format!("has the rows {a}:{b}, not {c}:{d}")
    } else if fields != spec.fields {
        "has other columns or another precision".to_owned()
    } else {
        return Ok(());
    };
    Err(format!("{} {wrong}", path.display()))
}

/// The error for a folder without parts.
fn none(path: &Path) -> SceneError {
    SceneError::is(path, "contains no part of a sweep")
}

/// Files of a folder with some names, sorted; names that begin with a dot belong to runs.
fn files(folder: &Path, named: impl Fn(&Path) -> bool) -> Result<Vec<PathBuf>, SceneError> {
    let paths = || -> std::io::Result<Vec<PathBuf>> {
        let entries = std::fs::read_dir(folder)?;
        entries.map(|entry| Ok(entry?.path())).collect()
    };
    let mut found = paths().map_err(|reason| SceneError::unreadable(folder, reason))?;
    found.retain(|path| named(path) && !is_hidden(path));
    found.sort();
    Ok(found)
}

/// The sweep of most parts, or else of most journals, with its number of rows; the first of several.
fn most(parts: &[Part], unfinished: &[Unfinished]) -> Option<(String, usize)> {
    let of_parts = parts.iter().map(|part| (&part.sha256, part.sweep_rows));
    let of_runs = unfinished.iter().map(|run| (&run.sha256, run.sweep_rows));
    let mut of: Vec<_> = match parts {
        [] => of_runs.collect(),
        _ => of_parts.collect(),
    };
    of.sort_unstable();
    let same = of
        .chunk_by(|a, b| a == b)
        .rev()
        .max_by_key(|same| same.len())?;
    Some((same[0].0.clone(), same[0].1))
}
