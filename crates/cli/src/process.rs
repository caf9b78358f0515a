//! How the program ends before its work is done: stopped by somebody, by a fault of its own, or without memory.

use crate::failure::tell;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;
use std::alloc::{GlobalAlloc, Layout, System};
use std::io::Write;
use std::panic::PanicHookInfo;
use std::process::exit;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// What is kept when the command is stopped now.
static NOTE: Mutex<Option<Box<dyn Fn() -> String + Send>>> = Mutex::new(None);

/// From now on says what is kept when the command is stopped.
pub(crate) fn say_then(note: impl Fn() -> String + Send + 'static) {
    *NOTE.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(note));
}

/// Listens for Ctrl-C and its like until the program ends; where that is not possible, they end it as ever.
pub(crate) fn listen() {
    // a file that grows beyond the limit of the process would end it without a handler
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM, SIGHUP]) else {
        return;
    };
    let ear = std::thread::Builder::new().name("interrupt".to_owned());
    let _ = ear.spawn(move || {
        for signal in signals.forever() {
            let note = NOTE.lock().unwrap_or_else(PoisonError::into_inner);
            let kept = note.as_ref().map(|note| note());
            let kept = kept.as_deref().unwrap_or("nothing was written");
            tell(format!("\nstopped: {kept}"));
            output::abandon();
            let _ = emulate_default_handler(signal);
        }
    });
}

/// Exit code of a program that met a fault of its own.
const FAULT: i32 = 101;

/// Ends the program with one sentence where it would unwind; with `RUST_BACKTRACE` as usual.
pub(crate) fn end_in_one_sentence() {
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
    let text = payload.downcast_ref::<String>().map(String::as_str);
    let text = text.or(payload.downcast_ref::<&str>().copied());
    let place = info.location().map(ToString::to_string);
    format!(
        "error: this is a fault of the program, please report it with its input: {} at {}",
        text.unwrap_or_default().replace('\n', " "),
        place.unwrap_or_default()
    )
}

/// The system's allocator; where it has nothing more, the program ends in a sentence.
struct OrSentence;

#[global_allocator]
static ALLOCATOR: OrSentence = OrSentence;

/// What was given, or the end of the program.
fn given(memory: *mut u8, bytes: usize) -> *mut u8 {
    if memory.is_null() {
        let _ = writeln!(
            std::io::stderr(),
            "error: there is no memory left, of which {bytes} bytes are needed: ask for less, or allow more"
        );
        // whatever was half-done stays, and is removed by the next run: nothing can be done without memory
        signal_hook::low_level::exit(1);
    }
    memory
}

// SAFETY: all of it is done by the system's allocator, as it was asked for.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for OrSentence {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        given(unsafe { System.alloc(layout) }, layout.size())
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        given(unsafe { System.alloc_zeroed(layout) }, layout.size())
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, bytes: usize) -> *mut u8 {
        given(unsafe { System.realloc(memory, layout, bytes) }, bytes)
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }
}
