//! Maps of the regions in which methods work and fail, with theoretical boundaries.
//!
//! `marches`: steps of marches; `models`: contact model that a scene needs; `inversions` and `kernels`: errors of
//! kernels.

pub(crate) mod inversions;
pub(crate) mod kernels;
pub(crate) mod marches;
pub(crate) mod models;
#[cfg(test)]
mod tests;

use crate::picture::Picture;
use figure::{Axis, Classes, Interval, Layer};

/// A plane divided into cells, each of which has a class.
struct StabilityMap<'a> {
    plane: [Interval; 2],
    /// Quantities of the axes.
    quantities: [&'a str; 2],
    /// Columns and rows of cells.
    shape: [usize; 2],
    classes: &'a [&'a str],
}

impl StabilityMap<'_> {
    /// A picture of the class of every cell; the classes are given by the index of the cell, by rows, and its ordinate.
    fn picture(
        &self,
        name: &'static str,
        title: &str,
        class: impl Fn(usize, f64) -> usize,
    ) -> Picture {
        let [x, y] = [0, 1].map(|side| Axis::over(self.plane[side], self.quantities[side]));
        let mut figure = Picture::new(name, title, x, y);
        let [columns, rows] = self.shape;
        let ordinates = self.plane[1].cells(rows);
        let cells = 0..columns * rows;
        figure.add(Layer::Classes(Classes {
            shape: self.shape,
            class: cells.map(|i| class(i, ordinates[i / columns])).collect(),
            names: self.classes.iter().map(ToString::to_string).collect(),
        }));
        figure
    }

    /// The abscissas of its columns.
    fn columns(&self) -> Vec<f64> {
        self.plane[0].cells(self.shape[0])
    }

    /// A curve of `count` points over the whole width.
    fn line(&self, count: usize, ordinate: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let places = self.plane[0].cells(count).into_iter();
        places.map(|x| (x, ordinate(x))).collect()
    }
}
