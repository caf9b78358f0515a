//! Where names and texts of any length are kept.

use crate::bytes::{Cursor, name};
use crate::error::{HdfError, damaged};
use crate::file::File;

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

/// A text of any length from its 16 bytes in the file: length, address of a collection, index there.
pub(crate) fn text(file: &File, place: &[u8]) -> Result<Vec<u8>, HdfError> {
    let what = "a text";
    let mut at = Cursor::new(place, what);
    let (length, address, index) = (at.u32()? as usize, at.u64()?, at.u32()?);
    if length == 0 {
        return Ok(Vec::new());
    }
    let header = file.read(address, 16, what)?;
    let mut at = Cursor::new(&header, what);
    at.expect(b"GCOL\x01")?;
    at.skip(3)?;
    let size = at.size()?;
    let collection = file.read(address, size, what)?;
    let mut at = Cursor::new(&collection, what);
    at.skip(16)?;
    while at.rest().len() >= 16 {
        let found = at.u16()?;
        at.skip(6)?;
        let size = at.size()?;
        if found == 0 {
            break;
        }
        if u32::from(found) == index {
            let text = at.take(size)?;
            return match text.get(..length) {
                Some(text) => Ok(text.to_vec()),
                None => Err(damaged("a text ends too soon")),
            };
        }
        at.skip(size.checked_next_multiple_of(8).unwrap_or(usize::MAX))?;
    }
    Err(damaged("a text is not where it should be"))
}
