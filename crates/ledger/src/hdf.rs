//! Reading HDF5 files that nobody vouches for, without the HDF5 library: on damaged or forged metadata it crashes, loops,
//! follows links into other files, loads code, or takes memory without end.
//!
//! `hdf5_reader` has no C code; it compares addresses and lengths with the file and ends at circles. Here it is given bytes
//! that were compared with the seal, no other file to follow links to, and no more memory than the file can fill.

use crate::error::HdfError;
use crate::seal::Sealed;
use hdf5_reader::{
    Attribute, Datatype, H5Type, Hdf5File, OpenOptions, SliceInfo, SliceInfoElem, StringSize,
};
use rayon::prelude::*;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::{fmt, io};

/// Bytes of numbers that a byte of a file may become: Deflate ends a little above a thousand.
const GROWTH: usize = 1100;

/// Numbers of a block that are worth more than one thread.
const LARGE: usize = 1 << 18;
/// Parts of such a block.
const BLOCK_PARTS: usize = 16;

/// An open file; its bytes are compared with its seal, where it has one, when they are read.
#[derive(Debug, Clone)]
pub struct HdfFile {
    bytes: Arc<Sealed>,
    /// The group that holds all others.
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
                "it was cut short to {} bytes, {written} were written",
                bytes.length
            )));
        }
        let root = Group {
            group: file.root_group()?,
            path: String::new(),
        };
        Ok(Self { bytes, root })
    }

    /// Bytes of the HDF5 part.
    pub fn length(&self) -> u64 {
        self.bytes.length
    }

    /// Whether it has a seal.
    pub fn is_sealed(&self) -> bool {
        self.bytes.digests.is_some()
    }

    /// Compares every byte with the seal, where there is one.
    ///
    /// # Errors
    /// What the system says, or where bytes are not those that were sealed.
    pub fn check(&self) -> io::Result<()> {
        self.bytes.check()
    }
}

/// A group of a file.
#[derive(Clone)]
pub struct Group {
    group: hdf5_reader::group::Group,
    /// Where it is in the file; nothing for the root.
    pub path: String,
}

impl fmt::Debug for Group {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Group").field(&self.path).finish()
    }
}

impl Group {
    /// Where something in it is in the file.
    pub fn item(&self, name: &str) -> String {
        format!("{}/{name}", self.path)
    }

    /// Names of the groups and datasets in it, ascending.
    pub fn members(&self) -> Result<Vec<String>, HdfError> {
        let (mut names, datasets) = self.group.member_names()?;
        names.extend(datasets);
        names.sort();
        Ok(names)
    }

    /// A group in it, by its path from here.
    pub fn group(&self, path: &str) -> Result<Self, HdfError> {
        let mut names = path.split('/').filter(|name| !name.is_empty());
        let group = names.try_fold(self.group.clone(), |group, name| group.group(name));
        Ok(Self {
            group: group?,
            path: self.item(path),
        })
    }

    /// A dataset in it, by its path from here.
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
            return refused("it is a list, needed one number");
        }
        Ok(attribute.read_scalar()?)
    }

    /// The list of numbers of an attribute.
    pub fn numbers<T: H5Type>(&self, name: &str) -> Result<Vec<T>, HdfError> {
        let attribute = self.group.attribute(name)?;
        same_type::<T>(&attribute.datatype)?;
        if attribute.shape.len() != 1 {
            return refused("it is no list of numbers");
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
    /// Its dimensions; none of a single value.
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// How many values it has.
    pub fn count(&self) -> usize {
        self.shape.iter().copied().fold(1, usize::saturating_mul)
    }

    /// Dimensions of its chunks, if it has them.
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

    /// All its numbers, in the order of the file, which take `limit` bytes of memory at most.
    pub fn numbers<T: H5Type + Send>(&self, limit: u64) -> Result<Vec<T>, HdfError> {
        let all: Vec<Range<usize>> = self.shape.iter().map(|&n| 0..n).collect();
        self.block(&all, limit)
    }

    /// The numbers of a block of it, which take `limit` bytes of memory at most.
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
        let high = self.chunk().and_then(|chunk| chunk.first().copied());
        let (Some(high @ 1..), true) = (high, count > LARGE) else {
            return self.read(block, count);
        };
        let rows = &block[0];
        let (first, end) = (rows.start / high, rows.end.div_ceil(high));
        let step = (end - first).div_ceil(BLOCK_PARTS);
        let parts = (first..end).into_par_iter().step_by(step).map(|k| {
            let part = rows.start.max(k * high)..rows.end.min((k + step).saturating_mul(high));
            let count = count / rows.len() * part.len();
            self.read(&[&[part], &block[1..]].concat(), count)
        });
        // of several that fail it is the first that is told, whatever the threads
        let parts = parts.collect::<Vec<_>>().into_iter();
        Ok(parts.collect::<Result<Vec<_>, _>>()?.concat())
    }

    /// `count` numbers, which a block has, on this thread.
    fn read<T: H5Type>(&self, block: &[Range<usize>], count: usize) -> Result<Vec<T>, HdfError> {
        let slice = |range: &Range<usize>| SliceInfoElem::Slice {
            start: range.start as u64,
            end: range.end as u64,
            step: 1,
        };
        let selections = block.iter().map(slice).collect();
        let found = self.data.read_slice::<T>(&SliceInfo { selections })?;
        if found.len() != count {
            let what = format!("{block:?} is no block of {:?}", self.shape);
            return Err(HdfError::Damaged(what));
        }
        Ok(found.into_raw_vec_and_offset().0)
    }

    /// All its numbers, whatever their type, as 64-bit floats.
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

    /// All its texts, which are UTF-8.
    pub fn texts(&self, limit: u64) -> Result<Vec<String>, HdfError> {
        admit(self.count(), 16, limit)?;
        Ok(self.data.read_strings()?)
    }
}

const TEXT: &str = "text";

/// A type in words, whatever the order of its bytes.
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
    refused(format!("its type is {found}, needed {needed}"))
}

fn refused<T>(what: impl Into<String>) -> Result<T, HdfError> {
    Err(HdfError::Refused(what.into()))
}

/// The one text of an attribute; a reference to a text that cannot be followed is none itself.
fn text(attribute: &Attribute) -> Result<String, HdfError> {
    match (&attribute.datatype, attribute.decoded_strings.as_deref()) {
        (_, Some([text])) => Ok(text.clone()),
        (_, Some(_)) => refused("it is a list, needed one text"),
        (
            Datatype::String {
                size: StringSize::Fixed(_),
                ..
            },
            None,
        ) => Ok(attribute.read_string()?),
        (found, None) if kind(found) == TEXT => {
            let what = "its text is not there or not UTF-8";
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
        "it makes {needed} bytes of numbers, more than {limit}"
    ))
}
