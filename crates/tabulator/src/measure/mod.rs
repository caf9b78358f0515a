//! How good a table is: errors off its grid (`verify`), the spacing that an error needs (`refine`), what is stored against
//! the exact kernels (`check`), and one table against another (`difference`).

pub(crate) mod check;
pub(crate) mod difference;
pub(crate) mod refine;
pub(crate) mod verify;
