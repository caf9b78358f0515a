//! A map of a few classes.

use crate::geometry::Rect;
use crate::layer::Classes;
use crate::layout::fills;
use crate::scene::{Fill, Scene, Segment, Shape};

/// One shape a class, each over the lighter ones: it covers the cells of its own class and of all darker ones, so
/// that no background shines through where two classes meet.
pub(super) fn draw(scene: &mut Scene, area: Rect, classes: &Classes) {
    let [columns, rows] = classes.shape;
    if columns == 0 || rows == 0 {
        return;
    }
    let (width, height) = (area.width() / columns as f64, area.height() / rows as f64);
    let fills = fills(classes.names.len());
    for (least, &colour) in fills.iter().enumerate() {
        let mut segments = Vec::new();
        for (row, cells) in classes.class.chunks(columns).enumerate() {
            let bottom = area.bottom - height * row as f64;
            let mut start = 0;
            for run in cells.chunk_by(|&a, &b| (a >= least) == (b >= least)) {
                let left = area.left + width * start as f64;
                let right = left + width * run.len() as f64;
                if run[0] >= least {
                    segments.extend([
                        Segment::Move(left, bottom - height),
                        Segment::Line(right, bottom - height),
                        Segment::Line(right, bottom),
                        Segment::Line(left, bottom),
                        Segment::Close,
                    ]);
                }
                start += run.len();
            }
        }
        if !segments.is_empty() {
            scene.shape(Shape {
                segments,
                fill: Some(Fill::solid(colour)),
                ..Shape::default()
            });
        }
    }
}
