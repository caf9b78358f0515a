//! What is asked for.

use crate::kind::Kind;
use figure::Figure;

/// What is asked for; the default suits every file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Request {
    /// What is shown; none: what suits the file.
    pub kind: Option<Kind>,
    /// Quantities by their names in the file; none: those that suit the kind.
    pub quantities: Vec<String>,
    /// Times in s at which fields are shown; none: times at which waves are seen.
    pub times_s: Vec<f64>,
    /// Frames of a section; none: four in a picture, and each of the file in an animation.
    pub frames: Option<usize>,
    /// The key along x of a sweep; none: the one with the most numbers.
    pub along: Option<String>,
    /// Keys of a sweep with the values at which they are held.
    pub at: Vec<(String, String)>,
    /// Title; none: one that says what the scene is.
    pub title: Option<String>,
}

/// A figure, and what its user should know.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// The figure.
    pub figure: Figure,
    /// Sentences: what is not shown, and how to see it.
    pub notes: Vec<String>,
}
