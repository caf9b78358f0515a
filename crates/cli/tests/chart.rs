//! `hertzlamb chart` from outside: bad usage is one sentence and exit code 2, at once.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::process::{Command, Output};

fn chart(folder: &std::path::Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hertzlamb"))
        .current_dir(folder)
        .arg("chart")
        .args(arguments)
        .output()
        .unwrap()
}

#[test]
fn a_folder_in_use_and_a_file_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::create_dir(here.join("used")).unwrap();
    std::fs::write(here.join("used/report.md"), "precious").unwrap();
    std::fs::write(here.join("file"), "precious").unwrap();
    for (arguments, part) in [
        (["--quick", "-o", "used"], "--force"),
        (["--quick", "-o", "file"], "file"),
        (["--quick", "-o", "file/below"], "file/below"),
    ] {
        let done = chart(here, &arguments);
        let message = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(2), "{message}");
        assert_eq!(message.trim().lines().count(), 1, "{message}");
        assert!(
            message.contains(part) && done.stdout.is_empty(),
            "{message}"
        );
    }
    assert_eq!(
        std::fs::read_to_string(here.join("used/report.md")).unwrap(),
        "precious"
    );
}

#[test]
fn usage_is_checked_and_explained() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(chart(folder.path(), &["--quick"]).status.code(), Some(2));
    assert_eq!(
        chart(folder.path(), &["--slow", "-o", "x"]).status.code(),
        Some(2)
    );
    let help = String::from_utf8(chart(folder.path(), &["--help"]).stdout).unwrap();
    assert!(help.contains("Examples") && help.contains("hertzlamb chart --quick"));
    assert!(!folder.path().join("x").exists());
}
