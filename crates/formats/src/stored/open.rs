//! An open file, and bounded reading from it.

use super::error::ReadError;
use super::file::{file_kind, open_hdf5, text_of};
use super::kind::FileKind;
use crate::section::parse;
use crate::sweep::schema::{PROBED_VERSION, TEXTS, part};
use crate::sweep::{Described, Fields, Precision, stored_columns};
use hdfread::{Dataset, Group, Kind, Number};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Most bytes of numbers that are read from a dataset at once.
const MOST_BYTES: u64 = 1 << 29;

/// A dataset of a file: its name, unit and meaning.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoredQuantity {
    /// Name in the file.
    pub name: String,
    /// Unit; `1` for none.
    pub unit: String,
    /// What it is, in a few words.
    pub meaning: String,
}

/// An open file of a known kind.
#[derive(Debug, Clone)]
pub(super) struct Stored {
    pub(super) path: PathBuf,
    root: Group,
}

impl Stored {
    /// Opens a file of a kind and of a version `major`.x.
    pub(super) fn open(
        path: &Path,
        wanted: FileKind,
        major: &'static str,
    ) -> Result<Self, ReadError> {
        let found = file_kind(path)?;
        if found != wanted {
            return Err(ReadError::Kind {
                path: path.to_owned(),
                found,
                wanted,
            });
        }
        let root = open_hdf5(path)?.root();
        let stored = Self {
            path: path.to_owned(),
            root: root.map_err(|error| ReadError::Damaged {
                path: path.to_owned(),
                what: error.to_string(),
            })?,
        };
        let version = stored.text("format_version")?;
        if version.split('.').next() != Some(major) {
            return Err(ReadError::Version {
                path: path.to_owned(),
                found: version,
                major,
            });
        }
        Ok(stored)
    }

    /// Something that every such file has is missing or wrong.
    pub(super) fn damaged(&self, what: impl Into<String>) -> ReadError {
        ReadError::Damaged {
            path: self.path.clone(),
            what: what.into(),
        }
    }

    /// A text of the root.
    pub(super) fn text(&self, name: &str) -> Result<String, ReadError> {
        text_of(self.root.attribute(name))
            .ok_or_else(|| self.damaged(format!("the text attribute {name} is missing")))
    }

    /// A number of the root, where it is there.
    pub(super) fn number(&self, name: &str) -> Option<f64> {
        let attribute = self.root.attribute(name).ok()?;
        let real = attribute.number::<f64>().ok();
        real.or_else(|| attribute.number::<u64>().ok().map(|count| count as f64))
    }

    /// A group, where it is there.
    pub(super) fn group(&self, name: &str) -> Option<Group> {
        let mut group = self.root.clone();
        for part in name.split('/').filter(|part| !part.is_empty()) {
            group = group.group(part).ok()?;
        }
        Some(group)
    }

    /// A dataset, where it is there.
    fn dataset(&self, path: &str) -> Option<Dataset> {
        let path = path.trim_start_matches('/');
        match path.rsplit_once('/') {
            Some((group, name)) => self.group(group)?.dataset(name).ok(),
            None => self.root.dataset(path).ok(),
        }
    }

    /// The shape of a dataset, where it is there.
    pub(super) fn shape(&self, path: &str) -> Option<Vec<usize>> {
        Some(self.dataset(path)?.shape().to_vec())
    }

    /// Name, unit and meaning of the datasets of a group that have a shape, in the order of the file.
    pub(super) fn quantities(&self, group: &str, shape: &[usize]) -> Vec<StoredQuantity> {
        let Some(group) = self.group(group) else {
            return Vec::new();
        };
        let found = group.members().filter_map(|name| {
            let dataset = group.dataset(name).ok()?;
            let described = |attribute| text_of(dataset.attribute(attribute)).unwrap_or_default();
            (dataset.shape() == shape).then(|| StoredQuantity {
                unit: described("units"),
                meaning: described("long_name"),
                name: name.to_owned(),
            })
        });
        found.collect()
    }

    /// All numbers of a dataset of a shape.
    pub(super) fn numbers(&self, path: &str, shape: &[usize]) -> Result<Vec<f64>, ReadError> {
        let numbers = self.of_shape(path, shape)?.as_f64(MOST_BYTES);
        numbers.map_err(|error| self.damaged(format!("{path} cannot be read: {error}")))
    }

    /// All numbers of a dataset with one dimension.
    pub(super) fn vector(&self, path: &str) -> Result<Vec<f64>, ReadError> {
        match self.shape(path).as_deref() {
            Some(&[length]) => self.numbers(path, &[length]),
            _ => Err(self.damaged(format!("the list {path} is missing"))),
        }
    }

    /// All texts of a list.
    pub(super) fn texts(&self, path: &str) -> Result<Vec<String>, ReadError> {
        match self.dataset(path) {
            Some(list) if list.shape().len() == 1 => list
                .texts(MOST_BYTES)
                .map_err(|error| self.damaged(format!("{path} cannot be read: {error}"))),
            Some(_) | None => Err(self.damaged(format!("the list {path} is missing"))),
        }
    }

    /// Unit of a dataset and the axis that it belongs to.
    pub(super) fn labels(&self, path: &str) -> Option<(String, String)> {
        let dataset = self.dataset(path)?;
        let unit = text_of(dataset.attribute("units")).unwrap_or_default();
        Some((unit, text_of(dataset.attribute("axis"))?))
    }

    /// Whether a list holds texts.
    pub(super) fn holds_texts(&self, path: &str) -> bool {
        self.dataset(path)
            .is_some_and(|list| list.kind() == Kind::Text)
    }

    /// What a dataset holds at one place of its first dimension.
    pub(super) fn slab<T: Number>(
        &self,
        path: &str,
        shape: &[usize],
        at: usize,
    ) -> Result<Vec<T>, ReadError> {
        let dataset = self.of_shape(path, shape)?;
        let mut block: Vec<_> = shape.iter().map(|&n| 0..n).collect();
        if let Some(first) = block.first_mut() {
            *first = at..at.saturating_add(1);
        }
        let numbers = dataset.block(&block, MOST_BYTES);
        numbers.map_err(|error| self.damaged(format!("{path} cannot be read: {error}")))
    }

    /// Some numbers of a dataset with one dimension of a length.
    pub(super) fn some<T: Number>(
        &self,
        path: &str,
        length: usize,
        rows: Range<usize>,
    ) -> Result<Vec<T>, ReadError> {
        let numbers = self.of_shape(path, &[length])?.block(&[rows], MOST_BYTES);
        numbers.map_err(|error| self.damaged(format!("{path} cannot be read: {error}")))
    }

    /// Which results a group has as datasets of a shape, and how exactly.
    pub(super) fn fields(&self, group: &str, shape: &[usize]) -> Result<Fields, ReadError> {
        let mut fields = Fields::all(self.probed()?);
        let mut kinds = Vec::new();
        let mut places = std::mem::take(&mut fields.places);
        places.retain(|&k| {
            let path = format!("{group}/{}", fields.named(k).name);
            let dataset = self.dataset(&path).filter(|found| found.shape() == shape);
            kinds.extend(dataset.as_ref().map(Dataset::kind));
            dataset.is_some()
        });
        fields.places = places;
        if !kinds.is_empty() && kinds.iter().all(|&kind| kind == f32::KIND) {
            fields.precision = Precision::Single;
        } else if kinds.iter().any(|&kind| kind != f64::KIND) {
            return Err(self.damaged("its results are not of one precision"));
        }
        Ok(fields)
    }

    /// The columns of the probes of a sweep, or of a part of one.
    fn probed(&self) -> Result<Vec<Described>, ReadError> {
        let version = self.text(TEXTS[1])?;
        if ![PROBED_VERSION, part::PROBED_VERSION].contains(&version.as_str()) {
            return Ok(Vec::new());
        }
        let sweep = parse(&self.text(TEXTS[3])?).and_then(|sweep| stored_columns(&sweep));
        sweep.map_err(|error| self.damaged(format!("its sweep cannot be read: {error}")))
    }

    /// Fails where the last number of a dataset of floats cannot be read: the file was cut short.
    pub(super) fn check_end(&self, path: &str, shape: &[usize]) -> Result<(), ReadError> {
        let last: Vec<_> = shape.iter().map(|&n| n.saturating_sub(1)..n).collect();
        let dataset = self.of_shape(path, shape)?;
        let end = if dataset.kind() == f32::KIND {
            dataset.block::<f32>(&last, MOST_BYTES).map(drop)
        } else {
            dataset.block::<f64>(&last, MOST_BYTES).map(drop)
        };
        end.map_err(|error| self.damaged(format!("{path} cannot be read: {error}")))
    }

    /// A dataset that has a shape.
    fn of_shape(&self, path: &str, shape: &[usize]) -> Result<Dataset, ReadError> {
        match self.dataset(path) {
            Some(found) if found.shape() == shape => Ok(found),
            Some(found) => Err(self.damaged(format!(
                "{path} has the shape {:?}, not {shape:?}",
                found.shape()
            ))),
            None => Err(self.damaged(format!("{path} is missing"))),
        }
    }
}
