//! Where names and texts of any length are kept.

use crate::bytes::{Cursor, name};
use crate::error::{HdfError, damaged};
use crate::file::File;
use std::collections::HashMap;
use std::ops::Range;

/// Names of the members of an old group.
#[derive(Debug)]
pub(crate) struct LocalHeap {
    data: Vec<u8>,
}

impl LocalHeap {
    pub(crate) fn load(file: &File, address: u64) -> Result<Self, HdfError> {
        let what = "a group's list of names";
        let header = file.read(address, 32, what)?;
        let mut at = Cursor::new(&header, what);
        at.expect(b"HEAP\0")?;
        at.skip(3)?;
        let size = at.size()?;
        at.skip(8)?;
        let data = file.read(at.u64()?, size, what)?;
        Ok(Self { data })
    }

    pub(crate) fn name(&self, offset: u64) -> Result<&str, HdfError> {
        let from = usize::try_from(offset).ok();
        let bytes = from.and_then(|from| self.data.get(from..));
        name(bytes.ok_or_else(|| damaged("a name lies outside its list"))?)
    }
}

/// Texts of any length, each found by 16 bytes of a dataset or an attribute: length, address of a collection, index there.
#[derive(Debug)]
pub(crate) struct Texts<'a> {
    file: &'a File,
    /// Collections that were read, with the places of what they hold.
    read: HashMap<u64, Collection>,
    /// Bytes that may still be read and given.
    left: u64,
}

type Collection = (Vec<u8>, HashMap<u32, Range<usize>>);

impl<'a> Texts<'a> {
    /// `limit` bytes are read and given at most.
    pub(crate) fn new(file: &'a File, limit: u64) -> Self {
        Self {
            file,
            read: HashMap::new(),
            left: limit,
        }
    }

    /// The text of a place.
    pub(crate) fn at(&mut self, place: &[u8]) -> Result<Vec<u8>, HdfError> {
        let mut at = Cursor::new(place, "a text");
        let (length, address, index) = (at.u32()? as usize, at.u64()?, at.u32()?);
        if length == 0 {
            return Ok(Vec::new());
        }
        self.take(length)?;
        if !self.read.contains_key(&address) {
            let found = self.load(address)?;
            self.read.insert(address, found);
        }
        let (bytes, places) = &self.read[&address];
        let text = places
            .get(&index)
            .and_then(|place| bytes.get(place.clone()));
        match text.and_then(|text| text.get(..length)) {
            Some(text) => Ok(text.to_vec()),
            None => Err(damaged("a text is not where it should be")),
        }
    }

    fn load(&mut self, address: u64) -> Result<Collection, HdfError> {
        let what = "a collection of texts";
        let header = self.file.read(address, 16, what)?;
        let mut at = Cursor::new(&header, what);
        at.expect(b"GCOL\x01")?;
        at.skip(3)?;
        let size = at.size()?;
        self.take(size)?;
        let bytes = self.file.read(address, size, what)?;
        let (mut places, mut from) = (HashMap::new(), 16_usize);
        while let Some(head) = bytes.get(from..from.saturating_add(16)) {
            let mut at = Cursor::new(head, what);
            let index = u32::from(at.u16()?);
            at.skip(6)?;
            let size = at.size()?;
            if index == 0 {
                break;
            }
            let start = from + 16;
            places.insert(index, start..start.saturating_add(size));
            let padded = size.checked_next_multiple_of(8).unwrap_or(usize::MAX);
            from = start.saturating_add(padded);
        }
        Ok((bytes, places))
    }

    fn take(&mut self, bytes: usize) -> Result<(), HdfError> {
        match self.left.checked_sub(bytes as u64) {
            Some(left) => {
                self.left = left;
                Ok(())
            }
            None => Err(damaged("its texts are longer than the file")),
        }
    }
}
