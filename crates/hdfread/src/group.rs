//! Groups: what they hold by hard links, and their attributes.

use crate::attribute::Attribute;
use crate::bytes::Cursor;
use crate::dataset::Dataset;
use crate::error::{HdfError, damaged, unsupported};
use crate::file::{File, NOWHERE};
use crate::heap::LocalHeap;
use crate::object::{Object, kind};
use std::collections::{BTreeMap, HashSet};

/// Members at most.
const MOST_MEMBERS: usize = 1 << 20;
/// Levels of a tree of members at most.
const MOST_LEVELS: u8 = 16;

/// A group, all members of which are hard links.
#[derive(Debug, Clone)]
pub struct Group {
    object: Object,
    members: BTreeMap<String, u64>,
}

impl File {
    /// The group that holds all others.
    ///
    /// # Errors
    /// [`HdfError`]; a link that is not a hard one is [`HdfError::Unsupported`].
    pub fn root(&self) -> Result<Group, HdfError> {
        Group::load(self, self.root_address())
    }
}

impl Group {
    fn load(file: &File, address: u64) -> Result<Self, HdfError> {
        let object = Object::load(file, address)?;
        let mut members = BTreeMap::new();
        if let Some(symbols) = object.message(kind::SYMBOLS)? {
            let mut at = Cursor::new(symbols, "a group");
            let (tree, names) = (at.u64()?, at.u64()?);
            let names = LocalHeap::load(file, names)?;
            let mut walk = Walk {
                file,
                names: &names,
                seen: HashSet::new(),
                members: &mut members,
            };
            walk.tree(tree, None)?;
        } else if let Some(info) = object.message(kind::LINK_INFO)? {
            compact(&object, info, &mut members)?;
        } else {
            return Err(damaged("a group has no list of members"));
        }
        Ok(Self { object, members })
    }

    /// Names of the members, ascending.
    pub fn members(&self) -> impl Iterator<Item = &str> {
        self.members.keys().map(String::as_str)
    }

    /// A group that is a member.
    pub fn group(&self, name: &str) -> Result<Self, HdfError> {
        Self::load(&self.object.file, self.address("group", name)?)
    }

    /// A dataset that is a member.
    pub fn dataset(&self, name: &str) -> Result<Dataset, HdfError> {
        let address = self.address("dataset", name)?;
        Dataset::load(&Object::load(&self.object.file, address)?)
    }

    /// An attribute of the group.
    pub fn attribute(&self, name: &str) -> Result<Attribute, HdfError> {
        Attribute::find(&self.object, name)
    }

    fn address(&self, what: &'static str, name: &str) -> Result<u64, HdfError> {
        let found = self.members.get(name).copied();
        found.ok_or_else(|| HdfError::Absent {
            what,
            name: name.to_owned(),
        })
    }
}

/// The members of a new group, in its header.
fn compact(
    object: &Object,
    info: &[u8],
    members: &mut BTreeMap<String, u64>,
) -> Result<(), HdfError> {
    let mut at = Cursor::new(info, "a group");
    at.skip(1)?;
    let flags = at.u8()?;
    at.skip(if flags & 1 != 0 { 8 } else { 0 })?;
    if at.u64()? != NOWHERE {
        return Err(unsupported("a group of many members in the newest format"));
    }
    for link in object.all(kind::LINK) {
        let mut at = Cursor::new(link?, "a link");
        at.expect(&[1])?;
        let flags = at.u8()?;
        let class = if flags & 0x08 != 0 { at.u8()? } else { 0 };
        at.skip(if flags & 0x04 != 0 { 8 } else { 0 })?;
        at.skip(if flags & 0x10 != 0 { 1 } else { 0 })?;
        let length = at.number(1 << (flags & 3))?;
        let name = at.name(usize::try_from(length).unwrap_or(usize::MAX))?;
        if class != 0 {
            return Err(not_hard(name));
        }
        let address = at.u64()?;
        insert(members, name, address)?;
    }
    Ok(())
}

fn not_hard(name: &str) -> HdfError {
    unsupported(format!("{name:?}, a link to another name or file,"))
}

fn insert(members: &mut BTreeMap<String, u64>, name: &str, address: u64) -> Result<(), HdfError> {
    if members.len() >= MOST_MEMBERS || members.insert(name.to_owned(), address).is_some() {
        return Err(damaged(format!("a group has {name:?} twice, or no end")));
    }
    Ok(())
}

/// A walk over the tree of an old group.
struct Walk<'a> {
    file: &'a File,
    names: &'a LocalHeap,
    seen: HashSet<u64>,
    members: &'a mut BTreeMap<String, u64>,
}

impl Walk<'_> {
    /// A node of the tree, one level below its parent.
    fn tree(&mut self, address: u64, parent: Option<u8>) -> Result<(), HdfError> {
        let what = "a group's tree of members";
        let head = self.file.read(address, 24, what)?;
        let mut at = Cursor::new(&head, what);
        at.expect(b"TREE\0")?;
        let (level, entries) = (at.u8()?, usize::from(at.u16()?));
        let falls = parent.is_none_or(|above| level + 1 == above);
        if level > MOST_LEVELS || !falls || !self.seen.insert(address) {
            return Err(damaged(format!("{what} goes in a circle")));
        }
        let body = self.file.read(address + 24, entries * 16, what)?;
        let mut at = Cursor::new(&body, what);
        for _ in 0..entries {
            at.skip(8)?;
            let child = at.u64()?;
            if level == 0 {
                self.leaf(child)?;
            } else {
                self.tree(child, Some(level))?;
            }
        }
        Ok(())
    }

    fn leaf(&mut self, address: u64) -> Result<(), HdfError> {
        let what = "a group's list of members";
        if !self.seen.insert(address) {
            return Err(damaged(format!("{what} is there twice")));
        }
        let head = self.file.read(address, 8, what)?;
        let mut at = Cursor::new(&head, what);
        at.expect(b"SNOD\x01")?;
        at.skip(1)?;
        let entries = usize::from(at.u16()?);
        let body = self.file.read(address + 8, entries * 40, what)?;
        let mut at = Cursor::new(&body, what);
        for _ in 0..entries {
            let (offset, object) = (at.u64()?, at.u64()?);
            let cached = at.u32()?;
            at.skip(20)?;
            let name = self.names.name(offset)?;
            if cached == 2 {
                return Err(not_hard(name));
            }
            insert(self.members, name, object)?;
        }
        Ok(())
    }
}
