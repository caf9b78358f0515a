//! Number of threads: `RAYON_NUM_THREADS`, or else the number of processors; fewer if the system starts fewer.

use crate::failure::{Failure, say};
use formats::SceneError;
use output::{MOST_THREADS, free_address_space};
use rayon::{ThreadBuilder, ThreadPoolBuilder};
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::thread;

/// Environment variable with the number of threads.
const KEY: &str = "RAYON_NUM_THREADS";
/// Stack size of each thread in bytes, whatever RUST_MIN_STACK is: the default of the standard library.
const STACK: usize = 2 << 20;
/// Address space in bytes that a thread needs: its stack and the arena of the C library's allocator. If it runs out, a
/// thread that has just started ends the program (test: `crates/cli/tests/ends.rs`).
const THREAD: f64 = (STACK + (64 << 20)) as f64;

/// Starts the threads of the pool.
///
/// They are started one by one before the pool is built, because a pool cannot be built with fewer threads after one of
/// them failed to start (`ulimit -u`, `pids.max`).
pub(crate) fn start() -> Result<(), Failure> {
    let asked = std::env::var(KEY).ok().and_then(|text| text.parse().ok());
    let wanted = match asked {
        None | Some(0) => thread::available_parallelism()
            .map_or(1, usize::from)
            .min(MOST_THREADS),
        Some(count) if count > MOST_THREADS => {
            let range = format!("[1, {MOST_THREADS}]");
            return Err(SceneError::out_of_range(KEY, count as f64, &range).into());
        }
        Some(count) => count,
    };
    let (give, take) = mpsc::channel::<ThreadBuilder>();
    let take = Arc::new(Mutex::new(take));
    let starts = |_: &usize| {
        let take = Arc::clone(&take);
        let worker = move || {
            let place = take.lock().unwrap_or_else(PoisonError::into_inner).recv();
            if let Ok(place) = place {
                place.run();
            }
        };
        thread::Builder::new()
            .stack_size(STACK)
            .spawn(worker)
            .is_ok()
    };
    let room = free_address_space().map_or(wanted, |bytes| (0.5 * bytes / THREAD) as usize);
    let count = (0..wanted.min(room.max(1))).take_while(starts).count();
    if count < wanted {
        say(format!(
            "warning: continuing with {count} of {wanted} threads: the system starts no more (ulimit -u, pids.max), or more would need over half of the allowed memory (ulimit -v); set {KEY} to choose the number"
        ));
    }
    let pool = ThreadPoolBuilder::new().num_threads(count.max(1));
    let made = match count {
        0 => pool.use_current_thread().build_global(),
        _ => {
            let hand = move |place| {
                let sent = give.send(place);
                sent.map_err(|error| std::io::Error::other(error.to_string()))
            };
            pool.spawn_handler(hand).build_global()
        }
    };
    made.map_err(Failure::work)
}
