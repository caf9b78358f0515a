//! Contact laws in closed form or without memory, one file each.

pub mod area_dashpot;
pub mod hertz;
pub(crate) mod pulse;
pub mod quasi_static;
pub mod radiation;
