//! Reads the results of a sweep, or some of its rows, from either format.

#[cfg(feature = "parquet")]
use super::groups;
use super::open::{FileKind, Stored, parquet_of_kind};
use crate::error::SceneError;
use crate::quantities::Described;
use crate::schema::sweep::{
    AXES, FAILED, FAILURE, FAILURES, LIST, MODEL, RESULTS, ROWS, SAMPLE, SHA256, part,
};
use crate::sweep::{
    BLOCK, Block, Blocks, Cells, Footer, NOT_HELD, Part, Precision, Selection, Spec, SweepAxis,
    SweptKey, Values, What, WrittenResults, columns,
};
use output::OutputFault;
use std::ops::Range;
use std::path::Path;

/// An open part; its rows are read one block at a time.
#[derive(Debug, Clone)]
pub struct StoredPart {
    /// Description of the part.
    pub part: Part,
    rows: PartRows,
}

#[derive(Debug, Clone)]
enum PartRows {
    /// An open file, and the reasons of its failures.
    Hdf5(Stored, Vec<String>),
    Parquet(Box<Footer>),
}

impl StoredPart {
    /// Opens a part; data that are read later are checked at that time.
    ///
    /// # Errors
    /// [`SceneError`], which contains the actual kind of the file.
    pub fn open(path: &Path) -> Result<Self, SceneError> {
        if let Some((footer, part)) = parquet_of_kind(path, FileKind::SweepPart)? {
            let rows = PartRows::Parquet(Box::new(footer));
            return Ok(Self { part, rows });
        }
        let stored = Stored::open(path, FileKind::SweepPart)?;
        let count = |name: &str| {
            let found = stored.number(name).map(|number| number as usize);
            found.ok_or_else(|| stored.damaged(format!("the number {name} is missing")))
        };
        let (sweep_rows, start) = (count(part::SWEEP_ROWS)?, count(part::FIRST_ROW)?);
        let end = start.checked_add(count(ROWS)?);
        let Some(end) = end.filter(|&end| end <= sweep_rows) else {
            return Err(stored.damaged("it has more rows than its sweep"));
        };
        let text = Some(stored.text(part::SHARD)?).filter(|text| !text.is_empty());
        let shard = text.map(|text| {
            let shard = text.parse();
            shard.map_err(|_| stored.damaged(format!("there is no shard {text}")))
        });
        let rows = start..end;
        let fields = stored.fields(RESULTS, &[rows.len()])?;
        let part = Part {
            path: path.to_owned(),
            sha256: stored.text(SHA256)?,
            failed: count(FAILED)?,
            selection: Selection {
                rows,
                shard: shard.transpose()?,
            },
            sweep_rows,
            fields,
            sealed: stored.file.is_sealed(),
        };
        let reasons = stored.texts(FAILURES.0)?;
        let rows = PartRows::Hdf5(stored, reasons);
        Ok(Self { part, rows })
    }

    /// Checks all bytes of a part that has a checksum trailer.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn check(&self) -> Result<(), SceneError> {
        match &self.rows {
            PartRows::Hdf5(stored, _) => stored.check(),
            PartRows::Parquet(footer) => check_groups(&self.part, footer),
        }
    }

    /// Compares the keys that vary with those of the part's sweep.
    pub(crate) fn check_keys(&self, spec: &Spec) -> Result<(), SceneError> {
        if self.sweep()? != spec.resolved {
            let what = "it belongs to another sweep than the other parts";
            return Err(SceneError::damaged(&self.part.path, what));
        }
        let PartRows::Hdf5(stored, _) = &self.rows else {
            // the hash of a group includes its keys
            return Ok(());
        };
        let length = [self.part.selection.rows.len()];
        let block = Block {
            start: self.part.selection.rows.start,
            ..Block::default()
        };
        let mut keys = columns(spec);
        keys.retain(|column| matches!(column.what, What::Key { .. }));
        for some in self.blocks() {
            for column in &keys {
                let key = &column.described.name;
                let path = format!("{RESULTS}/{key}");
                let wanted = column.what.cells(spec, &block, some.clone());
                let wanted = wanted.map_err(|fault| stored.damaged(fault.reason))?;
                let same = match column.what.words() {
                    Some(words) => {
                        let known = stored.texts(&format!("{}/{key}", part::WORDS))?;
                        let found = stored.some(&path, &length, some.clone())?;
                        known == *words && wanted == Cells::Words(found)
                    }
                    None => wanted == Cells::Double(stored.some(&path, &length, some.clone())?),
                };
                if !same {
                    let what = format!("the values of {key} differ from those of its sweep");
                    return Err(stored.damaged(what));
                }
            }
        }
        Ok(())
    }

    /// The part without its results: reads models and failures only; none for a part that is not HDF5.
    pub(crate) fn failures(&self) -> Option<impl Blocks> {
        matches!(self.rows, PartRows::Hdf5(..)).then(|| {
            let mut bare = self.clone();
            bare.part.fields.retain(|_| false);
            bare
        })
    }

    /// The sweep with its base scene, as TOML.
    ///
    /// # Errors
    /// [`SceneError`] if it is missing.
    pub fn sweep(&self) -> Result<String, SceneError> {
        match &self.rows {
            PartRows::Hdf5(stored, _) => stored.text("sweep"),
            PartRows::Parquet(footer) => Ok(footer.sweep.clone()),
        }
    }

    /// Ranges of its rows, counted from its first row, that fit into memory.
    fn blocks(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let rows = self.part.selection.rows.len();
        let starts = (0..rows).step_by(BLOCK);
        starts.map(move |start| start..(start + BLOCK).min(rows))
    }

    /// Some of its rows, counted from its first row.
    fn block(
        &self,
        stored: &Stored,
        reasons: &[String],
        rows: Range<usize>,
    ) -> Result<Block, SceneError> {
        let length = [self.part.selection.rows.len()];
        let path = |name: &str| format!("{RESULTS}/{name}");
        let start = self.part.selection.rows.start + rows.start;
        let mut block = Block::blank(start, rows.len(), self.part.fields.width());
        block.models = stored.some(&path(MODEL.0), &length, rows.clone())?;
        for (k, quantity) in self.part.fields.quantities() {
            let (path, rows) = (path(&quantity.name), rows.clone());
            let column: Vec<f64> = match self.part.fields.precision {
                Precision::Double => stored.some(&path, &length, rows)?,
                Precision::Single => {
                    let column = stored.some::<f32>(&path, &length, rows)?;
                    column.into_iter().map(f64::from).collect()
                }
            };
            block.fill(k, column);
        }
        let indices = stored.some::<i32>(&path(FAILURE.0), &length, rows)?;
        let failed = (block.start..).zip(indices);
        for (row, index) in failed.filter(|&(_, index)| index != -1) {
            let reason = usize::try_from(index).ok().and_then(|i| reasons.get(i));
            let what = || format!("the reason {index} of the failed row {row} is missing");
            let reason = reason.ok_or_else(|| stored.damaged(what()))?;
            block.failures.push((row, reason.clone()));
        }
        if block.holds() {
            return Ok(block);
        }
        Err(stored.damaged(NOT_HELD))
    }
}

impl Blocks for StoredPart {
    fn each(
        &self,
        visit: &mut dyn FnMut(&Block) -> Result<(), OutputFault>,
    ) -> Result<(), OutputFault> {
        match &self.rows {
            PartRows::Hdf5(stored, reasons) => self.blocks().try_for_each(|rows| {
                let block = self.block(stored, reasons, rows);
                visit(&block.map_err(|error| OutputFault::from(error.to_string()))?)
            }),
            #[cfg(feature = "parquet")]
            PartRows::Parquet(footer) => groups::each(&self.part, &footer.row_groups, visit),
            #[cfg(not(feature = "parquet"))]
            PartRows::Parquet(footer) => Err(OutputFault::from(format!(
                "{} is a Parquet file with {} row groups, but this program was built without Parquet",
                self.part.path.display(),
                footer.row_groups.len()
            ))),
        }
    }
}

/// The hash of the sweep that a complete file belongs to (none in HDF5 files of versions before 1.4) and its results;
/// all bytes are checked.
///
/// # Errors
/// [`SceneError`], which contains the actual kind of the file.
pub(crate) fn whole_sweep(path: &Path) -> Result<(Option<String>, WrittenResults), SceneError> {
    if let Some((footer, part)) = parquet_of_kind(path, FileKind::Sweep)? {
        check_groups(&part, &footer)?;
        return Ok((Some(part.sha256), part.fields));
    }
    let found = StoredSweep::open(path)?;
    let fields = found.stored.fields(RESULTS, &found.shape())?;
    Ok((found.stored.text(SHA256).ok(), fields))
}

/// Checks the rows of a Parquet file against their hashes, if the program can read them.
fn check_groups(part: &Part, footer: &Footer) -> Result<(), SceneError> {
    #[cfg(feature = "parquet")]
    groups::check(part, &footer.row_groups)
        .map_err(|fault| SceneError::damaged(&part.path, fault.reason))?;
    let _ = (part, footer);
    Ok(())
}

/// An open sweep with its axes; results are read on request.
#[derive(Debug, Clone)]
pub struct StoredSweep {
    stored: Stored,
    /// The axes; the last varies fastest.
    pub axes: Vec<SweepAxis>,
    /// Number of failed scenes.
    pub failed: u64,
}

impl StoredSweep {
    /// Opens a sweep.
    ///
    /// # Errors
    /// [`SceneError`], which contains the actual kind of the file.
    pub fn open(path: &Path) -> Result<Self, SceneError> {
        let stored = Stored::open(path, FileKind::Sweep)?;
        if stored.text(part::PARTS).is_ok() {
            let what = "refers to its parts and contains no results: read the parts, or merge them without --virtual";
            return Err(SceneError::is(path, what));
        }
        let axes = read_axes(&stored)?;
        Ok(Self {
            failed: stored.number("failed").unwrap_or(0.0) as u64,
            axes,
            stored,
        })
    }

    /// Path of the file.
    pub fn path(&self) -> &Path {
        &self.stored.path
    }

    /// The results of all rows.
    pub fn quantities(&self) -> Vec<Described> {
        let mut found = self.stored.quantities(RESULTS, &self.shape());
        // the scales of a sweep with one axis have the same shape as results
        found.retain(|quantity| {
            !quantity.name.contains('.') && quantity.name != SAMPLE && quantity.name != LIST
        });
        found
    }

    /// A result of all rows; NaN for failed scenes.
    ///
    /// # Errors
    /// [`SceneError`] for a result that the file does not have.
    pub fn values(&self, quantity: &str) -> Result<Vec<f64>, SceneError> {
        self.stored
            .numbers(&format!("{RESULTS}/{quantity}"), &self.shape())
    }

    fn shape(&self) -> Vec<usize> {
        self.axes.iter().map(|axis| axis.len).collect()
    }
}

/// The axes in the order of the dimensions: those of the product by name, then the list, then the draws.
fn read_axes(stored: &Stored) -> Result<Vec<SweepAxis>, SceneError> {
    let group = stored.group(AXES);
    let group = group.ok_or_else(|| stored.damaged(format!("the group {AXES} is missing")))?;
    let names = group.members();
    let mut axes: Vec<SweepAxis> = Vec::new();
    for name in names.map_err(|error| stored.damaged(error))? {
        let path = format!("{AXES}/{name}");
        let data = stored.dataset(&path);
        let data = data.and_then(|data| Some((data.text("axis").ok()?, data.holds_texts())));
        let unnamed = || stored.damaged(format!("{path} does not name its axis"));
        let (axis, holds_texts) = data.ok_or_else(unnamed)?;
        let values = if holds_texts {
            Values::Texts(stored.texts(&path)?)
        } else {
            Values::Numbers(stored.vector(&path)?)
        };
        let len = values.count();
        let (section, key) = name
            .split_once('.')
            .ok_or_else(|| stored.damaged(format!("{path} is not a key of a scene")))?;
        let column = SweptKey {
            section: section.to_owned(),
            key: key.to_owned(),
            values,
        };
        match axes.iter_mut().find(|known| known.name == axis) {
            Some(known) if known.len == len => known.columns.push(column),
            Some(_) => {
                return Err(stored.damaged(format!(
                    "{path} has {len} values, but other keys of its axis have more or fewer"
                )));
            }
            None => axes.push(SweepAxis {
                name: axis,
                len,
                columns: vec![column],
            }),
        }
    }
    axes.sort_by_key(|axis| match axis.name.as_str() {
        LIST => 1,
        SAMPLE => 2,
        _ => 0,
    });
    if axes.is_empty() {
        return Err(stored.damaged("it has no axes"));
    }
    Ok(axes)
}
