//! What the machine has left, and what it has given.

use crate::place::folder;
use std::fs;
use std::path::Path;

/// Memory in bytes where the system does not say what there is.
const UNKNOWN: f64 = 8e9;
/// Part of what is free that work may take: the rest is for the program and for what a forecast misses.
const USABLE: f64 = 0.85;

/// Threads that work may be divided among: far more than machines have processors, and few enough to start.
pub const MOST_THREADS: usize = 1024;

/// Memory in bytes that work may take: of the machine, of the container, of the process (`ulimit -v`).
pub fn free_memory() -> f64 {
    let free = [machine(), container(), free_address_space()];
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

/// What the groups of processes that this one is in may still take.
fn container() -> Option<f64> {
    let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
    left_in(Path::new("/sys/fs/cgroup"), &groups)
}

/// The same of the groups that a text as in `/proc/self/cgroup` lists, whose files are below `root`: of both versions of such
/// groups, and of those around each, up to the outermost that a container sees.
fn left_in(root: &Path, groups: &str) -> Option<f64> {
    let listed = groups.lines().filter_map(|line| {
        let (controllers, path) = line.split_once(':')?.1.split_once(':')?;
        let is_memory = |name| name == "memory";
        let (folder, files) = match controllers {
            "" => (
                root.to_owned(),
                ["memory.max", "memory.current", "inactive_file"],
            ),
            names if names.split(',').any(is_memory) => (
                root.join("memory"),
                [
                    "memory.limit_in_bytes",
                    "memory.usage_in_bytes",
                    "total_inactive_file",
                ],
            ),
            _ => return None,
        };
        let around = Path::new(path.trim_start_matches('/')).ancestors();
        around
            .filter_map(|group| left(&folder.join(group), files))
            .reduce(f64::min)
    });
    listed.reduce(f64::min)
}

/// What a group may still take, by its limit, what it has, and the part of that which is copies of files and can be dropped.
fn left(group: &Path, [limit, taken, dropped]: [&str; 3]) -> Option<f64> {
    let number = |name| {
        let text = fs::read_to_string(group.join(name)).ok()?;
        text.trim().parse::<f64>().ok()
    };
    let dropped = line_of(group.join("memory.stat"), dropped, 1).unwrap_or(0.0);
    Some((number(limit)? - (number(taken)? - dropped).max(0.0)).max(0.0))
}

/// Bytes that the process may still take of its address space, where there is a limit (`ulimit -v`).
pub fn free_address_space() -> Option<f64> {
    let limit = line_of("/proc/self/limits", "Max address space", 3)?;
    let taken = line_of("/proc/self/status", "VmSize:", 1).unwrap_or(0.0);
    Some((limit - 1024.0 * taken).max(0.0))
}

/// A word of the line of a file that starts with some words, as a number.
fn line_of(path: impl AsRef<Path>, start: &str, word: usize) -> Option<f64> {
    let text = fs::read_to_string(path).ok()?;
    let line = text.lines().find(|line| line.starts_with(start))?;
    line.split_whitespace().nth(word)?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tightest_group_around_the_process_counts() {
        let root = tempfile::tempdir().unwrap();
        let write = |path: &str, text: &str| {
            let path = root.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        };
        let left = |groups: &str| left_in(root.path(), groups);
        let first = "4:pids:/a\n3:cpu,memory:/a/b\n0::/\n";
        assert_eq!(left(first), None);
        // version 1: the outer group has no limit, copies of files can be dropped
        write("memory/a/memory.limit_in_bytes", "9223372036854771712\n");
        write("memory/a/memory.usage_in_bytes", "5000\n");
        write("memory/a/b/memory.limit_in_bytes", "1000\n");
        write("memory/a/b/memory.usage_in_bytes", "700\n");
        write(
            "memory/a/b/memory.stat",
            "cache 400\ntotal_inactive_file 200\n",
        );
        assert_eq!(left(first), Some(500.0));
        // version 2: the outer group is the tighter one, and has more than it may
        write("memory.max", "max\n");
        write("memory.current", "1\n");
        write("x/memory.max", "300\n");
        write("x/memory.current", "400\n");
        write("x/y/memory.max", "800\n");
        write("x/y/memory.current", "100\n");
        assert_eq!(left("0::/x/y\n"), Some(0.0));
        assert_eq!(left("0::/z/y\n"), None);
    }
}
