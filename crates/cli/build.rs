//! Links HDF5 from the archive beside the system's shared library, where that needs nothing but its filters.
//!
//! The shared library of Debian and Ubuntu loads thirty others, for files that are read over the network: that takes
//! longer than an impact does.

use std::env;
use std::error::Error;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// The libraries of HDF5's filters, and those of the system.
const NEEDED: [&str; 4] = ["-lsz", "-lz", "-ldl", "-lm"];

/// What the crate `hdf5-sys` and `pkg-config` go by.
const ASKED: &str = "HDF5_DIR HDF5_NO_PKG_CONFIG PKG_CONFIG PKG_CONFIG_PATH PKG_CONFIG_LIBDIR";

fn main() {
    for name in ASKED.split(' ') {
        println!("cargo::rerun-if-env-changed={name}");
    }
    // a folder with the archives alone: the linker takes them where it finds no shared library first
    if let Ok(Some(folder)) = archives() {
        println!("cargo::rustc-link-search=native={}", folder.display());
        for library in NEEDED {
            println!("cargo::rustc-link-arg={library}");
        }
    }
}

/// The archives of the HDF5 that the crate `hdf5-sys` finds, where a program is built from them.
fn archives() -> Result<Option<PathBuf>, Box<dyn Error>> {
    let target = env::var("TARGET")?;
    let other = ["CARGO_FEATURE_STATIC", "HDF5_NO_PKG_CONFIG", "PKG_CONFIG"];
    let is_other = other.into_iter().any(|name| env::var_os(name).is_some());
    if is_other || !target.ends_with("-linux-gnu") || env::var("HOST")? != target {
        return Ok(None);
    }
    let found = if let Ok(prefix) = env::var("HDF5_DIR") {
        format!("{prefix}/lib")
    } else {
        let mut asked = Command::new("pkg-config");
        let found = asked.args(["--libs-only-L", "hdf5"]).output()?;
        String::from_utf8(found.stdout)?.trim().replace("-L", "")
    };
    let folder = PathBuf::from(env::var("OUT_DIR")?);
    for name in ["libhdf5.a", "libhdf5_hl.a"] {
        // never through a link that lies there
        let _ = fs::remove_file(folder.join(name));
        fs::copy(format!("{found}/{name}"), folder.join(name))?;
        println!("cargo::rerun-if-changed={found}/{name}");
    }
    let opens = "int H5open(void); int main(void) { return H5open(); }\n";
    fs::write(folder.join("opens.c"), opens)?;
    let mut linker = Command::new("cc");
    linker.current_dir(&folder).stderr(Stdio::null());
    linker.args(["opens.c", "-o", "opens", "-L.", "-lhdf5_hl", "-lhdf5"]);
    let status = linker.args(NEEDED).status()?;
    Ok(status.success().then_some(folder))
}
