//! Datasets: where their numbers are, and reading them.

use crate::attribute::{Attribute, wrong_type};
use crate::block::copy;
use crate::bytes::{Cursor, name};
use crate::chunks::{self, Chunk};
use crate::error::{HdfError, damaged, unsupported};
use crate::file::NOWHERE;
use crate::filter::{self, Filter};
use crate::heap::Texts;
use crate::kind::{Kind, Number, as_f64};
use crate::object::{Object, kind};
use crate::space::{MOST_DIMENSIONS, Space, product};
use std::ops::Range;

/// A dataset all numbers of which are stored, in the same file.
#[derive(Debug, Clone)]
pub struct Dataset {
    object: Object,
    kind: Kind,
    shape: Vec<usize>,
    layout: Layout,
    filters: Vec<Filter>,
}

/// Where the numbers are.
#[derive(Debug, Clone)]
enum Layout {
    /// In the header.
    Compact(Vec<u8>),
    /// In one piece at an address.
    Contiguous(u64),
    /// In chunks of these dimensions.
    Chunked(Vec<usize>, Vec<Chunk>),
}

impl Dataset {
    pub(crate) fn load(object: &Object) -> Result<Self, HdfError> {
        let needed = |kind: u16, what: &str| {
            let found = object.message(kind)?;
            found.ok_or_else(|| damaged(format!("a dataset has no {what}")))
        };
        let shape = Space::parse(&mut Cursor::new(
            needed(kind::SPACE, "dimensions")?,
            "dimensions",
        ))?;
        let kind = Kind::parse(&mut Cursor::new(needed(kind::TYPE, "type")?, "a type"))?;
        if object.message(kind::EXTERNAL)?.is_some() {
            return Err(unsupported("a dataset whose numbers are in another file"));
        }
        let filters = match object.message(kind::FILTERS)? {
            Some(message) => filter::parse(message)?,
            None => Vec::new(),
        };
        let shape = shape.shape().to_vec();
        let mut dataset = Self {
            kind,
            shape,
            layout: Layout::Compact(Vec::new()),
            filters,
            object: object.clone(),
        };
        if kind.bytes() == 0 {
            return Err(damaged("a dataset of values without bytes"));
        }
        dataset.layout = dataset.find(needed(kind::LAYOUT, "layout")?)?;
        Ok(dataset)
    }

    /// Its type.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Its dimensions; none of a single value.
    #[must_use]
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// How many values it has.
    #[must_use]
    pub fn count(&self) -> usize {
        product(&self.shape)
    }

    /// Dimensions of its chunks, if it has them.
    #[must_use]
    pub fn chunk(&self) -> Option<&[usize]> {
        match &self.layout {
            Layout::Chunked(chunk, _) => Some(chunk),
            Layout::Compact(_) | Layout::Contiguous(_) => None,
        }
    }

    /// What its chunks went through.
    #[must_use]
    pub fn filters(&self) -> &[Filter] {
        &self.filters
    }

    /// Whether each of its chunks has a checksum.
    #[must_use]
    pub fn has_sums(&self) -> bool {
        let sum = self.filters.iter().position(|f| *f == Filter::Fletcher32);
        match (&self.layout, sum) {
            (Layout::Chunked(_, chunks), Some(sum)) => {
                chunks.iter().all(|chunk| chunk.skipped >> sum & 1 == 0)
            }
            _ => false,
        }
    }

    /// An attribute of the dataset.
    pub fn attribute(&self, name: &str) -> Result<Attribute, HdfError> {
        Attribute::find(&self.object, name)
    }

    /// All its numbers, in the order of the file, which take `limit` bytes of memory at most.
    pub fn numbers<T: Number>(&self, limit: u64) -> Result<Vec<T>, HdfError> {
        let all: Vec<Range<usize>> = self.shape.iter().map(|&n| 0..n).collect();
        self.block(&all, limit)
    }

    /// All its numbers, whatever their type, as 64-bit floats.
    ///
    /// # Errors
    /// As [`numbers`](Self::numbers).
    pub fn as_f64(&self, limit: u64) -> Result<Vec<f64>, HdfError> {
        if !self.kind.is_number() {
            return Err(HdfError::Type {
                found: self.kind.to_string(),
                needed: "numbers".to_owned(),
            });
        }
        let all: Vec<Range<usize>> = self.shape.iter().map(|&n| 0..n).collect();
        admit(self.count(), 8_usize.max(self.kind.bytes()), limit)?;
        let mut numbers = vec![0.0; self.count()];
        let kind = self.kind;
        self.visit(&all, |from, bytes| {
            for (slot, value) in numbers[from..]
                .iter_mut()
                .zip(bytes.chunks_exact(kind.bytes()))
            {
                *slot = as_f64(kind, value).unwrap_or(f64::NAN);
            }
        })?;
        Ok(numbers)
    }

    /// All its texts, which are UTF-8.
    pub fn texts(&self, limit: u64) -> Result<Vec<String>, HdfError> {
        if self.kind != Kind::Text {
            return Err(wrong_type(self.kind, Kind::Text));
        }
        admit(self.count(), self.kind.bytes(), limit)?;
        let all: Vec<Range<usize>> = self.shape.iter().map(|&n| 0..n).collect();
        let width = self.kind.bytes();
        let mut places = vec![0; self.count() * width];
        self.visit(&all, |from, bytes| {
            let to = from * width + bytes.len();
            if let Some(slots) = places.get_mut(from * width..to) {
                slots.copy_from_slice(bytes);
            }
        })?;
        let mut texts = Texts::new(&self.object.file, limit);
        let found = places.chunks_exact(width).map(|place| texts.at(place));
        found
            .map(|bytes| name(&bytes?).map(str::to_owned))
            .collect()
    }

    /// The numbers of a block of it, which take `limit` bytes of memory at most.
    pub fn block<T: Number>(&self, block: &[Range<usize>], limit: u64) -> Result<Vec<T>, HdfError> {
        if self.kind != T::KIND {
            return Err(wrong_type(self.kind, T::KIND));
        }
        let inside = |(range, &whole): (&Range<usize>, &usize)| {
            range.start <= range.end && range.end <= whole
        };
        if block.len() != self.shape.len() || !block.iter().zip(&self.shape).all(inside) {
            return Err(damaged(format!(
                "{block:?} is no block of {:?}",
                self.shape
            )));
        }
        let wide: Vec<usize> = block.iter().map(ExactSizeIterator::len).collect();
        let count = product(&wide);
        admit(count, size_of::<T>(), limit)?;
        let zero = T::read(&[0; 8][..size_of::<T>()]);
        let mut numbers = vec![zero; count];
        self.visit(block, |from, bytes| {
            for (slot, value) in numbers[from..]
                .iter_mut()
                .zip(bytes.chunks_exact(size_of::<T>()))
            {
                *slot = T::read(value);
            }
        })?;
        Ok(numbers)
    }

    /// Gives consecutive values of a block with the place of the first of them in it.
    fn visit(
        &self,
        block: &[Range<usize>],
        mut give: impl FnMut(usize, &[u8]),
    ) -> Result<(), HdfError> {
        let width = self.kind.bytes();
        match &self.layout {
            Layout::Compact(bytes) => {
                copy(
                    block,
                    &self.shape,
                    &vec![0; self.shape.len()],
                    &self.shape,
                    width,
                    bytes,
                    &mut give,
                );
            }
            Layout::Contiguous(address) => {
                // rows of the first dimension that lie outside are not read
                let row = product(self.shape.get(1..).unwrap_or(&[]));
                let rows = block.first().cloned().unwrap_or(0..1);
                let from = rows.start * row * width;
                let bytes = self.object.file.read(
                    address.saturating_add(from as u64),
                    rows.len() * row * width,
                    "a dataset",
                )?;
                let mut part = self.shape.clone();
                let mut first = vec![0; part.len()];
                if let (Some(part), Some(first)) = (part.first_mut(), first.first_mut()) {
                    (*part, *first) = (rows.len(), rows.start);
                }
                copy(block, &part, &first, &self.shape, width, &bytes, &mut give);
            }
            Layout::Chunked(chunk, chunks) => {
                let wanted = product(chunk).saturating_mul(width);
                for found in chunks {
                    let near = found.first.iter().zip(chunk).zip(block);
                    let touches = near.into_iter().all(|((&first, &part), range)| {
                        first < range.end && range.start < first.saturating_add(part)
                    });
                    if touches {
                        let stored = self
                            .object
                            .file
                            .read(found.address, found.size, "a chunk")?;
                        let bytes = filter::undo(&self.filters, found.skipped, stored, wanted)?;
                        copy(
                            block,
                            chunk,
                            &found.first,
                            &self.shape,
                            width,
                            &bytes,
                            &mut give,
                        );
                    }
                }
            }
        }
        Ok(())
    }

    /// The layout of a message, with all that the dimensions demand.
    fn find(&self, message: &[u8]) -> Result<Layout, HdfError> {
        let mut at = Cursor::new(message, "a dataset's layout");
        let version = at.u8()?;
        if !(3..=4).contains(&version) {
            return Err(unsupported(format!(
                "a dataset's layout of version {version}"
            )));
        }
        let needed = product(&self.shape).saturating_mul(self.kind.bytes());
        let class = at.u8()?;
        match class {
            0 => {
                let size = usize::from(at.u16()?);
                whole(size as u64, needed)?;
                Ok(Layout::Compact(at.take(size)?.to_vec()))
            }
            1 => {
                let (address, size) = (at.u64()?, at.u64()?);
                whole(if address == NOWHERE { 0 } else { size }, needed)?;
                if size > self.object.file.length() {
                    return Err(damaged(format!("it takes {size} bytes of the file")));
                }
                Ok(Layout::Contiguous(if needed == 0 { 0 } else { address }))
            }
            2 if version == 3 => self.in_tree(&mut at),
            2 => self.in_one(&mut at),
            3 => Err(unsupported("a dataset that is made of others")),
            _ => Err(damaged(format!("a dataset's layout of class {class}"))),
        }
    }

    /// Chunks that a tree lists.
    fn in_tree(&self, at: &mut Cursor<'_>) -> Result<Layout, HdfError> {
        let dimensions = usize::from(at.u8()?);
        let tree = at.u64()?;
        let chunk = self.chunk_of(dimensions, |_| Ok(at.u32()? as usize))?;
        let chunks = chunks::of_tree(&self.object.file, tree, &self.shape, &chunk)?;
        self.stored(&chunk, &chunks)?;
        Ok(Layout::Chunked(chunk, chunks))
    }

    /// A dataset of one chunk, in the newest format.
    fn in_one(&self, at: &mut Cursor<'_>) -> Result<Layout, HdfError> {
        let flags = at.u8()?;
        let dimensions = usize::from(at.u8()?);
        let bytes = usize::from(at.u8()?);
        let chunk = self.chunk_of(dimensions, |_| Ok(at.number(bytes)? as usize))?;
        if at.u8()? != 1 || chunks::count(&self.shape, &chunk) != 1 {
            return Err(unsupported("a dataset of many chunks in the newest format"));
        }
        let whole = product(&chunk).saturating_mul(self.kind.bytes());
        let (size, skipped) = match flags & 2 {
            0 => (whole, 0),
            _ => (at.size()?, at.u32()?),
        };
        let chunks = vec![Chunk {
            first: vec![0; chunk.len()],
            address: at.u64()?,
            size,
            skipped,
        }];
        self.stored(&chunk, &chunks)?;
        Ok(Layout::Chunked(chunk, chunks))
    }

    /// Dimensions of a chunk: as many as the dataset has, and the bytes of a value.
    fn chunk_of(
        &self,
        dimensions: usize,
        mut next: impl FnMut(usize) -> Result<usize, HdfError>,
    ) -> Result<Vec<usize>, HdfError> {
        if dimensions != self.shape.len() + 1 || dimensions > MOST_DIMENSIONS + 1 {
            return Err(damaged(format!("chunks of {dimensions} dimensions")));
        }
        let mut chunk = (0..dimensions)
            .map(&mut next)
            .collect::<Result<Vec<_>, _>>()?;
        let width = chunk.pop();
        if width != Some(self.kind.bytes()) || chunk.contains(&0) {
            return Err(damaged(format!(
                "chunks of {chunk:?} values of {width:?} bytes"
            )));
        }
        Ok(chunk)
    }

    /// Whether chunks are in the file, and as long as they have to be where nothing was done to them.
    fn stored(&self, chunk: &[usize], chunks: &[Chunk]) -> Result<(), HdfError> {
        let wanted = product(chunk).saturating_mul(self.kind.bytes());
        let sums = self
            .filters
            .iter()
            .filter(|f| **f == Filter::Fletcher32)
            .count();
        let total = chunks
            .iter()
            .fold(0, |sum: u64, c| sum.saturating_add(c.size as u64));
        if total > self.object.file.length() {
            return Err(damaged(format!("it takes {total} bytes of the file")));
        }
        let shrinks = self.filters.contains(&Filter::Deflate);
        if !shrinks
            && chunks
                .iter()
                .any(|c| c.size < wanted || c.size > wanted.saturating_add(4 * sums))
        {
            return Err(damaged("a chunk is not as long as its numbers"));
        }
        Ok(())
    }
}

/// Whether all numbers are stored.
fn whole(stored: u64, needed: usize) -> Result<(), HdfError> {
    if stored == needed as u64 {
        Ok(())
    } else {
        Err(damaged(format!(
            "{stored} of its {needed} bytes are stored"
        )))
    }
}

fn admit(count: usize, width: usize, limit: u64) -> Result<(), HdfError> {
    let needed = (count as u64).saturating_mul(width as u64);
    if needed > limit {
        return Err(HdfError::TooLarge { needed, limit });
    }
    Ok(())
}
