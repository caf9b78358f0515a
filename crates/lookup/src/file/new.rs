//! Creation of HDF5 files: a file is filled, closed and sealed, and every failure of the library is detected.
//!
//! The library keeps small datasets in memory until they are closed, and the binding closes them when a handle is
//! dropped. It cannot return an error then, and later calls succeed although the bytes are lost. Therefore the library
//! itself reports each call that fails (`H5Eset_auto2`), and a file with a failed call is not sealed.
//! `scripts/attacks/writes.py` makes each write of each command fail in turn.

use hdf5_sys::h5e::{H5E_DEFAULT, H5E_WALK_DOWNWARD, H5E_error2_t, H5Eset_auto2, H5Ewalk2};
use hdf5_sys::h5i::hid_t;
use std::cell::Cell;
use std::ffi::{CStr, c_int, c_uint, c_void};
use std::fs::File;
use std::path::Path;
use std::ptr::null_mut;

/// Creates a file under an unused name, calls `fill` and seals the file; returns its handle.
///
/// `fill` receives the file of the library, and a handle for direct writes. It must close every object of the library
/// that it opens. Every version of the library can read the file. By default version 2 of the library would write
/// groups and superblocks of a later format, which versions before 1.8 cannot read.
///
/// # Errors
/// The error of `fill`, or the reason why a call of the library or a write failed: that of the system, if there is one.
pub fn new_file<E: From<String>>(
    path: &Path,
    fill: impl FnOnce(&hdf5::File, &File) -> Result<(), E>,
) -> Result<File, E> {
    // other threads must wait: each turns the reports off at its first call, for all threads if the library is not
    // thread-safe
    let (written, failure) = hdf5::sync::sync(|| {
        let outer = FAILURE.take();
        // SAFETY: the function lives as long as the program, and the lock is held.
        #[allow(unsafe_code)]
        unsafe {
            H5Eset_auto2(H5E_DEFAULT, Some(note), null_mut());
        }
        let written = write(path, fill);
        (written, FAILURE.replace(outer))
    });
    match (written, failure) {
        (_, Some(reason)) => Err(reason.into()),
        (written, None) => {
            let file = written?;
            let sealed = ledger::seal(&file);
            sealed.map_err(|error| error.to_string())?;
            Ok(file)
        }
    }
}

fn write<E: From<String>>(
    path: &Path,
    fill: impl FnOnce(&hdf5::File, &File) -> Result<(), E>,
) -> Result<File, E> {
    let told = |error: hdf5::Error| E::from(reason(&error));
    let mut builder = hdf5::File::with_options();
    builder.with_fapl(|access| {
        // the environment variable HDF5_DRIVER could select a driver without a handle
        access.sec2().libver_earliest();
        // an unused name needs no lock, and some file systems do not support locks
        #[cfg(hdf5_locks)]
        access.file_locking(false);
        access
    });
    let library = builder.create_excl(path).map_err(told)?;
    let file = handle(&library, path).map_err(E::from)?;
    fill(&library, &file)?;
    library.flush().map_err(told)?;
    library.close().map_err(told)?;
    Ok(file)
}

/// A separate handle of a file that the library has open.
#[cfg(unix)]
fn handle(library: &hdf5::File, _: &Path) -> Result<File, String> {
    use hdf5_sys::{h5f::H5Fget_vfd_handle, h5p::H5P_DEFAULT};
    use std::os::fd::BorrowedFd;
    let mut place = null_mut();
    // SAFETY: the file is open, its driver has a descriptor, and the descriptor is copied before it can be closed.
    #[allow(unsafe_code)]
    let copied = hdf5::sync::sync(|| unsafe {
        hdf5::h5check(H5Fget_vfd_handle(library.id(), H5P_DEFAULT, &raw mut place))?;
        let descriptor = *place.cast_const().cast::<c_int>();
        Ok(BorrowedFd::borrow_raw(descriptor).try_clone_to_owned())
    });
    let copied = copied.map_err(|error: hdf5::Error| reason(&error))?;
    copied.map(File::from).map_err(|error| error.to_string())
}

#[cfg(not(unix))]
fn handle(_: &hdf5::File, path: &Path) -> Result<File, String> {
    let opened = File::options().read(true).write(true).open(path);
    opened.map_err(|error| error.to_string())
}

/// The message of the system, or the first line of the library's if there is none.
pub fn reason(error: &hdf5::Error) -> String {
    let (stack, said) = (error.stack(), error.to_string());
    let mut frames = stack.iter().flat_map(|stack| stack.iter());
    let system = frames.find_map(|frame| of_system(frame.desc()));
    let first = || said.lines().next().unwrap_or_default();
    system.unwrap_or_else(first).to_owned()
}

/// The message of the system in a description of the library.
fn of_system(description: &str) -> Option<&str> {
    let (_, message) = description.split_once("error message = '")?;
    Some(message.split_once('\'')?.0)
}

thread_local! {
    /// Reason for the first failed call on this thread since the current file was begun.
    static FAILURE: Cell<Option<String>> = const { Cell::new(None) };
}

/// Stores the reason of the first failure; the library calls this function at the end of each call that fails.
#[allow(unsafe_code)]
unsafe extern "C" fn note(stack: hid_t, _: *mut c_void) -> c_int {
    let mut found: Option<String> = None;
    // SAFETY: the stack is that of the failed call, and `found` outlives the walk.
    unsafe {
        H5Ewalk2(
            stack,
            H5E_WALK_DOWNWARD,
            Some(frame),
            (&raw mut found).cast(),
        )
    };
    let first = FAILURE.take().or(found);
    FAILURE.set(first.or_else(|| Some("a call of the HDF5 library failed".to_owned())));
    0
}

/// Stores the message of the system or, if there is none, of the frame nearest to the caller.
#[allow(unsafe_code)]
unsafe extern "C" fn frame(_: c_uint, frame: *const H5E_error2_t, found: *mut c_void) -> c_int {
    // SAFETY: the library passes one of its frames, and the pointer from `note`.
    let (frame, found) = unsafe { (&*frame, &mut *found.cast::<Option<String>>()) };
    if !frame.desc.is_null() {
        // SAFETY: the library terminates its texts with a NUL.
        let text = unsafe { CStr::from_ptr(frame.desc) }.to_string_lossy();
        let system = of_system(&text).map(str::to_owned);
        *found = system.or(found.take()).or_else(|| Some(text.into_owned()));
    }
    0
}

#[cfg(all(test, unix))]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

    use super::*;
    use std::os::fd::{AsRawFd, FromRawFd, OwnedFd};

    /// Creates a file with two small datasets; with `fails`, the library cannot write when it closes the first.
    fn made(path: &Path, fails: bool) -> Result<File, String> {
        new_file(path, |library, file| {
            let told = |error: hdf5::Error| reason(&error);
            let numbers: Vec<f64> = (0..100).map(f64::from).collect();
            let dataset = |name: &str| {
                let made = library.new_dataset::<f64>().shape([100]).create(name);
                let made = made.map_err(told)?;
                made.write_raw(&numbers).map_err(told)?;
                Ok::<_, String>(made)
            };
            let (first, second) = (dataset("first")?, dataset("second")?);
            let mut descriptor = descriptor(path, file);
            if fails {
                // a descriptor that is open for reading only, so that writes of the library fail
                rustix::io::dup2(File::open("/dev/null").unwrap(), &mut descriptor).unwrap();
            }
            drop(first);
            rustix::io::dup2(file, &mut descriptor).unwrap();
            std::mem::forget(descriptor);
            drop(second);
            Ok(())
        })
    }

    /// The descriptor that the library has of the file of `own`.
    fn descriptor(path: &Path, own: &File) -> OwnedFd {
        let of = |number: i32| std::fs::read_link(format!("/proc/self/fd/{number}"));
        let path = path.canonicalize().unwrap();
        // whatever other tests have open or close at this moment
        let mut others = (3..4096).filter(|&number| number != own.as_raw_fd());
        let number = others
            .find(|&number| of(number).is_ok_and(|to| to == path))
            .unwrap();
        // SAFETY: the descriptor is open, and is forgotten instead of closed.
        #[allow(unsafe_code)]
        unsafe {
            OwnedFd::from_raw_fd(number)
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_write_that_fails_once_while_a_handle_is_dropped_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let (good, bad) = (folder.path().join("good.h5"), folder.path().join("bad.h5"));
        drop(made(&good, false).unwrap());
        let file = ledger::HdfFile::open(&good).unwrap();
        assert!(file.is_sealed());
        let numbers = file.root.dataset("first").unwrap().numbers::<f64>(1 << 20);
        assert_eq!(numbers.unwrap()[99], 99.0);
        let failure = made(&bad, true).unwrap_err();
        assert!(failure.contains("Bad file descriptor"), "{failure}");
        assert!(!ledger::HdfFile::open(&bad).is_ok_and(|file| file.is_sealed()));
        // the failure has no effect on the next file
        drop(made(&folder.path().join("next.h5"), false).unwrap());
    }

    #[test]
    fn a_file_is_made_where_nothing_is() {
        let folder = tempfile::tempdir().unwrap();
        let (private, link) = (folder.path().join("private"), folder.path().join("link"));
        std::fs::write(&private, "private").unwrap();
        std::os::unix::fs::symlink(&private, &link).unwrap();
        for path in [&private, &link] {
            let failure = made(path, false).unwrap_err();
            assert!(failure.contains("File exists"), "{failure}");
            assert_eq!(std::fs::read(&private).unwrap(), b"private");
        }
    }
}
