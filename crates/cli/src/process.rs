//! Ends of the program before its work is done: a signal, an internal error, or no memory.

use crate::failure::{JSON, line, object};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;
use std::alloc::{GlobalAlloc, Layout, System};
use std::io::Write;
use std::panic::PanicHookInfo;
use std::process::exit;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

/// Message about the kept results, for a command that is stopped now.
static NOTE: Mutex<Option<Box<dyn Fn() -> String + Send>>> = Mutex::new(None);

/// Whether a signal is about to end the program.
static STOPPED: AtomicBool = AtomicBool::new(false);
/// Name of the thread that handles the signals.
const EAR: &str = "interrupt";

/// Sets the message about kept results that is printed when the command is stopped.
pub(crate) fn say_then(note: impl Fn() -> String + Send + 'static) {
    *NOTE.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(note));
}

/// Listens for Ctrl-C and similar signals until the program ends; if that is impossible, they end it at once.
pub(crate) fn listen() {
    // a file that grows beyond the process's limit would end the program unless this signal has a handler
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM, SIGHUP]) else {
        return;
    };
    let ear = thread::Builder::new().name(EAR.to_owned());
    let _ = ear.spawn(move || {
        if let Some(signal) = signals.forever().next() {
            STOPPED.store(true, Ordering::SeqCst);
            let note = NOTE.lock().unwrap_or_else(PoisonError::into_inner);
            let kept = note.as_ref().map(|note| note());
            let told = format!(
                "stopped: {}",
                kept.as_deref().unwrap_or("nothing was written")
            );
            // begins with a new line, after the progress bar
            let told = if JSON.load(Ordering::Relaxed) {
                object("stopped", &told)
            } else {
                format!("\n{}", line(told))
            };
            tell_at_once(&format!("{told}\n"));
            output::abandon();
            let _ = emulate_default_handler(signal);
            exit(128 + signal);
        }
    });
}

/// Waits for the end if a signal has arrived: any later failure is a consequence of it.
pub(crate) fn let_signals_end() {
    while STOPPED.load(Ordering::SeqCst) && thread::current().name() != Some(EAR) {
        thread::park();
    }
}

/// Writes as much on standard error as it accepts without waiting. Nobody may read it, or another thread may wait for
/// that while it holds the lock.
fn tell_at_once(text: &str) {
    #[cfg(unix)]
    {
        use rustix::event::{PollFd, PollFlags, Timespec, poll};
        /// Bytes that a pipe accepts at once if it is ready.
        const PIPE_BYTES: usize = 4096;
        let (error, at_once) = (rustix::stdio::stderr(), Timespec::default());
        let mut asked = [PollFd::new(&error, PollFlags::OUT)];
        if poll(&mut asked, Some(&at_once)).is_ok_and(|ready| ready > 0) {
            let _ = rustix::io::write(error, &text.as_bytes()[..text.len().min(PIPE_BYTES)]);
        }
    }
    #[cfg(not(unix))]
    let _ = std::io::stderr().write_all(text.as_bytes());
}

/// Exit code after an internal error.
const FAULT: i32 = 101;

/// Replaces the message of a panic by one sentence and exit code 101, except with `RUST_BACKTRACE` set.
pub(crate) fn end_in_one_sentence() {
    if std::env::var_os("RUST_BACKTRACE").is_some_and(|value| value != "0") {
        return;
    }
    std::panic::set_hook(Box::new(|info| {
        static TOLD: AtomicBool = AtomicBool::new(false);
        let_signals_end();
        if !TOLD.swap(true, Ordering::SeqCst) {
            let told = if JSON.load(Ordering::Relaxed) {
                object("fault", &sentence(info))
            } else {
                format!("error: {}", line(sentence(info)))
            };
            // Standard error may be closed: this must not cause a second panic.
            let _ = writeln!(std::io::stderr(), "{told}");
            output::abandon();
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
        "internal error, please report it with its input: {} at {}",
        text.unwrap_or_default().replace('\n', " "),
        place.unwrap_or_default()
    )
}

/// The system's allocator; when memory runs out, the program ends with one sentence.
struct OrSentence;

#[global_allocator]
static ALLOCATOR: OrSentence = OrSentence;

/// Returns the allocated memory, or ends the program without allocating.
fn given(memory: *mut u8, bytes: usize) -> *mut u8 {
    static TOLD: AtomicBool = AtomicBool::new(false);
    if memory.is_null() {
        if !TOLD.swap(true, Ordering::SeqCst) {
            let (before, behind) = match JSON.load(Ordering::Relaxed) {
                true => (r#"{"error":{"class":"memory","message":""#, r#""}}"#),
                false => ("error: ", ""),
            };
            let _ = writeln!(
                std::io::stderr(),
                "{before}no memory left: {bytes} more bytes are needed; request less work or allow more memory{behind}"
            );
            output::abandon();
        }
        signal_hook::low_level::exit(1);
    }
    memory
}

// SAFETY: every call is passed unchanged to the system's allocator.
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
