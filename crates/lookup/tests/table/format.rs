//! The file: round trip, checksums, and agreement with its description.

use crate::slices::sliced;
use crate::stand_in::content;
use lookup::{Table, content_hash, read, schema, write};
use std::path::PathBuf;

pub(crate) fn written(folder: &tempfile::TempDir) -> PathBuf {
    let path = folder.path().join("table.h5");
    // of an earlier call
    let _ = std::fs::remove_file(&path);
    write(&path, &content()).unwrap();
    path
}

#[test]
fn what_is_written_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = written(&folder);
    let back = read(&path).unwrap();
    assert_eq!(back, content());
    let stated = lookup::stated_hash(&path).unwrap();
    assert_eq!(stated, content_hash(&back));
    assert!(lookup::holds(&path, &back).unwrap());
    let mut other = back;
    other.slices[0].tail[3] += 1.0;
    assert!(!lookup::holds(&path, &other).unwrap());
    let table = Table::open(&path).unwrap();
    assert_eq!(table.id().len(), 16);
    assert_eq!(table.content().origin.format_version, "2.4");
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
    let path = folder.path().join("sliced.h5");
    write(&path, &sliced()).unwrap();
    let several = hdf5::File::open(path).unwrap();
    for (heading, found) in [
        ("Root attributes", sorted(several.attr_names().unwrap())),
        ("Root datasets", members(&file)),
        ("Slice attributes", sorted(slice.attr_names().unwrap())),
        ("Slice datasets", members(&slice)),
    ] {
        assert_eq!(sorted(documented(heading)), found, "{heading}");
    }
    let between = several.group(schema::BETWEEN).unwrap();
    let name = between.member_names().unwrap().remove(0);
    let group = between.group(&name).unwrap();
    let probes = [
        schema::PROBE_DIRECT,
        schema::PROBE_ERROR,
        schema::PROBE_LOOKED_UP,
    ];
    assert_eq!(members(&group), probes);
    assert_eq!(group.attr_names().unwrap(), [schema::POISSON_RATIO]);
    for name in schema::FIELD_NAMES {
        assert!(documented("Fields").contains(&name.to_owned()), "{name}");
    }
    for dataset in members(&slice) {
        let dataset = slice.dataset(&dataset).unwrap();
        for attribute in [schema::UNITS, schema::LONG_NAME] {
            assert!(
                dataset.attr(attribute).is_ok(),
                "{} has no {attribute}",
                dataset.name()
            );
        }
    }
}
