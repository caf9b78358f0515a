//! What a user sees of a fault of the program itself: one sentence and exit code 101.

use std::io::Write;
use std::panic::PanicHookInfo;
use std::process::exit;
use std::sync::atomic::{AtomicBool, Ordering};

/// Exit code of a program that met a fault of its own.
const FAULT: i32 = 101;

/// Ends the program with one sentence where it would unwind; with `RUST_BACKTRACE` as usual.
pub(crate) fn in_one_sentence() {
    if std::env::var_os("RUST_BACKTRACE").is_some_and(|value| value != "0") {
        return;
    }
    std::panic::set_hook(Box::new(|info| {
        static TOLD: AtomicBool = AtomicBool::new(false);
        if !TOLD.swap(true, Ordering::SeqCst) {
            // Standard error may be closed: that must not be a second fault.
            let _ = writeln!(std::io::stderr(), "{}", sentence(info));
        }
        exit(FAULT);
    }));
}

fn sentence(info: &PanicHookInfo<'_>) -> String {
    let payload = info.payload();
    let what = payload
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned())
        .or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_default();
    let place = info.location().map(ToString::to_string);
    format!(
        "error: this is a fault of the program, please report it with its input: {} at {}",
        what.replace('\n', " "),
        place.unwrap_or_default()
    )
}
