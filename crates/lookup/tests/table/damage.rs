//! Damage to a file: found before the HDF5 library is asked, or by the sum of the chunk that is read.

use crate::format::written;
use crate::older::one_sentence;
use crate::slices::sliced;
use crate::stand_in::content;
use lookup::{BadTable, Table, TableFile, content_hash, read, write};
use std::path::Path;

#[test]
fn damaged_and_foreign_files_are_refused_in_one_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let whole = std::fs::read(written(&folder)).unwrap();
    let path = folder.path().join("bad.h5");
    let refused = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        let error = Table::open(&path).unwrap_err();
        one_sentence(&error, &path);
        error
    };
    assert!(matches!(refused(b"").what, BadTable::NotHdf5(_)));
    assert!(matches!(
        refused(b"time_s,force_n\n0,0\n").what,
        BadTable::NotHdf5(_)
    ));
    for length in [whole.len() / 10, whole.len() / 2, whole.len() - 1] {
        assert!(matches!(
            refused(&whole[..length]).what,
            BadTable::Damaged(_)
        ));
    }
    let longer = [&whole[..], b"more"].concat();
    assert!(matches!(refused(&longer).what, BadTable::Damaged(_)));
    let missing = Table::open(Path::new("/no/such/table.h5")).unwrap_err();
    assert!(matches!(missing.what, BadTable::Unreadable(_)));
    one_sentence(&missing, Path::new("/no/such/table.h5"));
    assert!(matches!(
        Table::open(folder.path()).unwrap_err().what,
        BadTable::Unreadable(_)
    ));
}

#[test]
fn a_flipped_bit_anywhere_is_found_or_changes_nothing_that_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    write(&path, &sliced()).unwrap();
    let whole = std::fs::read(&path).unwrap();
    let reference = content_hash(&sliced());
    let file = TableFile::open(&path).unwrap();
    let part = file
        .part(0.13, [[0.0; 2], [0.5; 2]])
        .unwrap()
        .into_content();
    let (mut found, mut kept) = (0, 0);
    for place in (0..whole.len()).step_by(whole.len() / 97) {
        let mut bytes = whole.clone();
        bytes[place] ^= 0x10;
        std::fs::write(&path, &bytes).unwrap();
        // All of it: no byte is without a sum.
        assert!(read(&path).is_err(), "byte {place}");
        // A part of it: refused, or what was hit was not read.
        match TableFile::open(&path).and_then(|file| file.part(0.13, [[0.0; 2], [0.5; 2]])) {
            Ok(table) => {
                assert_eq!(table.into_content(), part, "byte {place}");
                kept += 1;
            }
            Err(error) => {
                one_sentence(&error, &path);
                found += 1;
            }
        }
    }
    assert!(found > 10 && kept > 10, "{found} found, {kept} not read");
    std::fs::write(&path, &whole).unwrap();
    assert_eq!(content_hash(&read(&path).unwrap()), reference);
}

#[test]
fn a_file_that_was_written_to_has_lost_its_seal() {
    let folder = tempfile::tempdir().unwrap();
    let path = written(&folder);
    let file = hdf5::File::open_rw(&path).unwrap();
    let tail = file.dataset("slices/nu_0.3/tail").unwrap();
    tail.write_slice(&[0.5_f32], (0, 0, 0, 0..1)).unwrap();
    file.close().unwrap();
    let error = Table::open(&path).unwrap_err();
    assert!(matches!(error.what, BadTable::Damaged(_)), "{error}");
}

#[test]
fn numbers_that_cannot_be_right_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    let mut bad = content();
    bad.slices[0].tail[0] = f32::NAN;
    write(&path, &bad).unwrap();
    let error = Table::open(&path).unwrap_err();
    one_sentence(&error, &path);
    let end = ": slices/nu_0.3/tail (r/r0 = 0, z/r0 = 0) = NaN, allowed: finite numbers";
    assert!(error.to_string().ends_with(end), "{error}");
    // Slices of different sizes, read for a ratio between them.
    let mut bad = sliced();
    bad.slices[4].tail.truncate(7 * 15 * 12 * 6);
    std::fs::remove_file(&path).unwrap();
    write(&path, &bad).unwrap();
    let error = TableFile::open(&path)
        .unwrap()
        .part(0.13, [[0.0; 2], [0.5; 2]])
        .unwrap_err();
    one_sentence(&error, &path);
    assert!(
        error.to_string().contains("/term has 7 values, needed 14"),
        "{error}"
    );
}
