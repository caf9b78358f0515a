//! Links HDF5 from the archive beside the system's shared library, where that needs nothing but its filters.
//!
//! The shared library of Debian and Ubuntu loads thirty others, for files that are read over the network: that
//! takes longer than an impact does.

use std::env;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The libraries of HDF5's filters, and those of the system.
const NEEDED: [&str; 4] = ["-lsz", "-lz", "-ldl", "-lm"];

fn main() {
    println!("cargo::rerun-if-env-changed=HDF5_DIR");
    let here = env::var("TARGET").is_ok_and(|target| target.ends_with("-linux-gnu"))
        && env::var("TARGET") == env::var("HOST");
    if !here || env::var_os("CARGO_FEATURE_STATIC").is_some() {
        return;
    }
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    // a folder with the archives alone: the linker takes them where it finds no shared library first
    if archives().is_some_and(|from| copied(&from, &out).is_ok() && links(&out)) {
        println!("cargo::rustc-link-search=native={}", out.display());
        for library in NEEDED {
            println!("cargo::rustc-link-arg-bins={library}");
        }
    }
}

/// The folder with the archives of the HDF5 that the crate `hdf5-sys` finds.
fn archives() -> Option<PathBuf> {
    if let Some(prefix) = env::var_os("HDF5_DIR") {
        return Some(Path::new(&prefix).join("lib"));
    }
    let found = Command::new("pkg-config")
        .args(["--libs-only-L", "hdf5"])
        .output()
        .ok()?;
    let folder = String::from_utf8(found.stdout).ok()?;
    Some(PathBuf::from(folder.trim().strip_prefix("-L")?))
}

fn copied(from: &Path, to: &Path) -> std::io::Result<()> {
    for name in ["libhdf5.a", "libhdf5_hl.a"] {
        let link = to.join(name);
        let _ = std::fs::remove_file(&link);
        symlink(from.join(name).canonicalize()?, link)?;
    }
    Ok(())
}

/// Whether a program is built from the archives in `folder`.
fn links(folder: &Path) -> bool {
    let source = folder.join("opens.c");
    std::fs::write(
        &source,
        "int H5open(void); int main(void) { return H5open(); }\n",
    )
    .is_ok()
        && Command::new("cc")
            .arg(&source)
            .arg("-o")
            .arg(folder.join("opens"))
            .arg("-L")
            .arg(folder)
            .args(["-lhdf5_hl", "-lhdf5"])
            .args(NEEDED)
            .stderr(Stdio::null())
            .status()
            .is_ok_and(|status| status.success())
}
