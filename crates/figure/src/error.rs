//! Why a figure cannot be drawn.

use std::fmt;
use thiserror::Error;

/// One of the two axes of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    X,
    Y,
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::X => "x",
            Self::Y => "y",
        })
    }
}

/// What a figure says that cannot be drawn. Panels are counted from 0.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FigureError {
    /// Nothing to draw.
    #[error("the figure has no panels")]
    NoPanels,
    /// A size that no picture has.
    #[error("{name} of {pixels} px: 1 to {largest} px can be drawn")]
    Size {
        /// Which size.
        name: &'static str,
        pixels: f64,
        /// Largest that is drawn.
        largest: f64,
    },
    /// An axis without length, or a logarithmic one that reaches zero.
    #[error("panel {panel}: the {side} axis cannot run from {low:?} to {high:?}")]
    Range {
        /// The panel.
        panel: usize,
        /// The axis.
        side: Side,
        /// Its lower end.
        low: f64,
        /// Its upper end.
        high: f64,
    },
    /// A mirrored axis, or one of equal lengths, that is logarithmic.
    #[error("panel {panel}: the {side} axis is mirrored or has equal lengths, and must be linear")]
    NotLinear {
        /// The panel.
        panel: usize,
        /// The axis.
        side: Side,
    },
    /// Nodes that do not rise.
    #[error("panel {panel}: the {side} nodes of an image must be finite and rise")]
    Nodes {
        /// The panel.
        panel: usize,
        /// The axis.
        side: Side,
    },
    /// Lists whose lengths do not fit each other.
    #[error("panel {panel}: {found} {what}, and {expected} are needed")]
    Count {
        /// The panel.
        panel: usize,
        /// What was counted.
        what: &'static str,
        /// Needed.
        expected: usize,
        found: usize,
    },
    /// More pixels than can be held.
    #[error("a picture of {width} by {height} pixels cannot be made")]
    Pixels {
        /// Pixels along x.
        width: u32,
        /// Pixels along y.
        height: u32,
    },
    /// The pixels could not be encoded.
    #[error("the PNG cannot be encoded: {0}")]
    Png(String),
    /// The frames could not be encoded.
    #[error("the GIF cannot be encoded: {0}")]
    Gif(String),
    /// The font could not be cut down to the letters that are used.
    #[error("the font cannot be embedded: {0}")]
    Font(String),
}
