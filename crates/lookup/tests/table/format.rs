//! The file: round trip, damage, foreign files, and agreement with its description.

use crate::slices::sliced;
use crate::stand_in::content;
use lookup::{Table, TableError, check_hash, content_hash, read, schema, write};
use std::path::{Path, PathBuf};

fn written(folder: &tempfile::TempDir) -> PathBuf {
    let path = folder.path().join("table.h5");
    write(&path, &content()).unwrap();
    path
}

#[test]
fn what_is_written_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = written(&folder);
    let back = read(&path).unwrap();
    assert_eq!(back, content());
    check_hash(&path, &back).unwrap();
    let table = Table::open(&path).unwrap();
    assert_eq!(table.id().len(), 16);
    assert_eq!(table.format_version(), "2.1");
}

#[test]
fn the_same_content_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let first = std::fs::read(written(&folder)).unwrap();
    let second = folder.path().join("second.h5");
    write(&second, &content()).unwrap();
    assert!(first == std::fs::read(second).unwrap());
}

#[test]
fn the_hash_covers_the_numbers_and_leaves_out_the_date() {
    let original = content();
    let mut dated = content();
    dated.origin.created_unix_s = 1;
    assert_eq!(content_hash(&original), content_hash(&dated));
    let mut changed = content();
    changed.slices[0].tail[3] += 1e-6;
    assert_ne!(content_hash(&original), content_hash(&changed));
}

#[test]
fn damaged_and_foreign_files_are_refused_in_one_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let whole = std::fs::read(written(&folder)).unwrap();
    let path = folder.path().join("bad.h5");
    let refused = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        let error = Table::open(&path).unwrap_err();
        assert!(!error.to_string().contains('\n'), "{error}");
        error
    };
    assert!(matches!(refused(b""), TableError::NotHdf5 { .. }));
    assert!(matches!(
        refused(b"time_s,force_n\n0,0\n"),
        TableError::NotHdf5 { .. }
    ));
    for length in [whole.len() / 10, whole.len() / 2, whole.len() - 1] {
        refused(&whole[..length]);
    }
    let missing = Table::open(Path::new("/no/such/table.h5")).unwrap_err();
    assert!(matches!(missing, TableError::Unreadable { .. }));
    assert!(missing.to_string().contains("/no/such/table.h5"));
    assert!(matches!(
        Table::open(folder.path()).unwrap_err(),
        TableError::Unreadable { .. }
    ));
}

#[test]
fn a_flipped_byte_is_found_by_a_checksum() {
    let folder = tempfile::tempdir().unwrap();
    let path = written(&folder);
    let whole = std::fs::read(&path).unwrap();
    let reference = content_hash(&content());
    let mut found = 0;
    for place in (0..whole.len()).step_by(whole.len() / 97) {
        let mut bytes = whole.clone();
        bytes[place] ^= 0x10;
        std::fs::write(&path, &bytes).unwrap();
        match read(&path) {
            // What was hit is not part of the content: padding, free space, the date.
            Ok(back) if content_hash(&back) == reference => {}
            Ok(back) => {
                assert!(check_hash(&path, &back).is_err(), "byte {place}");
                found += 1;
            }
            Err(_) => found += 1,
        }
    }
    assert!(found > 40, "only {found} of 97 hit the content");
}

fn changed(folder: &tempfile::TempDir, change: impl FnOnce(&hdf5::File)) -> TableError {
    let path = written(folder);
    let file = hdf5::File::open_rw(&path).unwrap();
    change(&file);
    file.close().unwrap();
    Table::open(&path).unwrap_err()
}

fn set_text(file: &hdf5::File, name: &str, value: &str) {
    let value: hdf5::types::VarLenUnicode = value.parse().unwrap();
    file.delete_attr(name).unwrap();
    file.new_attr::<hdf5::types::VarLenUnicode>()
        .create(name)
        .unwrap()
        .write_scalar(&value)
        .unwrap();
}

#[test]
fn versions_kinds_and_gaps_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let error = changed(&folder, |file| {
        set_text(file, schema::FORMAT_VERSION, "1.0");
    });
    assert!(
        error
            .to_string()
            .ends_with("has kernel-table format version \"1.0\"; this program reads version 2.x")
    );
    let error = changed(&folder, |file| {
        set_text(file, schema::FILE_TYPE, "hertzlamb impact results");
    });
    assert!(
        matches!(error, TableError::Foreign { found, .. } if found == "hertzlamb impact results")
    );
    let error = changed(&folder, |file| file.unlink("slices/nu_0.3/tail").unwrap());
    assert!(matches!(error, TableError::Item { item, .. } if item == "/slices/nu_0.3/tail"));
    let error = changed(&folder, |file| {
        file.dataset("slices/nu_0.3/tail")
            .unwrap()
            .write_slice(&[f32::NAN], (0, 0, 0, 0..1))
            .unwrap();
    });
    assert_eq!(
        error.to_string(),
        "kernel table: slices/nu_0.3/tail (r/r0 = 0, z/r0 = 0) = NaN, allowed: finite numbers"
    );
    let error = changed(&folder, |file| {
        file.dataset("r")
            .unwrap()
            .write_slice(&[9.0], 3..4)
            .unwrap();
    });
    assert!(error.to_string().starts_with("kernel table: r[4] = "));
    // A later minor version is read.
    let path = written(&folder);
    let file = hdf5::File::open_rw(&path).unwrap();
    set_text(&file, schema::FORMAT_VERSION, "2.7");
    file.close().unwrap();
    Table::open(&path).unwrap();
}

/// Names in back quotes at the start of the rows of the tables under `heading`.
fn documented(heading: &str) -> Vec<String> {
    let text = include_str!("../../../../data-schema/kernel-table.md");
    let section = text
        .split("\n## ")
        .find(|section| section.starts_with(heading))
        .unwrap();
    section
        .lines()
        .filter_map(|line| {
            line.strip_prefix("| `")?
                .split_once('`')
                .map(|(name, _)| name.to_owned())
        })
        .collect()
}

#[test]
fn the_description_names_what_is_in_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = hdf5::File::open(written(&folder)).unwrap();
    let sorted = |mut names: Vec<String>| {
        names.sort();
        names
    };
    let constants = |names: &[&str]| sorted(names.iter().map(|&name| name.to_owned()).collect());
    let members = |group: &hdf5::Group| {
        let names = group.member_names().unwrap();
        sorted(
            names
                .into_iter()
                .filter(|name| group.dataset(name).is_ok())
                .collect(),
        )
    };
    let slice = file.group("slices/nu_0.3").unwrap();
    for (heading, names, found) in [
        (
            "Root attributes",
            constants(&schema::ROOT_ATTRIBUTES),
            sorted(file.attr_names().unwrap()),
        ),
        (
            "Root datasets",
            constants(&schema::ROOT_DATASETS),
            members(&file),
        ),
        (
            "Slice attributes",
            constants(&schema::SLICE_ATTRIBUTES),
            sorted(slice.attr_names().unwrap()),
        ),
        (
            "Slice datasets",
            constants(&schema::SLICE_DATASETS),
            members(&slice),
        ),
    ] {
        assert_eq!(
            sorted(documented(heading)),
            names,
            "{heading}: document against constants"
        );
        assert_eq!(names, found, "{heading}: constants against file");
    }
    let path = folder.path().join("sliced.h5");
    write(&path, &sliced()).unwrap();
    let file = hdf5::File::open(path).unwrap();
    let between = file.group(schema::BETWEEN).unwrap();
    let name = between.member_names().unwrap().remove(0);
    let group = between.group(&name).unwrap();
    assert_eq!(members(&group), constants(&schema::BETWEEN_DATASETS));
    assert_eq!(group.attr_names().unwrap(), [schema::POISSON_RATIO]);
    for name in schema::FIELD_NAMES {
        assert!(documented("Fields").contains(&name.to_owned()), "{name}");
    }
    for dataset in schema::SLICE_DATASETS {
        let dataset = slice.dataset(dataset).unwrap();
        for attribute in [schema::UNITS, schema::LONG_NAME] {
            assert!(
                dataset.attr(attribute).is_ok(),
                "{} has no {attribute}",
                dataset.name()
            );
        }
    }
}
