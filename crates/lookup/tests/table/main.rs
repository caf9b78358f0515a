//! Tables filled from an analytic stand-in: the lookup and the file.

mod format;
mod interpolation;
mod stand_in;
