//! `hertzlamb chart` from outside: the folder that it writes; bad usage is one sentence and exit code 2, at once.

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

#[test]
fn a_quick_chart_has_the_rows_and_pictures_that_it_names() {
    let folder = tempfile::tempdir().unwrap();
    let done = chart(folder.path(), &["--quick", "-o", "out"]);
    let told = String::from_utf8(done.stdout).unwrap();
    assert_eq!(
        done.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    let read = |name: &str| std::fs::read_to_string(folder.path().join("out").join(name)).unwrap();

    let chart = read("chart.csv");
    let rows: Vec<&str> = chart.lines().skip(1).collect();
    for question in ["kernels,", "force,", "fields,", "impacts,"] {
        assert!(
            rows.iter().any(|row| row.starts_with(question)),
            "{question}"
        );
    }
    // error_max is the fifth of the columns from the right: the program's own single integral reaches what it is asked for
    let errors = rows
        .iter()
        .filter(|row| row.contains(",single integral,tolerance 1e-9,"));
    let errors = errors.map(|row| row.rsplit(',').nth(4).unwrap().parse().unwrap());
    let errors: Vec<f64> = errors.collect();
    assert_eq!(errors.len(), 4);
    assert!(errors.iter().all(|error| *error < 1e-8), "{errors:?}");

    let names = std::fs::read_dir(folder.path().join("out")).unwrap();
    let names = names.map(|file| file.unwrap().file_name().into_string().unwrap());
    let pictures: Vec<String> = names
        .filter_map(|name| Some(name.strip_suffix(".svg")?.to_owned()))
        .collect();
    let first = format!(
        "out/report.md: {} rows, {} pictures, ",
        rows.len(),
        pictures.len()
    );
    assert!(told.starts_with(&first), "{first}\n{told}");
    let (report, points) = (read("report.md"), read("pictures.csv"));
    for picture in &pictures {
        assert!(report.contains(&format!("({picture}.png)")), "{picture}");
        assert!(
            points
                .lines()
                .any(|line| line.starts_with(&format!("{picture},"))),
            "{picture}"
        );
    }
}
