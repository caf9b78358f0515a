//! How the loaded surface answers a unit step of force: exact, tabulated, and that of a flat punch.

pub mod disc;
pub mod exact;
pub mod punch;
pub mod shelf;
pub mod table;
