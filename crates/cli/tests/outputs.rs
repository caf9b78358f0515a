//! What a command may write, what two at once do, and what is kept when one is stopped.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
#![cfg(unix)]

use formats::Existing;
use formats::sweep::{Spec, run_rows};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

const SCENE: &str = "[target]\nmaterial = \"steel\"\n[striker]\nmaterial = \"steel\"\nmass_kg = 4e-3\n\
    tip_radius_m = 5e-3\nvelocity_m_s = 1.0\n";
const GRID: &str = "poisson_ratios = [0.3]\ncell_width = 0.8\npulse_lengths = [20.0]\nstencil_points = 2\n\
    [r]\nmax = 2.0\nspacing = 0.25\n[z]\nmax = 2.0\nspacing = 0.25\n";

fn sweep(count: usize) -> String {
    format!(
        "scene = \"scene.toml\"\n[product.striker]\nvelocity_m_s = {{ from = 0.1, to = 10.0, count = {count} }}\n"
    )
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("scene.toml", SCENE);
    write("grid.toml", GRID);
    write("sweep.toml", &sweep(3));
    let record = "[target]\nmaterial = \"steel\"\n[contact]\ndisc_radius_m = 1e-3\n[force]\nfile = \"pulse.h5\"\n";
    write("record.toml", record);
    folder
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hertzlamb"));
    command.current_dir(folder).args(arguments);
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().unwrap()
}

fn well(folder: &Path, arguments: &[&str]) {
    let done = run(folder, arguments);
    let said = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(0), "{arguments:?}: {said}");
}

/// All files of a folder.
fn all(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<_> = entries
        .map(|entry| {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, std::fs::read(&path).unwrap_or_default())
        })
        .collect();
    files.sort();
    files
}

/// A refusal changes nothing at all.
fn refused(folder: &Path, arguments: &[&str], code: i32, words: &str) {
    let before = all(folder);
    let done = run(folder, arguments);
    let said = String::from_utf8(done.stderr).unwrap();
    assert_eq!(done.status.code(), Some(code), "{arguments:?}: {said}");
    assert!(said.contains(words), "{arguments:?}: {said}");
    assert_eq!(said.trim().lines().count(), 1, "{said}");
    assert!(all(folder) == before, "{arguments:?}");
}

#[test]
fn an_output_is_never_an_input_and_never_something_else_than_a_file() {
    let folder = folder();
    let here = folder.path();
    well(here, &["tabulate", "--grid", "grid.toml", "-o", "table.h5"]);
    well(
        here,
        &[
            "tabulate",
            "--grid",
            "grid.toml",
            "--shard",
            "1/1",
            "-o",
            "1.shard",
        ],
    );
    well(here, &["impact", "scene.toml", "-o", "pulse.h5"]);
    for (input, name) in [
        ("scene.toml", "scene.h5"),
        ("sweep.toml", "sweep.h5"),
        ("sweep.toml", "sweep.csv"),
        ("grid.toml", "grid.h5"),
        ("1.shard", "shard.h5"),
    ] {
        std::fs::hard_link(here.join(input), here.join(name)).unwrap();
    }
    std::os::unix::fs::symlink("scene.toml", here.join("link.h5")).unwrap();
    let cases = [
        ("impact scene.toml -o scene.h5", "is the scene"),
        ("impact scene.toml -o link.h5", "is the scene"),
        (
            "impact scene.toml --table table.h5 -o ./table.h5",
            "is the kernel table",
        ),
        ("impact record.toml -o pulse.h5", "is the force record"),
        ("sweep sweep.toml -o sweep.h5", "is the sweep"),
        ("sweep sweep.toml -o new.h5 --csv sweep.csv", "is the sweep"),
        ("sweep sweep.toml -o scene.h5", "is the base scene"),
        ("sweep sweep.toml -o same --csv ./same", "are the same file"),
        ("sweep sweep.toml -o same.csv", "with the extension .h5"),
        ("tabulate --grid grid.toml -o grid.h5", "is the grid"),
        ("table merge 1.shard -o shard.h5", "is a shard"),
        ("impact scene.toml -o /dev/null", "device"),
    ];
    for (line, words) in cases {
        let mut arguments: Vec<&str> = line.split(' ').collect();
        arguments.push("--force");
        refused(here, &arguments, 2, words);
    }
    let shard = [
        "tabulate",
        "--grid",
        "grid.toml",
        "--shard",
        "1/1",
        "-o",
        "table.h5",
    ];
    refused(here, &shard, 2, ".shard");
}

#[test]
fn a_sweep_killed_between_its_two_outputs_goes_on() {
    let folder = folder();
    let here = folder.path();
    let both = ["sweep", "sweep.toml", "-o", "a.h5", "--csv", "a.csv"];
    well(here, &both);
    let whole = all(here);
    // As a kill leaves it: some outputs have their names, and the journal is there.
    let spec = Spec::from_file(&here.join("sweep.toml")).unwrap();
    let part = here.join("part");
    run_rows(&spec, &part, Existing::Keep, |_| true).unwrap();
    let journal = std::fs::read(&part).unwrap();
    std::fs::remove_file(&part).unwrap();
    for missing in [&["a.csv"][..], &["a.h5"], &["a.h5", "a.csv"], &[]] {
        std::fs::write(here.join("a.h5.part"), &journal).unwrap();
        for name in missing {
            std::fs::remove_file(here.join(name)).unwrap();
        }
        well(here, &both);
        assert!(all(here) == whole, "{missing:?}");
    }
    // what somebody else has put there is kept
    std::fs::write(here.join("a.h5.part"), &journal).unwrap();
    std::fs::write(here.join("a.csv"), "precious").unwrap();
    refused(here, &both, 2, "a.csv exists already");
    assert_eq!(std::fs::read(here.join("a.csv")).unwrap(), b"precious");
    well(here, &[&both[..], &["--force"]].concat());
    assert!(all(here) == whole);
}

#[test]
fn stopped_it_says_what_is_kept_and_two_at_once_are_one() {
    let folder = folder();
    let here = folder.path();
    std::fs::write(here.join("long.toml"), sweep(5_000_000)).unwrap();
    let long = ["sweep", "long.toml", "-o", "long.h5"];
    let mut child = command(here, &long)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while std::fs::metadata(here.join("long.h5.part")).map_or(0, |data| data.len()) < 100_000 {
        let ended = child.try_wait().unwrap();
        assert!(ended.is_none(), "{:?}", child.wait_with_output().unwrap());
        std::thread::sleep(Duration::from_millis(5));
    }
    let second = run(here, &[&long[..], &["--force"]].concat());
    let said = String::from_utf8(second.stderr).unwrap();
    assert_eq!(second.status.code(), Some(75), "{said}");
    assert!(said.contains("another run is writing long.h5"), "{said}");
    let killed = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(killed.unwrap().success());
    let done = child.wait_with_output().unwrap();
    assert!(!done.status.success());
    let said = String::from_utf8(done.stderr).unwrap();
    assert!(said.contains("scenes are kept in long.h5.part"), "{said}");
    assert!(
        said.contains("run the same command again to resume"),
        "{said}"
    );
    let left: Vec<String> = all(here).into_iter().map(|(name, _)| name).collect();
    assert!(!left.iter().any(|name| name.starts_with('.')), "{left:?}");
    // another sweep under the name: told what it is, and a word is enough
    std::fs::rename(here.join("sweep.toml"), here.join("long.toml")).unwrap();
    refused(here, &long, 2, "another sweep");
    well(here, &[&long[..], &["--force"]].concat());
}

#[test]
fn standard_error_that_nobody_reads_ends_no_run() {
    let folder = folder();
    let here = folder.path();
    let full = || {
        std::fs::File::options()
            .write(true)
            .open("/dev/full")
            .unwrap()
    };
    let mut table = command(here, &["tabulate", "--grid", "grid.toml", "-o", "t.h5"]);
    assert!(
        table
            .stdout(Stdio::null())
            .stderr(full())
            .status()
            .unwrap()
            .success()
    );
    assert!(here.join("t.h5").exists());
    let mut nowhere = command(here, &["table", "info", "nowhere.h5"]);
    assert_eq!(nowhere.stderr(full()).status().unwrap().code(), Some(2));
    let mut printed = command(here, &["materials"]);
    assert_eq!(
        printed
            .stdout(full())
            .stderr(Stdio::null())
            .status()
            .unwrap()
            .code(),
        Some(75)
    );
}

#[test]
fn rows_go_to_standard_output() {
    let folder = folder();
    let here = folder.path();
    let done = run(here, &["sweep", "sweep.toml", "-o", "a.h5", "--csv", "-"]);
    assert_eq!(done.status.code(), Some(0));
    assert_eq!(String::from_utf8(done.stdout).unwrap().lines().count(), 4);
    refused(
        here,
        &["sweep", "sweep.toml", "-o", "b.h5", "--csv", "-", "--json"],
        2,
        "--json",
    );
    refused(
        here,
        &["impact", "scene.toml", "-o", "-"],
        2,
        "standard output",
    );
}

fn output_of(done: &Output) -> (String, String) {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (text(&done.stdout), text(&done.stderr))
}

#[test]
fn a_table_that_cannot_serve_is_known_before_it_is_loaded() {
    let folder = folder();
    let here = folder.path();
    well(here, &["tabulate", "--grid", "grid.toml", "-o", "table.h5"]);
    // far outside the table, and too many points to be computed without a look at it
    let far =
        format!("{SCENE}[map]\nr_max_m = 2e-3\nz_max_m = 2e-3\npoints = [60, 60]\nframes = 2\n");
    std::fs::write(here.join("far.toml"), far).unwrap();
    let done = run(here, &["impact", "far.toml", "--table", "table.h5"]);
    let (told, said) = output_of(&done);
    assert_eq!(done.status.code(), Some(0), "{said}");
    assert!(
        told.contains("r/r0") && told.contains("is outside the table's range [0, 2]: computed"),
        "{told}"
    );
}

#[test]
fn words_are_plain() {
    let folder = folder();
    let here = folder.path();
    std::fs::write(
        here.join("glass.toml"),
        SCENE.replace("\"steel\"", "\"glass\""),
    )
    .unwrap();
    let long = SCENE.replace("steel", &"x".repeat(3_000_000));
    std::fs::write(here.join("long.toml"), long).unwrap();
    for arguments in [
        &["impact", "long.toml"][..],
        &["impact", "long.toml", "--json"],
    ] {
        let (_, said) = output_of(&run(here, arguments));
        assert!(said.len() < 10_000 && said.contains("materials library"));
    }
    for (arguments, words) in [
        (
            &["impact", "sweep.toml"][..],
            "this is a sweep, not a scene",
        ),
        (&["impact", "glass.toml"], "soda-lime-glass"),
        (&["sweep", "glass.toml", "-o", "x.h5"], "`hertzlamb impact`"),
    ] {
        refused(here, arguments, 2, words);
    }
    let (_, said) = output_of(&run(here, &["impact", "glass.toml"]));
    assert!(
        said.contains("did you mean") && said.contains("-glass"),
        "{said}"
    );
    let (told, _) = output_of(&run(here, &["impact", "--version"]));
    assert!(told.starts_with("hertzlamb "), "{told}");
    // a radius in mm taken for m
    std::fs::write(here.join("mm.toml"), SCENE.replace("5e-3", "5.0")).unwrap();
    let (_, said) = output_of(&run(here, &["impact", "mm.toml"]));
    assert!(said.contains("is the radius in m"), "{said}");
    let (told, said) = output_of(&run(here, &["impact", "mm.toml", "-q"]));
    assert!(told.contains("peak force") && said.is_empty(), "{said}");
}
