//! Pictures of impacts, from files that the program has written.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use figure::{Figure, measure};
use formats::{Existing, parse_scene, write_results};
use impact::{KernelChoice, simulate};
use plot::{Kind, PlotError, Request, compose};
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

fn picture(paths: &[PathBuf], kind: Option<Kind>) -> Result<(Figure, Vec<String>), PlotError> {
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
        kind: Some(Kind::Probes),
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
        said(std::slice::from_ref(&bare), Some(Kind::Probes))
            .ends_with("has no probes: give the scene a [[probe]] with r_m and z_m")
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
            .ends_with("is an HDF5 file, but none of hertzlamb's")
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
