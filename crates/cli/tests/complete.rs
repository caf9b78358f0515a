//! `--skip-complete` of `impact` and `tabulate`: a task that is given again ends at once, and never on something else.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::path::Path;
use std::process::Command;

const SCENE: &str = r#"
[target]
material = "steel"
[striker]
material = "bearing-steel"
shape = "ball"
diameter_m = 0.004
velocity_m_s = 1.0
[[probe]]
r_m = 0.002
z_m = 0.002
"#;

const RECORD: &str = r#"
[target]
material = "steel"
[force]
file = "pulse.csv"
[contact]
disc_radius_m = 0.001
"#;

const GRID: &str = "
poisson_ratios = [0.3]
cell_width = 0.25
[r]
max = 2.0
spacing = 0.25
[z]
max = 2.0
spacing = 0.25
";

/// Runs a command line in a folder: exit code and all that is said.
fn run(folder: &Path, line: &str) -> (Option<i32>, String) {
    let done = Command::new(env!("CARGO_BIN_EXE_hertzlamb"))
        .current_dir(folder)
        .args(line.split(' '))
        .output()
        .unwrap();
    let said = [done.stdout, done.stderr].concat();
    (done.status.code(), String::from_utf8(said).unwrap())
}

/// Expects an exit code and some words.
fn expect(folder: &Path, line: &str, code: i32, words: &str) {
    let (found, said) = run(folder, line);
    assert_eq!(found, Some(code), "{line}: {said}");
    assert!(said.contains(words), "{line}: {said}");
}

#[test]
fn an_impact_that_is_there_is_not_computed_again() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("s.toml"), SCENE).unwrap();
    let line = "impact s.toml -o s.h5 --skip-complete";
    expect(here, line, 0, "peak force");
    let before = std::fs::read(here.join("s.h5")).unwrap();
    expect(here, line, 0, "nothing to do");
    assert_eq!(std::fs::read(here.join("s.h5")).unwrap(), before);
    expect(
        here,
        &format!("{line} --csv s.csv"),
        1,
        "s.csv does not exist",
    );
    expect(here, &format!("{line} --force"), 2, "--force");

    let faster = SCENE.replace("= 1.0", "= 1.5");
    std::fs::write(here.join("s.toml"), faster).unwrap();
    expect(here, line, 1, "is the result of another scene");
    std::fs::write(here.join("s.toml"), SCENE).unwrap();
    std::fs::write(here.join("s.h5"), &before[..before.len() / 2]).unwrap();
    assert_eq!(run(here, line).0, Some(1));
    std::fs::write(here.join("s.h5"), "no results").unwrap();
    assert_eq!(run(here, line).0, Some(1));
    // one bit anywhere
    for place in (5..before.len()).step_by(before.len() / 40) {
        let mut bad = before.clone();
        bad[place] ^= 4;
        std::fs::write(here.join("s.h5"), bad).unwrap();
        assert_eq!(run(here, line).0, Some(1), "byte {place}");
    }
    // what a killed run has left goes, also where nothing is left to do
    std::fs::write(here.join("s.h5"), &before).unwrap();
    std::fs::write(here.join(".s.h5.lock"), "").unwrap();
    expect(here, line, 0, "nothing to do");
    assert!(!here.join(".s.h5.lock").exists());
}

#[test]
fn a_record_counts_by_its_samples() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("s.toml"), RECORD).unwrap();
    let record = "time_s,force_n\n0,0\n1e-5,10\n2e-5,0\n";
    std::fs::write(here.join("pulse.csv"), record).unwrap();
    let line = "impact s.toml -o s.h5 --skip-complete";
    expect(here, line, 0, "peak force");
    expect(here, line, 0, "nothing to do");
    std::fs::write(here.join("pulse.csv"), record.replace("10", "11")).unwrap();
    expect(here, line, 1, "is the result of another scene");
}

#[test]
fn a_table_that_is_there_is_not_built_again() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("g.toml"), GRID).unwrap();
    let line = "tabulate --grid g.toml -o k.h5 --skip-complete";
    expect(here, line, 0, "points");
    let before = std::fs::read(here.join("k.h5")).unwrap();
    expect(here, line, 0, "nothing to do");
    expect(here, &format!("{line} --nu 0.25"), 1, "has another grid");
    assert_eq!(std::fs::read(here.join("k.h5")).unwrap(), before);
    std::fs::write(here.join("k.h5"), &before[..before.len() / 2]).unwrap();
    assert_eq!(run(here, line).0, Some(1));

    // a shard is its own journal
    let shard = "tabulate --grid g.toml --shard 1/2 -o 1.shard --skip-complete";
    expect(here, shard, 0, "blocks");
    let before = std::fs::read(here.join("1.shard")).unwrap();
    expect(here, shard, 0, "blocks");
    assert_eq!(std::fs::read(here.join("1.shard")).unwrap(), before);
}
