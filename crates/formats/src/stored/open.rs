//! An open file, and bounded reading from it.

use super::error::ReadError;
use super::file::{file_kind, open_hdf5, text_of};
use super::kind::FileKind;
use hdf5::types::VarLenUnicode;
use hdf5::{File, Group, H5Type, Hyperslab, SliceOrIndex};
use std::path::{Path, PathBuf};

/// Most values that are read from a dataset at once: 512 MiB of doubles.
const MOST_VALUES: usize = 1 << 26;

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
    file: File,
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
        let stored = Self {
            path: path.to_owned(),
            file: open_hdf5(path)?,
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
        text_of(&self.file, name)
            .ok_or_else(|| self.damaged(format!("the text attribute {name} is missing")))
    }

    /// A number of the root, where it is there.
    pub(super) fn number(&self, name: &str) -> Option<f64> {
        self.file.attr(name).ok()?.read_scalar().ok()
    }

    /// A group, where it is there.
    pub(super) fn group(&self, name: &str) -> Option<Group> {
        self.file.group(name).ok()
    }

    /// The shape of a dataset, where it is there.
    pub(super) fn shape(&self, path: &str) -> Option<Vec<usize>> {
        Some(self.file.dataset(path).ok()?.shape())
    }

    /// Name, unit and meaning of the datasets of a group that have a shape, in the order of the file.
    pub(super) fn quantities(&self, group: &str, shape: &[usize]) -> Vec<StoredQuantity> {
        let names = self.group(group).and_then(|g| g.member_names().ok());
        let found = names.unwrap_or_default().into_iter().filter_map(|name| {
            let dataset = self.file.dataset(&format!("{group}/{name}")).ok()?;
            let described = |attribute| text_of(&dataset, attribute).unwrap_or_default();
            (dataset.shape() == shape).then(|| StoredQuantity {
                unit: described("units"),
                meaning: described("long_name"),
                name,
            })
        });
        found.collect()
    }

    /// All numbers of a dataset of a shape.
    pub(super) fn numbers(&self, path: &str, shape: &[usize]) -> Result<Vec<f64>, ReadError> {
        self.check(path, shape)?;
        self.raw(path)
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
        let found: Vec<VarLenUnicode> = match self.shape(path).as_deref() {
            Some(&[length]) => {
                self.check(path, &[length])?;
                self.raw(path)?
            }
            _ => return Err(self.damaged(format!("the list {path} is missing"))),
        };
        Ok(found.into_iter().map(|text| text.to_string()).collect())
    }

    /// Unit of a dataset and the axis that it belongs to.
    pub(super) fn labels(&self, path: &str) -> Option<(String, String)> {
        let dataset = self.file.dataset(path).ok()?;
        let unit = text_of(&dataset, "units").unwrap_or_default();
        Some((unit, text_of(&dataset, "axis")?))
    }

    /// Whether a list holds texts.
    pub(super) fn holds_texts(&self, path: &str) -> bool {
        let kind = self.file.dataset(path).and_then(|d| d.dtype());
        kind.and_then(|kind| kind.to_descriptor())
            .is_ok_and(|kind| matches!(kind, hdf5::types::TypeDescriptor::VarLenUnicode))
    }

    /// What a dataset holds at one place of its first dimension.
    pub(super) fn slab<T: H5Type>(
        &self,
        path: &str,
        shape: &[usize],
        at: usize,
    ) -> Result<Vec<T>, ReadError> {
        let bound: usize = shape[1..].iter().product();
        self.bounded(path, bound)?;
        let all = SliceOrIndex::Unlimited {
            start: 0,
            step: 1,
            block: 1,
        };
        let mut slab = vec![SliceOrIndex::Index(at)];
        slab.resize(shape.len(), all);
        let dataset = self
            .file
            .dataset(path)
            .ok()
            .filter(|d| d.shape() == shape)
            .ok_or_else(|| self.damaged(format!("{path} is missing or not of shape {shape:?}")))?;
        let read = dataset.read_slice::<T, _, ndarray::IxDyn>(Hyperslab::from(slab));
        read.map(|found| found.into_iter().collect())
            .map_err(|_| self.damaged(format!("{path} cannot be read")))
    }

    fn check(&self, path: &str, shape: &[usize]) -> Result<(), ReadError> {
        match self.shape(path) {
            Some(found) if found == shape => self.bounded(path, shape.iter().product()),
            Some(found) => {
                Err(self.damaged(format!("{path} has the shape {found:?}, not {shape:?}")))
            }
            None => Err(self.damaged(format!("{path} is missing"))),
        }
    }

    fn bounded(&self, path: &str, values: usize) -> Result<(), ReadError> {
        if values <= MOST_VALUES {
            return Ok(());
        }
        Err(self.damaged(format!(
            "{path} has {values} values, more than the {MOST_VALUES} that are read at once"
        )))
    }

    fn raw<T: H5Type>(&self, path: &str) -> Result<Vec<T>, ReadError> {
        let dataset = self.file.dataset(path);
        dataset
            .and_then(|dataset| dataset.read_raw())
            .map_err(|_| self.damaged(format!("{path} cannot be read")))
    }
}
