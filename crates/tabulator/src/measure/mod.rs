//! Accuracy of tables: the spacing for a given error (`refine`), comparison with the exact kernels (`check`), and
//! comparison of two tables (`difference`).

pub(crate) mod check;
pub(crate) mod difference;
pub(crate) mod refine;
