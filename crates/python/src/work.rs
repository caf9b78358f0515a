//! Long computations: run without the interpreter's lock, can be interrupted by Ctrl-C, and report their progress.
//!
//! The work runs on a separate thread. Meanwhile the caller's thread waits; at intervals it attaches to the interpreter,
//! checks for signals and calls the progress function.

use crate::errors::{outside, plain, raise, whole_in};
use output::MOST_THREADS;
use pyo3::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};
use tabulator::Progress;

/// Interval between two checks for signals.
const LOOK: Duration = Duration::from_millis(50);
/// Interval between two calls of the progress function.
const TELL: Duration = Duration::from_millis(100);
/// Longest wait for interrupted work to end; later the work ends in the background, and its result is dropped.
const GRACE: Duration = Duration::from_millis(150);

/// Allowed range of the number of threads, as text.
fn thread_range() -> String {
    format!("[1, {MOST_THREADS}]")
}

/// A requested number of threads, in [1, [`MOST_THREADS`]].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Threads(usize);

impl<'py> FromPyObject<'_, 'py> for Threads {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        whole_in("threads", &value, 1..=MOST_THREADS, &thread_range()).map(Self)
    }
}

/// Id of the process that started the threads of the library; 0 before any was started.
static OWNER: AtomicU32 = AtomicU32::new(0);

/// Progress of a computation, and the request to stop it.
#[derive(Debug, Default)]
pub(crate) struct Ticker {
    done: AtomicU64,
    total: AtomicU64,
    stopped: AtomicBool,
}

impl Ticker {
    /// Sets the number of finished units of work.
    pub(crate) fn at(&self, done: u64) {
        self.done.store(done, Ordering::Relaxed);
    }

    /// Unwinds to [`run`] if the work is to stop.
    fn or_stop(&self) {
        if self.is_stopped() {
            // no message is printed; unfinished work is dropped
            resume_unwind(Box::new(()));
        }
    }

    /// Whether the work is to stop.
    pub(crate) fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

impl Progress for Ticker {
    fn total(&self, _stage: &str, total: u64) {
        self.done.store(0, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    fn advance(&self, done: u64) {
        self.done.fetch_add(done, Ordering::Relaxed);
        self.or_stop();
    }

    fn slice(&self, _poisson_ratio: f64) {
        self.or_stop();
    }
}

/// Runs work of at most a millisecond on the caller's thread.
pub(crate) fn run_short<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    own()?;
    Ok(py.detach(work))
}

/// Runs work that may take longer, on `threads` threads (default: one for each processor).
///
/// `progress` is called with the finished and the total units of work. An exception of it, or of a signal handler, stops
/// the work and is raised.
pub(crate) fn run<T: Send + 'static>(
    py: Python<'_>,
    threads: Option<Threads>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&Ticker) -> T + Send + 'static,
) -> PyResult<T> {
    own()?;
    let ticker = Arc::new(Ticker::default());
    let (sender, mut receiver) = channel();
    let watched = Arc::clone(&ticker);
    let body = move || {
        let work = AssertUnwindSafe(|| within(threads, || work(&watched)));
        let done = catch_unwind(work).unwrap_or_else(|panic| Err(in_words(&*panic)));
        // the receiver is gone after an interruption
        let _ = sender.send(done);
    };
    let worker = std::thread::Builder::new().name("hertzlamb".to_owned());
    worker.spawn(body)?;
    let mut told = Instant::now();
    loop {
        let received;
        (received, receiver) = py.detach(move || (receiver.recv_timeout(LOOK), receiver));
        match received {
            Ok(Ok(result)) => {
                tell(py, progress.as_ref(), &ticker)?;
                return Ok(result);
            }
            Ok(Err(reason)) => return Err(raise(reason)),
            Err(RecvTimeoutError::Disconnected) => {
                return Err(raise("the work ended without a result"));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        let mut heard = py.check_signals();
        if heard.is_ok() && told.elapsed() >= TELL {
            told = Instant::now();
            heard = tell(py, progress.as_ref(), &ticker);
        }
        if let Err(error) = heard {
            ticker.stopped.store(true, Ordering::Relaxed);
            py.detach(move || drop(receiver.recv_timeout(GRACE)));
            return Err(error);
        }
    }
}

/// Runs the work in a pool of `threads` threads, by default in the global pool.
fn within<T: Send>(threads: Option<Threads>, work: impl FnOnce() -> T + Send) -> Result<T, String> {
    let Some(Threads(count)) = threads else {
        return Ok(work());
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
    let pool = pool.map_err(|error| error.to_string())?;
    Ok(pool.install(work))
}

/// Calls the progress function.
fn tell(py: Python<'_>, progress: Option<&Py<PyAny>>, ticker: &Ticker) -> PyResult<()> {
    let total = ticker.total.load(Ordering::Relaxed);
    if let Some(progress) = progress.filter(|_| total > 0) {
        progress.call1(py, (ticker.done.load(Ordering::Relaxed), total))?;
    }
    Ok(())
}

/// Checks that work can start in this process.
///
/// Raises `DomainError` if `RAYON_NUM_THREADS` exceeds [`MOST_THREADS`], and `ForkError` if the process was forked from one
/// that had computed: it would wait forever for the threads of its parent.
fn own() -> PyResult<()> {
    let asked = std::env::var("RAYON_NUM_THREADS").unwrap_or_default();
    let too_many = |threads: usize| threads > MOST_THREADS;
    if asked.parse().is_ok_and(too_many) {
        return Err(outside("RAYON_NUM_THREADS", &asked, &thread_range()));
    }
    let process = std::process::id();
    match OWNER.compare_exchange(0, process, Ordering::Relaxed, Ordering::Relaxed) {
        Err(owner) if owner != process => {
            let message = format!(
                "this process was forked from process {owner} after that process had computed, and the threads of hertzlamb do not survive a fork: start processes with multiprocessing.get_context(\"spawn\") or \"forkserver\""
            );
            Err(plain("ForkError", &message))
        }
        Ok(_) | Err(_) => Ok(()),
    }
}

/// Message of a panic.
fn in_words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or(panic.downcast_ref::<&str>().copied());
    format!("the program has a fault: {}", text.unwrap_or("it panicked"))
}
