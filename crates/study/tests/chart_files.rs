//! The files of a chart against their description in `data-schema/chart.md`.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use study::csv_file::COLUMNS;
use study::hdf_file::{ATTRIBUTES, FIGURES, FILE_TYPE, FORMAT_VERSION};

const DOCUMENT: &str = include_str!("../../../data-schema/chart.md");

#[test]
fn every_name_is_described() {
    for name in COLUMNS.iter().chain(&ATTRIBUTES) {
        assert!(DOCUMENT.contains(&format!("`{name}`")), "{name}");
    }
    assert!(DOCUMENT.contains(&format!("`/{FIGURES}`")));
    assert!(DOCUMENT.contains(&format!("`{FILE_TYPE}`")));
    assert!(DOCUMENT.contains(&format!("Version {FORMAT_VERSION}.")));
}
