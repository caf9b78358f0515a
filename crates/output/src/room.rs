//! What the machine has left, and what it has given.

use crate::place::folder;
use std::fs;
use std::path::Path;

/// Memory in bytes where the system does not say what there is.
const UNKNOWN: f64 = 8e9;
/// Part of what is free that work may take: the rest is for the program and for what a forecast misses.
const USABLE: f64 = 0.85;

/// Memory in bytes that work may take: of the machine, of the container, of the process (`ulimit -v`).
pub fn free_memory() -> f64 {
    let free = [machine(), container(), process()];
    let least = free.into_iter().flatten().reduce(f64::min);
    USABLE * least.unwrap_or(UNKNOWN)
}

/// Bytes that the disk of a file has left, where the system says so.
pub fn free_disk(path: &Path) -> Option<f64> {
    #[cfg(unix)]
    if let Ok(disk) = rustix::fs::statvfs(folder(path)) {
        return Some(disk.f_bavail as f64 * disk.f_frsize as f64);
    }
    let _ = folder(path);
    None
}

/// Seconds of all threads that the processor has spent on this process, where the system says so.
pub fn processor_s() -> Option<f64> {
    #[cfg(unix)]
    {
        use rustix::time::{ClockId, clock_gettime};
        let spent = clock_gettime(ClockId::ProcessCPUTime);
        Some(spent.tv_sec as f64 + 1e-9 * spent.tv_nsec as f64)
    }
    #[cfg(not(unix))]
    None
}

/// What the system could give a new program.
fn machine() -> Option<f64> {
    line_of("/proc/meminfo", "MemAvailable:", 1).map(|kilobytes| 1024.0 * kilobytes)
}

/// What the group of processes that this one is in may still take.
fn container() -> Option<f64> {
    let number = |name: &str| {
        let text = fs::read_to_string(format!("/sys/fs/cgroup/memory.{name}")).ok()?;
        text.trim().parse::<f64>().ok()
    };
    Some((number("max")? - number("current")?).max(0.0))
}

/// What the process may still take of its address space (`ulimit -v`).
fn process() -> Option<f64> {
    let limit = line_of("/proc/self/limits", "Max address space", 3)?;
    let taken = line_of("/proc/self/status", "VmSize:", 1).unwrap_or(0.0);
    Some((limit - 1024.0 * taken).max(0.0))
}

/// A word of the line of a file that starts with some words, as a number.
fn line_of(path: &str, start: &str, word: usize) -> Option<f64> {
    let text = fs::read_to_string(path).ok()?;
    let line = text.lines().find(|line| line.starts_with(start))?;
    line.split_whitespace().nth(word)?.parse().ok()
}
