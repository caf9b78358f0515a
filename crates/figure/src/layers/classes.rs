//! A map of a few classes.

use super::{Swatch, count};
use crate::drawing::{Drawing, DrawnPath};
use crate::error::FigureError;
use crate::geometry::Rect;
use crate::look::fills;

/// At most five classes on a regular grid of cells that fills the panel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Classes {
    /// Number of cells along x and y.
    pub shape: [usize; 2],
    /// Class of each cell, beginning at the low end of both axes; x varies fastest.
    pub class: Vec<usize>,
    /// Names of the classes, from light to dark.
    pub names: Vec<String>,
}

impl Classes {
    pub(super) fn check(&self, panel: usize) -> Result<(), FigureError> {
        let [columns, rows] = self.shape;
        count(panel, "cells of classes", columns * rows, self.class.len())
    }

    pub(super) fn swatches(&self) -> Vec<(&str, Swatch)> {
        let fills = fills(self.names.len())
            .iter()
            .map(|&fill| Swatch::Fill(fill));
        self.names.iter().map(String::as_str).zip(fills).collect()
    }

    /// One shape per class, over those of the lighter classes. It covers the cells of its own class and of all darker
    /// ones, so that the background is not visible between two classes.
    pub(super) fn draw(&self, drawing: &mut Drawing, area: Rect) {
        let [columns, rows] = self.shape;
        if columns == 0 || rows == 0 {
            return;
        }
        let (width, height) = (area.width() / columns as f64, area.height() / rows as f64);
        for (least, &colour) in fills(self.names.len()).iter().enumerate() {
            let mut shape = DrawnPath::default();
            for (row, cells) in self.class.chunks(columns).enumerate() {
                let bottom = area.bottom - height * row as f64;
                let mut start = 0;
                for run in cells.chunk_by(|&a, &b| (a >= least) == (b >= least)) {
                    if run[0] >= least {
                        let left = area.left + width * start as f64;
                        let cells =
                            Rect::new(left, bottom - height, width * run.len() as f64, height);
                        shape.segments.extend(DrawnPath::rectangle(cells).segments);
                    }
                    start += run.len();
                }
            }
            if !shape.segments.is_empty() {
                drawing.shape(shape.filled(colour, 1.0));
            }
        }
    }
}
