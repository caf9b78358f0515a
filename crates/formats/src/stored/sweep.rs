//! The results of a sweep, read back.

use super::open::{FileKind, Stored};
use crate::error::SceneError;
use crate::quantities::Described;
use crate::sweep::schema::part::PARTS;
use crate::sweep::schema::{AXES, LIST, RESULTS, SAMPLE, SHA256};
use crate::sweep::{Axis, Column, Fields, Values};
use std::path::Path;

/// An open sweep with its axes; results are read when they are asked for.
#[derive(Debug, Clone)]
pub struct StoredSweep {
    stored: Stored,
    /// The axes; the last runs fastest.
    pub axes: Vec<Axis>,
    /// Failed scenes.
    pub failed: u64,
}

impl StoredSweep {
    /// Opens a sweep.
    ///
    /// # Errors
    /// [`SceneError`], which says what the file is instead.
    pub fn open(path: &Path) -> Result<Self, SceneError> {
        let stored = Stored::open(path, FileKind::Sweep)?;
        if stored.text(PARTS).is_ok() {
            let what = "has the places of its parts, not their results: read the parts, or a copy of them in one file";
            return Err(SceneError::is(path, what));
        }
        let axes = read_axes(&stored)?;
        Ok(Self {
            failed: stored.number("failed").unwrap_or(0.0) as u64,
            axes,
            stored,
        })
    }

    /// Where it lies.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.stored.path
    }

    /// Which sweep it is of; nothing in files of versions before 1.4.
    #[must_use]
    pub fn sha256(&self) -> Option<String> {
        self.stored.text(SHA256).ok()
    }

    /// Which results it has, and how exactly.
    ///
    /// # Errors
    /// [`SceneError`] for a file that is not as it was written.
    pub fn fields(&self) -> Result<Fields, SceneError> {
        self.stored.fields(RESULTS, &self.shape())
    }

    /// The results of every row.
    #[must_use]
    pub fn quantities(&self) -> Vec<Described> {
        let mut found = self.stored.quantities(RESULTS, &self.shape());
        // scales of a sweep with one axis have the same shape
        found.retain(|quantity| {
            !quantity.name.contains('.') && quantity.name != SAMPLE && quantity.name != LIST
        });
        found
    }

    /// A result of all rows; NaN where a scene failed.
    ///
    /// # Errors
    /// [`SceneError`] for a result that is not there.
    pub fn values(&self, quantity: &str) -> Result<Vec<f64>, SceneError> {
        self.stored
            .numbers(&format!("{RESULTS}/{quantity}"), &self.shape())
    }

    fn shape(&self) -> Vec<usize> {
        self.axes.iter().map(|axis| axis.len).collect()
    }
}

/// The axes in the order of the dimensions: those of the product by their names, then the list's, then the draws'.
fn read_axes(stored: &Stored) -> Result<Vec<Axis>, SceneError> {
    let group = stored
        .group(AXES)
        .ok_or_else(|| stored.damaged(format!("the group {AXES} is missing")))?;
    let names = group.members();
    let mut axes: Vec<Axis> = Vec::new();
    for name in names.map_err(|error| stored.damaged(error))? {
        let path = format!("{AXES}/{name}");
        let data = stored.dataset(&path);
        let axis = data.as_ref().and_then(|data| data.text("axis").ok());
        let axis = axis.ok_or_else(|| stored.damaged(format!("{path} does not name its axis")))?;
        let values = if data.is_some_and(|data| data.holds_texts()) {
            Values::Texts(stored.texts(&path)?)
        } else {
            Values::Numbers(stored.vector(&path)?)
        };
        let len = values.count();
        let (section, key) = name
            .split_once('.')
            .ok_or_else(|| stored.damaged(format!("{path} is no key of a scene")))?;
        let column = Column {
            section: section.to_owned(),
            key: key.to_owned(),
            values,
        };
        match axes.iter_mut().find(|known| known.name == axis) {
            Some(known) if known.len == len => known.columns.push(column),
            Some(_) => {
                return Err(stored.damaged(format!(
                    "{path} has {len} values, unlike others of its axis"
                )));
            }
            None => axes.push(Axis {
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
