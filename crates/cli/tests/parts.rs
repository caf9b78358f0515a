//! A sweep in parts: the bytes of one run, and what is refused.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
#![cfg(unix)]

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

/// 120,000 rows in four blocks, with words, draws, a list, and rows that fail.
const SWEEP: &str = "[scene.target]\nmaterial = \"steel\"\n[scene.striker]\nmaterial = \"steel\"\nmass_kg = 4e-3\n\
    tip_radius_m = 5e-3\nvelocity_m_s = 1.0\n[scene.contact]\nmodel = \"hertz\"\n\
    [product.target]\nmaterial = [\"granite\", \"steel\"]\n\
    [list.striker]\ntip_radius_m = [1e-3, 5e-3]\nmass_kg = [1e-3, 4e-3]\n\
    [random]\nsamples = 30000\nseed = 5\n[random.striker]\n\
    velocity_m_s = { distribution = \"normal\", mean = 2.0, deviation = 0.7 }\n";
const ROWS: usize = 120_000;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), SWEEP).unwrap();
    std::fs::create_dir(folder.path().join("out")).unwrap();
    folder
}

fn command(folder: &Path, line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hertzlamb"));
    command.current_dir(folder).args(line.split(' '));
    command
}

fn run(folder: &Path, line: &str) -> Output {
    command(folder, line).output().unwrap()
}

fn well(folder: &Path, line: &str) -> String {
    let done = run(folder, line);
    let said = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(0), "{line}: {said}");
    String::from_utf8(done.stdout).unwrap()
}

fn refused(folder: &Path, line: &str, code: i32, words: &str) {
    let done = run(folder, line);
    let said = String::from_utf8(done.stderr).unwrap();
    assert_eq!(done.status.code(), Some(code), "{line}: {said}");
    assert!(said.contains(words), "{line}: {said}");
    assert_eq!(said.lines().count(), 1, "{said}");
}

fn json(folder: &Path, line: &str) -> Value {
    serde_json::from_str(&well(folder, line)).unwrap()
}

fn bytes(folder: &Path, name: &str) -> Vec<u8> {
    std::fs::read(folder.join(name)).unwrap()
}

#[test]
fn parts_in_any_division_are_the_bytes_of_one_run() {
    let folder = folder();
    let here = folder.path();
    well(here, "sweep s.toml -o whole.h5 --csv whole.csv");
    let mut lines = String::new();
    // four blocks in six shards: two have no rows, and are files all the same
    for shard in 1..=6 {
        let line =
            format!("sweep s.toml --shard {shard}/6 -o out/{shard}.h5 --csv {shard}.csv --json");
        let said = json(here, &line);
        assert_eq!(said["shard"], format!("{shard}/6"));
        assert_eq!(said["sweep_rows"], ROWS);
        let text = std::fs::read_to_string(here.join(format!("{shard}.csv"))).unwrap();
        let body = text.split_once('\n').unwrap();
        if lines.is_empty() {
            lines = format!("{}\n", body.0);
        }
        lines.push_str(body.1);
    }
    assert!(lines.as_bytes() == bytes(here, "whole.csv"), "rows differ");
    let status = json(here, "sweep status out --json");
    assert_eq!(status["complete"], true);
    assert_eq!(
        (&status["rows"], &status["shards"]),
        (&ROWS.into(), &6.into())
    );
    assert!(status["failed"].as_u64().unwrap() > 100, "{status}");
    assert!(
        status["parts"]
            .as_array()
            .unwrap()
            .iter()
            .any(|part| part["rows"] == 0)
    );
    assert_eq!(well(here, "sweep status out --missing"), "\n");
    well(here, "sweep merge out -o merged.h5");
    assert!(
        bytes(here, "merged.h5") == bytes(here, "whole.h5"),
        "merged differs"
    );
    // into the folder of the parts, twice
    well(here, "sweep merge out -o out/all.h5");
    well(here, "sweep merge out -o out/all.h5 --force");
    assert!(
        bytes(here, "out/all.h5") == bytes(here, "whole.h5"),
        "merged differs"
    );
    refused(
        here,
        "sweep merge out -o out/3.h5 --force",
        2,
        "a part that this command reads",
    );
    // another division, by rows that are no blocks
    std::fs::create_dir(here.join("rows")).unwrap();
    for (name, rows) in [
        ("a", "0:7"),
        ("b", "7:70001"),
        ("c", "70001:70001"),
        ("d", "70001:120000"),
    ] {
        well(
            here,
            &format!("sweep s.toml --rows {rows} -o rows/{name}.h5"),
        );
    }
    well(here, "sweep merge rows -o again.h5");
    assert!(
        bytes(here, "again.h5") == bytes(here, "whole.h5"),
        "merged differs"
    );
    refused(here, "sweep status rows --missing", 2, "--shards N");
    assert_eq!(well(here, "sweep status rows --missing --shards 3"), "\n");
}

#[test]
fn a_part_killed_and_run_twice_is_the_same_part() {
    let folder = folder();
    let here = folder.path();
    // slow enough to be caught
    let slow = SWEEP
        .replace("\"hertz\"", "\"growing\"")
        .replace("samples = 30000", "samples = 20000");
    std::fs::write(here.join("s.toml"), slow).unwrap();
    let line = "sweep s.toml --shard 2/3 -o out/2.h5";
    let child = command(here, line)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    let mut child = child.unwrap();
    let journal = here.join("out/2.h5.part");
    while std::fs::metadata(&journal).map_or(0, |data| data.len()) < 50_000 {
        assert_eq!(child.try_wait().unwrap(), None);
        std::thread::sleep(Duration::from_millis(2));
    }
    refused(here, line, 75, "another run is writing out/2.h5");
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!here.join("out/2.h5").exists());
    // what is left of other rows is not taken for these
    refused(
        here,
        "sweep s.toml --rows 0:5 -o out/2.h5",
        2,
        "another sweep",
    );
    let resumed = json(here, &format!("{line} --skip-complete --json"));
    assert!(resumed["resumed"].as_u64().unwrap() >= 64, "{resumed}");
    well(here, "sweep s.toml --shard 2/3 -o alone.h5");
    assert!(
        bytes(here, "out/2.h5") == bytes(here, "alone.h5"),
        "a resumed part differs"
    );
    assert!(!journal.exists());
}

#[test]
fn what_is_complete_is_skipped_and_what_differs_is_told() {
    let folder = folder();
    let here = folder.path();
    let line = "sweep s.toml --shard 1/4 --skip-complete -o out/1.h5";
    well(here, line);
    let before = bytes(here, "out/1.h5");
    assert_eq!(json(here, &format!("{line} --json"))["complete"], true);
    refused(
        here,
        "sweep s.toml --shard 1/4 -o out/1.h5",
        2,
        "exists already",
    );
    refused(
        here,
        "sweep s.toml --shard 2/4 --skip-complete -o out/1.h5",
        1,
        "has the rows 0:32768, not 32768:65536",
    );
    refused(
        here,
        "sweep s.toml --skip-complete -o out/1.h5",
        1,
        "is a part of a sweep, not a sweep",
    );
    refused(
        here,
        &format!("{line} --csv 1.csv"),
        1,
        "1.csv does not exist",
    );
    std::fs::write(here.join("t.toml"), SWEEP.replace("seed = 5", "seed = 6")).unwrap();
    refused(
        here,
        "sweep t.toml --shard 1/4 --skip-complete -o out/1.h5",
        1,
        "of another sweep",
    );
    // one that was cut short is not whole
    std::fs::write(here.join("out/1.h5"), &before[..before.len() - 200_000]).unwrap();
    let cut = run(here, line);
    assert_eq!(
        cut.status.code(),
        Some(1),
        "{}",
        String::from_utf8_lossy(&cut.stderr)
    );
    well(here, "sweep s.toml --shard 1/4 --force -o out/1.h5");
    assert!(bytes(here, "out/1.h5") == before);
    // a whole sweep too
    let few = SWEEP.replace("samples = 30000", "samples = 10");
    std::fs::write(here.join("few.toml"), few).unwrap();
    well(here, "sweep few.toml --skip-complete -o few.h5");
    assert!(well(here, "sweep few.toml --skip-complete -o few.h5").contains("nothing to do"));
    refused(
        here,
        "sweep s.toml --skip-complete -o few.h5",
        1,
        "of another sweep",
    );
}

#[test]
fn gaps_overlaps_and_strangers_are_not_merged() {
    let folder = folder();
    let here = folder.path();
    refused(
        here,
        "sweep merge out -o all.h5",
        2,
        "out contains no part of a sweep",
    );
    assert_eq!(
        well(here, "sweep status out --sweep s.toml --shards 4 --missing"),
        "1-4\n"
    );
    for shard in [1, 3] {
        well(
            here,
            &format!("sweep s.toml --shard {shard}/4 -o out/{shard}.h5"),
        );
    }
    assert_eq!(well(here, "sweep status out --missing"), "2,4\n");
    let status = json(here, "sweep status out --json");
    assert_eq!(status["complete"], false);
    assert_eq!(status["missing_shards"], serde_json::json!([2, 4]));
    assert_eq!(
        status["missing_rows"],
        serde_json::json!([[32768, 65536], [98304, 120_000]])
    );
    refused(
        here,
        "sweep merge out -o all.h5",
        2,
        "rows 32768 to 65535 of the sweep are in no part, and one more range is missing",
    );
    well(here, "sweep s.toml --shard 2/2 -o out/b.h5");
    refused(
        here,
        "sweep merge out -o all.h5",
        2,
        "are both in out/3.h5 and in out/b.h5",
    );
    let status = json(here, "sweep status out --json");
    assert!(
        status["overlap"].as_str().unwrap().contains("out/b.h5"),
        "{status}"
    );
    std::fs::remove_file(here.join("out/b.h5")).unwrap();
    std::fs::write(here.join("t.toml"), SWEEP.replace("seed = 5", "seed = 6")).unwrap();
    well(here, "sweep t.toml --shard 2/4 -o out/2.h5");
    refused(
        here,
        "sweep merge out -o all.h5",
        2,
        "out/2.h5 is a part of another sweep",
    );
    assert_eq!(well(here, "sweep status out --missing"), "2,4\n");
    std::fs::write(here.join("out/2.h5"), "text").unwrap();
    refused(here, "sweep merge out -o all.h5", 2, "out/2.h5 is text");
    let backwards = run(here, "sweep s.toml --rows 5:3 -o x.h5");
    assert_eq!(backwards.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&backwards.stderr).contains("5 is after 3"));
    refused(
        here,
        "sweep s.toml --rows 0:120001 -o x.h5",
        2,
        "the end of the rows = 120001 is outside [0, 120000], the rows of the sweep",
    );
    assert!(!here.join("all.h5").exists() && !here.join("x.h5").exists());
}

#[test]
fn a_plan_says_what_a_billion_rows_take() {
    let folder = folder();
    let here = folder.path();
    // draws none of which fails: a reason takes space beside the rows
    let billion = SWEEP.replace("samples = 30000", "samples = 10000000").replace("deviation = 0.7", "deviation = 0.01").replace(
        "[product.target]\n",
        "[product.contact]\ntolerance = { from = 1e-5, to = 1e-3, count = 25 }\n[product.target]\n",
    );
    std::fs::write(here.join("b.toml"), billion).unwrap();
    let plan = json(here, "sweep b.toml --plan --shards 239 --json");
    assert_eq!(
        (&plan["rows"], &plan["shards"]),
        (&1_000_000_000.into(), &239.into())
    );
    let most = plan["rows_per_shard"].as_u64().unwrap();
    assert!(
        most.is_multiple_of(32_768) && most * 239 >= 1_000_000_000,
        "{plan}"
    );
    let rate = plan["rows_per_second"].as_f64().unwrap();
    let seconds = plan["seconds_per_shard"].as_f64().unwrap();
    assert!((seconds * rate / most as f64 - 1.0).abs() < 1e-9, "{plan}");
    let sha256 = plan["sweep_sha256"].as_str().unwrap();
    let said = json(
        here,
        "sweep b.toml --rows 999999990:1000000000 -o end.h5 --json",
    );
    assert_eq!(said["sweep_sha256"], sha256);
    assert_eq!(said["rows"], 10);
    // bytes of a part, as the plan has them, beside what does not depend on its rows
    let [a, b] = ["0:1000", "0:33768"].map(|rows| {
        let name = format!("{}.h5", rows.len());
        well(here, &format!("sweep b.toml --rows {rows} -o {name}"));
        std::fs::metadata(here.join(name)).unwrap().len()
    });
    let planned = plan["bytes_per_shard"].as_u64().unwrap() * 32_768 / most;
    assert!((b - a).abs_diff(planned) < 4096, "{} {planned}", b - a);
    assert_eq!(plan["columns"][0], "row");
}

#[test]
fn chosen_columns_and_single_precision_are_kept_by_parts() {
    let folder = folder();
    let here = folder.path();
    let few = "--columns restitution,peak_force_n --float32";
    well(here, "sweep s.toml -o all.h5 --csv all.csv");
    well(here, &format!("sweep s.toml {few} -o few.h5 --csv few.csv"));
    for shard in 1..=2 {
        well(
            here,
            &format!("sweep s.toml {few} --shard {shard}/2 -o out/{shard}.h5"),
        );
    }
    well(here, "sweep merge out -o merged.h5");
    assert!(
        bytes(here, "merged.h5") == bytes(here, "few.h5"),
        "merged differs"
    );
    let table = |name: &str| -> Vec<Vec<String>> {
        let text = std::fs::read_to_string(here.join(name)).unwrap();
        let fields = |line: &str| line.splitn(40, ',').map(str::to_owned).collect();
        text.lines().take(1000).map(fields).collect()
    };
    let (all, few_rows) = (table("all.csv"), table("few.csv"));
    let names: Vec<&str> = few_rows[0].iter().map(String::as_str).collect();
    // the keys, the results in the order of the program, the model, the reason
    assert_eq!(
        names[4..],
        ["peak_force_n", "restitution", "model", "failure"]
    );
    let file = hdf5(here, "few.h5");
    for (k, name) in names.iter().enumerate().skip(4).take(2) {
        let place = all[0].iter().position(|other| other == name).unwrap();
        let stored = file.values(name).unwrap();
        for (row, (all, few)) in all.iter().zip(&few_rows).skip(1).enumerate() {
            let number = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
            let (exact, rounded) = (number(&all[place]), number(&few[k]));
            assert!(exact.is_nan() || exact as f32 == rounded as f32);
            assert!(exact.is_nan() || f64::from(exact as f32) == stored[row]);
        }
    }
    assert!(file.values("contact_time_s").is_err());
    let plan = json(
        here,
        &format!("sweep s.toml {few} --plan --shards 2 --json"),
    );
    let part = std::fs::metadata(here.join("out/1.h5")).unwrap().len();
    let planned = plan["bytes_per_shard"].as_u64().unwrap();
    assert!(
        part > planned && part < planned + 200_000,
        "{part} {planned}"
    );
    refused(
        here,
        "sweep s.toml --shard 1/2 --skip-complete -o out/1.h5",
        1,
        "has other columns or another precision",
    );
    well(here, "sweep s.toml --shard 2/2 --force -o out/2.h5");
    refused(
        here,
        "sweep merge out -o no.h5",
        2,
        "differ in their columns or precision",
    );
    refused(
        here,
        "sweep s.toml --columns restitutions -o no.h5",
        2,
        "columns = \"restitutions\" is not one of",
    );
}

fn hdf5(folder: &Path, name: &str) -> formats::stored::StoredSweep {
    formats::stored::StoredSweep::open(&folder.join(name)).unwrap()
}

/// Twelve rows with a probe, which take some milliseconds each.
const PROBED: &str = "[scene.target]\nmaterial = \"granite\"\n[scene.striker]\nshape = \"ball\"\nmaterial = \"bearing-steel\"\n\
    velocity_m_s = 2.0\n[[scene.probe]]\nr_m = 0.1\nz_m = 0.0\n[product.striker]\n\
    diameter_m = [3e-5, 1e-3, 1.1e-3, 1.2e-3, 1.3e-3, 1.4e-3, 1.5e-3, 1.6e-3, 1.7e-3, 1.8e-3, 1.9e-3, 2e-3]\n";

#[test]
fn rows_with_probes_are_divided_one_by_one_and_are_the_same_on_any_threads() {
    let folder = folder();
    let here = folder.path();
    std::fs::write(here.join("p.toml"), PROBED).unwrap();
    for threads in ["1", "64"] {
        let line = format!("sweep p.toml -o {threads}.h5");
        let done = command(here, &line)
            .env("RAYON_NUM_THREADS", threads)
            .output();
        assert!(done.unwrap().status.success(), "{threads} threads");
    }
    assert!(bytes(here, "1.h5") == bytes(here, "64.h5"));
    for shard in 1..=3 {
        let said = json(
            here,
            &format!("sweep p.toml --shard {shard}/3 -o out/{shard}.h5 --json"),
        );
        assert_eq!((&said["rows"], &said["failed"]), (&4.into(), &0.into()));
    }
    well(here, "sweep merge out -o merged.h5");
    assert!(bytes(here, "merged.h5") == bytes(here, "1.h5"));
}

#[test]
fn damage_and_an_overlap_of_one_row_are_refused() {
    let folder = folder();
    let here = folder.path();
    let few = SWEEP.replace("samples = 30000", "samples = 50");
    std::fs::write(here.join("few.toml"), few).unwrap();
    for rows in ["0:100", "100:200"] {
        well(
            here,
            &format!("sweep few.toml --rows {rows} -o out/{}.h5", &rows[..1]),
        );
    }
    well(here, "sweep merge out -o good.h5");
    for (rows, words) in [("99:100", "rows 99 to 99"), ("100:101", "rows 100 to 100")] {
        well(
            here,
            &format!("sweep few.toml --rows {rows} -o out/more.h5"),
        );
        refused(here, "sweep merge out -o all.h5", 2, words);
        let status = json(here, "sweep status out --json");
        assert!(
            status["overlap"].as_str().unwrap().starts_with(words),
            "{status}"
        );
        std::fs::remove_file(here.join("out/more.h5")).unwrap();
    }
    let good = bytes(here, "out/1.h5");
    for place in (3..good.len()).step_by(good.len() / 40) {
        let mut bad = good.clone();
        bad[place] ^= 16;
        std::fs::write(here.join("out/1.h5"), bad).unwrap();
        let status = json(here, "sweep status out --json");
        assert_eq!(status["foreign"][0]["file"], "out/1.h5", "byte {place}");
        refused(here, "sweep merge out -o all.h5", 2, "out/1.h5");
        refused(
            here,
            "sweep few.toml --rows 100:200 --skip-complete -o out/1.h5",
            1,
            "out/1.h5",
        );
    }
}

#[test]
fn what_no_disk_holds_is_not_begun_and_what_is_at_work_is_told() {
    let folder = folder();
    let here = folder.path();
    let endless = SWEEP.replace("samples = 30000", "samples = 200000000000");
    std::fs::write(here.join("endless.toml"), endless).unwrap();
    refused(here, "sweep endless.toml -o x.h5", 75, "GB of disk");
    assert!(!here.join("x.h5.part").exists());
    let long = SWEEP.replace("samples = 30000", "samples = 3000000");
    std::fs::write(here.join("long.toml"), long).unwrap();
    let mut child = command(here, "sweep long.toml --shard 1/2 -o out/1.h5")
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let journal = here.join("out/1.h5.part");
    while std::fs::metadata(&journal).map_or(0, |there| there.len()) < 100_000 {
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let status = json(here, "sweep status out --json");
    let unfinished = &status["unfinished"][0];
    assert_eq!(unfinished["file"], "out/1.h5.part");
    assert!(unfinished["kept"].as_u64().unwrap() > 0, "{status}");
    let many = run(here, "sweep s.toml --shard 1/1000001 -o y.h5");
    assert_eq!(many.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&many.stderr).contains("[1, 1000000]"));
}
