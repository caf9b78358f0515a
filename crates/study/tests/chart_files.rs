//! The files of a chart against their description in `data-schema/chart.md`.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use output::{Existing, Folder};
use std::collections::BTreeSet;
use study::{Chart, ComparedMethod, Effort, PICTURE_COLUMNS, Question, Record};

const DOCUMENT: &str = include_str!("../../../data-schema/chart.md");

/// Names in the first column of the first table of a section.
fn described(section: &str) -> Vec<&str> {
    let (_, text) = DOCUMENT.split_once(&format!("## {section}\n")).unwrap();
    let text = text.split("\n## ").next().unwrap();
    let rows = text.lines().skip_while(|line| !line.starts_with("|---"));
    let rows = rows.skip(1).take_while(|line| line.starts_with('|'));
    rows.map(|row| row.split('`').nth(1).unwrap()).collect()
}

#[test]
fn the_document_has_the_columns_in_their_order() {
    assert_eq!(
        described("Rows"),
        Record::COLUMNS.split_whitespace().collect::<Vec<_>>()
    );
    assert_eq!(
        described("Pictures"),
        PICTURE_COLUMNS.split(' ').collect::<Vec<_>>()
    );
}

fn record(method: ComparedMethod, cost_ns: f64, error_max: f64) -> Record {
    Record {
        question: Question::Kernels,
        scene: "axis, w",
        method,
        setting: "a setting, with a comma".to_owned(),
        default_path: method == ComparedMethod::SingleIntegral,
        cost_ns,
        cost_spread_ns: 1.0,
        error_max,
        error_rms: error_max,
        work: None,
        refusal: error_max.is_nan().then(|| "no \"answer\"".to_owned()),
    }
}

#[test]
fn a_folder_has_its_rows_and_says_what_failed_and_what_is_ahead() {
    let chart = Chart {
        effort: Effort::Quick,
        machine: "a machine".to_owned(),
        records: vec![
            record(ComparedMethod::SingleIntegral, 3000.0, 1e-9),
            record(ComparedMethod::Euler, 1000.0, 1e-9),
            record(ComparedMethod::Durbin, 10.0, f64::NAN),
        ],
        diagrams: Vec::new(),
        maps: Vec::new(),
        wall_s: 1.0,
    };
    // no reason is known why the second is not taken, at none of the six accuracies
    let ahead = chart.unexplained();
    assert_eq!(ahead.len(), 6);
    assert!(
        ahead
            .iter()
            .all(|text| text.contains("Euler is 3.0 times cheaper")),
        "{ahead:?}"
    );

    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("chart");
    chart
        .write(&Folder::claim(&path, Existing::Keep).unwrap())
        .unwrap();
    let files = std::fs::read_dir(&path)
        .unwrap()
        .map(|file| file.unwrap().file_name());
    let files: BTreeSet<String> = files.map(|name| name.into_string().unwrap()).collect();
    let names = ["chart.csv", "pictures.csv", "report.md"];
    assert_eq!(files, names.map(str::to_owned).into());

    let read = |name: &str| std::fs::read_to_string(path.join(name)).unwrap();
    let rows = read("chart.csv");
    let rows: Vec<&str> = rows.lines().collect();
    let columns: Vec<&str> = Record::COLUMNS.split_whitespace().collect();
    assert_eq!(rows[0], columns.join(","));
    let setting = "\"a setting, with a comma\"";
    assert_eq!(
        rows[1..],
        [
            format!(
                "kernels,\"axis, w\",single integral,{setting},true,3.0000e3,1.0000e0,1.0000e-9,1.0000e-9,,false,"
            ),
            format!(
                "kernels,\"axis, w\",Euler,{setting},false,1.0000e3,1.0000e0,1.0000e-9,1.0000e-9,,false,"
            ),
            format!(
                "kernels,\"axis, w\",Durbin,{setting},false,1.0000e1,1.0000e0,NaN,NaN,,true,\"no \"\"answer\"\"\""
            ),
        ]
    );
    assert_eq!(
        read("pictures.csv").trim_end(),
        PICTURE_COLUMNS.replace(' ', ",")
    );

    let report = read("report.md");
    for part in [
        "## How to compute a kernel",
        "The cheapest for an error of 1e-3 is Euler (1.0 us)",
        "- Euler: no reason is recorded: it should be adopted.",
        "at some setting or in some scene: Durbin.",
        "| kernels | axis, w | Durbin |",
    ] {
        assert!(report.contains(part), "{part}\n{report}");
    }
}
