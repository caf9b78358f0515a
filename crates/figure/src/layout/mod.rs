//! Where everything is, and the parts around a plot: axes, legends, colour bars, labels.
//!
//! `plan` has what is known of a panel without its size, `fit` what it needs around a plot of a size, `grid` the areas
//! of all panels. A part (`axes`, `legend`, `bar`, `marks`, `points`) is fitted and drawn in its own file.

mod axes;
mod bar;
mod fit;
mod grid;
mod legend;
pub(crate) mod marks;
mod plan;
pub(crate) mod points;
mod room;

pub(crate) use grid::{Layout, PAD, Placed, lay_out};
