//! Files of a format before 2.4: read, compared by their content, refused where something is not as it should be.

use crate::format::written;
use crate::stand_in::content;
use hdf5::types::VarLenUnicode;
use lookup::{BadTable, Table, TableError, TableFile, read, schema};
use std::path::{Path, PathBuf};

/// The stand-in as an older program would have written it, with `change` made to it: no seal.
fn older(folder: &tempfile::TempDir, change: impl FnOnce(&hdf5::File)) -> PathBuf {
    let path = folder.path().join("older.h5");
    let new = hdf5::File::open(written(folder)).unwrap();
    let old = hdf5::File::create(&path).unwrap();
    for name in new.member_names().unwrap() {
        if let Ok(group) = new.group(&name) {
            group.copy_to(&old, &name).unwrap();
        } else {
            new.dataset(&name).unwrap().copy_to(&old, &name).unwrap();
        }
    }
    for name in new.attr_names().unwrap() {
        let from = new.attr(&name).unwrap();
        if let Ok(text) = from.read_scalar::<VarLenUnicode>() {
            set_text(&old, &name, text.as_str());
        } else if from.dtype().unwrap().is::<u64>() {
            let value: u64 = from.read_scalar().unwrap();
            let to = old.new_attr::<u64>().create(name.as_str()).unwrap();
            to.write_scalar(&value).unwrap();
        } else {
            let values: Vec<f64> = from.read_raw().unwrap();
            let to = old.new_attr::<f64>().shape(from.shape());
            let to = to.create(name.as_str()).unwrap();
            to.write_raw(&values).unwrap();
        }
    }
    set_text(&old, schema::FORMAT_VERSION, "2.1");
    change(&old);
    old.close().unwrap();
    path
}

fn set_text(file: &hdf5::File, name: &str, value: &str) {
    let value: VarLenUnicode = value.parse().unwrap();
    if file.attr(name).is_ok() {
        file.delete_attr(name).unwrap();
    }
    let attribute = file.new_attr::<VarLenUnicode>().create(name).unwrap();
    attribute.write_scalar(&value).unwrap();
}

fn refused(folder: &tempfile::TempDir, change: impl FnOnce(&hdf5::File)) -> TableError {
    let path = older(folder, change);
    let error = Table::open(&path).unwrap_err();
    assert!(TableFile::open(&path).is_err());
    one_sentence(&error, &path);
    error
}

/// Every error names the file exactly once, in one line.
pub(crate) fn one_sentence(error: &TableError, path: &Path) {
    let text = error.to_string();
    assert!(!text.contains('\n'), "{text}");
    assert_eq!(text.matches(path.to_str().unwrap()).count(), 1, "{text}");
}

#[test]
fn they_are_read_and_say_their_version() {
    let folder = tempfile::tempdir().unwrap();
    let path = older(&folder, |_| {});
    let mut expected = content();
    expected.origin.format_version = "2.1".to_owned();
    assert_eq!(read(&path).unwrap(), expected);
    let table = Table::open(&path).unwrap();
    assert_eq!(table.content().origin.format_version, "2.1");
    TableFile::open(&path).unwrap();
}

#[test]
fn a_changed_number_is_found_by_the_hash_of_the_content() {
    let folder = tempfile::tempdir().unwrap();
    let error = refused(&folder, |file| {
        let data = file.dataset("slices/nu_0.3/remainder").unwrap();
        data.write_slice(&[0.25_f32], (1, 2, 3, 4..5)).unwrap();
    });
    let words = ": the content was changed";
    assert!(error.to_string().ends_with(words), "{error}");
}

#[test]
fn versions_kinds_and_gaps_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let error = refused(&folder, |file| {
        set_text(file, schema::FORMAT_VERSION, "1.0");
    });
    let text = error.to_string();
    let end = "has kernel-table format version \"1.0\"; this program reads version 2.x";
    assert!(text.ends_with(end), "{text}");
    let error = refused(&folder, |file| {
        set_text(file, schema::FILE_TYPE, "hertzlamb impact results");
    });
    assert!(matches!(error.what, BadTable::Foreign(found) if found == "hertzlamb impact results"));
    let error = refused(&folder, |file| {
        file.unlink("slices/nu_0.3/tail").unwrap();
    });
    assert!(matches!(error.what, BadTable::Item { item, .. } if item == "/slices/nu_0.3/tail"));
    let error = refused(&folder, |file| {
        let nodes = file.dataset("r").unwrap();
        nodes.write_slice(&[9.0], 3..4).unwrap();
    });
    assert!(error.to_string().contains(": r[4] = "), "{error}");
    // From 2.4 on there is a seal.
    let error = refused(&folder, |file| {
        set_text(file, schema::FORMAT_VERSION, "2.4");
    });
    assert!(matches!(error.what, BadTable::Damaged(_)), "{error}");
}

/// The dataset `name` of the slice made anew.
fn replaced(file: &hdf5::File, name: &str, make: impl FnOnce(&hdf5::Group)) {
    let slice = file.group("slices/nu_0.3").unwrap();
    slice.unlink(name).unwrap();
    make(&slice);
}

#[test]
fn numbers_that_lie_elsewhere_or_nowhere_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let said = |change: &dyn Fn(&hdf5::File)| refused(&folder, change).to_string();
    let other_numbers = "the content was changed";
    let soft = said(&|file| {
        replaced(file, "tail", |slice| {
            slice.link_soft("remainder", "tail").unwrap();
        });
    });
    assert!(soft.ends_with(other_numbers), "{soft}");
    let shape = (15, 12, 6, 40);
    let sparse = said(&|file| {
        replaced(file, "moment", |slice| {
            let data = slice.new_dataset::<f32>().shape(shape);
            let data = data.chunk((8, 8, 6, 40)).fletcher32();
            data.create("moment").unwrap();
        });
    });
    assert!(sparse.ends_with(other_numbers), "{sparse}");
    let raw = said(&|file| {
        file.unlink("r").unwrap();
        let data = file
            .new_dataset::<f64>()
            .shape([15])
            .external("/etc/passwd", 0, 120);
        data.create("r").unwrap();
    });
    assert!(
        raw.contains("cannot read /r: it is damaged: external"),
        "{raw}"
    );
    let zeroed = said(&|file| {
        replaced(file, "moment", |slice| {
            let zeros = ndarray::Array4::<f32>::zeros(shape);
            let data = slice.new_dataset::<f32>().shape(shape);
            let data = data.chunk((8, 8, 6, 40)).create("moment").unwrap();
            data.write(&zeros).unwrap();
        });
    });
    assert!(zeroed.ends_with(other_numbers), "{zeroed}");
    let doubled = said(&|file| {
        replaced(file, "moment", |slice| {
            let zeros = ndarray::Array4::<f64>::zeros(shape);
            let data = slice.new_dataset::<f64>().shape(shape);
            let data = data.chunk((8, 8, 6, 40)).fletcher32().create("moment");
            data.unwrap().write(&zeros).unwrap();
        });
    });
    assert!(doubled.contains("its type is 64-bit float"), "{doubled}");
}

#[test]
fn sizes_are_compared_before_memory_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let error = refused(&folder, |file| {
        replaced(file, "moment", |slice| {
            let zeros = ndarray::Array4::<f32>::zeros((15, 12, 6, 39));
            let data = slice.new_dataset::<f32>().shape((15, 12, 6, 39));
            let data = data.chunk((8, 8, 6, 39)).fletcher32().create("moment");
            data.unwrap().write(&zeros).unwrap();
        });
    });
    let words = "/moment has the dimensions [15, 12, 6, 39], needed [15, 12, 6, 40]";
    assert!(error.to_string().ends_with(words), "{error}");
    // Terabytes that are nowhere.
    let error = refused(&folder, |file| {
        file.unlink("r").unwrap();
        file.new_dataset::<f64>()
            .shape([1 << 37])
            .create("r")
            .unwrap();
    });
    let words = ": /r brings the numbers to load to 1099511627776 bytes, more than the ";
    assert!(error.to_string().contains(words), "{error}");
}
