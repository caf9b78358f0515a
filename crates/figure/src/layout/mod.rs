//! Where everything is, and the parts around a plot: axes, legends, colour bars, labels.
//!
//! `plan` has what is known of a panel without its size, `grid` fits each around a plot, gives it its area and draws it.
//! A part (`axes`, `legend`, `bar`, `labels`) is fitted and drawn in its own file.

mod axes;
mod bar;
mod grid;
mod labels;
mod legend;
mod plan;

pub use grid::draw;
