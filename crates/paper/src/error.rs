//! Why the paper could not be redone.

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
        /// Its name.
        name: &'static str,
        /// The reason.
        source: figure::RenderError,
    },
    /// A file could not be written, or is not to be.
    #[error(transparent)]
    Output(#[from] output::OutputError),
}
