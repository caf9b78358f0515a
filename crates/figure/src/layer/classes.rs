//! A map of a few classes.

use crate::interval::Interval;

/// A few classes on a regular grid of cells that fills the panel, at most five.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Classes {
    /// Cells along x and y.
    pub shape: [usize; 2],
    /// Class of each cell from the low end of both axes, x runs fastest.
    pub class: Vec<usize>,
    /// Names of the classes, from light to dark.
    pub names: Vec<String>,
}

impl Classes {
    /// The class of each cell from its centre.
    pub fn of(
        [x, y]: [Interval; 2],
        shape: [usize; 2],
        names: &[&str],
        mut class: impl FnMut(f64, f64) -> usize,
    ) -> Self {
        let (xs, ys) = (x.cells(shape[0]), y.cells(shape[1]));
        let mut classes = Vec::with_capacity(shape[0] * shape[1]);
        for &y in &ys {
            for &x in &xs {
                classes.push(class(x, y));
            }
        }
        Self {
            shape,
            class: classes,
            names: names.iter().map(|&name| name.to_owned()).collect(),
        }
    }
}
