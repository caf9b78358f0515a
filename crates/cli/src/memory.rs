//! How much memory a command may take.

use crate::failure::Failure;
use clap::Args;
use std::fs;

/// One flag, the same in every command that can take much.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct MemoryLimit {
    /// Memory that the work may take in GB; what the machine has free otherwise.
    #[arg(long, value_name = "GB", value_parser = gigabytes)]
    max_memory: Option<f64>,
}

/// Memory in bytes where the system does not say what there is.
const UNKNOWN: f64 = 8e9;

/// Part of what is free that the work may take: the rest is for the program and for what a forecast misses.
const USABLE: f64 = 0.85;

impl MemoryLimit {
    /// The limit in bytes.
    pub(crate) fn bytes(self) -> f64 {
        self.max_memory.map_or_else(
            || {
                let free = [machine(), container(), process()];
                let least = free.into_iter().flatten().reduce(f64::min);
                USABLE * least.unwrap_or(UNKNOWN)
            },
            |gigabytes| 1e9 * gigabytes,
        )
    }

    /// Refuses work that takes more.
    pub(crate) fn check(self, needed: f64, what: &str, change: &str) -> Result<(), Failure> {
        let limit = self.bytes();
        if needed <= limit {
            return Ok(());
        }
        Err(Failure::input(format!(
            "{what} needs about {:.3} GB of memory, more than the {:.3} GB allowed: {change}, or give --max-memory GB",
            1e-9 * needed,
            1e-9 * limit
        )))
    }
}

fn gigabytes(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        Ok(_) | Err(_) => Err("it is outside (0, inf)".to_owned()),
    }
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
