//! Pictures of sections, from files that the program has written.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use figure::{Figure, Layer, Scale, measure, to_gif};
use formats::{Existing, parse_scene, write_results};
use impact::{KernelChoice, simulate};
use plot::{PictureKind, Request, animate, compose};
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

fn request(kind: PictureKind, quantity: &str) -> Request {
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
            // colours change evenly over the cells that the front crosses
            if r.hypot(z) > front.unwrap() + 1.5 * 0.04 / 12.0 {
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
        &request(PictureKind::Waves, "velocity_z"),
    );
    let said = refused.unwrap_err().to_string();
    assert!(
        said.ends_with(
            "has no velocity_z: add [output] quantities = [\"velocity_z\"] to the scene"
        ),
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
        ..request(PictureKind::Waves, "stress_zz")
    };
    let (figure, _) = compose(std::slice::from_ref(&path), &asked).unwrap();
    let image = images(&figure)[0];
    assert_eq!(image.colours.range, Some((1e3, 1e6)));
    assert_eq!(image.colours.quantity, "magnitude of the axial stress");
    assert!(image.values.iter().all(|value| *value >= 0.0));
    texts(&figure);
    let turned = Request {
        limits: Some((1.0, -1.0)),
        ..request(PictureKind::Waves, "stress_zz")
    };
    let late = Request {
        times_s: vec![1e-6, 1e300],
        ..request(PictureKind::Waves, "stress_zz")
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
    for kind in [PictureKind::Peak, PictureKind::Axis] {
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
        (PictureKind::Peak, "von_mises"),
        (PictureKind::Peak, "stress_zz"),
        (PictureKind::Surface, "displacement_z"),
        (PictureKind::Depth, "stress_zz"),
        (PictureKind::Axis, "stress_zz"),
        (PictureKind::Axis, "displacement_z"),
        (PictureKind::Waves, "max_shear"),
    ] {
        let (figure, _) = compose(std::slice::from_ref(&path), &request(kind, quantity)).unwrap();
        assert!(texts(&figure).len() > 10, "{kind} {quantity}");
    }
    let unknown = compose(
        std::slice::from_ref(&path),
        &request(PictureKind::Waves, "stress_zx"),
    );
    assert!(unknown.unwrap_err().to_string().contains("did you mean"));
    let two = compose(
        &[path.clone(), path],
        &request(PictureKind::Waves, "stress_zz"),
    );
    let two = two.unwrap_err().to_string();
    assert!(two.ends_with("shows one file, but 2 were given"), "{two}");
}

fn sides(figure: &Figure) -> &figure::Image {
    images(figure)[0]
}

#[test]
fn the_largest_value_says_over_what_it_is_the_largest() {
    let folder = tempfile::tempdir().unwrap();
    for (frames, output, over, notes) in [
        (7, "", "largest over 7 frames", 1),
        (8, "peaks = true", "largest over 8 frames", 1),
        (
            9,
            "peaks = true\nquantities = [\"von_mises\"]",
            "largest over time",
            0,
        ),
    ] {
        let path = section(folder.path(), frames, output);
        let (figure, said) = compose(&[path], &request(PictureKind::Peak, "von_mises")).unwrap();
        let words = &sides(&figure).colours.quantity;
        assert!(words.ends_with(over), "{words}");
        assert_eq!(said.len(), notes, "{said:?}");
        assert!(said.iter().all(|note| note.contains("peaks = true")));
        assert!(
            texts(&figure)
                .iter()
                .any(|text| text.starts_with("largest "))
        );
    }
}

/// A contact of some 0.01 mm lies in a cell of 3.3 mm: the cell is not filled with its stress.
#[test]
fn a_contact_does_not_fill_its_cell() {
    let folder = tempfile::tempdir().unwrap();
    let path = section(folder.path(), 60, "peaks = true");
    for (quantity, power) in [("stress_zz", 2.0), ("displacement_z", 1.0)] {
        let (figure, _) = compose(
            std::slice::from_ref(&path),
            &request(PictureKind::Peak, quantity),
        )
        .unwrap();
        let image = sides(&figure);
        let (width, cell) = (image.x.len(), 0.04 / 12.0);
        let at = |r: f64, z: f64| {
            let near = |nodes: &[f64], x: f64| nodes.iter().position(|n| (n - x).abs() < 1e-9);
            image.values[near(&image.y, z).unwrap() * width + near(&image.x, r).unwrap()]
        };
        assert!(width > 300, "{width}");
        // half as far is twice the displacement or four times the stress
        let ratio = at(0.0, 0.5 * cell) / at(0.0, cell);
        let law = 2.0_f64.powf(power);
        assert!(
            ratio > 0.8 * law && ratio < 2.0 * law,
            "{quantity}: {ratio}"
        );
    }
}

/// Between two places of the section a wave is as large as at them.
#[test]
fn a_wave_along_the_surface_has_no_teeth() {
    let folder = tempfile::tempdir().unwrap();
    let path = section(folder.path(), 150, "");
    let (figure, notes) =
        compose(&[path], &request(PictureKind::Surface, "displacement_z")).unwrap();
    assert!(notes.is_empty(), "{notes:?}");
    let image = sides(&figure);
    let parts = (image.y.len() - 1) / 12;
    let largest = |row: usize| {
        let row = &image.values[row * image.x.len()..][..image.x.len()];
        row.iter()
            .copied()
            .filter(|v| v.is_finite())
            .fold(0.0_f64, |m, v| m.max(v.abs()))
    };
    // the Rayleigh wave has passed these cells when the output ends
    for cell in 2..5 {
        let [a, middle, b] = [0, parts / 2, parts].map(|part| largest(cell * parts + part));
        assert!(
            middle > 0.93 * a.min(b) && middle < 1.07 * a.max(b),
            "{cell}: {a} {middle} {b}"
        );
    }
    let few = section(folder.path(), 6, "");
    let (_, notes) = compose(&[few], &request(PictureKind::Surface, "displacement_z")).unwrap();
    assert!(
        notes[0].contains("look like dots: use [map] frames = "),
        "{notes:?}"
    );
}

#[test]
fn the_axis_has_a_static_curve_for_stored_stresses() {
    let folder = tempfile::tempdir().unwrap();
    let stored = section(folder.path(), 11, "quantities = [\"von_mises\"]");
    let derived = section(folder.path(), 12, "");
    let [stored, derived] = [stored, derived].map(|path| {
        let (figure, _) = compose(&[path], &request(PictureKind::Axis, "von_mises")).unwrap();
        let lines = figure.panels[0]
            .layers
            .iter()
            .filter_map(|layer| match layer {
                Layer::Line(line) if line.name.starts_with("static") => Some(line.points.clone()),
                _ => None,
            });
        lines.collect::<Vec<_>>()
    });
    assert!(stored.len() == 1 && stored == derived);
}

#[test]
fn a_span_chooses_the_frames() {
    let folder = tempfile::tempdir().unwrap();
    let path = section(folder.path(), 71, "");
    let asked = Request {
        span_s: Some((2e-6, 5e-6)),
        frames: Some(4),
        ..request(PictureKind::Waves, "displacement_z")
    };
    let (figure, _) = compose(std::slice::from_ref(&path), &asked).unwrap();
    assert_eq!(figure.panels.len(), 4);
    for (panel, wanted) in figure.panels.iter().zip([2.0, 3.0, 4.0, 5.0]) {
        let shown: f64 = panel.title.split(' ').next().unwrap().parse().unwrap();
        // half of the distance of two frames
        assert!((shown - wanted).abs() < 0.051, "{}", panel.title);
    }
    let both = Request {
        times_s: vec![3e-6],
        ..asked
    };
    let said = compose(&[path], &both).unwrap_err().to_string();
    assert!(said.ends_with("use only one of them"), "{said}");
}

/// Frames that the scene puts at some times are those that a picture of these times shows.
#[test]
fn times_of_a_scene_are_times_of_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[target]\nmaterial = \"steel\"\n[striker]\nmaterial = \"bearing-steel\"\nmass_kg = 3.3e-8\n\
        tip_radius_m = 1e-4\nvelocity_m_s = 2\n[map]\nr_max_m = 0.01\nz_max_m = 0.01\npoints = [4, 4]\n\
        times_s = [7.77e-7, 1.5e-6, 2.22e-6]\n";
    let scene = parse_scene(text, folder.path()).unwrap();
    let outcome = simulate(&scene, &KernelChoice::Direct).unwrap();
    let path = folder.path().join("times.h5");
    write_results(&path, &scene, &outcome, Existing::Keep).unwrap();
    let of = |times_s: &[f64]| {
        let asked = Request {
            times_s: times_s.to_vec(),
            ..request(PictureKind::Waves, "stress_zz")
        };
        compose(std::slice::from_ref(&path), &asked)
    };
    assert_eq!(of(&[7.77e-7, 2.22e-6]).unwrap().0.panels.len(), 2);
    assert!(of(&[6e-7]).is_err() && of(&[2.4e-6]).is_err());
}

#[test]
fn von_mises_on_a_soft_target_has_its_line_of_yield() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[target]\nmaterial = \"mild-steel\"\n[striker]\nmaterial = \"tungsten-carbide\"\nshape = \"ball\"\n\
        diameter_m = 0.002\nvelocity_m_s = 3\n[output]\npeaks = true\nquantities = [\"von_mises\"]\n\
        [map]\nr_max_m = 1e-3\nz_max_m = 1e-3\npoints = [11, 11]\nframes = 3\n";
    let scene = parse_scene(text, folder.path()).unwrap();
    let outcome = simulate(&scene, &KernelChoice::Direct).unwrap();
    let path = folder.path().join("soft.h5");
    write_results(&path, &scene, &outcome, Existing::Keep).unwrap();
    let (figure, _) = compose(&[path], &request(PictureKind::Peak, "von_mises")).unwrap();
    let strength_pa = scene.target.material().yield_strength_pa.unwrap();
    let image = sides(&figure);
    let line = figure.panels[0]
        .layers
        .iter()
        .find_map(|layer| match layer {
            Layer::Line(line) => Some(line),
            _ => None,
        });
    let points = line.unwrap().points.iter().filter(|p| p.0.is_finite());
    assert!(points.clone().count() > 20);
    for (r, z) in points {
        let cell =
            |nodes: &[f64], x: f64| nodes.partition_point(|n| *n <= x).clamp(1, nodes.len() - 1);
        let (i, k) = (cell(&image.x, *r), cell(&image.y, *z));
        let corners = [(i - 1, k - 1), (i, k - 1), (i - 1, k), (i, k)];
        let values = corners.map(|(i, k)| image.values[k * image.x.len() + i]);
        let (low, high) = (
            values.into_iter().fold(f64::INFINITY, f64::min),
            values.into_iter().fold(0.0, f64::max),
        );
        assert!(
            0.999 * low <= strength_pa && strength_pa <= 1.001 * high,
            "{r} {z}: {low} {high}"
        );
    }
    assert!(
        figure.subtitle.contains("the onset of yield"),
        "{}",
        figure.subtitle
    );
}
