//! Pictures of sections, from files that the program has written.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use figure::{Figure, Layer, Scale, measure, to_gif};
use formats::{Existing, parse_scene, write_results};
use impact::{KernelChoice, simulate};
use plot::{Kind, Request, animate, compose};
use std::path::{Path, PathBuf};

/// A section of 40 mm under a steel ball of 0.2 mm on steel, whose pulse is 6 mm long.
fn section(folder: &Path, frames: usize, output: &str) -> PathBuf {
    let text = format!(
        "[target]\nmaterial = \"steel\"\n[striker]\nmaterial = \"bearing-steel\"\nmass_kg = 3.3e-8\n\
         tip_radius_m = 1e-4\nvelocity_m_s = 2\n[contact]\ntolerance = 1e-3\n[output]\nduration_s = 7e-6\n{output}\n\
         [map]\nr_max_m = 0.04\nz_max_m = 0.04\npoints = [13, 13]\nframes = {frames}\n"
    );
    let scene = parse_scene(&text, folder).unwrap();
    let outcome = simulate(&scene, &KernelChoice::Direct).unwrap();
    let path = folder.join(format!("{frames}.vtkhdf"));
    write_results(&path, &scene, &outcome, Existing::Keep).unwrap();
    path
}

fn request(kind: Kind, quantity: &str) -> Request {
    Request {
        kind: Some(kind),
        quantities: vec![quantity.to_owned()],
        ..Request::default()
    }
}

/// Every text of a figure, none over another and none outside, at three widths.
fn texts(figure: &Figure) -> Vec<String> {
    let mut found = Vec::new();
    for width in [320.0, 700.0, 1200.0] {
        let measured = measure(&figure.clone().width(width)).unwrap();
        let texts = measured.texts();
        for (i, (text, place)) in texts.iter().enumerate() {
            assert!(measured.canvas.holds(place), "{text} is cut off at {width}");
            for (other, second) in &texts[..i] {
                assert!(!place.overlaps(second), "{text} over {other} at {width}");
            }
        }
        found = texts.into_iter().map(|(text, _)| text).collect();
    }
    found
}

fn images(figure: &Figure) -> Vec<&figure::Image> {
    let mut found = Vec::new();
    for layer in figure.panels.iter().flat_map(|panel| &panel.layers) {
        if let Layer::Image(image) = layer {
            found.push(image);
        }
    }
    found
}

#[test]
fn a_section_shows_its_waves_without_being_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = section(folder.path(), 120, "quantities = [\"velocity_z\"]");
    let (figure, notes) = compose(std::slice::from_ref(&path), &Request::default()).unwrap();
    assert_eq!(figure.panels.len(), 4);
    assert!(notes.is_empty(), "{notes:?}");
    let texts = texts(&figure);
    for wanted in ["P", "S", "R"] {
        let count = texts.iter().filter(|text| *text == wanted).count();
        assert_eq!(count, 4, "{wanted}: {texts:?}");
    }
    assert!(texts.iter().any(|text| text == "depth [mm]"));
    // before the first wave there is nothing, at any of the times
    for (panel, image) in figure.panels.iter().zip(images(&figure)) {
        let front = panel.layers.iter().find_map(|layer| match layer {
            Layer::Line(line) => Some(line.points[0].0),
            _ => None,
        });
        let largest = image.values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        for (i, value) in image.values.iter().enumerate() {
            let (r, z) = (image.x[i % image.x.len()], image.y[i / image.x.len()]);
            if r.hypot(z) > front.unwrap() {
                assert!(value.abs() < 1e-6 * largest, "{r} {z}: {value}");
            }
        }
    }
    let (figures, _) = animate(
        &[path],
        &Request {
            frames: Some(3),
            ..Request::default()
        },
    )
    .unwrap();
    let gif = to_gif(&figures, 1.0, 0.1).unwrap();
    assert!(figures.len() == 3 && gif.starts_with(b"GIF89a"));
}

#[test]
fn velocities_are_those_of_the_file_or_none() {
    let folder = tempfile::tempdir().unwrap();
    let without = section(folder.path(), 9, "");
    let refused = compose(
        std::slice::from_ref(&without),
        &request(Kind::Waves, "velocity_z"),
    );
    let said = refused.unwrap_err().to_string();
    assert!(
        said.ends_with("has no velocity_z: give the scene [output] quantities = [\"velocity_z\"]"),
        "{said}"
    );
    let (figure, notes) = compose(&[without], &Request::default()).unwrap();
    assert!(notes[0].contains("quantities"), "{notes:?}");
    assert_eq!(images(&figure)[0].colours.quantity, "axial displacement");
}

#[test]
fn limits_and_ratios_are_those_that_are_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = section(folder.path(), 9, "");
    let asked = Request {
        limits: Some((1e3, 1e6)),
        scale: Some(Scale::Logarithmic),
        ..request(Kind::Waves, "stress_zz")
    };
    let (figure, _) = compose(std::slice::from_ref(&path), &asked).unwrap();
    let image = images(&figure)[0];
    assert_eq!(image.colours.range, Some((1e3, 1e6)));
    assert_eq!(image.colours.quantity, "size of the axial stress");
    assert!(image.values.iter().all(|value| *value >= 0.0));
    texts(&figure);
    let turned = Request {
        limits: Some((1.0, -1.0)),
        ..request(Kind::Waves, "stress_zz")
    };
    let late = Request {
        times_s: vec![1e-6, 1e300],
        ..request(Kind::Waves, "stress_zz")
    };
    for (asked, sentence) in [
        (turned, "the limits 1:-1"),
        (late, "there is no frame at 1e300 s"),
    ] {
        let refused = compose(std::slice::from_ref(&path), &asked).unwrap_err();
        assert!(refused.to_string().starts_with(sentence), "{refused}");
    }
}

#[test]
fn limits_from_zero_make_a_scale_linear() {
    let folder = tempfile::tempdir().unwrap();
    let path = section(folder.path(), 20, "peaks = true");
    for kind in [Kind::Peak, Kind::Axis] {
        let decades = compose(std::slice::from_ref(&path), &request(kind, "von_mises"));
        let asked = Request {
            limits: Some((0.0, 1e6)),
            ..request(kind, "von_mises")
        };
        let linear = compose(std::slice::from_ref(&path), &asked);
        let scales = [decades, linear].map(|drawn| {
            let (figure, _) = drawn.unwrap();
            texts(&figure);
            let image = images(&figure).first().map(|image| image.colours.scale);
            image.unwrap_or(figure.panels[0].y.scale)
        });
        assert_eq!(scales, [Scale::Logarithmic, Scale::Linear], "{kind:?}");
    }
}

#[test]
fn every_kind_of_picture_of_a_section_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let path = section(folder.path(), 60, "");
    for (kind, quantity) in [
        (Kind::Peak, "von_mises"),
        (Kind::Peak, "stress_zz"),
        (Kind::Surface, "displacement_z"),
        (Kind::Depth, "stress_zz"),
        (Kind::Axis, "stress_zz"),
        (Kind::Axis, "displacement_z"),
        (Kind::Waves, "max_shear"),
    ] {
        let (figure, _) = compose(std::slice::from_ref(&path), &request(kind, quantity)).unwrap();
        assert!(texts(&figure).len() > 10, "{kind} {quantity}");
    }
    let unknown = compose(
        std::slice::from_ref(&path),
        &request(Kind::Waves, "stress_zx"),
    );
    assert!(unknown.unwrap_err().to_string().contains("did you mean"));
    let two = compose(&[path.clone(), path], &request(Kind::Waves, "stress_zz"));
    let two = two.unwrap_err().to_string();
    assert!(two.ends_with("shows one file, and 2 were given"), "{two}");
}
