//! Sweeps in Parquet: the rows of HDF5, the same bytes however they were computed, and damage that is told.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
#![cfg(feature = "parquet")]

use formats::parts::Parts;
use formats::stored::{FileKind, StoredPart, file_kind};
use formats::sweep::{
    Block, Blocks, PARQUET_VERSION, Precision, Selection, Spec, WrittenResults, compute_rows,
    stage_rows,
};
use formats::{Existing, Output};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// 200,000 rows in two groups, with words, draws, a list, and rows that fail.
const SWEEP: &str = "[scene.target]\nmaterial = \"steel\"\n[scene.striker]\nmaterial = \"steel\"\nmass_kg = 4e-3\n\
    tip_radius_m = 5e-3\nvelocity_m_s = 1.0\n[scene.contact]\nmodel = \"hertz\"\n\
    [product.target]\nmaterial = [\"granite\", \"steel\"]\n\
    [list.striker]\ntip_radius_m = [1e-3, 5e-3]\nmass_kg = [1e-3, 4e-3]\n\
    [random]\nsamples = 50000\nseed = 5\n[random.striker]\n\
    velocity_m_s = { distribution = \"normal\", mean = 2.0, deviation = 0.7 }\n";

fn spec() -> Spec {
    Spec::from_toml(SWEEP, Path::new(".")).unwrap()
}

/// Some rows, in blocks of so many.
fn rows(spec: &Spec, rows: Range<usize>, size: usize) -> Vec<Block> {
    let blocks = rows.clone().step_by(size).map(|start| {
        let count = size.min(rows.end - start);
        let block = compute_rows(spec, start, 1, count, |_, _| true);
        let mut block = block.unwrap().unwrap();
        block.start += start;
        for (row, _) in &mut block.failures {
            *row += start;
        }
        block
    });
    blocks.collect()
}

fn write(path: &Path, spec: &Spec, range: Option<Range<usize>>, size: usize) -> Vec<u8> {
    let mut spec = spec.clone();
    spec.selection = range.map(|rows| Selection { rows, shard: None });
    let output = Output::claim(path, Existing::Replace).unwrap();
    let blocks = rows(&spec, spec.selected(), size);
    let staged = stage_rows(&output, &spec, &blocks).unwrap();
    staged.commit().unwrap();
    std::fs::read(path).unwrap()
}

fn merged(folder: &Path, output: &Path) -> Vec<u8> {
    let output = Output::claim(output, Existing::Replace).unwrap();
    let parts = Parts::in_folder(folder, None).unwrap();
    parts.merge(&output, false).unwrap().commit().unwrap();
    std::fs::read(&output.path).unwrap()
}

#[test]
fn parts_of_either_format_merge_to_the_bytes_of_one_run_of_either() {
    let folder = tempfile::tempdir().unwrap();
    let here = |name: &str| folder.path().join(name);
    for precision in [Precision::Double, Precision::Single] {
        let mut spec = spec();
        spec.fields.precision = precision;
        let whole = write(&here("whole.parquet"), &spec, None, 32_768);
        let other = write(&here("other.parquet"), &spec, None, 7_777);
        assert!(whole == other, "the bytes depend on the blocks");
        let hdf5 = write(&here("whole.h5"), &spec, None, 32_768);
        assert_eq!(file_kind(&here("whole.parquet")), Ok(FileKind::Sweep));
        let parts = here("parts");
        let _ = std::fs::remove_dir_all(&parts);
        std::fs::create_dir(&parts).unwrap();
        // a merged file beside the parts is passed over; the formats may be mixed
        std::fs::copy(here("whole.parquet"), parts.join("all.parquet")).unwrap();
        let ranges = [("0.parquet", 0..7), ("1.h5", 7..140_001)];
        let more = [
            ("2.parquet", 140_001..140_001),
            ("3.parquet", 140_001..200_000),
        ];
        for (name, range) in ranges.into_iter().chain(more) {
            write(&parts.join(name), &spec, Some(range), 10_000);
        }
        assert!(merged(&parts, &here("merged.parquet")) == whole);
        assert!(merged(&parts, &here("merged.h5")) == hdf5);
    }
}

#[test]
fn blocks_are_those_that_were_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.parquet");
    let mut spec = spec();
    spec.fields = WrittenResults::default()
        .only(&["restitution", "yield_onset"])
        .unwrap();
    write(&path, &spec, Some(30_000..170_000), 32_768);
    let stored = StoredPart::open(&path).unwrap();
    assert_eq!(stored.part.fields, spec.fields);
    assert_eq!(stored.part.sha256, spec.sha256);
    let computed = rows(&spec, 30_000..170_000, 140_000).remove(0);
    let (mut row, mut failed) = (0, 0);
    stored
        .each(&mut |block| {
            for (k, quantity) in formats::QUANTITIES.iter().enumerate() {
                let written = ["restitution", "yield_onset"].contains(&quantity.name);
                for (i, numbers) in block.rows().enumerate() {
                    let expected = if written {
                        computed.numbers[(row + i) * computed.width + k]
                    } else {
                        f64::NAN
                    };
                    let same = expected.is_nan() && numbers[k].is_nan();
                    assert!(same || expected.to_bits() == numbers[k].to_bits());
                }
            }
            assert_eq!(block.start, 30_000 + row);
            assert!(computed.models[row..].starts_with(&block.models));
            assert!(computed.failures[failed..].starts_with(&block.failures));
            row += block.len();
            failed += block.failures.len();
            Ok(())
        })
        .unwrap();
    assert_eq!((row, failed), (140_000, computed.failures.len()));
    assert!(failed > 0 && stored.part.failed == failed);
}

/// Why the file at a path cannot be read, in one sentence; nothing where it can.
fn refusal(path: &Path) -> Option<String> {
    let read = StoredPart::open(path).map_err(|error| error.to_string());
    let read = read.and_then(|part| part.each(&mut |_| Ok(())).map_err(|fault| fault.reason));
    let reason = read.err()?;
    assert!(
        !reason.is_empty() && reason.lines().count() == 1,
        "{reason}"
    );
    assert!(reason.contains(path.to_str().unwrap()), "{reason}");
    Some(reason)
}

fn part(folder: &Path) -> (PathBuf, Vec<u8>) {
    let path = folder.join("part.parquet");
    let bytes = write(&path, &spec(), Some(40_000..41_000), 1000);
    assert_eq!(refusal(&path), None);
    (path, bytes)
}

#[test]
fn a_file_that_is_cut_short_is_refused_wherever_it_was_cut() {
    let folder = tempfile::tempdir().unwrap();
    let (path, bytes) = part(folder.path());
    for step in 0..2_000 {
        let length = bytes.len() * step / 2_000;
        std::fs::write(&path, &bytes[..length]).unwrap();
        assert!(refusal(&path).is_some(), "{length} bytes");
    }
    std::fs::write(&path, [&bytes[..], b"PAR1"].concat()).unwrap();
    assert!(refusal(&path).is_some());
}

#[test]
fn a_flipped_bit_anywhere_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let (path, bytes) = part(folder.path());
    // some bytes of the rows, and all of the footer
    let footer = bytes.len()
        - 8
        - u32::from_le_bytes(bytes[bytes.len() - 8..][..4].try_into().unwrap()) as usize;
    let places = (0..footer).step_by(footer / 3_000 + 1);
    for (i, place) in places.chain(footer..bytes.len()).enumerate() {
        let mut damaged = bytes.clone();
        damaged[place] ^= 1 << (i % 8);
        std::fs::write(&path, &damaged).unwrap();
        assert!(refusal(&path).is_some(), "byte {place} of {}", bytes.len());
    }
}

#[test]
fn the_format_is_written_down() {
    let folder = tempfile::tempdir().unwrap();
    let (_, bytes) = part(folder.path());
    let document = include_str!("../../../data-schema/sweep.md");
    let section = document.split("\n## Parquet\n").nth(1).unwrap();
    assert!(
        section
            .trim_start()
            .starts_with(&format!("Version {PARQUET_VERSION}"))
    );
    let begin = bytes
        .windows(13)
        .position(|part| part == b"{\"file_type\":")
        .unwrap();
    let mut texts = serde_json::Deserializer::from_slice(&bytes[begin..]).into_iter();
    let text: serde_json::Value = texts.next().unwrap().unwrap();
    for name in text.as_object().unwrap().keys() {
        assert!(
            section.contains(&format!("`{name}`")),
            "{name} is not described"
        );
    }
    assert!(text["columns"]["row"]["units"] == "1");
}
