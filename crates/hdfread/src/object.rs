//! Object headers: the messages that describe a group or a dataset.

use crate::bytes::Cursor;
use crate::error::{HdfError, damaged, unsupported};
use crate::file::File;

/// Kinds of messages that are looked at.
pub(crate) mod kind {
    pub(crate) const SPACE: u16 = 0x01;
    pub(crate) const LINK_INFO: u16 = 0x02;
    pub(crate) const TYPE: u16 = 0x03;
    pub(crate) const LINK: u16 = 0x06;
    pub(crate) const EXTERNAL: u16 = 0x07;
    pub(crate) const LAYOUT: u16 = 0x08;
    pub(crate) const FILTERS: u16 = 0x0b;
    pub(crate) const ATTRIBUTE: u16 = 0x0c;
    pub(crate) const CONTINUATION: u16 = 0x10;
    pub(crate) const SYMBOLS: u16 = 0x11;
}

/// Messages and blocks of one header at most.
const MOST_MESSAGES: usize = 1 << 14;
const MOST_BLOCKS: usize = 1 << 10;
/// Bytes of one block at most: messages have 64 KB each.
const MOST_BYTES: usize = 1 << 26;

/// The message is kept elsewhere.
const SHARED: u8 = 0x02;

/// One message.
#[derive(Debug, Clone)]
struct Message {
    kind: u16,
    flags: u8,
    data: Vec<u8>,
}

/// A group or a dataset.
#[derive(Debug, Clone)]
pub(crate) struct Object {
    pub(crate) file: File,
    messages: Vec<Message>,
}

impl Object {
    /// The object whose header is at an address.
    pub(crate) fn load(file: &File, address: u64) -> Result<Self, HdfError> {
        let start = file.read_up_to(address, 64, "an object's header")?;
        let mut object = Self {
            file: file.clone(),
            messages: Vec::new(),
        };
        if start.starts_with(b"OHDR") {
            object.second(address, &start)?;
        } else {
            object.first(address, &start)?;
        }
        Ok(object)
    }

    /// The only message of a kind, if there is one.
    pub(crate) fn message(&self, kind: u16) -> Result<Option<&[u8]>, HdfError> {
        let mut found = self.all(kind);
        let first = found.next().transpose()?;
        match found.next() {
            None => Ok(first),
            Some(_) => Err(damaged(format!("a header has two messages of kind {kind}"))),
        }
    }

    /// All messages of a kind.
    pub(crate) fn all(&self, kind: u16) -> impl Iterator<Item = Result<&[u8], HdfError>> {
        let of_kind = self.messages.iter().filter(move |m| m.kind == kind);
        of_kind.map(|message| {
            if message.flags & SHARED == 0 {
                Ok(message.data.as_slice())
            } else {
                Err(unsupported("a named type or another shared part"))
            }
        })
    }

    /// Reads a header of version 1: its messages are padded to eight bytes.
    fn first(&mut self, address: u64, start: &[u8]) -> Result<(), HdfError> {
        let mut at = Cursor::new(start, "an object's header");
        at.expect(&[1])?;
        at.skip(7)?;
        let size = at.u32()? as usize;
        let mut blocks = vec![(address.saturating_add(16), size as u64)];
        let mut done = 0;
        while let Some(&(address, length)) = blocks.get(done) {
            let block = self.block(&blocks, done, address, length)?;
            let mut at = Cursor::new(&block, "an object's header");
            while at.rest().len() >= 8 {
                let (kind, size) = (at.u16()?, at.u16()?);
                let flags = at.u8()?;
                at.skip(3)?;
                let data = at.take(usize::from(size))?;
                self.add(kind, flags, data, &mut blocks)?;
            }
            done += 1;
        }
        Ok(())
    }

    /// Reads a header of version 2.
    fn second(&mut self, address: u64, start: &[u8]) -> Result<(), HdfError> {
        let mut at = Cursor::new(start, "an object's header");
        at.expect(b"OHDR\x02")?;
        let flags = at.u8()?;
        at.skip(if flags & 0x20 != 0 { 16 } else { 0 })?;
        at.skip(if flags & 0x10 != 0 { 4 } else { 0 })?;
        let size = at.number(1 << (flags & 3))?;
        let before = (start.len() - at.rest().len()) as u64;
        let mut blocks = vec![(address.saturating_add(before), size)];
        let mut done = 0;
        while let Some(&(address, length)) = blocks.get(done) {
            let block = self.block(&blocks, done, address, length)?;
            let mut at = Cursor::new(&block, "an object's header");
            if done > 0 {
                at.expect(b"OCHK")?;
            }
            let head = if flags & 0x04 != 0 { 6 } else { 4 };
            // A sum ends every block but the first, which is read without it.
            let sum = if done > 0 { 4 } else { 0 };
            while at.rest().len() >= head + sum {
                let (kind, size) = (u16::from(at.u8()?), at.u16()?);
                let flags = at.u8()?;
                at.skip(head - 4)?;
                let data = at.take(usize::from(size))?;
                self.add(kind, flags, data, &mut blocks)?;
            }
            done += 1;
        }
        Ok(())
    }

    fn block(
        &self,
        blocks: &[(u64, u64)],
        index: usize,
        address: u64,
        length: u64,
    ) -> Result<Vec<u8>, HdfError> {
        if blocks[..index].contains(&(address, length)) {
            return Err(damaged("an object's header goes in a circle"));
        }
        if length > MOST_BYTES as u64 {
            return Err(damaged(format!("an object's header has {length} bytes")));
        }
        self.file
            .read(address, length as usize, "an object's header")
    }

    fn add(
        &mut self,
        kind: u16,
        flags: u8,
        data: &[u8],
        blocks: &mut Vec<(u64, u64)>,
    ) -> Result<(), HdfError> {
        if kind == kind::CONTINUATION {
            let mut at = Cursor::new(data, "an object's header");
            blocks.push((at.u64()?, at.u64()?));
        } else {
            self.messages.push(Message {
                kind,
                flags,
                data: data.to_vec(),
            });
        }
        if self.messages.len() > MOST_MESSAGES || blocks.len() > MOST_BLOCKS {
            return Err(damaged("an object's header does not end"));
        }
        Ok(())
    }
}
