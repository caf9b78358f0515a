//! One line makes a target of cargo-fuzz out of one of the crate `fuzzing`.

use fuzzing::Target;
use std::path::Path;
use std::sync::OnceLock;
use tempfile::TempDir;

pub use libfuzzer_sys::fuzz_target;

/// Gives an input to the target of a name; what scenes name lies in a folder made once.
pub fn judge(name: &str, input: &[u8]) {
    static FOLDER: OnceLock<TempDir> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let named = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus/named");
        for name in ["pulse.csv", "materials.toml", "base.toml"] {
            std::fs::copy(named.join(name), folder.path().join(name)).expect("a file to copy");
        }
        folder
    });
    let target = Target::named(name).expect("a target of that name");
    let _ = target.judge(input, folder.path());
}

/// The target of a name.
#[macro_export]
macro_rules! target {
    ($name:ident) => {
        $crate::fuzz_target!(|input: &[u8]| { $crate::judge(stringify!($name), input) });
    };
}
