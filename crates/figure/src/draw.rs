//! From a layout to a scene.

use crate::colour::WHITE;
use crate::error::FigureError;
use crate::figure::Figure;
use crate::geometry::Rect;
use crate::layers::Plot;
use crate::layout::{Layout, PAD, Placed, lay_out, marks, points};
use crate::scene::{Anchor, Scene, Shape, Text};
use crate::text::{LINE, Typeface};

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
    scene.shape(Shape::rectangle(canvas).filled(WHITE, 1.0));
    heading(&mut scene, &layout);
    for panel in &layout.panels {
        draw_panel(&mut scene, panel, &layout.faces);
    }
    if let Some((bar, plots)) = &layout.bar {
        bar.draw(&mut scene, *plots, &layout.faces);
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

fn draw_panel(scene: &mut Scene, placed: &Placed<'_>, faces: &Typeface) {
    let Placed {
        plan,
        fitted,
        frame,
    } = placed;
    if !plan.is_filled() {
        fitted.axes.draw_grid(scene, frame);
    }
    let plot = Plot {
        frame,
        colours: plan.colours.as_ref(),
    };
    for (layer, &slot) in plan.panel.layers.iter().zip(&plan.slots) {
        layer.kind().draw(scene, &plot, slot);
    }
    marks::draw(scene, plan, frame, &fitted.marks, faces);
    fitted.axes.draw(scene, frame, faces);
    let mut line = frame.area.top - faces.gap() - Typeface::lines(faces.mark, fitted.mark_rows);
    for title in fitted.title.iter().rev() {
        let at = (frame.area.centre().0, line - 0.2 * faces.panel);
        scene.text(Text::new(title, at, faces.panel, Anchor::Middle));
        line -= LINE * faces.panel;
    }
    let legend = fitted.legend.as_ref();
    let taken = legend.and_then(|legend| legend.covered(frame.area));
    points::draw(scene, plan, frame, taken, faces.tick);
    if let Some(legend) = legend {
        legend.draw(scene, frame.area, faces.legend);
    }
    if let Some(bar) = &fitted.bar {
        bar.draw(scene, frame.area, faces);
    }
}
