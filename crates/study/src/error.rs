//! Why a chart could not be made.

use fault::{Class, Culprit, Fault};
use thiserror::Error;

/// Why a chart could not be made.
#[derive(Debug, Error)]
pub enum StudyError {
    /// A number outside the physics.
    #[error(transparent)]
    Domain(#[from] halfspace::DomainError),
    /// A march failed where it must not.
    #[error(transparent)]
    March(#[from] contact::MarchError),
    /// A contact that follows the load failed where it must not.
    #[error(transparent)]
    Growing(#[from] contact::GrowingError),
    /// A contact failed where it must not.
    #[error(transparent)]
    Contact(#[from] contact::ContactError),
    /// Fields of an impact that could not be computed.
    #[error(transparent)]
    Fields(#[from] impact::FieldsError),
    /// A body that cannot be made.
    #[error(transparent)]
    Body(#[from] contact::BodyError),
    /// A material that is not in the library.
    #[error(transparent)]
    Material(#[from] contact::UnknownMaterial),
    /// A field that could not be computed.
    #[error(transparent)]
    Field(#[from] impact::FieldError),
    /// A local table could not be built.
    #[error(transparent)]
    Build(#[from] tabulator::BuildError),
    /// A local table could not be read.
    #[error(transparent)]
    Table(#[from] lookup::TableError),
    /// A lookup failed where it must not.
    #[error(transparent)]
    Lookup(#[from] lookup::LookupError),
    /// A temporary file.
    #[error("a temporary folder cannot be made: {0}")]
    Temporary(#[from] std::io::Error),
    /// A picture could not be drawn: a mistake of this library.
    #[error("the picture {name} cannot be drawn: {source}")]
    Picture {
        /// Name of its files.
        name: &'static str,
        source: figure::RenderError,
    },
    /// A file could not be written, or is not to be.
    #[error(transparent)]
    Output(#[from] output::OutputError),
}

impl Fault for StudyError {
    fn culprit(&self) -> Culprit<'_> {
        match self {
            Self::Output(error) => error.culprit(),
            _ => Culprit::of(Class::Work),
        }
    }
}
