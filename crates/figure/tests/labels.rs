//! No label is cut off and none lies over another, at any size.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

#[path = "../examples/gallery/curves.rs"]
mod curves;
#[path = "../examples/gallery/fields.rs"]
mod fields;
#[path = "../examples/gallery/waves.rs"]
mod waves;

use figure::{Figure, Layer, Rect, measure};

fn gallery() -> Vec<(&'static str, Figure)> {
    vec![
        ("histories", curves::histories()),
        ("convergence", curves::convergence()),
        ("styles", curves::styles()),
        ("classes", curves::classes()),
        ("histograms", curves::histograms()),
        ("section", fields::section()),
        ("frames", fields::frames()),
        ("magnitude", fields::magnitude()),
        ("column", curves::column()),
    ]
}

/// Sizes from a thumbnail to a poster: width, height of the plots, height of the text.
const SIZES: [[f64; 3]; 8] = [
    [120.0, 60.0, 12.0],
    [240.0, 90.0, 9.0],
    [321.0, 160.0, 9.5],
    [321.0, 160.0, 16.0],
    [640.0, 200.0, 12.0],
    [860.0, 300.0, 24.0],
    [1600.0, 700.0, 14.0],
    [4000.0, 1500.0, 40.0],
];

fn sized(mut figure: Figure, [width, height, text]: [f64; 3]) -> Figure {
    (figure.width, figure.text) = (width, text);
    for panel in &mut figure.panels {
        panel.height = height;
    }
    figure
}

/// Rounding apart.
fn overlap(a: &Rect, b: &Rect) -> bool {
    let narrower = Rect {
        left: a.left + 0.01,
        top: a.top + 0.01,
        right: a.right - 0.01,
        bottom: a.bottom - 0.01,
    };
    narrower.overlaps(b)
}

#[test]
fn no_label_lies_over_another_or_leaves_the_canvas() {
    let mut faults = Vec::new();
    for (name, figure) in gallery() {
        let own = [figure.width, figure.panels[0].height, figure.text];
        for size in SIZES.into_iter().chain([own]) {
            let found = measure(&sized(figure.clone(), size)).unwrap();
            let texts = found.texts();
            for (i, (text, area)) in texts.iter().enumerate() {
                if !found.canvas.holds(area) {
                    faults.push(format!("{name} at {size:?}: \"{text}\" leaves the canvas"));
                }
                for (other, below) in &texts[..i] {
                    if overlap(area, below) {
                        faults.push(format!("{name} at {size:?}: \"{text}\" over \"{other}\""));
                    }
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_axis_and_mark_is_labelled() {
    for (name, figure) in gallery() {
        let found = measure(&figure).unwrap();
        let written: String = found.texts().into_iter().map(|(text, _)| text).collect();
        for panel in &figure.panels {
            for axis in [&panel.x, &panel.y] {
                let first = axis.quantity.split(' ').next().unwrap();
                assert!(written.contains(first), "{name}: {first}");
            }
            for layer in &panel.layers {
                if let Layer::Mark { label, .. } = layer {
                    assert!(written.contains(label), "{name}: {label}");
                }
            }
        }
    }
    let found = measure(&fields::frames()).unwrap();
    let texts = found.texts();
    let bars = texts.iter().filter(|(t, _)| t.contains("[mm/s]"));
    assert_eq!(bars.count(), 1, "one colour bar for all frames");
}

#[test]
fn equal_lengths_are_equal_at_any_size() {
    for size in SIZES {
        let found = measure(&sized(fields::section(), size)).unwrap();
        let plot = found.plots[0];
        // 80 mm by 30 mm
        let ratio = plot.width() / plot.height();
        assert!((ratio - 80.0 / 30.0).abs() < 1e-9, "{size:?}: {ratio}");
    }
}
