//! Fields: sections, frames, magnitudes.

use crate::waves::{SPEEDS, even, velocity};
use figure::{
    Axis, ColourMap, ColourScale, Figure, Image, Layer, Legend, Limits, Mirror, Panel, Sharing,
    Style, Unit,
};

fn depth() -> Axis {
    Axis::linear("depth z").si("m").reversed()
}

fn scale() -> ColourScale {
    ColourScale::new(
        "vertical velocity",
        Unit::Si("m/s".to_owned()),
        ColourMap::Diverging,
    )
    .limits(Limits::Percentile(99.5))
}

fn field(time: f64, nodes: usize) -> Layer {
    let (r, z) = (even(0.0, 0.04, nodes), even(0.0, 0.03, nodes));
    Layer::Image(Image::of(r, z, scale(), |r, z| velocity(r, z, time)))
}

/// A quarter circle of a radius.
fn front(radius: f64) -> Vec<(f64, f64)> {
    even(0.0, std::f64::consts::FRAC_PI_2, 60)
        .into_iter()
        .map(|angle| (radius * angle.sin(), radius * angle.cos()))
        .collect()
}

fn snapshot(time: f64, nodes: usize) -> Panel {
    Panel::new(Axis::linear("distance x from the axis").si("m"), depth())
        .title(&format!("t = {:.0} µs", 1e6 * time))
        .equal_lengths()
        .mirrored(Mirror::Even)
        .layer(field(time, nodes))
        .line("P front", Style::Rimmed, front(SPEEDS[0] * (time - 0.8e-6)))
        .line(
            "S front",
            Style::RimmedDashed,
            front(SPEEDS[1] * (time - 0.8e-6)),
        )
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
        .sharing(Sharing::Both)
        .common_colour_bar();
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
    let colours = ColourScale::new(
        "largest shear stress τ",
        Unit::Fixed("P/r_{0}^{2}".to_owned()),
        ColourMap::Sequential,
    )
    .limits(Limits::Percentile(99.0));
    let stress = |r: f64, z: f64| 0.31 * z / (z * z + 0.5 * r * r + 0.25).powf(1.5);
    Figure::new("Static field").width(620.0).panel(
        Panel::new(
            Axis::logarithmic("radius").unit("r_{0}"),
            Axis::linear("depth").unit("r_{0}").reversed(),
        )
        .height(320.0)
        .layer(Layer::Image(Image::of(r, z, colours, stress)))
        .mark(1.0, "edge of the disc"),
    )
}
