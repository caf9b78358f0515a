//! Reads untrusted HDF5 files without the HDF5 library. On damaged or forged metadata that library crashes, loops,
//! follows links into other files, loads code, or allocates memory without limit.
//!
//! `hdf5_reader` contains no C code, checks addresses and lengths against the file and detects cycles. This module
//! gives it bytes whose checksums were verified, no other file to follow links to, and a memory limit that follows from
//! the file size.

use crate::error::HdfError;
use crate::seal::Sealed;
use hdf5_reader::{
    Attribute, Datatype, H5Type, Hdf5File, OpenOptions, SliceInfo, SliceInfoElem, StringSize,
};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::{fmt, io};

/// Largest number of bytes of numbers per byte of a file: Deflate expands by a little over a thousand.
const GROWTH: usize = 1100;

/// Size of a block in numbers from which several threads are used.
const LARGE: usize = 1 << 18;

/// An open file. If it has a checksum trailer, bytes are verified when they are read.
#[derive(Debug, Clone)]
pub struct HdfFile {
    bytes: Arc<Sealed>,
    /// The root group.
    pub root: Group,
}

impl HdfFile {
    /// Opens the regular file at `path`.
    ///
    /// # Errors
    /// [`HdfError`].
    pub fn open(path: &Path) -> Result<Self, HdfError> {
        let bytes = Arc::new(Sealed::open(path)?);
        let most = (bytes.length as usize).saturating_mul(GROWTH);
        let options = OpenOptions::default()
            .with_chunk_cache_bytes(0)
            .with_max_chunk_bytes(most)
            .with_max_read_bytes(most)
            .with_max_object_header_bytes(bytes.length as usize);
        let file = Hdf5File::from_storage_with_options(Arc::clone(&bytes) as _, options)?;
        let written = file.superblock().eof_address;
        if written > bytes.length {
            return Err(HdfError::Damaged(format!(
                "it was truncated to {} of {written} bytes",
                bytes.length
            )));
        }
        let root = Group {
            group: file.root_group()?,
            path: String::new(),
        };
        Ok(Self { bytes, root })
    }

    /// Length of the HDF5 part in bytes.
    pub fn length(&self) -> u64 {
        self.bytes.length
    }

    /// Whether the file has a checksum trailer.
    pub fn is_sealed(&self) -> bool {
        self.bytes.digests.is_some()
    }

    /// Verifies all bytes of a file that has a checksum trailer.
    ///
    /// # Errors
    /// An error of the operating system, or bytes that differ from their checksum.
    pub fn check(&self) -> io::Result<()> {
        self.bytes.check()
    }
}

/// A group of a file.
#[derive(Clone)]
pub struct Group {
    group: hdf5_reader::group::Group,
    /// Path in the file; empty for the root.
    pub path: String,
}

impl fmt::Debug for Group {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Group").field(&self.path).finish()
    }
}

impl Group {
    /// Path in the file of an item of this group.
    pub fn item(&self, name: &str) -> String {
        format!("{}/{name}", self.path)
    }

    /// Names of the groups and datasets in this group, ascending.
    pub fn members(&self) -> Result<Vec<String>, HdfError> {
        let (mut names, datasets) = self.group.member_names()?;
        names.extend(datasets);
        names.sort();
        Ok(names)
    }

    /// A group, by its path relative to this group.
    pub fn group(&self, path: &str) -> Result<Self, HdfError> {
        let mut names = path.split('/').filter(|name| !name.is_empty());
        let group = names.try_fold(self.group.clone(), |group, name| group.group(name));
        Ok(Self {
            group: group?,
            path: self.item(path),
        })
    }

    /// A dataset, by its path relative to this group.
    pub fn dataset(&self, path: &str) -> Result<Dataset, HdfError> {
        let (group, name) = path.rsplit_once('/').unwrap_or(("", path));
        let data = self.group(group)?.group.dataset(name)?;
        let shape = data.shape().iter().map(|&n| n as usize).collect();
        Ok(Dataset { data, shape })
    }

    /// The text of an attribute.
    pub fn text(&self, name: &str) -> Result<String, HdfError> {
        text(&self.group.attribute(name)?)
    }

    /// The number of an attribute.
    pub fn number<T: H5Type>(&self, name: &str) -> Result<T, HdfError> {
        let attribute = self.group.attribute(name)?;
        same_type::<T>(&attribute.datatype)?;
        if !attribute.shape.is_empty() {
            return refused("it is a list, but one number is required");
        }
        Ok(attribute.read_scalar()?)
    }

    /// The list of numbers of an attribute.
    pub fn numbers<T: H5Type>(&self, name: &str) -> Result<Vec<T>, HdfError> {
        let attribute = self.group.attribute(name)?;
        same_type::<T>(&attribute.datatype)?;
        if attribute.shape.len() != 1 {
            return refused("it is not a list of numbers");
        }
        Ok(attribute.read_1d()?)
    }
}

/// A dataset of a file.
pub struct Dataset {
    data: hdf5_reader::Dataset,
    shape: Vec<usize>,
}

impl Dataset {
    /// Its dimensions; empty for a single value.
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// Number of values.
    pub fn count(&self) -> usize {
        self.shape.iter().copied().fold(1, usize::saturating_mul)
    }

    /// Dimensions of its chunks, if it is chunked.
    pub fn chunk(&self) -> Option<Vec<usize>> {
        let chunk = self.data.chunks()?.into_iter();
        Some(chunk.map(|n| n as usize).collect())
    }

    /// Whether its values are texts.
    pub fn holds_texts(&self) -> bool {
        kind(self.data.dtype()) == TEXT
    }

    /// Whether its values are numbers of a type.
    pub fn holds<T: H5Type>(&self) -> bool {
        same_type::<T>(self.data.dtype()).is_ok()
    }

    /// The text of an attribute.
    pub fn text(&self, name: &str) -> Result<String, HdfError> {
        text(&self.data.attribute(name)?)
    }

    /// All numbers, in the order of the file; they may need at most `limit` bytes of memory.
    pub fn numbers<T: H5Type + Send>(&self, limit: u64) -> Result<Vec<T>, HdfError> {
        let all: Vec<Range<usize>> = self.shape.iter().map(|&n| 0..n).collect();
        self.block(&all, limit)
    }

    /// The numbers of a block; they may need at most `limit` bytes of memory.
    pub fn block<T: H5Type + Send>(
        &self,
        block: &[Range<usize>],
        limit: u64,
    ) -> Result<Vec<T>, HdfError> {
        same_type::<T>(self.data.dtype())?;
        let lengths = block.iter().map(ExactSizeIterator::len);
        let count = lengths.fold(1, usize::saturating_mul);
        admit(count, size_of::<T>(), limit)?;
        if count == 0 {
            return Ok(Vec::new());
        }
        let selection = SliceInfo {
            selections: block.iter().map(range).collect(),
        };
        let in_parallel = || self.data.read_slice_parallel::<T>(&selection);
        // on one thread of several errors the first in order is returned
        let found = match count > LARGE {
            true => in_parallel().or_else(|_| self.data.read_slice::<T>(&selection))?,
            false => self.data.read_slice::<T>(&selection)?,
        };
        if found.len() != count {
            let what = format!("{block:?} is not a block of {:?}", self.shape);
            return Err(HdfError::Damaged(what));
        }
        Ok(found.into_raw_vec_and_offset().0)
    }

    /// All numbers, of any type, as 64-bit floats.
    ///
    /// # Errors
    /// As [`numbers`](Self::numbers).
    pub fn as_f64(&self, limit: u64) -> Result<Vec<f64>, HdfError> {
        admit(self.count(), size_of::<f64>(), limit)?;
        macro_rules! first_of {
            ($($number:ty),*) => {
                $(if self.holds::<$number>() {
                    let numbers = self.numbers::<$number>(limit)?;
                    return Ok(numbers.into_iter().map(|x| x as f64).collect());
                })*
            };
        }
        first_of!(f64, f32, i64, i32, i16, i8, u64, u32, u16, u8);
        wrong_type(&kind(self.data.dtype()), "numbers")
    }

    /// All texts, which are UTF-8.
    pub fn texts(&self, limit: u64) -> Result<Vec<String>, HdfError> {
        admit(self.count(), 16, limit)?;
        Ok(self.data.read_strings()?)
    }
}

/// All of a range of an axis.
fn range(range: &Range<usize>) -> SliceInfoElem {
    SliceInfoElem::Slice {
        start: range.start as u64,
        end: range.end as u64,
        step: 1,
    }
}

const TEXT: &str = "text";

/// Name of a type, without its byte order.
fn kind(datatype: &Datatype) -> String {
    match datatype {
        Datatype::FloatingPoint { size, .. } => format!("{}-bit float", 8 * u32::from(*size)),
        Datatype::FixedPoint { size, signed, .. } => {
            let sign = if *signed { "" } else { "unsigned " };
            format!("{}-bit {sign}integer", 8 * u32::from(*size))
        }
        Datatype::String { .. } => TEXT.to_owned(),
        Datatype::VarLen { base, .. } if base.is_vlen_string_base() => TEXT.to_owned(),
        _ => "neither numbers nor text".to_owned(),
    }
}

fn same_type<T: H5Type>(found: &Datatype) -> Result<(), HdfError> {
    let (found, needed) = (kind(found), kind(&T::hdf5_type()));
    if found == needed {
        return Ok(());
    }
    wrong_type(&found, &needed)
}

fn wrong_type<T>(found: &str, needed: &str) -> Result<T, HdfError> {
    refused(format!("its type is {found}, but {needed} is required"))
}

fn refused<T>(what: impl Into<String>) -> Result<T, HdfError> {
    Err(HdfError::Refused(what.into()))
}

/// The only text of an attribute; a reference that cannot be followed is an error.
fn text(attribute: &Attribute) -> Result<String, HdfError> {
    match (&attribute.datatype, attribute.decoded_strings.as_deref()) {
        (_, Some([text])) => Ok(text.clone()),
        (_, Some(_)) => refused("it is a list, but one text is required"),
        (
            Datatype::String {
                size: StringSize::Fixed(_),
                ..
            },
            None,
        ) => Ok(attribute.read_string()?),
        (found, None) if kind(found) == TEXT => {
            let what = "its text is missing or not UTF-8";
            Err(HdfError::Damaged(what.to_owned()))
        }
        (found, None) => wrong_type(&kind(found), TEXT),
    }
}

fn admit(count: usize, width: usize, limit: u64) -> Result<(), HdfError> {
    let needed = (count as u64).saturating_mul(width as u64);
    if needed <= limit {
        return Ok(());
    }
    refused(format!(
        "it needs {needed} bytes of memory, more than the limit {limit}"
    ))
}
