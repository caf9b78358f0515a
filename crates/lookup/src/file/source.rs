//! Reading single items of an open file: each is looked at before memory is asked for it.

use super::error::TableError;
use super::seal::Cover;
use crate::error::ContentError;
use hdf5::dataset::Layout;
use hdf5::filters::Filter;
use hdf5::types::{TypeDescriptor, VarLenUnicode};
use hdf5::{Attribute, Dataset, File, Group, H5Type, LinkType};
use ndarray::s;
use std::cell::Cell;
use std::path::{Path, PathBuf};

/// Bytes of numbers that a byte of a file may become: tables have 2 to 4, the compression itself ends at a thousand.
const GROWTH: u64 = 256;
/// Entries of a list that is an attribute.
const MOST_IN_ATTRIBUTE: usize = 1 << 12;

/// A file that is being read.
#[derive(Debug)]
pub(super) struct Source {
    path: PathBuf,
    file: File,
    bytes: u64,
    cover: Cover,
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
    pub(super) fn new(path: &Path, file: File, bytes: u64, cover: Cover) -> Self {
        Self {
            path: path.to_owned(),
            file,
            bytes,
            cover,
            loaded: Cell::new(0),
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn cover(&self) -> Cover {
        self.cover
    }

    /// The root, all members of which are hard links.
    pub(super) fn root(&self) -> Result<Place, TableError> {
        let place = Place {
            group: (*self.file).clone(),
            name: String::new(),
        };
        self.members(&place)?;
        Ok(place)
    }

    /// Names of what a group holds, all of it by hard links.
    pub(super) fn members(&self, place: &Place) -> Result<Vec<String>, TableError> {
        let mut names = Vec::new();
        let mut elsewhere = None;
        place
            .group
            .iter_visit_default(|name, link| {
                match link.link_type {
                    LinkType::Hard => names.push(name.to_owned()),
                    LinkType::Soft | LinkType::External => elsewhere = Some(name.to_owned()),
                }
                Ok(())
            })
            .map_err(|error| self.unreadable(&place.name, &error))?;
        match elsewhere {
            None => Ok(names),
            Some(name) => Err(self.item(&place.item(&name), "links are not followed")),
        }
    }

    /// The group `name` in `parent`, all members of which are hard links.
    pub(super) fn group(&self, parent: &Place, name: &str) -> Result<Place, TableError> {
        let name_in_file = parent.item(name);
        let group = parent.group.group(name);
        let group = group.map_err(|error| self.unreadable(&name_in_file, &error))?;
        let place = Place {
            group,
            name: name_in_file,
        };
        self.members(&place)?;
        Ok(place)
    }

    /// The dataset `name` of a group, of `rank` dimensions: its numbers are of type `T`, in this file, all of them.
    pub(super) fn dataset<T: H5Type>(
        &self,
        place: &Place,
        name: &str,
        rank: usize,
    ) -> Result<Dataset, TableError> {
        let item = place.item(name);
        let failed = |error: &hdf5::Error| self.unreadable(&item, error);
        let data = place.group.dataset(name).map_err(|error| failed(&error))?;
        let stored = data.dtype().and_then(|stored| stored.to_descriptor());
        let stored = stored.map_err(|error| failed(&error))?;
        if stored != T::type_descriptor() {
            let detail = format!("its type is {stored}, needed {}", T::type_descriptor());
            return Err(self.item(&item, &detail));
        }
        if data.ndim() != rank {
            let detail = format!("it has {} dimensions, needed {rank}", data.ndim());
            return Err(self.item(&item, &detail));
        }
        self.stored_here(&data, size_of::<T>())
            .map_err(|detail| self.item(&item, &detail))?;
        Ok(data)
    }

    /// Whether all numbers of a dataset are stored, in this file.
    fn stored_here(&self, data: &Dataset, width: usize) -> Result<(), String> {
        let plan = data.create_plist().map_err(|error| first_line(&error))?;
        let external = plan.get_external().map_err(|error| first_line(&error))?;
        if !external.is_empty() {
            return Err("its numbers are in another file".to_owned());
        }
        let shape = data.shape();
        let numbers = shape
            .iter()
            .fold(1_u64, |all, &n| all.saturating_mul(n as u64));
        if numbers == 0 {
            return Ok(());
        }
        let layout = plan.get_layout().map_err(|error| first_line(&error))?;
        if data.storage_size() > self.bytes {
            let detail = format!("it takes {} bytes of the file", data.storage_size());
            return Err(detail);
        }
        if layout == Layout::Chunked {
            let filters = plan.get_filters().map_err(|error| first_line(&error))?;
            return chunks(data, &shape, &filters);
        }
        if layout != Layout::Contiguous && layout != Layout::Compact {
            return Err("its numbers are those of other datasets".to_owned());
        }
        let needed = numbers.saturating_mul(width as u64);
        if data.storage_size() != needed {
            let detail = format!("{} of its {needed} bytes are stored", data.storage_size());
            return Err(detail);
        }
        Ok(())
    }

    /// A list of numbers.
    pub(super) fn list<T: H5Type>(&self, place: &Place, name: &str) -> Result<Vec<T>, TableError> {
        let data = self.dataset::<T>(place, name, 1)?;
        self.admit(&place.item(name), data.size(), size_of::<T>())?;
        data.read_raw()
            .map_err(|error| self.unreadable(&place.item(name), &error))
    }

    /// Dimensions of a dataset over (r, z, .., ..).
    pub(super) fn dimensions(&self, place: &Place, name: &str) -> Result<[usize; 4], TableError> {
        let shape = self.dataset::<f32>(place, name, 4)?.shape();
        <[usize; 4]>::try_from(shape).map_err(|_| self.item(&place.item(name), "no dimensions"))
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
            return Err(TableError::Dimensions {
                path: self.path.clone(),
                item,
                needed: needed.to_vec(),
                found: data.shape(),
            });
        }
        let [rows, columns] = [count[0].min(needed[0]), count[1].min(needed[1])];
        let numbers = crate::validate::product(&[rows, columns, needed[2], needed[3]]);
        self.admit(&item, numbers, size_of::<f32>())?;
        let read = if [rows, columns] == needed[..2] {
            data.read_raw()
        } else {
            data.read_slice::<f32, _, ndarray::Ix4>(s![..rows, ..columns, .., ..])
                .map(|array| array.into_raw_vec_and_offset().0)
        };
        read.map_err(|error| self.unreadable(&item, &error))
    }

    /// A text that is an attribute.
    pub(super) fn text(&self, place: &Place, name: &str) -> Result<String, TableError> {
        let attribute = self.attribute::<VarLenUnicode>(place, name)?;
        let item = place.item(name);
        if !attribute.is_scalar() {
            return Err(self.item(&item, "it is a list, needed one text"));
        }
        let text: VarLenUnicode = attribute
            .read_scalar()
            .map_err(|error| self.unreadable(&item, &error))?;
        // The binding takes the bytes for UTF-8 without looking.
        String::from_utf8(text.as_bytes().to_vec()).map_err(|_| self.item(&item, "it is not UTF-8"))
    }

    /// A number that is an attribute.
    pub(super) fn number<T: H5Type>(&self, place: &Place, name: &str) -> Result<T, TableError> {
        let attribute = self.attribute::<T>(place, name)?;
        if !attribute.is_scalar() {
            return Err(self.item(&place.item(name), "it is a list, needed one number"));
        }
        attribute
            .read_scalar()
            .map_err(|error| self.unreadable(&place.item(name), &error))
    }

    /// A list of numbers that is an attribute.
    pub(super) fn numbers(&self, place: &Place, name: &str) -> Result<Vec<f64>, TableError> {
        let attribute = self.attribute::<f64>(place, name)?;
        if attribute.ndim() != 1 || attribute.size() > MOST_IN_ATTRIBUTE {
            return Err(self.item(&place.item(name), "it is no list of numbers"));
        }
        attribute
            .read_raw()
            .map_err(|error| self.unreadable(&place.item(name), &error))
    }

    fn attribute<T: H5Type>(&self, place: &Place, name: &str) -> Result<Attribute, TableError> {
        let item = place.item(name);
        let failed = |error: &hdf5::Error| self.unreadable(&item, error);
        let attribute = place.group.attr(name).map_err(|error| failed(&error))?;
        let stored: TypeDescriptor = attribute
            .dtype()
            .and_then(|stored| stored.to_descriptor())
            .map_err(|error| failed(&error))?;
        if stored == T::type_descriptor() {
            return Ok(attribute);
        }
        let detail = format!("its type is {stored}, needed {}", T::type_descriptor());
        Err(self.item(&item, &detail))
    }

    /// Counts numbers that are about to be loaded.
    fn admit(&self, item: &str, numbers: usize, width: usize) -> Result<(), TableError> {
        let more = (numbers as u64).saturating_mul(width as u64);
        let needed = self.loaded.get().saturating_add(more);
        let limit = self.bytes.saturating_mul(GROWTH);
        if needed > limit {
            return Err(TableError::TooLarge {
                path: self.path.clone(),
                item: item.to_owned(),
                needed,
                limit,
            });
        }
        self.loaded.set(needed);
        Ok(())
    }

    /// An item that is not as it should be.
    pub(super) fn item(&self, item: &str, detail: &str) -> TableError {
        TableError::Item {
            path: self.path.clone(),
            item: item.to_owned(),
            detail: detail.to_owned(),
        }
    }

    /// An item that the library cannot read.
    pub(super) fn unreadable(&self, item: &str, error: &hdf5::Error) -> TableError {
        self.item(item, &first_line(error))
    }

    /// Numbers of the file that are no table.
    pub(super) fn content(&self, source: impl Into<ContentError>) -> TableError {
        TableError::Content {
            path: self.path.clone(),
            source: source.into(),
        }
    }
}

/// Whether chunks are all there, no larger than the dataset, with filters that the library brings itself.
fn chunks(data: &Dataset, shape: &[usize], filters: &[Filter]) -> Result<(), String> {
    let known = |filter: &Filter| {
        matches!(
            filter,
            Filter::Deflate(_) | Filter::Shuffle | Filter::Fletcher32
        )
    };
    if let Some(filter) = filters.iter().find(|filter| !known(filter)) {
        return Err(format!("the filter {filter:?} is none of the format"));
    }
    if !filters.contains(&Filter::Fletcher32) {
        return Err("its chunks have no Fletcher-32 sum".to_owned());
    }
    let chunk = data.chunk().unwrap_or_default();
    let fits = |(&part, &whole): (&usize, &usize)| part > 0 && part <= whole;
    if chunk.len() != shape.len() || !chunk.iter().zip(shape).all(fits) {
        return Err(format!("its chunks are {chunk:?} of {shape:?}"));
    }
    let parts: Vec<usize> = shape
        .iter()
        .zip(&chunk)
        .map(|(n, c)| n.div_ceil(*c))
        .collect();
    let needed = crate::validate::product(&parts);
    match data.num_chunks() {
        Some(found) if found == needed => Ok(()),
        found => Err(format!(
            "{} of its {needed} chunks are there",
            found.unwrap_or(0)
        )),
    }
}

/// The first line of what the HDF5 library says.
pub(super) fn first_line(error: &hdf5::Error) -> String {
    error
        .to_string()
        .lines()
        .next()
        .unwrap_or_default()
        .to_owned()
}
