//! Tables from outside: interruptions at any moment, shards, extension, files in the way, damage.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

const GRID: &str = "\
poisson_ratios = [0.25, 0.3]
cell_width = 0.25
tail_terms = 8
tolerance = 1e-7
[r]
max = 0.875
spacing = 0.125
[z]
max = 0.875
spacing = 0.125
";

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hertzlamb"));
    command
        .current_dir(folder)
        .args(arguments)
        .env("SOURCE_DATE_EPOCH", "0")
        // the child of another test may hold the lock of a file that this process has written
        .env("HDF5_USE_FILE_LOCKING", "FALSE");
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().unwrap()
}

fn well(folder: &Path, arguments: &[&str]) -> String {
    let done = run(folder, arguments);
    let message = String::from_utf8_lossy(&done.stderr).into_owned();
    assert_eq!(done.status.code(), Some(0), "{arguments:?}: {message}");
    String::from_utf8(done.stdout).unwrap()
}

/// The last line of what a command says that ends with this code.
fn refused(folder: &Path, arguments: &[&str], code: i32) -> String {
    let done = run(folder, arguments);
    let message = String::from_utf8(done.stderr).unwrap();
    assert_eq!(done.status.code(), Some(code), "{arguments:?}: {message}");
    message.lines().last().unwrap_or_default().to_owned()
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("grid.toml"), GRID).unwrap();
    folder
}

fn bytes(folder: &Path, name: &str) -> Vec<u8> {
    std::fs::read(folder.join(name)).unwrap()
}

const BUILD: [&str; 5] = ["tabulate", "--grid", "grid.toml", "-o", "t.h5"];

#[test]
fn killed_at_any_moment_the_same_command_gives_the_same_bytes() {
    let folder = folder();
    let here = folder.path();
    well(
        here,
        &["tabulate", "--grid", "grid.toml", "-o", "straight.h5"],
    );
    let mut kills = 0;
    // Ever later moments, so that all stages are met whatever the speed of the machine.
    for moment in (1..=24).map(|i: u64| 20 * i) {
        let mut child = command(here, &BUILD).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(moment));
        // SIGKILL: the process cannot clean up.
        child.kill().unwrap();
        child.wait().unwrap();
        if here.join("t.h5").exists() {
            break;
        }
        kills += 1;
    }
    if !here.join("t.h5").exists() {
        well(here, &BUILD);
    }
    assert!(kills > 0);
    assert!(bytes(here, "t.h5") == bytes(here, "straight.h5"));
}

#[test]
fn shards_make_the_same_bytes() {
    let folder = folder();
    let here = folder.path();
    well(here, &BUILD);
    for shard in ["1/3", "2/3", "3/3"] {
        let name = format!("{}.shard", &shard[..1]);
        well(
            here,
            &[
                "tabulate",
                "--grid",
                "grid.toml",
                "--shard",
                shard,
                "-o",
                &name,
            ],
        );
    }
    let shards = ["3.shard", "1.shard", "2.shard"];
    well(
        here,
        &[&["table", "merge"], &shards[..], &["-o", "m.h5"]].concat(),
    );
    assert!(bytes(here, "t.h5") == bytes(here, "m.h5"));
    well(here, &["table", "diff", "t.h5", "m.h5"]);
}

#[test]
fn a_table_grows_by_slices_and_places_and_keeps_its_numbers() {
    let folder = folder();
    let here = folder.path();
    well(here, &BUILD);
    let old = lookup::read(&here.join("t.h5")).unwrap();
    well(here, &["tabulate", "--nu", "0.28,0.3", "-o", "t.h5"]);
    // The same table made at once.
    let whole = GRID.replace("cell_width", "exact_ratios = [0.28]\ncell_width");
    std::fs::write(here.join("whole.toml"), whole).unwrap();
    well(
        here,
        &["tabulate", "--grid", "whole.toml", "-o", "whole.h5"],
    );
    assert!(bytes(here, "t.h5") == bytes(here, "whole.h5"));

    well(
        here,
        &[
            "tabulate",
            "--r-max",
            "1.1",
            "--z-max",
            "1",
            "--time-factor",
            "1.7",
            "-o",
            "t.h5",
        ],
    );
    let new = lookup::read(&here.join("t.h5")).unwrap();
    assert_eq!((new.r_max, new.z_max), (1.125, 1.0));
    assert!(new.slices[0].cells > old.slices[0].cells);
    for (i, _) in old.r.iter().enumerate() {
        for (k, _) in old.z.iter().enumerate() {
            let row = |content: &lookup::Content, field: usize| {
                let cells = content.slices[0].cells;
                let start = ((i * content.z.len() + k) * 6 + field) * cells;
                content.slices[0].remainder[start..start + old.slices[0].cells].to_vec()
            };
            for field in 0..6 {
                assert_eq!(row(&old, field), row(&new, field));
            }
        }
    }
    well(here, &["table", "verify", "t.h5", "--sample", "60"]);
    let message = refused(here, &["tabulate", "--r-max", "0.5", "-o", "t.h5"], 2);
    assert!(
        message.contains("r_max = 0.5 is less than the 1.125"),
        "{message}"
    );
}

#[test]
fn files_in_the_way_and_places_that_cannot_be_written_are_refused() {
    let folder = folder();
    let here = folder.path();
    std::fs::write(here.join("precious.h5"), "precious").unwrap();
    for arguments in [
        ["tabulate", "--grid", "grid.toml", "-o", "precious.h5"],
        ["tabulate", "--nu", "0.3", "-o", "precious.h5"],
        ["tabulate", "--grid", "grid.toml", "-o", "none/t.h5"],
        ["tabulate", "--grid", "grid.toml", "-o", "/proc/t.h5"],
        ["tabulate", "--tol", "1e-5", "-o", "t.h5"],
    ] {
        refused(here, &arguments, 2);
    }
    let message = refused(
        here,
        &["tabulate", "--tol", "2", "--pulse", "10", "-o", "t.h5"],
        2,
    );
    assert_eq!(message, "error: grid: tol = 2 is outside [1e-7, 0.1]");
    assert_eq!(bytes(here, "precious.h5"), b"precious");
}

#[test]
fn a_second_run_on_one_file_is_refused() {
    let folder = folder();
    let here = folder.path();
    let mut first = command(here, &["tabulate", "--grid", "demo", "-o", "t.h5"])
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    while std::fs::read(here.join("t.h5.journal")).map_or(0, |bytes| bytes.len()) < 1 << 16 {
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(50));
    let message = refused(here, &["tabulate", "--grid", "demo", "-o", "t.h5"], 75);
    first.kill().unwrap();
    first.wait().unwrap();
    assert!(message.contains("another run is writing t.h5"), "{message}");
    let message = refused(here, &BUILD, 2);
    assert!(message.contains("another kernel table"), "{message}");
}

/// A file that may not grow behaves as on a full disk.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported_and_nothing_is_lost() {
    let folder = folder();
    let here = folder.path();
    well(
        here,
        &["tabulate", "--grid", "grid.toml", "-o", "straight.h5"],
    );
    // Blocks of 512 bytes: the journal is cut short.
    for blocks in ["20", "300"] {
        let script = format!(
            "trap '' XFSZ; ulimit -f {blocks}; exec {} {}",
            env!("CARGO_BIN_EXE_hertzlamb"),
            BUILD.join(" ")
        );
        let done = Command::new("sh")
            .args(["-c", &script])
            .current_dir(here)
            .env("SOURCE_DATE_EPOCH", "0")
            .output()
            .unwrap();
        let message = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(75), "{message}");
        let last = message.lines().last().unwrap();
        assert!(last.starts_with("error: cannot write "), "{message}");
        assert!(last.contains("no space left"), "{message}");
        assert!(!here.join("t.h5").exists());
    }
    well(here, &BUILD);
    assert!(bytes(here, "t.h5") == bytes(here, "straight.h5"));
}

#[test]
fn a_damaged_table_is_found_and_its_bad_nodes_are_named() {
    let folder = folder();
    let here = folder.path();
    well(here, &BUILD);
    let path = here.join("t.h5");
    // A wrong number under a right checksum: only the exact kernels can tell.
    let mut content = lookup::read(&path).unwrap();
    let (cells, depths) = (content.slices[0].cells, content.z.len());
    content.slices[0].remainder[((depths + 2) * 6 + 1) * cells + 3] += 1e-3;
    lookup::write(&here.join("wrong.h5"), &content).unwrap();
    let message = refused(
        here,
        &["table", "verify", "wrong.h5", "--sample", "1000"],
        1,
    );
    assert!(
        message.contains("nu = 0.25, r/r0 = 0.125, z/r0 = 0.25: displacement_z"),
        "{message}"
    );
    let message = refused(here, &["table", "diff", "t.h5", "wrong.h5"], 1);
    assert!(message.contains("differ"), "{message}");
    // A byte of the numbers: a checksum of the file can tell, and where.
    let raw = bytes(here, "t.h5");
    let mut named = 0;
    for place in (0..raw.len()).step_by(raw.len() / 30) {
        let mut flipped = raw.clone();
        flipped[place] ^= 0x40;
        std::fs::write(here.join("broken.h5"), flipped).unwrap();
        let done = run(here, &["table", "verify", "broken.h5", "--sample", "1"]);
        let message = String::from_utf8(done.stderr).unwrap();
        if message.contains("unreadable nodes: nu = ") {
            assert_eq!(done.status.code(), Some(1), "{message}");
            named += 1;
        }
    }
    assert!(
        named > 10,
        "{named} of 31 flipped bytes traced to their nodes"
    );
    // A number that is none, and a wrong one among those beside the averages.
    content.slices[1].moment[7 * cells] = f32::NAN;
    lookup::write(&here.join("nan.h5"), &content).unwrap();
    let message = refused(here, &["table", "verify", "nan.h5"], 1);
    assert!(
        message.contains("nu = 0.3, r/r0 = 0, z/r0 = 0.125: displacement_z (moment) is not finite"),
        "{message}"
    );
    content.slices[1].moment[7 * cells] = 0.3;
    lookup::write(&here.join("moment.h5"), &content).unwrap();
    let message = refused(
        here,
        &["table", "verify", "moment.h5", "--sample", "1000"],
        1,
    );
    assert!(
        message.contains("nu = 0.3, r/r0 = 0, z/r0 = 0.125: displacement_z (moment) differs"),
        "{message}"
    );
    assert!(well(here, &["table", "info", "t.h5"]).contains("0.25, 0.3"));
}
