//! How good a table is: the spacing that an error needs (`refine`), the stored numbers compared with the exact kernels
//! (`check`), and one table compared with another (`difference`).

pub(crate) mod check;
pub(crate) mod difference;
pub(crate) mod refine;
