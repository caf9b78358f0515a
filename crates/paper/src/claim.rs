//! What the text says of a figure, and whether it holds.

/// A sentence of the paper that has no number, and the numbers that it is judged by here.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// What the paper says.
    pub says: &'static str,
    /// What is found here.
    pub found: String,
    /// Whether that is so.
    pub holds: bool,
}

impl Claim {
    pub(crate) fn new(says: &'static str, holds: bool, found: String) -> Self {
        Self { says, found, holds }
    }
}
