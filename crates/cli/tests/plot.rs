//! `hertzlamb plot` from outside.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::path::Path;
use std::process::{Command, Output};

const SCENE: &str = "\
[target]
material = \"granite\"
[striker]
material = \"bearing-steel\"
mass_kg = 1.1e-4
tip_radius_m = 0.0015
velocity_m_s = 2.0
[contact]
tolerance = 1e-3
[[probe]]
r_m = 0.01
z_m = 0.0
";

fn hertzlamb(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hertzlamb"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap()
}

fn done(folder: &Path, arguments: &[&str]) -> String {
    let done = hertzlamb(folder, arguments);
    let message = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(done.status.success(), "{arguments:?}: {message}");
    message
}

/// Exit code 2 and one sentence with a part.
fn refused(folder: &Path, arguments: &[&str], part: &str) {
    let done = hertzlamb(folder, arguments);
    let message = String::from_utf8_lossy(&done.stderr).into_owned();
    assert_eq!(done.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(message.contains(part), "{message}");
}

#[test]
fn results_become_svg_png_and_pdf() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("scene.toml"), SCENE).unwrap();
    done(at, &["impact", "scene.toml", "-o", "drop.h5"]);
    for (name, start) in [
        ("drop.svg", &b"<svg"[..]),
        ("drop.png", &b"\x89PNG"[..]),
        ("drop.PDF", &b"%PDF"[..]),
    ] {
        done(at, &["plot", "drop.h5", "-o", name]);
        assert!(
            std::fs::read(at.join(name)).unwrap().starts_with(start),
            "{name}"
        );
    }
    let svg = std::fs::read_to_string(at.join("drop.svg")).unwrap();
    assert!(svg.contains("force [N]") && svg.contains("Hertz, without waves"));
    // an existing picture is kept, and the same input gives the same bytes
    refused(at, &["plot", "drop.h5", "-o", "drop.svg"], "pass --force");
    done(at, &["plot", "drop.h5", "-o", "drop.svg", "--force"]);
    assert_eq!(std::fs::read_to_string(at.join("drop.svg")).unwrap(), svg);
}

#[test]
fn what_is_no_picture_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("scene.toml"), SCENE).unwrap();
    refused(
        at,
        &["plot", "scene.toml", "-o", "a.svg"],
        "scene.toml is text",
    );
    refused(
        at,
        &["plot", "none.h5", "-o", "a.svg"],
        "cannot read none.h5",
    );
    refused(
        at,
        &["plot", "none.h5", "-o", "a.jpg"],
        "does not have the extension .svg, .png, .pdf or .gif",
    );
    refused(
        at,
        &["plot", "none.h5", "-o", "a.svg", "--kind", "cake"],
        "possible values",
    );
    refused(
        at,
        &["plot", "none.h5", "-o", "a.svg", "--scale", "3"],
        "--scale does not apply to a.svg",
    );
    refused(
        at,
        &["plot", "none.h5", "-o", "a.svg", "--log", "--linear"],
        "cannot be used with",
    );
    assert!(!at.join("a.svg").exists());
}

const SWEEP: &str = "\
[scene.striker]
shape = \"ball\"
material = \"bearing-steel\"
diameter_m = 0.002
[scene.target]
material = \"granite\"
[scene.output]
quantities = [\"velocity_r\"]
peaks = true
[[scene.probe]]
r_m = 0.008
z_m = 0.006
[product.striker]
velocity_m_s = [1.0, 2.0]
";

#[test]
fn a_quantity_of_a_sweep_without_its_probe_is_understood() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("sweep.toml"), SWEEP).unwrap();
    done(at, &["sweep", "sweep.toml", "-o", "s.h5"]);
    let plot = ["plot", "s.h5", "-o", "s.svg", "--quantity"];
    let advice = "did you mean probe_1_velocity_r_peak?";
    refused(at, &[plot.as_slice(), &["velocity_r"]].concat(), advice);
    done(
        at,
        &[plot.as_slice(), &["probe_1_velocity_r_peak"]].concat(),
    );
}

#[test]
fn a_section_without_probes_has_its_errors_on_the_console() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let (scene, _) = SCENE.split_once("[[probe]]").unwrap();
    let map = "[map]\nr_max_m = 0.01\nz_max_m = 0.01\npoints = [4, 3]\nframes = 9\n";
    std::fs::write(at.join("scene.toml"), format!("{scene}{map}")).unwrap();
    let done = hertzlamb(at, &["impact", "scene.toml"]);
    let text = String::from_utf8_lossy(&done.stdout).into_owned();
    let line = text.lines().find(|line| line.starts_with("section errors"));
    let words = line.unwrap().split_whitespace();
    let errors: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
    // at half of the points and at most, of displacements and of stresses; then places
    assert!(errors.len() >= 4, "{text}");
    let is_small = |error: &&f64| **error > 1e-9 && **error < 0.1;
    assert!(errors.iter().filter(is_small).count() >= 4, "{text}");
}
