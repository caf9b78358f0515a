//! Markers that differ in shape.

use svg::node::element::{Circle, Group, Path, path::Data};

/// Adds the `index`-th marker of half width `size`.
pub(super) fn draw(
    group: Group,
    index: usize,
    x: f64,
    y: f64,
    size: f64,
    stroke: &str,
    fill: &str,
) -> Group {
    let s = size;
    // every other round of shapes is filled
    let fill = if (index / 7).is_multiple_of(2) {
        fill
    } else {
        stroke
    };
    let polygon = |corners: &[(f64, f64)]| {
        let mut data = Data::new();
        for (i, (dx, dy)) in corners.iter().enumerate() {
            let at = (x + dx * s, y + dy * s);
            data = if i == 0 {
                data.move_to(at)
            } else {
                data.line_to(at)
            };
        }
        data.close()
    };
    let data = match index % 7 {
        0 => {
            return group.add(
                Circle::new()
                    .set("cx", x)
                    .set("cy", y)
                    .set("r", 0.95 * s)
                    .set("fill", fill)
                    .set("stroke", stroke)
                    .set("stroke-width", 1.5),
            );
        }
        1 => polygon(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
        2 => polygon(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]),
        3 => polygon(&[(0.0, -1.3), (1.0, 0.0), (0.0, 1.3), (-1.0, 0.0)]),
        4 => polygon(&[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)]),
        5 => Data::new()
            .move_to((x - s, y - s))
            .line_to((x + s, y + s))
            .move_to((x - s, y + s))
            .line_to((x + s, y - s)),
        _ => {
            let corner = |i: usize| {
                let angle = std::f64::consts::PI * (i as f64 / 5.0 - 0.5);
                let radius = if i.is_multiple_of(2) { 1.3 } else { 0.55 };
                (radius * angle.cos(), radius * angle.sin())
            };
            polygon(&(0..10).map(corner).collect::<Vec<_>>())
        }
    };
    group.add(
        Path::new()
            .set("d", data)
            .set("fill", fill)
            .set("stroke", stroke)
            .set("stroke-width", 1.5),
    )
}
