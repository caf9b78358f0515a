//! Why the paper could not be redone.

use fault::{Class, Culprit, Fault};
use thiserror::Error;

/// Why the paper could not be redone: a mistake of this library, or a folder that takes no files.
#[derive(Debug, Error)]
pub enum PaperError {
    /// A material that is not in the library.
    #[error(transparent)]
    Material(#[from] contact::UnknownMaterial),
    /// A body that cannot be made.
    #[error(transparent)]
    Body(#[from] contact::BodyError),
    /// A contact that could not be solved.
    #[error(transparent)]
    Contact(#[from] contact::ContactError),
    /// A number outside the physics.
    #[error(transparent)]
    Domain(#[from] halfspace::DomainError),
    /// Fields that could not be computed.
    #[error(transparent)]
    Fields(#[from] impact::FieldsError),
    /// A figure that could not be drawn.
    #[error("{name} cannot be drawn: {source}")]
    Picture {
        name: &'static str,
        source: figure::RenderError,
    },
    /// A file could not be written, or is not to be.
    #[error(transparent)]
    Output(#[from] output::OutputError),
}

impl Fault for PaperError {
    fn culprit(&self) -> Culprit<'_> {
        match self {
            Self::Output(error) => error.culprit(),
            _ => Culprit::of(Class::Work),
        }
    }
}
