//! Rows of a sweep in several files: what a folder has of them, what it lacks, and all of them in one.

use crate::error::SceneError;
use crate::stored::{FileKind, Part, StoredPart, file_kind, whole_sweep};
use crate::sweep::{
    Block, Blocks, Shard, Spec, SweepError, Unfinished, grain, stage_hdf5, stage_rows,
};
use ledger::gaps;
use output::{HDF5, Output, OutputFault, ROWS, Staged, folder, is_hidden};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// What rows are of that do not belong to a sweep.
const OTHER: &str = "another sweep, or of this one before its files or the program changed";

/// The parts of one sweep in a folder.
#[derive(Debug)]
pub struct Parts {
    /// Which sweep.
    pub sha256: String,
    /// Its rows.
    pub sweep_rows: usize,
    /// Rows that shards do not divide.
    grain: usize,
    /// The parts, by their first rows.
    pub parts: Vec<Part>,
    /// Files with the ending of HDF5 or Parquet that are none of them, each with a sentence that says what it is.
    pub foreign: Vec<(PathBuf, String)>,
    /// Journals of runs that are at work, or were interrupted.
    pub unfinished: Vec<Unfinished>,
}

impl Parts {
    /// Opens the parts in a folder: of the sweep `wanted`, or of that of most of them.
    ///
    /// # Errors
    /// [`SweepError`] for a folder that cannot be read or, where no sweep is wanted, has no parts.
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

    /// Rows of the sweep that no part has.
    pub fn missing(&self) -> Vec<Range<usize>> {
        let held = self.full().map(|part| part.selection.rows.clone());
        gaps(&held.collect::<Vec<_>>(), &(0..self.sweep_rows))
    }

    /// Into how many shards the sweep was divided, where the parts agree on it.
    pub fn shards(&self) -> Option<usize> {
        let parts = self.parts.iter();
        let mut counts = parts.map(|part| Some(part.selection.shard?.count));
        let first = counts.next()??;
        counts.all(|count| count == Some(first)).then_some(first)
    }

    /// The shards, of so many, some rows of which no part has.
    pub fn missing_shards(&self, count: usize) -> Vec<usize> {
        let missing = self.missing();
        let lacks = |&index: &usize| {
            let rows = Shard { index, count }.range(self.sweep_rows, self.grain);
            let next = missing.partition_point(|gap| gap.end <= rows.start);
            missing.get(next).is_some_and(|gap| gap.start < rows.end)
        };
        (1..=count).filter(lacks).collect()
    }

    /// The first rows that two parts have, if there are any.
    pub fn overlap(&self) -> Option<SceneError> {
        let full: Vec<&Part> = self.full().collect();
        full.windows(2).find_map(|pair| {
            let [first, second] = [pair[0], pair[1]];
            let (before, rows) = (&first.selection.rows, &second.selection.rows);
            (before.end > rows.start).then(|| {
                let (from, to) = (rows.start, rows.end.min(before.end) - 1);
                let [one, two] = [first, second].map(|part| part.path.display());
                let sentence =
                    format!("rows {from} to {to} are in {one} and in {two}: remove one of the two");
                SceneError::in_sentence(&first.path, sentence)
            })
        })
    }

    /// Writes the whole sweep, byte by byte as one run would have, in the format that the name says, into an output that was claimed before.
    ///
    /// Where it `refers`, it is an HDF5 file whose results lie in the parts, which are to stay where they are, seen from it.
    ///
    /// # Errors
    /// [`SweepError`] where rows are missing, or twice there, or a file is none of the sweep's parts, or none to refer to.
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
                return Err(unreferred("it is no HDF5 file"));
            }
            let path = seen_from(&output.real, &part.path);
            let path = path.ok_or_else(|| unreferred("its path is no text"))?;
            Ok((path, part.selection.rows.clone()))
        });
        let sources = sources.collect::<Result<Vec<_>, SceneError>>()?;
        Ok(stage_hdf5(output, &spec, Some(&sources), &rows)?)
    }

    /// The sweep, where all its rows are there, once.
    fn whole(&self, output: &Output) -> Result<Spec, SweepError> {
        // what was merged before may lie beside the parts
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
            let sentence = format!("and {other} have other columns, or another precision");
            return Err(SceneError::is(&first.path, sentence).into());
        }
        Ok(spec)
    }

    /// Those that have rows.
    fn full(&self) -> impl Iterator<Item = &Part> {
        let parts = self.parts.iter();
        parts.filter(|part| !part.selection.rows.is_empty())
    }
}

/// The rows of the parts, with the keys of their sweep: all of them, or without their results.
struct Checked<'a> {
    parts: &'a Parts,
    spec: &'a Spec,
    all: bool,
}

impl Blocks for Checked<'_> {
    /// One part is open at a time: there may be more than files that a process may open.
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

/// The path of one file from the folder of another, where it is a text.
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

/// What a part says of itself, where its bytes are those that were written.
fn undamaged(path: &Path) -> Result<Part, SceneError> {
    let open = StoredPart::open(path)?;
    open.check().map(|()| open.part)
}

/// Why the file at `path` is not the whole result of a sweep or, where some are selected, of these rows.
///
/// # Errors
/// One sentence.
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
        "has other columns, or another precision".to_owned()
    } else {
        return Ok(());
    };
    Err(format!("{} {wrong}", path.display()))
}

/// What is said of a place without parts.
fn none(path: &Path) -> SceneError {
    SceneError::is(path, "has no part of a sweep")
}

/// Files of a folder with some names, by name; those that begin with a dot belong to runs.
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

/// The sweep that most parts, or else journals, are of, with its rows; the first of several.
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
