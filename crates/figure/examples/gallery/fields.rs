//! Fields: sections, frames, magnitudes.

use crate::waves::{SPEEDS, even, velocity};
use figure::{Axis, ColourMap, Figure, Image, Layer, Legend, Panel, Sharing, Style};

fn depth() -> Axis {
    Axis::linear("depth z").si("m").reversed()
}

/// A field over its nodes, in colours up to a size below which a fraction of the values lies.
fn image(
    [x, y]: [Vec<f64>; 2],
    colours: Axis,
    map: ColourMap,
    fraction: f64,
    value: impl Fn(f64, f64) -> f64,
) -> Layer {
    let values: Vec<f64> = y
        .iter()
        .flat_map(|&y| x.iter().map(move |&x| (x, y)))
        .map(|(x, y)| value(x, y))
        .collect();
    let mut sizes: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let largest = sizes[(fraction * (sizes.len() - 1) as f64).round() as usize];
    Layer::Image(Image::new(x, y, values, colours.range(0.0, largest), map))
}

fn field(time: f64, nodes: usize) -> Layer {
    let (r, z) = (even(0.0, 0.04, nodes), even(0.0, 0.03, nodes));
    let colours = Axis::linear("vertical velocity").si("m/s");
    image([r, z], colours, ColourMap::Diverging, 0.995, |r, z| {
        velocity(r, z, time)
    })
}

/// A quarter circle of a radius.
fn front(radius: f64) -> Vec<(f64, f64)> {
    even(0.0, std::f64::consts::FRAC_PI_2, 60)
        .into_iter()
        .map(|angle| (radius * angle.sin(), radius * angle.cos()))
        .collect()
}

fn snapshot(time: f64, nodes: usize) -> Panel {
    let distance = Axis::linear("distance x from the axis").si("m");
    let mut panel = Panel::new(distance, depth());
    panel.has_equal_lengths = true;
    panel.is_mirrored = true;
    panel
        .title(&format!("t = {:.0} µs", 1e6 * time))
        .layer(field(time, nodes))
        .line("P front", Style::Rimmed, front(SPEEDS[0] * (time - 0.8e-6)))
        .line("S front", Style::Rimmed, front(SPEEDS[1] * (time - 0.8e-6)))
}

/// A mirrored section with wave fronts.
pub(crate) fn section() -> Figure {
    Figure::new("Vertical velocity under the impact")
        .width(820.0)
        .panel(snapshot(7e-6, 160))
}

/// Several frames with one colour bar.
pub(crate) fn frames() -> Figure {
    let mut figure = Figure::new("Waves in the block")
        .columns(3)
        .width(1000.0)
        .sharing(Sharing::Both);
    figure.has_common_bar = true;
    for i in 1..=6 {
        let panel = snapshot(2e-6 * f64::from(i), 90).legend(Legend::Off);
        figure = figure.panel(panel);
    }
    figure
}

/// A magnitude over uneven nodes, on a logarithmic axis.
pub(crate) fn magnitude() -> Figure {
    let r: Vec<f64> = (0..60).map(|i| 0.05 * 1.08_f64.powi(i)).collect();
    let z = even(0.02, 6.0, 80);
    let colours = Axis::linear("largest shear stress τ").unit("P/r_{0}^{2}");
    let stress = |r: f64, z: f64| 0.31 * z / (z * z + 0.5 * r * r + 0.25).powf(1.5);
    Figure::new("Static field").width(620.0).panel(
        Panel::new(
            Axis::logarithmic("radius").unit("r_{0}"),
            Axis::linear("depth").unit("r_{0}").reversed(),
        )
        .height(320.0)
        .layer(image([r, z], colours, ColourMap::Sequential, 0.99, stress))
        .mark(1.0, "edge of the disc"),
    )
}
