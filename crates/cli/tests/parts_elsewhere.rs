//! Parts that are Parquet, and parts that a file refers to.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
#![cfg(unix)]

use std::path::Path;
use std::process::Command;

/// 80,000 rows in three blocks, with words, draws, a list, and rows that fail.
const SWEEP: &str = "[scene.target]\nmaterial = \"steel\"\n[scene.striker]\nmaterial = \"steel\"\nmass_kg = 4e-3\n\
    tip_radius_m = 5e-3\nvelocity_m_s = 1.0\n[scene.contact]\nmodel = \"hertz\"\n\
    [product.target]\nmaterial = [\"granite\", \"steel\"]\n\
    [list.striker]\ntip_radius_m = [1e-3, 5e-3]\nmass_kg = [1e-3, 4e-3]\n\
    [random]\nsamples = 20000\nseed = 5\n[random.striker]\n\
    velocity_m_s = { distribution = \"normal\", mean = 2.0, deviation = 0.7 }\n";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), SWEEP).unwrap();
    std::fs::create_dir(folder.path().join("out")).unwrap();
    folder
}

/// Runs a command line: exit code, standard output, and standard error.
fn run(folder: &Path, line: &str) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hertzlamb"));
    let done = command
        .current_dir(folder)
        .args(line.split(' '))
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (done.status.code(), text(&done.stdout), text(&done.stderr))
}

fn well(folder: &Path, line: &str) -> String {
    let (code, out, said) = run(folder, line);
    assert_eq!(code, Some(0), "{line}: {said}");
    out
}

fn refused(folder: &Path, line: &str, code: i32, words: &str) {
    let (found, _, said) = run(folder, line);
    assert_eq!(found, Some(code), "{line}: {said}");
    assert!(said.contains(words), "{line}: {said}");
    assert_eq!(said.lines().count(), 1, "{said}");
}

#[cfg(not(feature = "parquet"))]
#[test]
fn a_program_without_parquet_says_how_to_build_it_in() {
    let folder = folder();
    let here = folder.path();
    let words = "but this program was built without that format: build it with `cargo build --release --package hertzlamb-cli --features parquet`";
    refused(here, "sweep s.toml -o rows.parquet", 2, words);
    refused(here, "sweep merge out -o all.parquet", 2, words);
    assert!(!here.join("rows.parquet.part").exists());
}

#[cfg(feature = "parquet")]
#[test]
fn parts_in_parquet_are_listed_skipped_and_merged() {
    let folder = folder();
    let here = folder.path();
    let bytes = |name: &str| std::fs::read(here.join(name)).unwrap();
    well(here, "sweep s.toml -o whole.parquet --csv whole.csv");
    well(here, "sweep s.toml -o whole.h5");
    assert!(well(here, "sweep s.toml --skip-complete -o whole.parquet").contains("nothing to do"));
    // five shards of three blocks: two have no rows
    for shard in [1, 2, 3, 5] {
        well(
            here,
            &format!("sweep s.toml --shard {shard}/5 -o out/{shard}.parquet"),
        );
    }
    assert_eq!(well(here, "sweep status out --missing"), "4\n");
    refused(here, "sweep merge out -o all.parquet", 2, "are in no part");
    let fourth = "sweep s.toml --shard 4/5 --skip-complete -o out/4.parquet";
    well(here, fourth);
    assert!(well(here, fourth).contains("nothing to do"));
    for name in ["whole.parquet", "whole.h5"] {
        well(here, &format!("sweep merge out -o all-{name}"));
        assert!(
            bytes(&format!("all-{name}")) == bytes(name),
            "{name} differs"
        );
    }
    refused(
        here,
        "sweep merge out -o v.h5 --virtual",
        2,
        "it is not an HDF5 file",
    );
    // damage of the footer and of rows is seen when the part is looked at
    let part = bytes("out/4.parquet");
    std::fs::write(here.join("out/4.parquet"), &part[..part.len() - 1]).unwrap();
    assert_eq!(well(here, "sweep status out --missing"), "4\n");
    refused(here, fourth, 1, "it was truncated");
    let mut damaged = part.clone();
    damaged[part.len() / 2] ^= 1;
    std::fs::write(here.join("out/4.parquet"), &damaged).unwrap();
    refused(
        here,
        "sweep merge out -o again.parquet",
        2,
        "out/4.parquet: the rows from",
    );
    std::fs::write(here.join("out/4.parquet"), &part).unwrap();
    well(here, "sweep merge out -o again.parquet");
}

#[test]
fn a_merge_that_refers_to_its_parts_is_refused_as_a_copy_is_and_by_what_would_read_it() {
    let folder = folder();
    let here = folder.path();
    for rows in ["0:7", "7:50001", "50001:50001"] {
        let name = rows.replace(':', "-");
        well(
            here,
            &format!("sweep s.toml --rows {rows} -o out/{name}.h5"),
        );
    }
    let line = "sweep merge out -o all.h5 --virtual";
    refused(
        here,
        line,
        2,
        "rows 50001 to 79999 of the sweep are in no part",
    );
    well(here, "sweep s.toml --rows 50000:80000 -o out/last.h5");
    refused(
        here,
        line,
        2,
        "rows 50000 to 50000 are both in out/7-50001.h5 and in out/last.h5",
    );
    well(
        here,
        "sweep s.toml --rows 50001:80000 --force -o out/last.h5",
    );
    #[cfg(feature = "parquet")]
    refused(
        here,
        "sweep merge out -o all.parquet --virtual",
        2,
        "must be an HDF5 file",
    );
    well(here, line);
    assert!(std::fs::metadata(here.join("all.h5")).unwrap().len() < 2_000_000);
    // beside the parts too, and again
    well(here, "sweep merge out -o out/all.h5 --virtual");
    well(here, "sweep merge out -o out/all.h5 --virtual --force");
    refused(here, "plot all.h5 -o all.svg", 2, "refers to its parts");
    refused(
        here,
        "sweep s.toml --skip-complete -o all.h5",
        1,
        "refers to its parts",
    );
}
