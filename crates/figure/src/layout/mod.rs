//! Layout: positions of all elements, and the parts around a plot: axes, legends, colour bars, labels.
//!
//! `plan` determines the properties of panels that do not depend on their sizes. `grid` fits each panel around its
//! plot, places and draws it. Each part (`axes`, `legend`, `bar`, `labels`) is fitted and drawn in its own file.

mod axes;
mod bar;
mod grid;
mod labels;
mod legend;
mod plan;

pub use grid::draw;
