//! What happens when somebody stops a command: nothing half-done stays, and he hears what is kept.

use crate::failure::tell;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

type Note = Box<dyn Fn() -> String + Send>;

/// What is kept when the command is stopped now.
static NOTE: Mutex<Option<Note>> = Mutex::new(None);

/// Signal of a file that grows beyond the limit of the process; without a handler it ends the process.
#[cfg(unix)]
const FILE_TOO_LARGE: std::ffi::c_int = signal_hook::consts::SIGXFSZ;

/// From now on says what is kept when the command is stopped.
pub(crate) fn say_then(note: impl Fn() -> String + Send + 'static) {
    *NOTE.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(note));
}

/// Listens for Ctrl-C and its like until the program ends; where that is not possible, they end it as ever.
pub(crate) fn listen() {
    #[cfg(unix)]
    let _ = signal_hook::flag::register(FILE_TOO_LARGE, Arc::new(AtomicBool::new(false)));
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM, SIGHUP]) else {
        return;
    };
    let _ = std::thread::Builder::new()
        .name("interrupt".to_owned())
        .spawn(move || {
            for signal in signals.forever() {
                let note = NOTE.lock().unwrap_or_else(PoisonError::into_inner);
                let kept = note
                    .as_ref()
                    .map_or_else(|| "nothing was written".to_owned(), |note| note());
                tell(format!("\nstopped: {kept}"));
                output::abandon();
                let _ = emulate_default_handler(signal);
            }
        });
}
