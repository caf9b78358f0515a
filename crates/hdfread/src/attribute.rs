//! Attributes.

use crate::bytes::{Cursor, name};
use crate::error::{HdfError, damaged, unsupported};
use crate::file::File;
use crate::heap::Texts;
use crate::kind::{Kind, Number};
use crate::object::{Object, kind};
use crate::space::{Space, product};

/// An attribute.
#[derive(Debug, Clone)]
pub struct Attribute {
    file: File,
    kind: Kind,
    space: Space,
    data: Vec<u8>,
}

impl Attribute {
    /// That of an object with a name.
    pub(crate) fn find(object: &Object, wanted: &str) -> Result<Self, HdfError> {
        for message in object.all(kind::ATTRIBUTE) {
            if let Some(found) = parse(message?, wanted, &object.file)? {
                return Ok(found);
            }
        }
        Err(HdfError::Absent {
            what: "attribute",
            name: wanted.to_owned(),
        })
    }

    /// Its type.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Its dimensions; none of a single value.
    #[must_use]
    pub fn shape(&self) -> &[usize] {
        self.space.shape()
    }

    /// Its numbers, in the order of the file.
    ///
    /// # Errors
    /// [`HdfError::Type`].
    pub fn numbers<T: Number>(&self) -> Result<Vec<T>, HdfError> {
        if self.kind != T::KIND {
            return Err(wrong_type(self.kind, T::KIND));
        }
        Ok(self
            .data
            .chunks_exact(size_of::<T>())
            .map(T::read)
            .collect())
    }

    /// Its only number.
    ///
    /// # Errors
    /// [`HdfError::Type`]; [`HdfError::Damaged`] where it is a list.
    pub fn number<T: Number>(&self) -> Result<T, HdfError> {
        match (self.numbers()?.as_slice(), &self.space) {
            (&[number], Space::Scalar) => Ok(number),
            _ => Err(damaged("it is a list, needed one number")),
        }
    }

    /// Its only text, which is UTF-8.
    pub fn text(&self) -> Result<String, HdfError> {
        if self.space != Space::Scalar {
            return Err(damaged("it is a list, needed one text"));
        }
        let bytes = match self.kind {
            Kind::Text => Texts::new(&self.file, 2 * self.file.length()).at(&self.data)?,
            Kind::FixedText { .. } => self.data.clone(),
            Kind::Float { .. } | Kind::Integer { .. } | Kind::Other { .. } => {
                return Err(wrong_type(self.kind, Kind::Text));
            }
        };
        match name(&bytes) {
            Ok(text) => Ok(text.to_owned()),
            Err(_) => Err(damaged("it is not UTF-8")),
        }
    }
}

pub(crate) fn wrong_type(found: Kind, needed: Kind) -> HdfError {
    HdfError::Type {
        found: found.to_string(),
        needed: needed.to_string(),
    }
}

/// The attribute of a message if it has the name.
fn parse(message: &[u8], wanted: &str, file: &File) -> Result<Option<Attribute>, HdfError> {
    let mut at = Cursor::new(message, "an attribute");
    let (version, flags) = (at.u8()?, at.u8()?);
    let sizes = [at.u16()?, at.u16()?, at.u16()?].map(usize::from);
    let pad = |size: usize| match version {
        1 => size.next_multiple_of(8),
        _ => size,
    };
    match version {
        1 | 2 => {}
        3 => at.skip(1)?,
        _ => return Err(damaged(format!("an attribute of version {version}"))),
    }
    let mut parts = [&[][..]; 3];
    for (part, size) in parts.iter_mut().zip(sizes) {
        *part = at.take(pad(size))?;
    }
    if name(parts[0])? != wanted {
        return Ok(None);
    }
    if version > 1 && flags & 3 != 0 {
        return Err(unsupported("an attribute of a named type"));
    }
    let kind = Kind::parse(&mut Cursor::new(parts[1], "an attribute's type"))?;
    let space = Space::parse(&mut Cursor::new(parts[2], "an attribute's dimensions"))?;
    let length = product(space.shape()).saturating_mul(kind.bytes());
    Ok(Some(Attribute {
        file: file.clone(),
        kind,
        space,
        data: at.take(length)?.to_vec(),
    }))
}
