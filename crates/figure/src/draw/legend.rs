//! The legend, in a plot or beside it.

use super::{curve, histogram, marker};
use crate::colour::{BLACK, Colour, MARK, WHITE};
use crate::geometry::Rect;
use crate::layout::{Block, LegendPlace, Look, Marker, SWATCH, Swatch, Typeface};
use crate::scene::{Anchor, Fill, Scene, Shape, Stroke, Text};
use crate::text::LINE;

/// Draws a legend around a plot.
pub(super) fn draw(
    scene: &mut Scene,
    block: &Block,
    place: &LegendPlace,
    plot: Rect,
    faces: &Typeface,
) {
    let (left, top) = match place {
        LegendPlace::Inside(found) => {
            let frame = Rect::new(
                plot.left + found.left,
                plot.top + found.top,
                found.width(),
                found.height(),
            );
            let back = Fill {
                colour: WHITE,
                opacity: 0.85,
            };
            let edge = Stroke::solid(Colour::new(0xcc_cc_cc), 0.8);
            scene.shape(Shape::rectangle(frame).filled(back).stroked(edge));
            let air = 0.5 * (found.width() - block.width);
            (
                frame.left + air,
                frame.top + 0.5 * (found.height() - block.height),
            )
        }
        LegendPlace::Right(from) => (plot.right + from, plot.top),
        LegendPlace::Below(from) => (plot.left, plot.bottom + from),
    };
    let size = faces.legend;
    for entry in &block.entries {
        let (x, mut line) = (left + entry.left, top + entry.top + size);
        swatch(scene, &entry.swatch, (x, line - 0.33 * size), size);
        for text in &entry.lines {
            let at = (x + SWATCH + 0.5 * size, line);
            scene.text(Text::new(text, at, size, Anchor::Start));
            line += LINE * size;
        }
    }
}

/// The sample of an entry, from a place at its left to the right.
fn swatch(scene: &mut Scene, swatch: &Swatch, (x, y): (f64, f64), size: f64) {
    let patch = Rect::new(x + 2.0, y - 0.45 * size, SWATCH - 4.0, 0.9 * size);
    match swatch {
        Swatch::Fill(colour) => {
            let edge = Stroke::solid(MARK, 0.8);
            let fill = Fill::solid(*colour);
            scene.shape(Shape::rectangle(patch).filled(fill).stroked(edge));
        }
        Swatch::Bars(look) => histogram::outline(
            scene,
            &[
                (patch.left, patch.bottom),
                (patch.left, patch.top),
                (patch.right, patch.top),
                (patch.right, patch.bottom),
            ],
            look,
            patch.grown(2.0),
        ),
        Swatch::Curve { line, band } => {
            if let Some(colour) = *band {
                let fill = Fill {
                    colour,
                    opacity: curve::BAND,
                };
                scene.shape(Shape::rectangle(patch).filled(fill));
            }
            if let Some(look) = line {
                sample(scene, look, (x, y));
            }
        }
    }
}

fn sample(scene: &mut Scene, look: &Look, (x, y): (f64, f64)) {
    if look.line {
        let stroke = Stroke {
            colour: look.colour,
            width: look.width,
            dash: look.dash,
        };
        scene.shape(Shape::polyline(&[(x, y), (x + SWATCH, y)], stroke));
    }
    let colour = match look.marker {
        Marker::Dot => BLACK,
        Marker::None | Marker::Shape(_) => look.colour,
    };
    marker::draw(scene, look.marker, (x + 0.5 * SWATCH, y), colour);
}
