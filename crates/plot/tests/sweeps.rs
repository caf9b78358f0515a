//! Pictures of sweeps and tables, from files that the program has written.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use figure::{Figure, Layer, measure};
use formats::sweep::{Spec, run_rows, stage_rows};
use formats::{Existing, Output};
use plot::{PictureKind, PlotError, Request, compose};
use std::path::{Path, PathBuf};

/// The results of a sweep of a steel ball on some targets.
fn sweep(folder: &Path, name: &str, varies: &str) -> PathBuf {
    let text = format!(
        "[scene.target]\nmaterial = \"steel\"\n[scene.striker]\nmaterial = \"bearing-steel\"\nmass_kg = 4.1e-3\n\
         tip_radius_m = 0.005\nvelocity_m_s = 1.0\n{varies}"
    );
    let spec = Spec::from_toml(&text, folder).unwrap();
    let path = folder.join(name);
    let part = folder.join("part");
    let done = run_rows(&spec, &part, Existing::Replace, |_| true).unwrap();
    let output = Output::claim(&path, Existing::Keep).unwrap();
    let staged = stage_rows(&output, &spec, &done.unwrap()).unwrap();
    staged.commit().unwrap();
    path
}

const VELOCITIES: &str =
    "[product.striker]\nvelocity_m_s = { from = 0.05, to = 5, count = 9, spacing = \"log\" }\n";
const TARGETS: &str = "[product.target]\nmaterial = [\"steel\", \"granite\", \"pmma\"]\n";
const DRAWS: &str = "[random]\nsamples = 60\n[random.striker]\n\
    tip_radius_m = { distribution = \"normal\", mean = 0.005, deviation = 1e-4 }\n";

fn drawn(path: &Path, request: &Request) -> Figure {
    compose(&[path.to_owned()], request).unwrap().0
}

fn lines(figure: &Figure, panel: usize) -> Vec<(&str, &[(f64, f64)])> {
    let layers = figure.panels[panel].layers.iter();
    let found = layers.filter_map(|layer| match layer {
        Layer::Line(line) => Some((line.name.as_str(), line.points.as_slice())),
        _ => None,
    });
    found.collect()
}

/// No text over another and none outside, at three widths.
fn check(figure: &Figure) {
    for width in [320.0, 700.0, 1200.0] {
        let measured = measure(&figure.clone().width(width)).unwrap();
        let texts = measured.texts();
        for (i, (text, place)) in texts.iter().enumerate() {
            assert!(measured.canvas.holds(place), "{text} is cut off at {width}");
            for (other, second) in &texts[..i] {
                assert!(!place.overlaps(second), "{text} over {other} at {width}");
            }
        }
    }
}

#[test]
fn one_key_of_numbers_gives_lines_named_by_the_words() {
    let folder = tempfile::tempdir().unwrap();
    let path = sweep(folder.path(), "v.h5", &format!("{VELOCITIES}{TARGETS}"));
    let figure = drawn(&path, &Request::default());
    check(&figure);
    let found = lines(&figure, 0);
    let names: Vec<&str> = found.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["steel", "granite", "pmma"]);
    assert!(found.iter().all(|(_, points)| points.len() == 9));
    // Hertz: the force grows as v^(6/5)
    let [first, last] = [found[0].1[0], found[0].1[8]];
    let power = (last.1 / first.1).ln() / (last.0 / first.0).ln();
    assert!((power - 1.2).abs() < 0.01, "{power}");
    let request = Request {
        kind: Some(PictureKind::Loss),
        at: vec![("target.material".to_owned(), "granite".to_owned())],
        ..Request::default()
    };
    let figure = drawn(&path, &request);
    check(&figure);
    let found = lines(&figure, 0);
    assert_eq!(
        found.iter().map(|l| l.0).collect::<Vec<_>>(),
        ["", "slope 3/5"]
    );
    let slope = found[1].1;
    let power = (slope[1].1 / slope[0].1).ln() / (slope[1].0 / slope[0].0).ln();
    assert!((power - 0.6).abs() < 1e-12, "{power}");
    assert!(
        found[0]
            .1
            .iter()
            .all(|(v, loss)| *loss < slope[1].1 * (v / slope[1].0).powf(0.6))
    );
}

#[test]
fn two_keys_of_numbers_give_heat_maps_with_their_values_in_place() {
    let folder = tempfile::tempdir().unwrap();
    let masses = "mass_kg = { from = 1e-3, to = 8e-3, count = 8 }\n";
    let path = sweep(folder.path(), "h.h5", &format!("{VELOCITIES}{masses}"));
    let figure = drawn(&path, &Request::default());
    check(&figure);
    let Layer::Image(image) = &figure.panels[0].layers[0] else {
        unreachable!("a heat map is an image");
    };
    assert_eq!((image.x.len(), image.y.len()), (9, 8));
    assert_eq!((image.x[8], image.y[7]), (5.0, 8.0));
    // P grows as v^(6/5) m^(3/5)
    let at = |i: usize, k: usize| image.values[k * 9 + i];
    let power = (at(0, 7) / at(0, 0)).ln() / 8_f64.ln();
    assert!((power - 0.6).abs() < 0.01, "{power}");
}

#[test]
fn draws_give_histograms_and_bands() {
    let folder = tempfile::tempdir().unwrap();
    let path = sweep(folder.path(), "r.h5", DRAWS);
    let figure = drawn(&path, &Request::default());
    check(&figure);
    let bars = lines(&figure, 0)[0].1;
    // each bar is two points of its height
    assert_eq!(bars.iter().map(|p| p.1).sum::<f64>(), 2.0 * 60.0);
    let marks = figure.panels[0]
        .layers
        .iter()
        .filter(|l| matches!(l, Layer::Mark { .. }));
    assert_eq!(marks.count(), 3);
    let path = sweep(folder.path(), "rv.h5", &format!("{VELOCITIES}{DRAWS}"));
    let figure = drawn(&path, &Request::default());
    check(&figure);
    let Layer::Line(line) = &figure.panels[0].layers[0] else {
        unreachable!("draws over a key give a curve");
    };
    let [lower, upper] = &line.band;
    let mut triples = lower.iter().zip(&line.points).zip(upper);
    assert!(lower.len() == 9 && triples.all(|((l, m), u)| l.1 < m.1 && m.1 < u.1));
}

#[test]
fn draws_over_their_own_key_are_points_or_bins() {
    let folder = tempfile::tempdir().unwrap();
    let few = sweep(folder.path(), "few.h5", DRAWS);
    let many = DRAWS.replace("samples = 60", "samples = 2000");
    let many = sweep(folder.path(), "many.h5", &many);
    let request = Request {
        along: Some("striker.tip_radius_m".to_owned()),
        ..Request::default()
    };
    let figure = drawn(&few, &request);
    check(&figure);
    assert_eq!(lines(&figure, 0)[0].1.len(), 60);
    assert!(matches!(&figure.panels[0].layers[0], Layer::Line(line) if line.band[0].is_empty()));
    let figure = drawn(&many, &request);
    check(&figure);
    assert!(matches!(&figure.panels[0].layers[0], Layer::Line(line) if line.band[0].len() == 20));
    // Hertz: P grows as R^(1/5)
    let middle = lines(&figure, 0)[0].1;
    let (first, last) = (middle[0], middle[19]);
    let power = (last.1 / first.1).ln() / (last.0 / first.0).ln();
    assert!((power - 0.2).abs() < 0.01, "{power}");
    assert!(figure.subtitle.contains("2000 draws in 20 bins"));
}

#[test]
fn what_cannot_be_shown_of_a_sweep_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = sweep(folder.path(), "v.h5", &format!("{VELOCITIES}{TARGETS}"));
    let said = |request: &Request| {
        compose(std::slice::from_ref(&path), request)
            .unwrap_err()
            .to_string()
    };
    let kind = |kind| Request {
        kind: Some(kind),
        ..Request::default()
    };
    assert!(
        said(&kind(PictureKind::Impact))
            .contains("v.h5 is a sweep, for which the picture impact does not exist")
    );
    let wrong = Request {
        along: Some("target.material".to_owned()),
        ..Request::default()
    };
    assert!(said(&wrong).contains("target.material has no numbers"));
    let wrong = Request {
        along: Some("striker.velocity".to_owned()),
        ..Request::default()
    };
    assert!(said(&wrong).contains("did you mean striker.velocity_m_s?"));
    let at = vec![("target.material".to_owned(), "granit".to_owned())];
    assert!(
        said(&Request {
            at,
            ..Request::default()
        })
        .contains("did you mean granite?")
    );
    let held = |value: &str| Request {
        at: vec![("striker.velocity_m_s".to_owned(), value.to_owned())],
        along: Some("target.material".to_owned()),
        ..Request::default()
    };
    let near = said(&held("0.051"));
    assert!(
        near.contains("velocity_m_s = 0.051 does not exist in")
            && near.contains("choose one of 0.05, "),
        "{near}"
    );
    assert!(
        said(&held("0.05")).contains("has no numbers"),
        "the value itself is there"
    );
    let moving = plot::animate(std::slice::from_ref(&path), &Request::default());
    assert!(moving.unwrap_err().to_string().ends_with("v.h5 is a sweep"));
    let names: Vec<String> = (0..12).map(|i| format!("{}.0", i + 1)).collect();
    let many = format!(
        "{VELOCITIES}[list.striker]\ntip_radius_m = [{}]\nmass_kg = [{}]\n",
        names.join(","),
        names.join(",")
    );
    let path = sweep(folder.path(), "many.h5", &format!("{many}{TARGETS}"));
    let refused = compose(&[path], &Request::default()).unwrap_err();
    let PlotError::TooManyCurves {
        curves,
        ref example,
        ..
    } = refused
    else {
        panic!("{refused}");
    };
    assert!(curves > 12 && example.is_some(), "{refused}");
    assert!(
        refused.to_string().ends_with("select some of them"),
        "{refused}"
    );
}

#[test]
fn restitution_has_the_slope_where_something_yields() {
    let folder = tempfile::tempdir().unwrap();
    let request = Request {
        kind: Some(PictureKind::Restitution),
        ..Request::default()
    };
    let yields = "[scene.contact]\nplasticity = \"thornton\"\nyield_pressure_pa = 1e9\n";
    for (name, flow, curves) in [("elastic.h5", "", 1), ("plastic.h5", yields, 2)] {
        let path = sweep(folder.path(), name, &format!("{flow}{VELOCITIES}"));
        let figure = drawn(&path, &request);
        let lines = lines(&figure, 0);
        assert_eq!(lines.len(), curves, "{name}");
        let is_of_yield = figure.panels[0].x.quantity.ends_with("at yield");
        assert_eq!(is_of_yield, curves == 2, "{name}");
        assert_eq!(lines[curves - 1].0 == "slope -1/4", curves == 2, "{name}");
    }
}

const HEIGHTS: &str = "[product.striker]\ndrop_height_m = [0.0204, 0.0816, 0.3264, 1.3056]\ndiameter_m = [0.002, 0.003]\n";

/// A sweep of a ball on granite, which has no velocity and no mass of its own.
fn ball(folder: &Path, name: &str, scene: &str, varies: &str) -> PathBuf {
    let text = format!(
        "[scene.target]\nmaterial = \"granite\"\n[scene.striker]\nmaterial = \"bearing-steel\"\nshape = \"ball\"\n\
         {scene}{varies}"
    );
    let spec = Spec::from_toml(&text, folder).unwrap();
    let path = folder.join(name);
    let part = folder.join("part");
    let done = run_rows(&spec, &part, Existing::Replace, |_| true).unwrap();
    let output = Output::claim(&path, Existing::Keep).unwrap();
    let staged = stage_rows(&output, &spec, &done.unwrap()).unwrap();
    staged.commit().unwrap();
    path
}

fn marks(figure: &Figure) -> usize {
    let layers = figure.panels.iter().flat_map(|panel| &panel.layers);
    layers.filter(|l| matches!(l, Layer::Mark { .. })).count()
}

#[test]
fn a_histogram_of_a_design_has_no_quantiles_and_holds_its_keys() {
    let folder = tempfile::tempdir().unwrap();
    let path = ball(folder.path(), "d.h5", "", HEIGHTS);
    let request = Request {
        kind: Some(PictureKind::Histogram),
        quantities: vec!["peak_force_n".to_owned()],
        ..Request::default()
    };
    let figure = drawn(&path, &request);
    let counted = |figure: &Figure| 0.5 * lines(figure, 0)[0].1.iter().map(|p| p.1).sum::<f64>();
    assert_eq!((marks(&figure), counted(&figure)), (0, 8.0));
    let held = Request {
        at: vec![("striker.diameter_m".to_owned(), "0.003".to_owned())],
        ..request
    };
    let figure = drawn(&path, &held);
    assert_eq!(counted(&figure), 4.0);
    assert!(
        figure.subtitle.starts_with("4 of 8 scenes"),
        "{}",
        figure.subtitle
    );
}

#[test]
fn a_sweep_says_how_many_of_its_rows_yield() {
    let folder = tempfile::tempdir().unwrap();
    let path = ball(
        folder.path(),
        "y.h5",
        "diameter_m = 0.003\n",
        "[product.target]\nmaterial = [\"mild-steel\", \"granite\"]\n[product.striker]\nvelocity_m_s = [1e-4, 3.0, 9.0]\n",
    );
    let onset = formats::stored::StoredSweep::open(&path)
        .unwrap()
        .values("yield_onset")
        .unwrap();
    let yielding = onset.iter().filter(|x| **x > 1.0).count();
    assert!((2..6).contains(&yielding), "{onset:?}");
    for kind in [
        PictureKind::Sweep,
        PictureKind::Histogram,
        PictureKind::Loss,
    ] {
        let request = Request {
            kind: Some(kind),
            ..Request::default()
        };
        let subtitle = drawn(&path, &request).subtitle;
        assert!(
            subtitle.contains(&format!("6 scenes, {yielding} of 6 yield")),
            "{subtitle}"
        );
    }
    let at = vec![("striker.velocity_m_s".to_owned(), "0.0001".to_owned())];
    let slow = Request {
        kind: Some(PictureKind::Histogram),
        at,
        ..Request::default()
    };
    assert!(!drawn(&path, &slow).subtitle.contains("yield"));
}

#[test]
fn losses_over_heights_are_those_over_velocities() {
    let folder = tempfile::tempdir().unwrap();
    let heights = ball(
        folder.path(),
        "h.h5",
        "diameter_m = 0.0025\n",
        "[product.striker]\ndrop_height_m = [0.05, 0.2, 0.8]\n",
    );
    for kind in [PictureKind::Loss, PictureKind::Restitution] {
        let request = Request {
            kind: Some(kind),
            ..Request::default()
        };
        let figure = drawn(&heights, &request);
        check(&figure);
        let points = lines(&figure, 0)[0].1.to_vec();
        assert_eq!(points.len(), 3);
        for ((v, _), h) in points.iter().zip([0.05_f64, 0.2, 0.8]) {
            assert!(
                (v / (2.0 * 9.80665 * h).sqrt() - 1.0).abs() < 1e-12,
                "{kind}: {v}"
            );
        }
    }
    // a law without loss has nothing to show on a logarithmic axis
    let none = ball(
        folder.path(),
        "n.h5",
        "diameter_m = 0.0025\n",
        "[scene.contact]\nmodel = \"hertz\"\n[product.striker]\nvelocity_m_s = [0.1, 1.0]\n",
    );
    let request = Request {
        kind: Some(PictureKind::Loss),
        ..Request::default()
    };
    let said = compose(&[none], &request).unwrap_err().to_string();
    assert!(said.contains("no value is above zero"), "{said}");
}

#[test]
fn advice_can_be_followed() {
    let folder = tempfile::tempdir().unwrap();
    let path = ball(
        folder.path(),
        "a.h5",
        "drop_height_m = 0.1\n",
        "[product.striker]\ndiameter_m = { from = 1e-3, to = 5e-3, count = 9 }\nmaterial = [\"bearing-steel\", \"tungsten-carbide\", \"copper\", \"ice\"]\n[product.target]\nmaterial = [\"granite\", \"steel\", \"pmma\", \"soda-lime-glass\"]\n",
    );
    let mut request = Request::default();
    for _ in 0..3 {
        match compose(std::slice::from_ref(&path), &request) {
            Ok((figure, _)) => return check(&figure),
            Err(PlotError::TooManyCurves {
                example: Some(advice),
                ..
            }) => {
                let (key, value) = advice.split_once('=').unwrap();
                request.at.push((key.to_owned(), value.to_owned()));
            }
            Err(other) => panic!("{other}"),
        }
    }
    unreachable!("the advice {:?} leads nowhere", request.at);
}

#[test]
fn a_part_of_a_name_is_understood() {
    let folder = tempfile::tempdir().unwrap();
    let varies = "[product.target]\ndensity_kg_m3 = [2600.0, 2700.0]\n";
    let path = ball(
        folder.path(),
        "p.h5",
        "drop_height_m = 0.1\ndiameter_m = 0.002\n",
        varies,
    );
    let said = |request: Request| {
        compose(std::slice::from_ref(&path), &request)
            .unwrap_err()
            .to_string()
    };
    let along = Request {
        along: Some("density".to_owned()),
        ..Request::default()
    };
    let found = said(along);
    assert!(
        found.contains("did you mean target.density_kg_m3?"),
        "{found}"
    );
    let quantity = Request {
        quantities: vec!["contact_time".to_owned()],
        ..Request::default()
    };
    let found = said(quantity);
    assert!(found.contains("did you mean contact_time_s?"), "{found}");
}

#[test]
fn a_scale_is_that_of_what_is_shown_or_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let varies =
        "[product.striker]\nvelocity_m_s = [0.01, 0.1, 1.0, 10.0]\ndiameter_m = [0.002, 0.003]\n";
    let path = ball(folder.path(), "s.h5", "", varies);
    let scale = |request: Request| {
        let request = Request {
            quantities: vec!["contact_time_s".to_owned(), "peak_force_n".to_owned()],
            ..request
        };
        let figure = drawn(&path, &request);
        check(&figure);
        [
            figure.panels[0].x.scale,
            figure.panels[0].y.scale,
            figure.panels[1].y.scale,
        ]
    };
    use figure::Scale::{Linear, Logarithmic};
    assert_eq!(
        scale(Request::default()),
        [Logarithmic, Linear, Logarithmic]
    );
    assert_eq!(
        scale(Request {
            scale: Some(Linear),
            ..Request::default()
        }),
        [Linear; 3]
    );
    assert_eq!(
        scale(Request {
            scale: Some(Logarithmic),
            ..Request::default()
        }),
        [Logarithmic; 3]
    );
    // of one velocity forces are not decades apart
    let at = vec![("striker.velocity_m_s".to_owned(), "1".to_owned())];
    assert_eq!(
        scale(Request {
            at,
            ..Request::default()
        })[1..],
        [Linear; 2]
    );
}

#[test]
fn between_few_values_nothing_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let varies = "[product.striker]\nvelocity_m_s = { from = 0.1, to = 3, count = 9 }\ndiameter_m = [0.001, 0.002, 0.004]\n";
    let path = ball(folder.path(), "c.h5", "", varies);
    let along = |key: &str| {
        let request = Request {
            along: Some(key.to_owned()),
            quantities: vec!["loss".to_owned()],
            ..Request::default()
        };
        let figure = drawn(&path, &request);
        check(&figure);
        figure.panels[0]
            .layers
            .iter()
            .find_map(|layer| match layer {
                Layer::Image(image) => Some((image.x.len(), image.has_cells)),
                _ => None,
            })
    };
    assert_eq!(along("striker.diameter_m"), Some((3, true)));
    // the other way there are three curves
    assert_eq!(along("striker.velocity_m_s"), None);
}
