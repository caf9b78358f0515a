//! A new HDF5 file: made, filled, closed and sealed, with every failure of the library noticed.
//!
//! The library keeps small datasets in memory until they are closed, which the binding does where a handle is dropped: it cannot
//! return an error then, and later calls succeed although the bytes are lost. So the library itself reports each call that fails
//! (`H5Eset_auto2`), whoever makes it; a file of which one failed is not sealed.
//! `scripts/attacks/writes.py` fails each write of each command in turn.

use hdf5_sys::h5e::{H5E_DEFAULT, H5E_WALK_DOWNWARD, H5E_error2_t, H5Eset_auto2, H5Ewalk2};
use hdf5_sys::h5i::hid_t;
use std::cell::Cell;
use std::ffi::{CStr, c_int, c_uint, c_void};
use std::fs::File;
use std::path::Path;
use std::ptr::null_mut;

/// Makes a file where nothing has its name, has it filled and seals it; returns its handle.
///
/// `fill` gets the file of the library, and the handle for what it writes itself. Everything of the library that it opens is
/// closed when it returns.
/// The file is one that every version of the library reads, whatever the linked one prefers: version 2 of the library would
/// write groups and superblocks of a later format, which its versions before 1.8 do not know.
///
/// # Errors
/// What `fill` says, or the reason why a call of the library or a write failed: that of the system, if there is one.
pub fn new_file<E: From<String>>(
    path: &Path,
    fill: impl FnOnce(&hdf5::File, &File) -> Result<(), E>,
) -> Result<File, E> {
    // other threads wait: each turns the reports off at its first call, for all of them where the library knows no threads
    let (written, failure) = hdf5::sync::sync(|| {
        let outer = FAILURE.take();
        // SAFETY: the function lives as long as the program, the lock is held.
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
        // HDF5_DRIVER may name another one, which has no handle
        access.sec2().libver_earliest();
        // a name that nobody else has needs no lock, which some file systems do not keep
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

/// A handle of its own of a file that the library has open.
#[cfg(unix)]
fn handle(library: &hdf5::File, _: &Path) -> Result<File, String> {
    use hdf5_sys::{h5f::H5Fget_vfd_handle, h5p::H5P_DEFAULT};
    use std::os::fd::BorrowedFd;
    let mut place = null_mut();
    // SAFETY: the file is open, and its driver is the one that has a descriptor, which is copied before it can be closed.
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

/// What the system said, if it did, else the first line of what the library says.
pub fn reason(error: &hdf5::Error) -> String {
    let (stack, said) = (error.stack(), error.to_string());
    let mut frames = stack.iter().flat_map(|stack| stack.iter());
    let system = frames.find_map(|frame| of_system(frame.desc()));
    let first = || said.lines().next().unwrap_or_default();
    system.unwrap_or_else(first).to_owned()
}

/// What the system said, in the words of the library.
fn of_system(description: &str) -> Option<&str> {
    let (_, message) = description.split_once("error message = '")?;
    Some(message.split_once('\'')?.0)
}

thread_local! {
    /// Why the first call failed on this thread since a file was begun.
    static FAILURE: Cell<Option<String>> = const { Cell::new(None) };
}

/// Keeps the reason of the first failure; the library calls it at the end of each call that fails.
#[allow(unsafe_code)]
unsafe extern "C" fn note(stack: hid_t, _: *mut c_void) -> c_int {
    let mut found: Option<String> = None;
    // SAFETY: the stack is that of the call, and `found` outlives the walk.
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

/// Keeps what the system said or, where it said nothing, what the frame nearest to the caller says.
#[allow(unsafe_code)]
unsafe extern "C" fn frame(_: c_uint, frame: *const H5E_error2_t, found: *mut c_void) -> c_int {
    // SAFETY: the library passes a frame of its own, and what `note` gave it.
    let (frame, found) = unsafe { (&*frame, &mut *found.cast::<Option<String>>()) };
    if !frame.desc.is_null() {
        // SAFETY: a text of the library that ends with a NUL.
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

    /// Makes a file with two small datasets; where it fails, the library cannot write while it closes the first.
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
                // a descriptor that is open for reading alone: the library calls it, and the system refuses
                rustix::io::dup2(File::open("/dev/null").unwrap(), &mut descriptor).unwrap();
            }
            drop(first);
            rustix::io::dup2(file, &mut descriptor).unwrap();
            std::mem::forget(descriptor);
            drop(second);
            Ok(())
        })
    }

    /// The descriptor of the library, which has the same file open as `own`.
    fn descriptor(path: &Path, own: &File) -> OwnedFd {
        let of = |number: i32| std::fs::read_link(format!("/proc/self/fd/{number}"));
        let path = path.canonicalize().unwrap();
        let mut others =
            (3..own.as_raw_fd()).filter(|&number| of(number).is_ok_and(|to| to == path));
        let number = others.next_back().unwrap();
        // SAFETY: it is open, and forgotten before it is closed.
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
        // nothing of it is left for the next file
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
