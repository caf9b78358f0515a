//! The files of a chart against their description in `data-schema/chart.md`, and the folder that takes them.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use formats::Existing;
use study::hdf_file::{ATTRIBUTES, FIGURES, FILE_TYPE, FORMAT_VERSION};
use study::{Folder, StudyError, csv_file::COLUMNS};

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

#[test]
fn a_folder_that_holds_anything_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("chart");
    drop(Folder::claim(&inside, Existing::Keep).unwrap());
    std::fs::write(inside.join("chart.csv"), "precious").unwrap();
    let refused = Folder::claim(&inside, Existing::Keep).unwrap_err();
    assert!(matches!(refused, StudyError::Exists { .. }));
    // the command knows how to replace it, the library does not
    assert!(
        refused
            .to_string()
            .ends_with("chart.csv exists already and is not replaced")
    );
    drop(Folder::claim(&inside, Existing::Replace).unwrap());
    // nothing is touched before there is something to put in its place
    assert_eq!(
        std::fs::read_to_string(inside.join("chart.csv")).unwrap(),
        "precious"
    );
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    let refused = Folder::claim(&file, Existing::Replace).unwrap_err();
    assert!(refused.to_string().contains("not a folder"));
}
