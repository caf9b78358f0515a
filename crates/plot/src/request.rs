//! What is asked for.

use crate::kind::Kind;

/// What is asked for; the default suits every file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Request {
    /// What is shown; none: what suits the file.
    pub kind: Option<Kind>,
    /// Quantities by their names in the file; none: those that suit the kind.
    pub quantities: Vec<String>,
    /// Title; none: one that says what the scene is.
    pub title: Option<String>,
}
