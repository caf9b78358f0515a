//! How the program ends where the system gives it less than it asks for, or somebody stops it; and what its messages show.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
#![cfg(unix)]

use serde_json::Value;
use std::io::Write;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

const SCENE: &str = "[target]\nmaterial = \"granite\"\n[striker]\nmaterial = \"steel\"\nmass_kg = 2e-3\n\
    tip_radius_m = 4e-3\nvelocity_m_s = 0.7\n";

fn folder(rows: usize) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let sweep = format!(
        "scene = \"scene.toml\"\n[product.striker]\nvelocity_m_s = {{ from = 0.2, to = 5.0, count = {rows} }}\n"
    );
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    std::fs::write(folder.path().join("sweep.toml"), sweep).unwrap();
    folder
}

/// The command in a shell with limits, before which a line of it stands.
fn limited(folder: &Path, limits: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new("sh");
    let line = format!("{limits}; exec \"$0\" \"$@\"");
    command
        .arg("-c")
        .arg(line)
        .arg(env!("CARGO_BIN_EXE_hertzlamb"));
    command.args(arguments).current_dir(folder);
    command
}

fn run(folder: &Path, limits: &str, arguments: &[&str]) -> Output {
    limited(folder, limits, arguments).output().unwrap()
}

fn said(done: &Output) -> String {
    String::from_utf8(done.stderr.clone()).unwrap()
}

/// The one error on standard error, as an object.
fn error(done: &Output) -> Value {
    let object: Value = serde_json::from_slice(&done.stderr).unwrap();
    object["error"].clone()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

#[test]
fn threads_that_the_system_does_not_start_are_done_without() {
    let folder = folder(500);
    let here = folder.path();
    let all = run(
        here,
        "RAYON_NUM_THREADS=2",
        &["sweep", "sweep.toml", "-o", "a.h5"],
    );
    assert!(all.status.success(), "{}", said(&all));
    // the stacks of 1,000 threads take 2 GB
    let few = "ulimit -v 2000000; export RAYON_NUM_THREADS=1000";
    let done = run(here, few, &["sweep", "sweep.toml", "-o", "b.h5"]);
    assert!(done.status.success(), "{}", said(&done));
    assert!(said(&done).contains(" of 1000 threads"), "{}", said(&done));
    let read = |name: &str| std::fs::read(here.join(name)).unwrap();
    assert!(read("a.h5") == read("b.h5"));
    let many = "export RAYON_NUM_THREADS=1025";
    let refused = run(here, many, &["impact", "scene.toml", "--json"]);
    assert_eq!(refused.status.code(), Some(2));
    let found = error(&refused);
    assert_eq!(found["key"], "RAYON_NUM_THREADS");
    assert_eq!(found["range"], "[1, 1024]");
    assert_eq!(found["value"], 1025.0);
}

#[test]
fn memory_that_is_not_there_is_an_object_and_leaves_nothing() {
    let folder = folder(3);
    let here = folder.path();
    let long: String = (0..4_000_000).map(|i| format!("{i}e-9,1\n")).collect();
    std::fs::write(here.join("long.csv"), format!("time_s,force_n\n{long}")).unwrap();
    let record = "[target]\nmaterial = \"steel\"\n[contact]\ndisc_radius_m = 1e-3\n[force]\nfile = \"long.csv\"\n";
    std::fs::write(here.join("record.toml"), record).unwrap();
    let before = names(here);
    let little = "export RAYON_NUM_THREADS=1; ulimit -v 90000";
    let done = run(
        here,
        little,
        &["impact", "record.toml", "-o", "a.h5", "--json"],
    );
    assert_eq!(done.status.code(), Some(1), "{}", said(&done));
    let found = error(&done);
    assert_eq!(found["class"], "memory");
    assert!(
        found["message"]
            .as_str()
            .unwrap()
            .contains("no memory left"),
        "{found}"
    );
    assert_eq!(names(here), before);
}

#[test]
fn a_signal_ends_a_run_whose_standard_error_nobody_reads() {
    let folder = folder(9_000_000);
    let here = folder.path();
    for signal in ["TERM", "INT", "HUP"] {
        let (_unread, mut error) = std::io::pipe().unwrap();
        rustix::fs::fcntl_setfl(&error, rustix::fs::OFlags::NONBLOCK).unwrap();
        while error.write(&[b'.'; 512]).is_ok() {}
        rustix::fs::fcntl_setfl(&error, rustix::fs::OFlags::empty()).unwrap();
        let mut child = limited(here, "true", &["sweep", "sweep.toml", "-o", "a.h5"]);
        let mut child = child.stdout(Stdio::null()).stderr(error).spawn().unwrap();
        while std::fs::metadata(here.join("a.h5.part")).map_or(0, |data| data.len()) < 50_000 {
            assert!(child.try_wait().unwrap().is_none());
            std::thread::sleep(Duration::from_millis(5));
        }
        // the next line that it says waits for a reader
        std::thread::sleep(Duration::from_secs(1));
        let number = child.id().to_string();
        let sent = Command::new("kill")
            .args([&format!("-{signal}"), &number])
            .status();
        assert!(sent.unwrap().success());
        let began = Instant::now();
        let status = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break status;
            }
            if began.elapsed() > Duration::from_secs(20) {
                child.kill().unwrap();
                panic!("SIG{signal} did not end the run");
            }
            std::thread::sleep(Duration::from_millis(5));
        };
        let expected = [("HUP", 1), ("INT", 2), ("TERM", 15)];
        assert!(
            expected.contains(&(signal, status.signal().unwrap())),
            "{status}"
        );
        assert!(!names(here).iter().any(|name| name.starts_with('.')));
        std::fs::remove_file(here.join("a.h5.part")).unwrap();
    }
}

#[test]
fn a_run_that_is_stopped_says_so_in_an_object() {
    let folder = folder(9_000_000);
    let here = folder.path();
    let mut child = limited(
        here,
        "true",
        &["sweep", "sweep.toml", "-o", "a.h5", "--json", "-q"],
    );
    let child = child
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while std::fs::metadata(here.join("a.h5.part")).map_or(0, |data| data.len()) < 50_000 {
        std::thread::sleep(Duration::from_millis(5));
    }
    let sent = Command::new("kill").arg(child.id().to_string()).status();
    assert!(sent.unwrap().success());
    let done = child.wait_with_output().unwrap();
    assert_eq!(done.status.signal(), Some(15));
    let found = error(&done);
    assert_eq!(found["class"], "stopped");
    assert!(
        found["message"]
            .as_str()
            .unwrap()
            .contains("kept in a.h5.part"),
        "{found}"
    );
}

#[test]
fn a_name_with_a_new_line_makes_no_line_of_its_own() {
    let folder = folder(3);
    let here = folder.path();
    let forged = "a\nerror: forged\u{7f}";
    std::fs::write(here.join(forged), SCENE).unwrap();
    let own = format!("[materials]\nfile = '''{forged}'''\n{SCENE}");
    std::fs::write(here.join("own.toml"), own).unwrap();
    let results = format!("{forged}.h5");
    for arguments in [
        &[
            "impact",
            forged,
            "-o",
            &results,
            "--csv",
            &format!("{forged}.csv"),
        ][..],
        &["impact", forged, "-o", &results],
        &["impact", forged, "-o", &results, "--skip-complete"],
        &["impact", "own.toml"],
        &["impact", &format!("{forged}none")],
        &["impact", "scene.toml", "--table", forged],
        &["plot", &results, "-o", &format!("{forged}.svg")],
        &["plot", forged, "-o", &format!("{forged}2.svg")],
        &["plot", &results, "-o", &format!("a.svg{forged}")],
        &["sweep", "sweep.toml", "-o", &format!("{forged}s.h5")],
        &["sweep", "status", forged],
        &["table", "info", forged],
        &["tabulate", "--grid", forged, "-o", "t.h5"],
        &["materials", forged],
        &["materials", "--", forged],
        &["materials", "--file", forged],
        &[forged],
        &["impact", "scene.toml", forged],
        &["sweep", "sweep.toml", "-o", "b.h5", "--shard", forged],
        &["infer", "scene.toml", "--restitution", forged],
    ] {
        let done = run(here, "true", arguments);
        for text in [&done.stdout, &done.stderr] {
            let text = String::from_utf8_lossy(text);
            assert!(
                !text.lines().any(|line| line.starts_with("error: forged")),
                "{arguments:?}: {text}"
            );
            assert!(!text.contains('\u{7f}'), "{arguments:?}: {text}");
        }
        let mut json = arguments.to_vec();
        json.insert(1, "--json");
        let done = run(here, "true", &json);
        for text in [&done.stdout, &done.stderr] {
            let shown = String::from_utf8_lossy(text);
            let lines = shown.lines().filter(|line| line.starts_with('{'));
            lines.for_each(|line| drop(serde_json::from_str::<Value>(line).unwrap()));
            assert!(
                !shown.lines().any(|line| line.starts_with("error: forged")),
                "{shown}"
            );
        }
    }
}

#[test]
fn an_impact_with_one_of_its_two_outputs_goes_on() {
    let folder = folder(3);
    let here = folder.path();
    let both = ["impact", "scene.toml", "-o", "a.h5", "--csv", "a.csv"];
    assert!(run(here, "true", &both).status.success());
    let read = |name: &str| std::fs::read(here.join(name)).unwrap();
    let (results, text) = (read("a.h5"), read("a.csv"));
    // as a run that was killed between its two names leaves it
    std::fs::remove_file(here.join("a.csv")).unwrap();
    let again = run(here, "true", &both);
    assert!(again.status.success(), "{}", said(&again));
    assert!(read("a.h5") == results && read("a.csv") == text);
    // both there, or those of another scene: nothing is replaced
    assert_eq!(run(here, "true", &both).status.code(), Some(2));
    std::fs::remove_file(here.join("a.csv")).unwrap();
    std::fs::write(here.join("scene.toml"), SCENE.replace("0.7", "0.8")).unwrap();
    let other = run(here, "true", &both);
    assert_eq!(other.status.code(), Some(2));
    assert!(
        said(&other).contains("a.h5 exists already"),
        "{}",
        said(&other)
    );
    assert!(read("a.h5") == results && !here.join("a.csv").exists());
}

#[test]
fn rows_that_were_not_taken_are_printed_by_the_same_command() {
    let folder = folder(40);
    let here = folder.path();
    let rows = ["sweep", "sweep.toml", "-o", "a.h5", "--csv", "-"];
    let full = std::fs::File::options()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let refused = limited(here, "true", &rows).stdout(full).status().unwrap();
    assert_eq!(refused.code(), Some(75));
    let again = run(here, "true", &rows);
    assert!(again.status.success(), "{}", said(&again));
    assert_eq!(String::from_utf8(again.stdout).unwrap().lines().count(), 41);
    assert_eq!(names(here), ["a.h5", "scene.toml", "sweep.toml"]);
    assert_eq!(run(here, "true", &rows).status.code(), Some(2));
}

#[test]
fn the_key_of_an_error_is_a_key() {
    let folder = folder(3);
    let here = folder.path();
    let of = |contact: &str| {
        std::fs::write(
            here.join("wrong.toml"),
            format!("{SCENE}[contact]\n{contact}\n"),
        )
        .unwrap();
        let done = run(here, "true", &["impact", "wrong.toml", "--json"]);
        assert_eq!(done.status.code(), Some(2), "{}", said(&done));
        error(&done)
    };
    let growing = of("model = \"growing\"\nscheme = \"explicit\"");
    assert_eq!(growing["key"], "contact.scheme");
    let static_share = of("model = \"wave\"\nscheme = \"explicit\"\nstatic_share = \"dynamic\"");
    assert_eq!(static_share["key"], "contact.scheme");
    let infinite = of("step_s = inf");
    assert_eq!(infinite["value"], "inf");
}
