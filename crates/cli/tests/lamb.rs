//! Exact histories, and comparisons with them.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

const CASE: &str = "[target]\nmaterial = \"granite\"\n[source]\nprofile = \"point\"\ntime_function = \"ricker\"\nfrequency_hz = 2e5\n\
    [[receiver]]\nr_m = 0.05\nz_m = 0\n[output]\nend_s = 6e-5\nstep_s = 2e-7\n";

fn hertzlamb(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hertzlamb"));
    command
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

#[test]
fn exit_codes_say_whether_histories_agree() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let write = |name: &str, text: &str| std::fs::write(here.join(name), text).unwrap();
    write("case.toml", CASE);
    let other = CASE.replace("frequency_hz = 2e5", "force_n = 1.02\nfrequency_hz = 2e5");
    write("other.toml", &other);
    for (case, file) in [("case.toml", "exact.csv"), ("other.toml", "mine.csv")] {
        let done = hertzlamb(here, &["lamb", case, "-o", file, "--json"]);
        assert!(
            done.status.success(),
            "{}",
            String::from_utf8_lossy(&done.stderr)
        );
        let report: Value = serde_json::from_slice(&done.stdout).unwrap();
        let row = &report["histories"][1];
        assert_eq!(row["name"], "uz");
        assert!(row["error"].as_f64().unwrap() < 2e-9 * row["peak"].as_f64().unwrap());
    }
    let code = |more: &[&str]| {
        let arguments = [&["compare", "mine.csv", "exact.csv"], more].concat();
        hertzlamb(here, &arguments).status.code()
    };
    assert_eq!(code(&[]), Some(0));
    assert_eq!(code(&["--tolerance", "0.01", "-o", "both.svg"]), Some(1));
    assert!(
        std::fs::read_to_string(here.join("both.svg"))
            .unwrap()
            .contains("<svg")
    );
    assert_eq!(code(&["-o", "both.svg"]), Some(2));
    assert_eq!(code(&["-o", "both.png"]), Some(2));
    assert_eq!(code(&["-o", "mine.csv", "--force"]), Some(2));
    assert_eq!(code(&["--tolerance", "-1"]), Some(2));
    assert_eq!(code(&["--map", "a=b"]), Some(2));
    let done = hertzlamb(here, &["compare", "mine.csv", "exact.csv", "--json"]);
    let report: Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(
        (
            &report["passed"],
            report["columns"].as_array().unwrap().len()
        ),
        (&Value::Bool(true), 2)
    );
    let found = &report["columns"][1];
    for (name, value) in [
        ("error", 0.02),
        ("shifted_error", 0.02),
        ("spectral_error", 0.02),
        ("amplitude", 1.02),
    ] {
        assert!(
            (found[name].as_f64().unwrap() - value).abs() < 1e-9,
            "{name}"
        );
    }
}

#[test]
fn outputs_are_kept_and_inputs_are_safe() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("case.toml"), CASE).unwrap();
    let run = |file: &str, more: &[&str]| {
        let arguments = [&["lamb", "case.toml", "-o", file], more].concat();
        hertzlamb(here, &arguments).status.code()
    };
    assert_eq!(run("out.h5", &[]), Some(0));
    assert_eq!(run("out.h5", &[]), Some(2));
    assert_eq!(run("out.h5", &["--force"]), Some(0));
    assert_eq!(run("out.dat", &[]), Some(2));
    assert_eq!(run("case.toml", &["--force"]), Some(2));
    assert_eq!(
        std::fs::read_to_string(here.join("case.toml")).unwrap(),
        CASE
    );
}
