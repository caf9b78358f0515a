//! Pictures of impacts, from files that the program has written.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use figure::{Figure, measure};
use formats::{Existing, parse_scene, write_results};
use impact::{KernelChoice, simulate};
use plot::{PictureKind, PlotError, Request, compose};
use std::path::{Path, PathBuf};

/// A results file of a steel ball on granite, 40 mm thick, at a velocity.
fn impact(folder: &Path, name: &str, velocity_m_s: f64, rest: &str) -> PathBuf {
    let text = format!(
        "[target]\nmaterial = \"granite\"\nthickness_m = 0.04\n[striker]\nmaterial = \"bearing-steel\"\n\
         mass_kg = 1.1e-4\ntip_radius_m = 1.5e-3\nvelocity_m_s = {velocity_m_s}\n[contact]\ntolerance = 1e-3\n{rest}"
    );
    let scene = parse_scene(&text, folder).unwrap();
    let outcome = simulate(&scene, &KernelChoice::Direct).unwrap();
    let path = folder.join(name);
    write_results(&path, &scene, &outcome, Existing::Keep).unwrap();
    path
}

const PROBES: &str = "[[probe]]\nr_m = 0.02\nz_m = 0\n[[probe]]\nr_m = 0\nz_m = 0.02\n";

fn picture(
    paths: &[PathBuf],
    kind: Option<PictureKind>,
) -> Result<(Figure, Vec<String>), PlotError> {
    let request = Request {
        kind,
        ..Request::default()
    };
    compose(paths, &request)
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

#[test]
fn an_impact_has_hertz_beside_it_and_arrivals_at_its_probes() {
    let folder = tempfile::tempdir().unwrap();
    let path = impact(folder.path(), "drop.h5", 2.0, PROBES);
    let (figure, notes) = picture(&[path], None).unwrap();
    assert_eq!(figure.panels.len(), 5);
    let texts = texts(&figure);
    for wanted in [
        "force [N]",
        "contact force",
        "Hertz, without waves",
        "displacement [nm]",
    ] {
        assert!(
            texts.iter().any(|text| text == wanted),
            "{wanted} in {texts:?}"
        );
    }
    let count = |wanted: &str| texts.iter().filter(|text| *text == wanted).count();
    // a Rayleigh wave passes on the surface, and none straight below
    assert_eq!([count("P"), count("S"), count("R")], [2, 2, 1]);
    assert_eq!(count("valid until the echo"), 2);
    assert!(notes.is_empty());
}

#[test]
fn several_impacts_are_labelled_by_what_differs() {
    let folder = tempfile::tempdir().unwrap();
    let paths = [1.0, 2.0, 4.0].map(|v| impact(folder.path(), &format!("{v}.h5"), v, PROBES));
    let (figure, _) = picture(&paths, None).unwrap();
    let texts = texts(&figure);
    for wanted in ["velocity 1 m/s", "velocity 2 m/s", "velocity 4 m/s"] {
        assert!(
            texts.iter().any(|text| text == wanted),
            "{wanted} in {texts:?}"
        );
    }
    let request = Request {
        kind: Some(PictureKind::Probes),
        quantities: vec!["stress_zz".to_owned()],
        ..Request::default()
    };
    let (figure, _) = compose(&paths, &request).unwrap();
    assert_eq!(figure.panels.len(), 2);
    assert_eq!(figure.panels[0].y.quantity, "axial stress");
}

#[test]
fn what_cannot_be_drawn_is_told_in_one_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let bare = impact(folder.path(), "bare.h5", 2.0, "");
    let said = |paths: &[PathBuf], kind| picture(paths, kind).unwrap_err().to_string();
    assert!(
        said(std::slice::from_ref(&bare), Some(PictureKind::Probes))
            .ends_with("has no probes: add a [[probe]] with r_m and z_m to the scene")
    );
    let text = folder.path().join("scene.toml");
    std::fs::write(&text, "[target]\n").unwrap();
    assert!(said(&[text], None).ends_with("scene.toml is text, not a file of results in HDF5"));
    let absent = said(&[folder.path().join("none.h5")], None);
    assert!(
        absent.contains("cannot read") && absent.contains("none.h5"),
        "{absent}"
    );
    let foreign = folder.path().join("foreign.h5");
    hdf5::File::create(&foreign).unwrap();
    assert!(
        said(std::slice::from_ref(&foreign), None)
            .ends_with("is an HDF5 file, but not one of hertzlamb")
    );
    // a file that was cut short
    let bytes = std::fs::read(&bare).unwrap();
    let cut = folder.path().join("cut.h5");
    for keep in [0, 5, 100, bytes.len() / 2, bytes.len() - 1] {
        std::fs::write(&cut, &bytes[..keep]).unwrap();
        assert!(
            picture(std::slice::from_ref(&cut), None).is_err(),
            "{keep} bytes"
        );
    }
    let probes = impact(folder.path(), "probes.h5", 2.0, PROBES);
    let request = Request {
        quantities: vec!["stress_zx".to_owned()],
        ..Request::default()
    };
    let refused = compose(&[probes], &request).unwrap_err().to_string();
    assert!(refused.contains("did you mean stress_zz?"), "{refused}");
}

fn curves(figure: &Figure, panel: usize) -> Vec<&figure::Line> {
    let layers = figure.panels[panel].layers.iter();
    let lines = layers.filter_map(|layer| match layer {
        figure::Layer::Line(line) => Some(line),
        _ => None,
    });
    lines.collect()
}

#[test]
fn sizes_keep_the_negative_parts() {
    let folder = tempfile::tempdir().unwrap();
    let path = impact(folder.path(), "sizes.h5", 1.3, PROBES);
    let asked = |scale| Request {
        kind: Some(PictureKind::Probes),
        quantities: vec!["stress_rr".to_owned()],
        scale,
        ..Request::default()
    };
    let signed = compose(std::slice::from_ref(&path), &asked(None))
        .unwrap()
        .0;
    let sizes = asked(Some(figure::Scale::Logarithmic));
    let sizes = compose(std::slice::from_ref(&path), &sizes).unwrap().0;
    texts(&sizes);
    for panel in 0..2 {
        let [signed, shown] = [&signed, &sizes].map(|figure| curves(figure, panel)[0]);
        assert!(signed.points.iter().any(|p| p.1 < 0.0));
        let same = |(a, b): (&(f64, f64), &(f64, f64))| a.0 == b.0 && a.1.abs() == b.1;
        assert!(signed.points.iter().zip(&shown.points).all(same));
        assert_eq!(signed.points.len(), shown.points.len());
        let largest = shown.points.iter().map(|p| p.1).fold(0.0, f64::max);
        let axis = &sizes.panels[panel].y;
        assert_eq!(axis.quantity, "magnitude of the radial stress");
        // not the eighteen decades of rounding
        assert!(axis.range.unwrap().0 >= 1e-7 * largest && axis.range.unwrap().1 >= largest);
        let [lower, upper] = &shown.band;
        let mut sides = lower.iter().zip(upper).zip(&shown.points);
        assert!(sides.all(|((l, u), p)| l.1 > 0.0 && l.1 <= u.1 && u.1 >= p.1));
    }
}

#[test]
fn an_option_that_a_kind_does_not_use_is_refused_with_the_kinds_that_do() {
    let folder = tempfile::tempdir().unwrap();
    let path = impact(folder.path(), "o.h5", 1.7, PROBES);
    let of = |kind, change: fn(&mut Request)| {
        let mut request = Request {
            kind: Some(kind),
            ..Request::default()
        };
        change(&mut request);
        compose(std::slice::from_ref(&path), &request)
            .unwrap_err()
            .to_string()
    };
    type Change = fn(&mut Request);
    let frames: Change = |r| r.frames = Some(3);
    let two: Change = |r| r.quantities = vec!["stress_zz".to_owned(), "stress_rr".to_owned()];
    let one: Change = |r| r.quantities = vec!["stress_zz".to_owned()];
    let times: Change = |r| r.times_s = vec![1e-6];
    let along: Change = |r| r.along = Some("striker.mass_kg".to_owned());
    let at: Change = |r| r.at = vec![("striker.mass_kg".to_owned(), "1".to_owned())];
    let span: Change = |r| r.span_s = Some((0.0, 1e-6));
    let scale: Change = |r| r.scale = Some(figure::Scale::Linear);
    for (kind, change, said) in [
        (
            PictureKind::Loop,
            one,
            "the picture loop does not use quantity: impact, probes, spectrum, waves, peak, x-t, depth-t and axis do",
        ),
        (
            PictureKind::Waves,
            two,
            "the picture waves does not use several quantities: impact, probes and spectrum do",
        ),
        (
            PictureKind::Axis,
            two,
            "the picture axis does not use several quantities: impact, probes and spectrum do",
        ),
        (
            PictureKind::Impact,
            frames,
            "the picture impact does not use frames: only waves does",
        ),
        (
            PictureKind::Peak,
            times,
            "the picture peak does not use times: waves and axis do",
        ),
        (
            PictureKind::Probes,
            along,
            "the picture probes does not use along: no picture of the results of an impact does",
        ),
        (
            PictureKind::Surface,
            at,
            "the picture x-t does not use at: no picture of the results of an impact does",
        ),
        (
            PictureKind::Loop,
            span,
            "the picture loop does not use span: impact, probes, sensors, waves, x-t and depth-t do",
        ),
        (
            PictureKind::Loop,
            scale,
            "the picture loop does not use log or linear: impact, probes, spectrum, waves, peak, x-t, depth-t and axis do",
        ),
    ] {
        assert_eq!(of(kind, change), said);
    }
}

/// Hertz's pulse is closed: -3 dB and its zeros in products of frequency and contact time (states of the pulse by quadrature).
#[test]
fn spectra_have_the_corner_and_the_zeros_of_hertz_and_follow_the_pulse() {
    let folder = tempfile::tempdir().unwrap();
    let closed = PROBES.replacen("[[probe]]", "model = \"hertz\"\n[[probe]]", 1);
    let long = format!("{closed}[output]\nduration_s = 4e-4\nquantities = [\"velocity_z\"]\n");
    let paths = [("h.h5", &closed), ("long.h5", &long)];
    let paths = paths.map(|(name, rest)| impact(folder.path(), name, 0.4, rest));
    let marks = |figure: &Figure, panel: usize| -> Vec<f64> {
        let layers = figure.panels[panel].layers.iter();
        let of = |layer: &figure::Layer| match layer {
            figure::Layer::Mark { x, .. } => Some(*x),
            _ => None,
        };
        layers.filter_map(of).collect()
    };
    let mut spans = Vec::new();
    for path in &paths {
        let (figure, _) = picture(std::slice::from_ref(path), Some(PictureKind::Spectrum)).unwrap();
        // the force and both probes
        assert_eq!(figure.panels.len(), 3);
        let stored = formats::stored::StoredImpact::open(path).unwrap();
        let contact_s = stored.number("contact_time_s").unwrap();
        let zeros: Vec<f64> = marks(&figure, 0).iter().map(|f| f * contact_s).collect();
        for (zero, exact) in zeros
            .iter()
            .zip([1.8040285, 2.7613640, 3.7550097, 4.7527230])
        {
            assert!((zero / exact - 1.0).abs() < 2e-3, "{zeros:?}");
        }
        assert_eq!(zeros.len(), 4);
        let at_probe = marks(&figure, 1);
        assert!((at_probe[0] * contact_s / 0.669_616_41 - 1.0).abs() < 1e-3);
        assert_eq!(at_probe.len(), 5);
        assert!(texts(&figure).iter().any(|text| text.contains("corner")));
        // the displacement has no more than the pulse: it falls in the zeros as the force does
        let curve = curves(&figure, 1)[0];
        let near = |f: f64| {
            let distance = |p: &&(f64, f64)| (p.0 * contact_s / f - 1.0).abs();
            let by = |a: &&(f64, f64), b: &&(f64, f64)| distance(a).total_cmp(&distance(b));
            curve.points.iter().min_by(by).unwrap().1
        };
        assert!(
            near(zeros[0]) < 0.2 * near(2.2),
            "{} {}",
            near(zeros[0]),
            near(2.2)
        );
        let last = curve.points.last().unwrap().0 * contact_s;
        spans.push(last);
    }
    assert!(
        (spans[0] / spans[1] - 1.0).abs() < 0.01 && (spans[0] - 6.0).abs() < 0.3,
        "{spans:?}"
    );
    let asked = Request {
        kind: Some(PictureKind::Spectrum),
        quantities: vec!["velocity_z".to_owned()],
        ..Request::default()
    };
    let (figure, _) = compose(&paths[1..], &asked).unwrap();
    assert_eq!(curves(&figure, 2).len(), 1);
    assert!(
        texts(&figure)
            .iter()
            .any(|text| text.contains("axial velocity"))
    );
}

#[test]
fn a_quantity_of_the_contact_is_drawn_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = impact(folder.path(), "q.h5", 0.7, PROBES);
    let asked = |kind, names: &[&str]| Request {
        kind,
        quantities: names.iter().map(|&name| name.to_owned()).collect(),
        ..Request::default()
    };
    let of = |kind, names: &[&str]| compose(std::slice::from_ref(&path), &asked(kind, names));
    let (figure, _) = of(None, &["force"]).unwrap();
    assert_eq!(figure.panels.len(), 1);
    let largest = curves(&figure, 0)[0]
        .points
        .iter()
        .map(|p| p.1)
        .fold(0.0, f64::max);
    let peak = formats::stored::StoredImpact::open(&path)
        .unwrap()
        .number("peak_force_n")
        .unwrap();
    assert!((largest / peak - 1.0).abs() < 1e-2);
    let (figure, _) = of(None, &["velocity", "stress_zz"]).unwrap();
    let quantities: Vec<&str> = figure
        .panels
        .iter()
        .map(|panel| panel.y.quantity.as_str())
        .collect();
    assert_eq!(
        quantities,
        ["velocity of the striker", "axial stress", "axial stress"]
    );
    let said = of(Some(PictureKind::Probes), &["force"])
        .unwrap_err()
        .to_string();
    assert!(said.ends_with("use the picture impact"), "{said}");
    // what cannot be drawn is not left out in silence
    let bare = impact(folder.path(), "b.h5", 0.7, "");
    let said = compose(&[bare], &asked(None, &["stress_zz"]))
        .unwrap_err()
        .to_string();
    assert!(said.contains("has no probes"), "{said}");
}

#[test]
fn a_span_is_the_time_axis() {
    let folder = tempfile::tempdir().unwrap();
    let path = impact(folder.path(), "z.h5", 1.1, PROBES);
    let asked = |kind, span_s| Request {
        kind: Some(kind),
        span_s: Some(span_s),
        ..Request::default()
    };
    for kind in [PictureKind::Impact, PictureKind::Probes] {
        let (figure, _) = compose(std::slice::from_ref(&path), &asked(kind, (4e-6, 7e-6))).unwrap();
        for (i, panel) in figure.panels.iter().enumerate() {
            assert_eq!(panel.x.range, Some((4e-6, 7e-6)));
            let points = &curves(&figure, i)[0].points;
            // a sample at both sides, so that curves run to the ends
            assert!(points[0].0 <= 4e-6 && points[points.len() - 1].0 >= 7e-6);
            assert!(points[1].0 >= 4e-6 && points[points.len() - 2].0 <= 7e-6);
        }
    }
    for (span_s, why) in [
        ((7e-6, 4e-6), "must be before"),
        ((1.0, 2.0), "contains no data"),
    ] {
        let said = compose(
            std::slice::from_ref(&path),
            &asked(PictureKind::Probes, span_s),
        );
        let said = said.unwrap_err().to_string();
        assert!(said.contains(why), "{said}");
    }
}

#[test]
fn spectra_begin_together() {
    let folder = tempfile::tempdir().unwrap();
    let paths = [0.02, 5.0].map(|v| impact(folder.path(), &format!("{v}.h5"), v, ""));
    let (figure, _) = picture(&paths, Some(PictureKind::Spectrum)).unwrap();
    let first = |i: usize| curves(&figure, 0)[i].points[0].0;
    assert_eq!(first(0), first(1));
}
