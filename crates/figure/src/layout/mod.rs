//! Where everything is: ranges, ticks, legends and the areas of the panels.

mod bar;
mod columns;
mod fit;
mod frame;
mod grid;
mod legend;
mod limits;
mod looks;
mod marks;
mod plan;
mod room;
mod typeface;

pub(crate) use bar::BarFit;
pub(crate) use columns::PAD;
pub(crate) use frame::Frame;
pub(crate) use grid::{Layout, Placed, lay_out};
pub(crate) use legend::{Block, LegendPlace, Swatch};
pub(crate) use looks::{Look, Marker, Slot, fills, look};
pub(crate) use plan::{AxisPlan, Colours};
pub(crate) use room::occupied;
pub(crate) use typeface::{SWATCH, Typeface};
