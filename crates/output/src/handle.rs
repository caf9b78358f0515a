//! Files by their handles: another process with access to a folder can put another file under a name at any time.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::Path;

/// Creates an empty file under an unused name; an existing file or link is not touched.
pub(crate) fn make(name: &Path) -> io::Result<File> {
    let mut new = File::options();
    new.read(true).write(true).create_new(true).open(name)
}

/// The options with an additional flag that prevents following links.
pub(crate) fn without_links(options: &mut OpenOptions) -> &mut OpenOptions {
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt;
        options.custom_flags(rustix::fs::OFlags::NOFOLLOW.bits() as i32);
    }
    options
}

/// Whether an open file is the one with this name.
#[cfg(unix)]
pub(crate) fn is_at(file: &File, name: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (file.metadata(), std::fs::symlink_metadata(name)) {
        (Ok(open), Ok(there)) => (open.dev(), open.ino()) == (there.dev(), there.ino()),
        _ => false,
    }
}

#[cfg(not(unix))]
pub(crate) fn is_at(_: &File, name: &Path) -> bool {
    name.exists()
}
