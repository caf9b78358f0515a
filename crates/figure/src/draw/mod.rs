//! From a layout to a scene, one kind of thing a file.

mod axes;
mod bar;
mod classes;
mod curve;
mod histogram;
mod image;
mod legend;
mod marker;
mod marks;
mod points;

use crate::colour::{BLACK, WHITE};
use crate::error::FigureError;
use crate::figure::Figure;
use crate::geometry::Rect;
use crate::layer::Layer;
use crate::layout::{Layout, PAD, Placed, Slot, Typeface, lay_out, look};
use crate::panel::Mirror;
use crate::scene::{Anchor, Fill, Item, Scene, Shape, Stroke, Text};

/// Everything that a figure shows, with places in pixels.
pub(crate) fn draw(figure: &Figure) -> Result<Scene, FigureError> {
    figure.check()?;
    let layout = lay_out(figure);
    let mut scene = Scene {
        width: layout.width,
        height: layout.height,
        plots: layout.panels.iter().map(|p| p.frame.area).collect(),
        items: Vec::new(),
    };
    let canvas = Rect::new(0.0, 0.0, layout.width, layout.height);
    scene.shape(Shape::rectangle(canvas).filled(Fill::solid(WHITE)));
    heading(&mut scene, &layout);
    for panel in &layout.panels {
        draw_panel(&mut scene, panel, &layout);
    }
    if let Some((fitted, plots)) = &layout.bar {
        bar::draw(&mut scene, fitted, *plots, &layout.faces);
    }
    Ok(scene)
}

/// Title and the line below it.
fn heading(scene: &mut Scene, layout: &Layout<'_>) {
    let faces = &layout.faces;
    let mut top = PAD;
    let titles = layout.title.iter().map(|line| (line, faces.title));
    let subtitles = layout.subtitle.iter().map(|line| (line, faces.subtitle));
    for (line, size) in titles.chain(subtitles) {
        scene.text(Text::new(line, (PAD, top + size), size, Anchor::Start));
        top += Typeface::lines(size, 1);
    }
}

fn draw_panel(scene: &mut Scene, placed: &Placed<'_>, layout: &Layout<'_>) {
    let faces = &layout.faces;
    let layers = &placed.plan.panel.layers;
    if !layers.iter().any(Layer::fills) {
        axes::grid(scene, placed);
    }
    let slots = layout.looks.slots(layers);
    for (layer, &slot) in layers.iter().zip(&slots) {
        draw_layer(scene, placed, layer, slot);
    }
    marks::draw(scene, placed, faces);
    axes::draw(scene, placed, faces);
    points::draw(scene, placed, faces);
    if let Some((block, place)) = &placed.fitted.legend {
        legend::draw(scene, block, place, placed.frame.area, faces);
    }
    if let Some(fitted) = &placed.fitted.bar {
        bar::draw(scene, fitted, placed.frame.area, faces);
    }
}

fn draw_layer(scene: &mut Scene, placed: &Placed<'_>, layer: &Layer, slot: Slot) {
    let frame = &placed.frame;
    let mirror = placed.plan.panel.mirror;
    match layer {
        Layer::Line(line) => {
            let look = look(slot, line.style);
            for points in sides(&line.points, mirror) {
                curve::draw(scene, frame, &points, look);
            }
        }
        Layer::Band(band) => curve::band(scene, frame, band, slot, mirror),
        Layer::Histogram(bars) => histogram::draw(scene, frame, bars, slot),
        Layer::Image(field) => {
            if let Some(colours) = &placed.plan.colours {
                let picture = image::pixels(field, frame, colours, mirror);
                scene.items.push(Item::Picture(picture));
            }
        }
        Layer::Classes(classes) => classes::draw(scene, frame.area, classes),
        // over everything else, with their labels
        Layer::Mark(_) | Layer::Point(_) => {}
    }
}

/// A curve, and where a panel is mirrored also its other half.
fn sides(points: &[(f64, f64)], mirror: Mirror) -> Vec<Vec<(f64, f64)>> {
    let own = points.to_vec();
    match mirror {
        Mirror::Off => vec![own],
        Mirror::Even | Mirror::Odd => {
            let other = own.iter().map(|&(x, y)| (-x, y)).collect();
            vec![own, other]
        }
    }
}

/// The thin line around a plot and the ticks.
fn thin() -> Stroke {
    Stroke::solid(BLACK, 1.0)
}
