//! How the program ends before its work is done: stopped by somebody, by a fault of its own, or without memory.

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

/// What is kept when the command is stopped now.
static NOTE: Mutex<Option<Box<dyn Fn() -> String + Send>>> = Mutex::new(None);

/// Whether a signal is about to end the program.
static STOPPED: AtomicBool = AtomicBool::new(false);
/// The thread that ends it.
const EAR: &str = "interrupt";

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
            // a new line, behind what a bar of progress shows
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

/// Waits for the end where a signal has come: what the program does or fails in from then on is a consequence.
pub(crate) fn let_signals_end() {
    while STOPPED.load(Ordering::SeqCst) && thread::current().name() != Some(EAR) {
        thread::park();
    }
}

/// Writes on standard error what it takes at once. Nobody may read it, and another thread may wait for that with its lock.
fn tell_at_once(text: &str) {
    #[cfg(unix)]
    {
        use rustix::event::{PollFd, PollFlags, Timespec, poll};
        /// Bytes that a pipe takes at least where it takes any.
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

/// Exit code of a program that met a fault of its own.
const FAULT: i32 = 101;

/// Ends the program with one sentence where it would unwind; with `RUST_BACKTRACE` as usual.
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
            // Standard error may be closed: that must not be a second fault.
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
        "this is a fault of the program, please report it with its input: {} at {}",
        text.unwrap_or_default().replace('\n', " "),
        place.unwrap_or_default()
    )
}

/// The system's allocator; where it has nothing more, the program ends in a sentence.
struct OrSentence;

#[global_allocator]
static ALLOCATOR: OrSentence = OrSentence;

/// What was given, or the end of the program, which takes no memory either.
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
                "{before}there is no memory left, of which {bytes} bytes are needed: ask for less, or allow more{behind}"
            );
            output::abandon();
        }
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
