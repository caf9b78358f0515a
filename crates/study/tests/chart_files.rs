//! The files of a chart against their description in `data-schema/chart.md`.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use study::{PICTURE_COLUMNS, Record};

const DOCUMENT: &str = include_str!("../../../data-schema/chart.md");

#[test]
fn every_name_is_described() {
    for name in Record::COLUMNS.split(' ').chain(PICTURE_COLUMNS.split(' ')) {
        assert!(DOCUMENT.contains(&format!("`{name}`")), "{name}");
    }
}
