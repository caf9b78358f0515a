//! Files that the HDF5 library writes are read as they were written; damaged ones are errors, never more.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use hdf5::types::{FixedAscii, VarLenUnicode};
use ledger::{HdfError, HdfFile};
use std::path::Path;

const LIMIT: u64 = 1 << 24;

/// A file with something of everything.
fn write(path: &Path, options: &mut hdf5::FileBuilder) {
    let file = options.create(path).unwrap();
    let group = file.create_group("slices").unwrap();
    let numbers: Vec<f32> = (0..20 * 11 * 3).map(|i| (i as f32).sin()).collect();
    let data = group
        .new_dataset::<f32>()
        .shape((20, 11, 3))
        .chunk((8, 8, 3))
        .shuffle()
        .deflate(2)
        .fletcher32()
        .create("patches")
        .unwrap();
    data.write_raw(&numbers).unwrap();
    for i in 0..20 {
        let pair = [f64::from(i), 0.5];
        let builder = group.new_dataset_builder().with_data(&pair);
        builder.create(format!("axis_{i}").as_str()).unwrap();
    }
    let whole: Vec<i16> = (-3..4).collect();
    let builder = file.new_dataset_builder().with_data(&whole);
    builder.create("whole").unwrap();
    file.new_dataset::<f64>()
        .shape([0])
        .create("empty")
        .unwrap();
    let text: VarLenUnicode = "depth \u{2193}".parse().unwrap();
    let attribute = file.new_attr::<VarLenUnicode>().create("text").unwrap();
    attribute.write_scalar(&text).unwrap();
    let fixed = FixedAscii::<8>::from_ascii("fixed").unwrap();
    let attribute = file.new_attr::<FixedAscii<8>>().create("fixed").unwrap();
    attribute.write_scalar(&fixed).unwrap();
    let attribute = file.new_attr::<u64>().create("count").unwrap();
    attribute.write_scalar(&(1_u64 << 60)).unwrap();
    let attribute = file.new_attr::<f64>().shape([3]).create("list").unwrap();
    attribute.write(&[1.0, 2.0, 4.0]).unwrap();
    file.close().unwrap();
}

/// Everything in it as one list of numbers and texts.
fn everything(path: &Path) -> Result<(Vec<f64>, Vec<String>), HdfError> {
    let root = HdfFile::open(path)?.root;
    let slices = root.group("slices")?;
    let mut numbers: Vec<f64> = Vec::new();
    let patches = slices.dataset("patches")?;
    numbers.extend(patches.numbers::<f32>(LIMIT)?.into_iter().map(f64::from));
    let block = patches.block::<f32>(&[3..17, 7..9, 1..3], LIMIT)?;
    numbers.extend(block.into_iter().map(f64::from));
    let names = slices.members()?;
    for name in names.iter().filter(|name| name.starts_with("axis")) {
        numbers.extend(slices.dataset(name)?.as_f64(LIMIT)?);
    }
    numbers.extend(root.dataset("whole")?.as_f64(LIMIT)?);
    numbers.extend(root.dataset("empty")?.numbers::<f64>(LIMIT)?);
    numbers.push(root.number::<u64>("count")? as f64);
    numbers.extend(root.numbers::<f64>("list")?);
    Ok((numbers, vec![root.text("text")?, root.text("fixed")?]))
}

fn expected() -> (Vec<f64>, Vec<String>) {
    let at = |i: usize| f64::from((i as f32).sin());
    let mut numbers: Vec<f64> = (0..20 * 11 * 3).map(at).collect();
    for i in 3..17 {
        for k in 7..9 {
            numbers.extend((1..3).map(|l| at((i * 11 + k) * 3 + l)));
        }
    }
    let mut names: Vec<String> = (0..20).map(|i| format!("{i}")).collect();
    names.sort();
    numbers.extend(names.iter().flat_map(|n| [n.parse().unwrap(), 0.5]));
    numbers.extend((-3..4).map(f64::from));
    numbers.push((1_u64 << 60) as f64);
    numbers.extend([1.0, 2.0, 4.0]);
    (
        numbers,
        vec!["depth \u{2193}".to_owned(), "fixed".to_owned()],
    )
}

#[test]
fn what_the_library_writes_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    write(&path, &mut hdf5::File::with_options());
    assert_eq!(everything(&path).unwrap(), expected());
    write(
        &path,
        hdf5::File::with_options().with_fcpl(|plan| plan.istore_k(16)),
    );
    assert_eq!(everything(&path).unwrap(), expected());
    // Behind a block of the user's.
    write(
        &path,
        hdf5::File::with_options().with_fcpl(|plan| plan.userblock(1024)),
    );
    assert_eq!(everything(&path).unwrap(), expected());
}

#[test]
fn the_newest_format_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new.h5");
    let file = hdf5::File::with_options()
        .with_fapl(|plan| plan.libver_latest())
        .create(&path)
        .unwrap();
    let force = file.new_dataset_builder().with_data(&[1.0, 2.0]);
    drop(force.create("force").unwrap());
    let grows = file.new_dataset::<f64>().shape([4..]).chunk([2]).shuffle();
    let grows = grows.deflate(3).create("grows").unwrap();
    grows.write(&[1.0, 2.0, 3.0, 4.0]).unwrap();
    drop(grows);
    file.flush().unwrap();
    file.close().unwrap();
    let root = HdfFile::open(&path).unwrap().root;
    for (name, numbers) in [("force", &[1.0, 2.0][..]), ("grows", &[1.0, 2.0, 3.0, 4.0])] {
        let found = root.dataset(name).unwrap().as_f64(LIMIT);
        assert_eq!(found.unwrap(), numbers, "{name}");
    }
}

#[test]
fn a_limit_is_kept_and_a_type_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    write(&path, &mut hdf5::File::with_options());
    let root = HdfFile::open(&path).unwrap().root;
    let patches = root.group("slices").unwrap().dataset("patches").unwrap();
    let needed = 20 * 11 * 3 * 4;
    assert!(patches.numbers::<f32>(needed).is_ok());
    let error = patches.numbers::<f32>(needed - 1).unwrap_err();
    let text = format!(
        "it needs {needed} bytes of memory, more than the limit {}",
        needed - 1
    );
    assert_eq!(error.to_string(), text);
    let error = patches.numbers::<f64>(LIMIT).unwrap_err();
    assert_eq!(
        error.to_string(),
        "its type is 32-bit float, but 64-bit float is required"
    );
    // of a text and of a number
    let error = root.number::<f64>("text").unwrap_err();
    assert_eq!(
        error.to_string(),
        "its type is text, but 64-bit float is required"
    );
    let error = root.text("count").unwrap_err();
    assert_eq!(
        error.to_string(),
        "its type is 64-bit unsigned integer, but text is required"
    );
}

#[test]
fn numbers_that_the_file_cannot_hold_or_that_lie_elsewhere_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let file = hdf5::File::create(&path).unwrap();
    // terabytes that are nowhere
    let nowhere = file.new_dataset::<f64>().shape([1_usize << 37]);
    nowhere.create("nowhere").unwrap();
    let chunk = file.new_dataset::<f64>().shape([1_usize << 37]);
    chunk.chunk([1 << 28]).create("chunk").unwrap();
    let other = file.new_dataset::<f64>().shape([10]);
    other
        .external("/etc/passwd", 0, 80)
        .create("other")
        .unwrap();
    file.link_external("other.h5", "x", "link").unwrap();
    file.link_soft("self", "self").unwrap();
    file.flush().unwrap();
    file.close().unwrap();
    let root = HdfFile::open(&path).unwrap().root;
    for name in ["nowhere", "chunk", "other", "link", "self", "absent"] {
        let numbers = root.dataset(name).and_then(|data| data.as_f64(u64::MAX));
        assert!(numbers.is_err(), "{name}");
    }
}

/// Numbers of a generator of Marsaglia's.
struct Draws(u64);

impl Draws {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % limit
    }
}

#[test]
fn damage_is_an_error_or_other_numbers_but_never_more() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    write(&path, &mut hdf5::File::with_options());
    let good = std::fs::read(&path).unwrap();
    let mut draws = Draws(88_172_645_463_325_252);
    let mut refused = 0;
    for _ in 0..4_000 {
        let mut bad = good.clone();
        for _ in 0..=draws.below(4) {
            let at = draws.below(bad.len());
            match draws.below(4) {
                0 => bad[at] ^= 1 << draws.below(8),
                1 => bad[at] = [0, 0xff, 0x7f, 1][draws.below(4)],
                2 => {
                    let end = (at + 8).min(bad.len());
                    bad[at..end].fill([0, 0xff][draws.below(2)]);
                }
                _ if draws.below(20) == 0 => bad.truncate(at + 1),
                _ => bad[at] = draws.below(256) as u8,
            }
        }
        std::fs::write(&path, bad).unwrap();
        refused += usize::from(everything(&path).is_err());
    }
    assert!(refused > 200, "{refused}");
}

#[test]
fn what_is_no_regular_file_is_not_opened() {
    let folder = tempfile::tempdir().unwrap();
    let zero = Path::new("/dev/zero");
    for path in [folder.path(), zero].into_iter().filter(|p| p.exists()) {
        let error = HdfFile::open(path).unwrap_err();
        assert_eq!(error.to_string(), "it is not a regular file");
    }
}
