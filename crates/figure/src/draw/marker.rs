//! Markers that differ in shape.

use crate::colour::{Colour, WHITE};
use crate::layout::Marker;
use crate::scene::{Fill, Scene, Segment, Shape, Stroke};

/// Half of a marker's width.
const SIZE: f64 = 4.2;

/// Shapes before they come again, filled.
const SHAPES: usize = 7;

/// Draws the marker of a curve.
pub(super) fn draw(scene: &mut Scene, marker: Marker, at: (f64, f64), colour: Colour) {
    match marker {
        Marker::None => {}
        Marker::Dot => scene.shape(Shape::circle(at, 1.6).filled(Fill::solid(colour))),
        Marker::Shape(index) => {
            // every other round of shapes is filled
            let is_open = (index / SHAPES).is_multiple_of(2);
            let fill = if is_open { WHITE } else { colour };
            shape(scene, index % SHAPES, at, SIZE, colour, fill);
        }
    }
}

/// Draws a star.
pub(super) fn star(scene: &mut Scene, at: (f64, f64), size: f64, colour: Colour) {
    shape(scene, SHAPES - 1, at, size, colour, WHITE);
}

fn shape(
    scene: &mut Scene,
    index: usize,
    (x, y): (f64, f64),
    size: f64,
    colour: Colour,
    fill: Colour,
) {
    let polygon = |corners: &[(f64, f64)]| {
        let corners = corners
            .iter()
            .map(|(dx, dy)| (x + dx * size, y + dy * size));
        Shape::polygon(&corners.collect::<Vec<_>>())
    };
    let shape = match index {
        0 => Shape::circle((x, y), 0.95 * size),
        1 => polygon(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
        2 => polygon(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]),
        3 => polygon(&[(0.0, -1.3), (1.0, 0.0), (0.0, 1.3), (-1.0, 0.0)]),
        4 => polygon(&[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)]),
        5 => Shape {
            segments: vec![
                Segment::Move(x - size, y - size),
                Segment::Line(x + size, y + size),
                Segment::Move(x - size, y + size),
                Segment::Line(x + size, y - size),
            ],
            ..Shape::default()
        },
        _ => {
            let corner = |i: usize| {
                let angle = std::f64::consts::PI * (i as f64 / 5.0 - 0.5);
                let radius = if i.is_multiple_of(2) { 1.3 } else { 0.55 };
                (radius * angle.cos(), radius * angle.sin())
            };
            polygon(&(0..10).map(corner).collect::<Vec<_>>())
        }
    };
    let shape = shape.stroked(Stroke::solid(colour, 1.5));
    scene.shape(shape.filled(Fill::solid(fill)));
}
