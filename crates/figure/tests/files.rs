//! Small figures as files: SVG to the byte, PNG with something on it, PDF with its font.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use figure::{
    Axis, Classes, ColourMap, Figure, Image, Interval, Layer, Line, Panel, Scale, Style, to_gif,
    to_pdf, to_png, to_svg,
};
use std::path::Path;
use tiny_skia::{Pixmap, PremultipliedColorU8};

/// A curve over a band, with a mark.
fn curve() -> Figure {
    let squares = (0..5).map(|i| (f64::from(i), f64::from(i * i)));
    let points: Vec<_> = squares.map(|(x, y)| (x, [y - 1.0, y, y + 1.0])).collect();
    Figure::new("A < B & C").width(300.0).panel(
        Panel::new(
            Axis::linear("time").unit("r_{0}/c_{1}"),
            Axis::linear("force").si("N"),
        )
        .height(120.0)
        .banded("P", Style::Marked, &points)
        .mark(1.0, "S"),
    )
}

/// Classes on logarithmic axes, with a point.
fn classes() -> Figure {
    let x = Interval::logarithmic(1.0, 1e6);
    let y = Interval::logarithmic(1e-9, 1.0);
    let row = x.cells(4).into_iter().map(|x| usize::from(x > 1e3));
    let map = Classes {
        shape: [4, 2],
        class: row.clone().chain(row).collect(),
        names: vec!["good".to_owned(), "bad".to_owned()],
    };
    let broken = vec![
        (1.0, 1.0),
        (1e2, 1e-3),
        (f64::NAN, 1.0),
        (1e4, 1e-6),
        (1e6, 1e-9),
    ];
    Figure::new("").width(360.0).panel(
        Panel::new(Axis::over(x, "cost"), Axis::over(y, "error"))
            .height(120.0)
            .layer(Layer::Classes(map))
            .line("front", Style::HeavyDashed, broken)
            .layer(Layer::star((1e5, 1e-2), "here")),
    )
}

/// An image with its bar, and a histogram.
fn image() -> Figure {
    let nodes = vec![0.0, 1.0, 2.0];
    let values = nodes
        .iter()
        .flat_map(|y| nodes.iter().map(move |x| 1e-6 * (x - y)));
    let (values, colours) = (values.collect(), Axis::linear("u").si("m"));
    let image = Image::new(nodes.clone(), nodes, values, colours, ColourMap::Diverging);
    let bars = Line::histogram("n", &[1.0, 2.0, 2.5, 4.0], 3, Scale::Linear);
    let axis = || Axis::linear("x").si("m");
    Figure::new("")
        .width(300.0)
        .columns(2)
        .panel(
            Panel::new(axis(), axis().reversed())
                .height(80.0)
                .layer(Layer::Image(image)),
        )
        .panel(
            Panel::new(Axis::linear("e"), Axis::linear("n"))
                .height(80.0)
                .layer(Layer::Line(bars)),
        )
}

fn all() -> [(&'static str, Figure); 3] {
    [
        ("curve", curve()),
        ("classes", classes()),
        ("image", image()),
    ]
}

#[test]
fn the_svg_is_the_same_to_the_byte() {
    for (name, figure) in all() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/golden/{name}.svg"));
        let svg = to_svg(&figure).unwrap();
        // writes them anew; then look at each
        if std::env::var_os("FIGURE_BLESS").is_some() {
            std::fs::write(&path, &svg).unwrap();
        }
        let golden = std::fs::read_to_string(&path).unwrap();
        assert!(svg == golden, "{name}.svg is not what it was");
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
    }
}

#[test]
fn the_png_has_the_curve_its_text_and_its_size() {
    let decode = |figure: &Figure| Pixmap::decode_png(&to_png(figure, 2.0).unwrap()).unwrap();
    let pixels = decode(&curve());
    assert_eq!(pixels.width(), 600);
    let blue = |p: &&PremultipliedColorU8| p.blue() > 100 && p.red() < 60;
    assert!(
        pixels.pixels().iter().filter(blue).count() > 300,
        "the curve"
    );
    let dark = |pixels: &Pixmap| pixels.pixels().iter().filter(|p| p.green() < 100).count();
    let mut silent = curve();
    silent.title.clear();
    assert!(dark(&pixels) > 100 + dark(&decode(&silent)), "the title");
}

/// Pages whose height ends within a pixel, of several widths.
#[test]
fn an_animation_is_white_to_its_last_row() {
    for pixels in [293.0, 300.5, 411.0, 607.3] {
        let figures = [curve().width(pixels), curve().width(pixels)];
        let bytes = to_gif(&figures, 1.0, 0.1).unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(bytes.as_slice()).unwrap();
        let (width, mut frames) = (usize::from(decoder.width()), 0);
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            let last = &frame.buffer[frame.buffer.len() - 4 * width..];
            assert!(last.iter().all(|byte| *byte == 255), "{pixels}");
            frames += 1;
        }
        assert_eq!(frames, 2);
    }
}

/// Frames whose layout differs share a page.
#[test]
fn frames_of_different_sizes_make_an_animation() {
    let figures = [curve().width(300.0), curve().width(302.0)];
    let bytes = to_gif(&figures, 1.0, 0.1).unwrap();
    let mut decoder = gif::DecodeOptions::new()
        .read_info(bytes.as_slice())
        .unwrap();
    assert_eq!(decoder.width(), 302);
    assert!(decoder.read_next_frame().unwrap().is_some());
}

#[test]
fn an_image_is_seen_in_its_colours() {
    let pixels = Pixmap::decode_png(&to_png(&image(), 1.0).unwrap()).unwrap();
    let count = |of: &dyn Fn(u8, u8) -> bool| {
        let found = pixels.pixels().iter();
        found.filter(|p| of(p.red(), p.blue())).count()
    };
    assert!(count(&|red, blue| red > 120 && blue < 60) > 30, "positive");
    assert!(count(&|red, blue| blue > 120 && red < 60) > 30, "negative");
}

#[test]
fn the_pdf_has_its_page_its_font_and_its_pictures() {
    for (name, figure) in all() {
        let pdf = to_pdf(&figure).unwrap();
        let text = String::from_utf8_lossy(&pdf);
        assert!(text.starts_with("%PDF-1."), "{name}");
        assert!(text.trim_end().ends_with("%%EOF"), "{name}");
        assert!(text.contains("Ubuntu-Light") && text.contains("/ToUnicode"));
        let pictures = if name == "image" { 2 } else { 0 };
        assert_eq!(text.matches("/Subtype /Image").count(), pictures, "{name}");
        assert!(pdf.len() < 60_000, "{name}: {}", pdf.len());
    }
}

#[test]
fn what_cannot_be_drawn_is_refused_with_its_place() {
    let refused = |figure: &Figure| to_svg(figure).expect_err("drawn");
    let none = refused(&Figure::new("")).to_string();
    assert_eq!(none, "the figure has no panels");
    let mut figure = classes();
    figure.panels[0].y.range = Some((0.0, 1.0));
    let message = refused(&figure).to_string();
    assert_eq!(message, "panel 0: the y axis cannot run from 0 to 1");
    let mut figure = image();
    if let Layer::Image(image) = &mut figure.panels[0].layers[0] {
        image.values.pop();
    }
    let message = refused(&figure).to_string();
    assert_eq!(message, "panel 0: 8 values of an image, but 9 are required");
    let wide = refused(&curve().width(1e9));
    assert_eq!(
        wide.to_string(),
        "the width of 1000000000 px is outside [1, 16384] px"
    );
    let mut figure = classes();
    figure.panels[0].has_equal_lengths = true;
    let message = refused(&figure).to_string();
    assert!(message.ends_with("has equal lengths, and must be linear"));
}
