//! Every promise of the crate, on real files.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use fault::{Fault as _, Remedy};
use output::{CSV, Existing, HDF5, Output, OutputError, apart, write_whole};
use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

fn new(mut file: &File) -> io::Result<()> {
    file.write_all(b"new")
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_is_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let full = |mut file: &File| {
        file.write_all(b"half")?;
        Err(io::Error::from_raw_os_error(28))
    };
    let refused = write_whole(&path, Existing::Keep, full).unwrap_err();
    assert_eq!(refused.culprit().remedy, Remedy::Wait);
    assert!(refused.to_string().contains("no space left"), "{refused}");
    assert!(names(folder.path()).is_empty());

    write_whole(&path, Existing::Keep, |mut file| file.write_all(b"old")).unwrap();
    let refused = write_whole(&path, Existing::Keep, new).unwrap_err();
    assert!(matches!(refused, OutputError::Exists { .. }), "{refused}");
    write_whole(&path, Existing::Replace, full).unwrap_err();
    assert_eq!(std::fs::read(&path).unwrap(), b"old");
    write_whole(&path, Existing::Replace, new).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"new");
    assert_eq!(names(folder.path()), ["a.h5"]);
}

#[test]
fn one_run_at_a_time_and_nothing_of_a_dead_one_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let dead = [".a.h5.0123456789abcdef.part", ".a.h5.lock"];
    let others = [
        ".a.h5.0123.part",
        ".b.h5.0123456789abcdef.part",
        "a.h5.part",
    ];
    for name in dead.iter().chain(&others) {
        std::fs::write(folder.path().join(name), "").unwrap();
    }
    let first = Output::claim(&path, Existing::Keep).unwrap();
    let second = Output::claim(&path, Existing::Replace).unwrap_err();
    assert!(matches!(second, OutputError::Busy { .. }));
    assert_eq!(second.culprit().remedy, Remedy::Wait);
    first.write(new).unwrap();
    drop(first);
    drop(Output::claim(&path, Existing::Replace).unwrap());
    let mut expected: Vec<String> = others.iter().map(ToString::to_string).collect();
    expected.push("a.h5".to_owned());
    expected.sort();
    assert_eq!(names(folder.path()), expected);
}

#[test]
fn a_file_under_the_name_of_the_lock_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    std::fs::write(folder.path().join(".a.h5.lock"), "precious").unwrap();
    write_whole(&path, Existing::Keep, new).unwrap();
    assert_eq!(names(folder.path()), [".a.h5.lock", "a.h5"]);
}

#[test]
fn what_was_written_before_a_kill_is_accepted_if_it_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    for (old, accepted) in [("new", true), ("old", false), ("newer", false)] {
        std::fs::write(&path, old).unwrap();
        let output = Output::claim(&path, Existing::KeepUnlessSame).unwrap();
        assert_eq!(output.write(new).is_ok(), accepted, "{old}");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), old);
        drop(output);
        assert_eq!(names(folder.path()), ["a.csv"]);
    }
    // longer than what is compared together
    let long: Vec<u8> = (0..5_u32 << 19).map(|i| (i / 7) as u8).collect();
    let mut other = long.clone();
    other[3 << 18] ^= 1;
    for (old, accepted) in [
        (&long[..], true),
        (&other, false),
        (&long[..4 << 18], false),
    ] {
        std::fs::write(&path, old).unwrap();
        let output = Output::claim(&path, Existing::KeepUnlessSame).unwrap();
        let written = output.write(|mut file| file.write_all(&long));
        assert_eq!(written.is_ok(), accepted, "{} bytes", old.len());
        assert!(std::fs::read(&path).unwrap() == old);
    }
}

#[cfg(unix)]
#[test]
fn links_are_written_through_and_permissions_kept() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("deep")).unwrap();
    std::fs::write(at("deep/a.h5"), "old").unwrap();
    std::fs::set_permissions(at("deep/a.h5"), PermissionsExt::from_mode(0o600)).unwrap();
    symlink("deep/b.h5", at("one.h5")).unwrap();
    symlink("a.h5", at("deep/b.h5")).unwrap();
    write_whole(&at("one.h5"), Existing::Replace, new).unwrap();
    assert_eq!(std::fs::read(at("deep/a.h5")).unwrap(), b"new");
    let mode = std::fs::metadata(at("deep/a.h5")).unwrap().permissions();
    assert_eq!(mode.mode() & 0o777, 0o600);
    // a link to what is not there yet
    symlink("c.h5", at("deep/d.h5")).unwrap();
    write_whole(&at("deep/d.h5"), Existing::Keep, new).unwrap();
    assert_eq!(names(&at("deep")), ["a.h5", "b.h5", "c.h5", "d.h5"]);
    assert!(at("deep/d.h5").is_symlink() && !at("deep/c.h5").is_symlink());
    // the file is the same whatever it is called
    let first = Output::claim(&at("one.h5"), Existing::Replace).unwrap();
    let second = Output::claim(&at("deep/a.h5"), Existing::Replace).unwrap_err();
    assert!(matches!(second, OutputError::Busy { .. }), "{second}");
    drop(first);
    symlink("loop", at("loop")).unwrap();
    let looped = Output::claim(&at("loop"), Existing::Replace).unwrap_err();
    assert!(looped.to_string().contains("link"), "{looped}");
}

/// Somebody else who may write to the folder puts a link to a private file, or the file itself, in the place of the temporary:
/// the private file keeps its bytes and its permissions, and the output what it was.
#[cfg(unix)]
#[test]
fn a_file_in_the_place_of_the_temporary_is_left_alone() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode() & 0o777;
    type Exchange = fn(&Path, &Path) -> io::Result<()>;
    let ways: [Exchange; 2] = [
        |private, name| symlink(private, name),
        |private, name| std::fs::hard_link(private, name),
    ];
    for exchange in ways {
        let folder = tempfile::tempdir().unwrap();
        let (path, private) = (folder.path().join("a.h5"), folder.path().join("private"));
        std::fs::write(&path, "old").unwrap();
        std::fs::set_permissions(&path, PermissionsExt::from_mode(0o666)).unwrap();
        std::fs::write(&private, "private").unwrap();
        std::fs::set_permissions(&private, PermissionsExt::from_mode(0o600)).unwrap();
        let output = Output::claim(&path, Existing::Replace).unwrap();
        let refused = output.write(|mut file| {
            let hidden = names(folder.path()).into_iter();
            let part = hidden.into_iter().find(|name| name.ends_with(".part"));
            let part = folder.path().join(part.unwrap());
            std::fs::remove_file(&part)?;
            exchange(&private, &part)?;
            file.write_all(b"new")
        });
        let refused = refused.unwrap_err().to_string();
        assert!(refused.contains("another process"), "{refused}");
        assert_eq!(std::fs::read(&private).unwrap(), b"private");
        assert_eq!(mode(&private), 0o600);
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        drop(output);
        assert_eq!(names(folder.path()), ["a.h5", "private"]);
    }
}

#[cfg(unix)]
#[test]
fn what_is_no_file_is_refused_even_to_be_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.h5");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    let long = folder.path().join("n".repeat(300));
    let own = File::create(folder.path().join("own")).unwrap();
    let open = format!("/proc/self/fd/{}", std::os::fd::AsRawFd::as_raw_fd(&own));
    let cases = [
        (folder.path(), "folder"),
        (Path::new("/dev/null"), "device"),
        (pipe.as_path(), "pipe"),
        (Path::new("-"), "standard output"),
        (Path::new(&open), "open file"),
        (long.as_path(), "too long"),
        (Path::new("/nowhere/at/all.h5"), "does not exist"),
        (Path::new(""), "empty"),
    ];
    assert!(made.unwrap().success());
    for (path, words) in cases {
        for existing in [Existing::Keep, Existing::Replace] {
            let refused = write_whole(path, existing, new).unwrap_err();
            assert!(refused.to_string().contains(words), "{refused}");
            assert_ne!(refused.culprit().remedy, Remedy::Wait);
        }
    }
}

#[test]
fn outputs_are_no_inputs_and_differ_from_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("scene.toml"), "").unwrap();
    std::fs::hard_link(at("scene.toml"), at("hard.h5")).unwrap();
    std::fs::create_dir(at("deep")).unwrap();
    let scene = [("the scene", at("scene.toml"))];
    for name in ["scene.toml", "hard.h5", "deep/../scene.toml"] {
        let refused = apart(&[&at(name)], &scene).unwrap_err();
        assert!(matches!(refused, OutputError::Refused(..)), "{refused}");
        assert!(refused.to_string().contains("is the scene"), "{refused}");
    }
    let twice = apart(&[&at("new.h5"), &at("deep/../new.h5")], &[]).unwrap_err();
    assert!(matches!(twice, OutputError::Refused(..)), "{twice}");
    assert!(twice.to_string().contains("are the same file"), "{twice}");
    apart(&[&at("new.h5"), &at("deep/new.h5")], &scene).unwrap();
}

#[test]
fn the_ending_of_another_format_is_refused() {
    for name in ["a.h5", "a.HDF5", "a", "a.b/c", "a.vtkhdf"] {
        HDF5.check(Path::new(name)).unwrap();
    }
    let refused = HDF5.check(Path::new("a.csv")).unwrap_err().to_string();
    assert!(
        refused.contains("a.csv") && refused.contains(".h5"),
        "{refused}"
    );
    CSV.check(Path::new("a.csv")).unwrap();
    CSV.check(Path::new("a.h5")).unwrap_err();
}
