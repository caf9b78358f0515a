//! Reading single items of an open file: each is looked at before memory is asked for it.

use super::error::{BadTable, TableError};
use crate::error::ContentError;
use hdfread::{Attribute, Dataset, File, Group, HdfError, Number};
use ledger::Seal;
use std::cell::Cell;
use std::path::{Path, PathBuf};

/// Bytes of numbers that a byte of a file may become: tables have 2 to 4, the compression itself ends at a thousand.
const GROWTH: u64 = 32;

/// A file that is being read.
#[derive(Debug)]
pub(super) struct Source {
    path: PathBuf,
    file: File,
    bytes: u64,
    seal: Option<Seal>,
    /// Bytes of numbers loaded so far.
    loaded: Cell<u64>,
}

/// A group of the file, with its path inside it for messages.
#[derive(Debug, Clone)]
pub(super) struct Place {
    group: Group,
    name: String,
}

impl Place {
    /// Path of an item of the group.
    pub(super) fn item(&self, name: &str) -> String {
        format!("{}/{name}", self.name)
    }
}

impl Source {
    pub(super) fn new(path: &Path, file: File, seal: Option<Seal>) -> Self {
        Self {
            path: path.to_owned(),
            bytes: file.length(),
            file,
            seal,
            loaded: Cell::new(0),
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn is_sealed(&self) -> bool {
        self.seal.is_some()
    }

    /// Compares all bytes, where the file has a seal.
    pub(super) fn check_seal(&self) -> Result<(), TableError> {
        let checked = self.seal.as_ref().map_or(Ok(()), Seal::check);
        checked.map_err(|error| BadTable::Damaged(error.to_string()).of(&self.path))
    }

    /// The root.
    pub(super) fn root(&self) -> Result<Place, TableError> {
        let group = self.file.root();
        Ok(Place {
            group: group.map_err(|error| self.unreadable("/", &error))?,
            name: String::new(),
        })
    }

    /// Names of what a group holds.
    pub(super) fn members(place: &Place) -> Vec<String> {
        place.group.members().map(str::to_owned).collect()
    }

    /// The group `name` in `parent`.
    pub(super) fn group(&self, parent: &Place, name: &str) -> Result<Place, TableError> {
        let name_in_file = parent.item(name);
        let group = parent.group.group(name);
        Ok(Place {
            group: group.map_err(|error| self.unreadable(&name_in_file, &error))?,
            name: name_in_file,
        })
    }

    /// The dataset `name` of a group, of `rank` dimensions: its numbers are of type `T`, in this file, all of them.
    pub(super) fn dataset<T: Number>(
        &self,
        place: &Place,
        name: &str,
        rank: usize,
    ) -> Result<Dataset, TableError> {
        let item = place.item(name);
        let data = place.group.dataset(name);
        let data = data.map_err(|error| self.unreadable(&item, &error))?;
        if data.kind() != T::KIND {
            let detail = format!("its type is {}, needed {}", data.kind(), T::KIND);
            return Err(self.item(&item, &detail));
        }
        let found = data.shape().len();
        if found != rank {
            let detail = format!("it has {found} dimensions, needed {rank}");
            return Err(self.item(&item, &detail));
        }
        let chunk = match data.chunk() {
            Some(chunk) if data.count() > 0 => chunk,
            Some(_) | None => return Ok(data),
        };
        let fits = |(&part, &whole): (&usize, &usize)| part <= whole;
        if !chunk.iter().zip(data.shape()).all(fits) {
            let detail = format!("its chunks are {chunk:?} of {:?}", data.shape());
            return Err(self.item(&item, &detail));
        }
        if !data.has_sums() {
            return Err(self.item(&item, "its chunks have no Fletcher-32 sum"));
        }
        Ok(data)
    }

    /// A list of numbers.
    pub(super) fn list<T: Number>(&self, place: &Place, name: &str) -> Result<Vec<T>, TableError> {
        let data = self.dataset::<T>(place, name, 1)?;
        self.admit(&place.item(name), data.count(), size_of::<T>())?;
        data.numbers(u64::MAX)
            .map_err(|error| self.unreadable(&place.item(name), &error))
    }

    /// Dimensions of a dataset over (r, z, .., ..).
    pub(super) fn dimensions(&self, place: &Place, name: &str) -> Result<[usize; 4], TableError> {
        let data = self.dataset::<f32>(place, name, 4)?;
        <[usize; 4]>::try_from(data.shape())
            .map_err(|_| self.item(&place.item(name), "no dimensions"))
    }

    /// The first `count` entries along the first two dimensions of a dataset, which has the dimensions `needed`.
    pub(super) fn corner(
        &self,
        place: &Place,
        name: &str,
        needed: [usize; 4],
        count: [usize; 2],
    ) -> Result<Vec<f32>, TableError> {
        let item = place.item(name);
        let data = self.dataset::<f32>(place, name, 4)?;
        if data.shape() != needed {
            let (needed, found) = (needed.to_vec(), data.shape().to_vec());
            return Err(BadTable::Dimensions {
                item,
                needed,
                found,
            }
            .of(&self.path));
        }
        let [rows, columns] = [count[0].min(needed[0]), count[1].min(needed[1])];
        let numbers = crate::validate::product(&[rows, columns, needed[2], needed[3]]);
        self.admit(&item, numbers, size_of::<f32>())?;
        data.block(&[0..rows, 0..columns, 0..needed[2], 0..needed[3]], u64::MAX)
            .map_err(|error| self.unreadable(&item, &error))
    }

    /// A text that is an attribute.
    pub(super) fn text(&self, place: &Place, name: &str) -> Result<String, TableError> {
        let text = self.attribute(place, name)?.text();
        text.map_err(|error| self.unreadable(&place.item(name), &error))
    }

    /// A number that is an attribute.
    pub(super) fn number<T: Number>(&self, place: &Place, name: &str) -> Result<T, TableError> {
        let number = self.attribute(place, name)?.number();
        number.map_err(|error| self.unreadable(&place.item(name), &error))
    }

    /// A list of numbers that is an attribute.
    pub(super) fn numbers(&self, place: &Place, name: &str) -> Result<Vec<f64>, TableError> {
        let attribute = self.attribute(place, name)?;
        if attribute.shape().len() != 1 {
            return Err(self.item(&place.item(name), "it is no list of numbers"));
        }
        let numbers = attribute.numbers();
        numbers.map_err(|error| self.unreadable(&place.item(name), &error))
    }

    fn attribute(&self, place: &Place, name: &str) -> Result<Attribute, TableError> {
        let found = place.group.attribute(name);
        found.map_err(|error| self.unreadable(&place.item(name), &error))
    }

    /// Counts numbers that are about to be loaded.
    fn admit(&self, item: &str, numbers: usize, width: usize) -> Result<(), TableError> {
        let more = (numbers as u64).saturating_mul(width as u64);
        let needed = self.loaded.get().saturating_add(more);
        let limit = self.bytes.saturating_mul(GROWTH);
        if needed > limit {
            let item = item.to_owned();
            return Err(BadTable::TooLarge {
                item,
                needed,
                limit,
            }
            .of(&self.path));
        }
        self.loaded.set(needed);
        Ok(())
    }

    /// An item that is not as it should be.
    pub(super) fn item(&self, item: &str, detail: &str) -> TableError {
        let (item, detail) = (item.to_owned(), detail.to_owned());
        BadTable::Item { item, detail }.of(&self.path)
    }

    /// An item that cannot be read.
    pub(super) fn unreadable(&self, item: &str, error: &HdfError) -> TableError {
        self.item(item, &error.to_string())
    }

    /// Numbers of the file that are no table.
    pub(super) fn content(&self, source: impl Into<ContentError>) -> TableError {
        BadTable::Content(source.into()).of(&self.path)
    }
}
