//! Reading of single items of an open file; each is checked before memory is allocated for it.

use super::error::{BadTable, TableError};
use crate::validate::product;
use ledger::{Dataset, Group, H5Type, HdfFile};
use std::cell::Cell;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Largest ratio of decoded bytes to the size of the file; tables have 2 to 4, and Deflate allows about 1000.
const GROWTH: u64 = 32;

/// An open file.
#[derive(Debug)]
pub(super) struct TableSource {
    pub(super) path: PathBuf,
    pub(super) file: HdfFile,
    /// Bytes of the numbers loaded so far.
    loaded: Cell<u64>,
    /// Decoded bytes of the chunks that contain the nodes read so far.
    pub(super) decoded: Cell<u64>,
}

impl TableSource {
    pub(super) fn new(path: &Path, file: HdfFile) -> Self {
        Self {
            path: path.to_owned(),
            file,
            loaded: Cell::new(0),
            decoded: Cell::new(0),
        }
    }

    /// Compares all bytes with the seal, if the file has one.
    pub(super) fn check_seal(&self) -> Result<(), TableError> {
        let checked = self.file.check();
        checked.map_err(|error| BadTable::Damaged(error.to_string()).of(&self.path))
    }

    /// The groups in a group.
    pub(super) fn groups(&self, parent: &Group) -> Result<Vec<Group>, TableError> {
        let names = parent.members();
        let names = names.map_err(|error| self.item(&parent.path, error))?;
        let groups = names.iter().map(|name| self.group(parent, name));
        groups.collect()
    }

    /// The group `name` in `parent`.
    pub(super) fn group(&self, parent: &Group, name: &str) -> Result<Group, TableError> {
        let group = parent.group(name);
        group.map_err(|error| self.item(&parent.item(name), error))
    }

    /// The dataset `name` of a group, with its `RANK` dimensions.
    pub(super) fn dataset<const RANK: usize>(
        &self,
        place: &Group,
        name: &str,
    ) -> Result<(Dataset, [usize; RANK]), TableError> {
        let item = place.item(name);
        let data = place.dataset(name);
        let data = data.map_err(|error| self.item(&item, error))?;
        let Ok(shape) = data.shape().try_into() else {
            let found = data.shape().len();
            let detail = format!("it has {found} dimensions, needed {RANK}");
            return Err(self.item(&item, detail));
        };
        Ok((data, shape))
    }

    /// The numbers of a dataset with one dimension.
    pub(super) fn list<T: H5Type>(&self, place: &Group, name: &str) -> Result<Vec<T>, TableError> {
        let (data, [count]) = self.dataset(place, name)?;
        self.admit(&place.item(name), count, size_of::<T>())?;
        data.numbers(u64::MAX)
            .map_err(|error| self.item(&place.item(name), error))
    }

    /// The entries `wanted` along the first two dimensions of a dataset, whose dimensions must be `needed`.
    pub(super) fn block(
        &self,
        place: &Group,
        name: &str,
        needed: [usize; 4],
        wanted: &[Range<usize>; 2],
    ) -> Result<Vec<f32>, TableError> {
        let item = place.item(name);
        let (data, found) = self.dataset(place, name)?;
        if found != needed {
            let wrong = format!("{item} has the dimensions {found:?}, needed {needed:?}");
            return Err(self.wrong(wrong));
        }
        let [rows, columns] = wanted.clone();
        let numbers = product(&[rows.len(), columns.len(), needed[2], needed[3]]);
        self.admit(&item, numbers, size_of::<f32>())?;
        let whole = |range: &Range<usize>, size: usize| {
            range.end.saturating_add(size - 1) / size * size - range.start / size * size
        };
        let chunk = data.chunk().filter(|c| c.len() == 4 && !c.contains(&0));
        let [high, wide] = chunk.map_or([1; 2], |chunk| [chunk[0], chunk[1]]);
        let nodes = product(&[whole(&rows, high), whole(&columns, wide)]);
        let decoded = product(&[nodes, needed[2], needed[3], size_of::<f32>()]) as u64;
        self.decoded.set(self.decoded.get().saturating_add(decoded));
        data.block(&[rows, columns, 0..needed[2], 0..needed[3]], u64::MAX)
            .map_err(|error| self.item(&item, error))
    }

    /// The text of an attribute.
    pub(super) fn text(&self, place: &Group, name: &str) -> Result<String, TableError> {
        let text = place.text(name);
        text.map_err(|error| self.item(&place.item(name), error))
    }

    /// The number of an attribute.
    pub(super) fn number<T: H5Type>(&self, place: &Group, name: &str) -> Result<T, TableError> {
        let number = place.number(name);
        number.map_err(|error| self.item(&place.item(name), error))
    }

    /// The list of numbers of an attribute.
    pub(super) fn numbers(&self, place: &Group, name: &str) -> Result<Vec<f64>, TableError> {
        let numbers = place.numbers(name);
        numbers.map_err(|error| self.item(&place.item(name), error))
    }

    /// Counts numbers before they are loaded; an error if the file becomes too large in memory.
    fn admit(&self, item: &str, numbers: usize, width: usize) -> Result<(), TableError> {
        let more = (numbers as u64).saturating_mul(width as u64);
        let needed = self.loaded.get().saturating_add(more);
        let limit = self.file.length().saturating_mul(GROWTH);
        if needed > limit {
            let wrong = format!(
                "{item} brings the numbers to load to {needed} bytes, more than the {limit} that the size of the file allows"
            );
            return Err(self.wrong(wrong));
        }
        self.loaded.set(needed);
        Ok(())
    }

    /// Error of an item that cannot be read, or is invalid.
    #[allow(clippy::needless_pass_by_value, reason = "errors are handed on")]
    pub(super) fn item(&self, item: &str, detail: impl ToString) -> TableError {
        let (item, detail) = (item.to_owned(), detail.to_string());
        BadTable::Item { item, detail }.of(&self.path)
    }

    /// Error of numbers that are not a table.
    #[allow(clippy::needless_pass_by_value, reason = "errors are handed on")]
    pub(super) fn wrong(&self, what: impl ToString) -> TableError {
        BadTable::Wrong(what.to_string()).of(&self.path)
    }
}
