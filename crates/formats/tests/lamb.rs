//! Cases of Lamb's problem: reading, bad input, files, and names in the document.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use formats::lamb::{compare_files, read_lamb, stage_lamb};
use formats::schema::lamb as schema;
use formats::{Existing, Output};
use ledger::HdfFile;
use oracle::Limits;
use std::path::Path;

const DOCUMENT: &str = include_str!("../../../data-schema/lamb.md");
const CASE: &str = "[target]\nmaterial = \"granite\"\n[source]\nprofile = \"hertz\"\nradius_m = 0.001\ntime_function = \"ricker\"\nfrequency_hz = 2e5\n\
    [[receiver]]\nname = \"a\"\nx_m = -0.003\ny_m = 0.004\nz_m = 0.002\n[output]\nend_s = 2e-5\nstep_s = 1e-7\nquantities = [\"displacement\", \"stress\"]\n";

#[test]
fn the_document_has_every_name() {
    let keys = [&schema::SOURCE[..], &schema::RECEIVER, &schema::OUTPUT].concat();
    let names = schema::HISTORIES.iter().map(|row| row.0);
    for name in keys.into_iter().chain(names).chain([
        schema::ERROR,
        schema::CASE,
        schema::TIME.0,
        schema::FILE_TYPE,
    ]) {
        assert!(DOCUMENT.contains(&format!("`{name}`")), "{name}");
    }
    assert!(DOCUMENT.contains(&format!("Version {}", schema::FORMAT_VERSION)));
    for (_, meaning) in schema::HISTORIES {
        assert!(DOCUMENT.contains(meaning), "{meaning}");
    }
}

#[test]
fn the_cases_of_the_repository_are_read() {
    for name in ["point", "buried", "disc"] {
        let path = format!(
            "{}/../../scenes/lamb-{name}.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        let case = read_lamb(Path::new(&path)).unwrap();
        assert_eq!((case.receivers.len(), case.warning()), (3, None), "{name}");
    }
}

#[test]
fn bad_cases_are_one_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.toml");
    let told = |from: &str, to: &str| {
        std::fs::write(&path, CASE.replace(from, to)).unwrap();
        let error = match read_lamb(&path) {
            Ok(case) => case.run().unwrap_err().to_string(),
            Err(error) => error.to_string(),
        };
        assert!(!error.contains('\n'), "{error}");
        error
    };
    for (from, to, part) in [
        (
            "[source]",
            "[sauce]",
            "unknown key sauce; did you mean source?",
        ),
        ("radius_m = 0.001\n", "", "source.radius_m is missing"),
        (
            "radius_m = 0.001",
            "radius_m = -1",
            "source.radius_m = -1 is outside (0, inf)",
        ),
        ("\"hertz\"", "\"hurtz\"", "did you mean hertz?"),
        (
            "\"hertz\"",
            "\"point\"",
            "source.radius_m cannot be combined",
        ),
        (
            "\"ricker\"",
            "\"step\"",
            "source.frequency_hz cannot be combined",
        ),
        (
            "\"ricker\"",
            "\"file\"",
            "source.frequency_hz cannot be combined",
        ),
        (
            "\"ricker\"\nfrequency_hz = 2e5",
            "\"file\"\nfile = \"none.csv\"",
            "none.csv",
        ),
        ("frequency_hz = 2e5", "frequency_hz = 1e15", "output.end_s"),
        ("y_m = 0.004\n", "", "receiver[1].r_m is missing"),
        (
            "y_m = 0.004",
            "r_m = 0.004",
            "receiver[1].r_m cannot be combined",
        ),
        (
            "z_m = 0.002",
            "z_m = -1",
            "receiver[1].z_m = -1 is outside [0, inf)",
        ),
        ("\"a\"", "\"a/b\"", "receiver[1].name = \"a/b\""),
        (
            "step_s = 1e-7",
            "step_s = 1e-14",
            "output.end_s over output.step_s",
        ),
        ("\"stress\"", "\"strain\"", "output.quantities = \"strain\""),
        (
            "material = \"granite\"",
            "material = \"granite\"\nthickness_m = 1",
            "target.thickness_m cannot be combined",
        ),
        (
            "material = \"granite\"",
            "material = \"granite\"\nquality_factor = 20",
            "target.quality_factor cannot be combined",
        ),
        ("[[receiver]]", "[receiver]", "write [[receiver]]"),
    ] {
        let error = told(from, to);
        assert!(error.contains(part), "{to}: {error}");
    }
}

#[test]
fn both_files_have_the_same_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    std::fs::write(file("case.toml"), CASE).unwrap();
    let case = read_lamb(&file("case.toml")).unwrap();
    let found = case.run().unwrap();
    for name in ["a.csv", "a.h5"] {
        let output = Output::claim(&file(name), Existing::Keep).unwrap();
        stage_lamb(&output, &file(name), &case, &found)
            .unwrap()
            .commit()
            .unwrap();
    }
    let text = std::fs::read_to_string(file("a.csv")).unwrap();
    let mut lines = text.lines().skip_while(|line| line.starts_with('#'));
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 201);
    let hdf = HdfFile::open(&file("a.h5")).unwrap();
    assert!(hdf.is_sealed());
    for (name, unit) in [
        ("ur", "m"),
        ("uz", "m"),
        ("ux", "m"),
        ("uy", "m"),
        ("szz", "pa"),
        ("srr", "pa"),
        ("stt", "pa"),
        ("srz", "pa"),
    ] {
        let column = names
            .iter()
            .position(|own| *own == format!("a_{name}_{unit}"))
            .unwrap();
        let samples = hdf
            .root
            .group("a")
            .unwrap()
            .dataset(name)
            .unwrap()
            .as_f64(1 << 20)
            .unwrap();
        assert!(rows.iter().map(|row| row[column]).eq(samples), "{name}");
    }
    let place = |name: &str| names.iter().position(|own| *own == name).unwrap();
    let [ur, ux, uy] = ["a_ur_m", "a_ux_m", "a_uy_m"].map(place);
    for row in &rows {
        assert!((row[ux] + 0.6 * row[ur]).abs() <= 1e-15 * row[ur].abs());
        assert!((row[uy] - 0.8 * row[ur]).abs() <= 1e-15 * row[ur].abs());
    }
}

#[test]
fn columns_are_matched_by_name_and_map() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let row =
        |i: i32, unit: f64| format!("{},{}\n", f64::from(i) * unit, (f64::from(i) * 0.2).sin());
    let rows = |unit: f64| (0..100).map(|i| row(i, unit)).collect::<String>();
    let ours = file("ours.csv", &format!("time_s,a_uz_m\n{}", rows(1e-3)));
    let limits = Limits {
        tolerance: 0.01,
        time_tolerance_s: None,
    };
    let with = |text: &str, map: &[(&str, &str)]| {
        let theirs = file("theirs.csv", text);
        let map: Vec<(String, String)> = map
            .iter()
            .map(|(a, b)| ((*a).to_owned(), (*b).to_owned()))
            .collect();
        compare_files([&theirs, &ours], &map, limits)
    };
    for (header, map) in [
        ("time_ms,A_UZ_M", &[][..]),
        ("# t_ms,a_uz_m", &[]),
        ("Time [ms],w", &[("w", "a_uz_m")]),
    ] {
        let (found, alone) = with(&format!("{header}\n{}", rows(1.0)), map).unwrap();
        assert!(
            found.len() == 1 && alone.is_empty() && found[0].found.error < 1e-12,
            "{header}"
        );
    }
    for (text, map, part) in [
        (
            format!("time_ms,w\n{}", rows(1.0)),
            &[][..],
            "has the columns a_uz_m: no column of",
        ),
        (
            format!("time_ms,w\n{}", rows(1.0)),
            &[("w", "b")],
            "no column \"b\"",
        ),
        (
            format!("time_ms,a_uz_m\n0,nan\n{}", rows(1.0)),
            &[],
            "line 2: \"nan\" is not a finite number",
        ),
        (
            format!("time_ms,a_uz_m,b\n{}", rows(1.0)),
            &[],
            "has 2 names and 1 columns",
        ),
        (
            "time_ms\n1\n2\n".to_owned(),
            &[],
            "there are no rows with a time and a sample",
        ),
        (
            format!("step,a_uz_m\n{}", rows(1.0)),
            &[],
            "has the unit \"step\"",
        ),
    ] {
        let error = with(&text, map).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}
