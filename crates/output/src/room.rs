//! Resources of the machine: free memory, disk space and processor time.

use crate::place::folder;
use std::fs;
use std::path::Path;

/// Assumed free memory in bytes if the system does not report it.
const UNKNOWN: f64 = 8e9;
/// Fraction of the free memory that work may use; the rest is for the program and for errors of the forecast.
const USABLE: f64 = 0.85;

/// Largest number of threads: far more than the processors of any machine, and few enough to start.
pub const MOST_THREADS: usize = 1024;

/// Memory in bytes that work may use, limited by the machine, the container and the process (`ulimit -v`).
pub fn free_memory() -> f64 {
    let free = [machine(), container(), free_address_space()];
    let least = free.into_iter().flatten().reduce(f64::min);
    USABLE * least.unwrap_or(UNKNOWN)
}

/// Free bytes on the disk of a file, if the system reports them.
pub fn free_disk(path: &Path) -> Option<f64> {
    #[cfg(unix)]
    if let Ok(disk) = rustix::fs::statvfs(folder(path)) {
        return Some(disk.f_bavail as f64 * disk.f_frsize as f64);
    }
    let _ = folder(path);
    None
}

/// Processor time of this process in s, over all threads, if the system reports it.
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

/// Memory that the machine could give to a new program.
fn machine() -> Option<f64> {
    line_of("/proc/meminfo", "MemAvailable:", 1).map(|kilobytes| 1024.0 * kilobytes)
}

/// Memory that the control groups of this process may still use.
fn container() -> Option<f64> {
    let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
    left_in(Path::new("/sys/fs/cgroup"), &groups)
}

/// Free memory in the control groups that a text such as `/proc/self/cgroup` lists; their files are below `root`. Both
/// versions of control groups and all visible parent groups are considered.
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

/// Free memory of a group: its limit minus its use, of which cached files can be dropped.
fn left(group: &Path, [limit, taken, dropped]: [&str; 3]) -> Option<f64> {
    let number = |name| {
        let text = fs::read_to_string(group.join(name)).ok()?;
        text.trim().parse::<f64>().ok()
    };
    let dropped = line_of(group.join("memory.stat"), dropped, 1).unwrap_or(0.0);
    Some((number(limit)? - (number(taken)? - dropped).max(0.0)).max(0.0))
}

/// Free address space of the process in bytes, if it is limited (`ulimit -v`).
pub fn free_address_space() -> Option<f64> {
    let limit = line_of("/proc/self/limits", "Max address space", 3)?;
    let taken = line_of("/proc/self/status", "VmSize:", 1).unwrap_or(0.0);
    Some((limit - 1024.0 * taken).max(0.0))
}

/// A word, as a number, in the first line of a file that begins with `start`.
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
        // version 1: the outer group has no limit, cached files can be dropped
        write("memory/a/memory.limit_in_bytes", "9223372036854771712\n");
        write("memory/a/memory.usage_in_bytes", "5000\n");
        write("memory/a/b/memory.limit_in_bytes", "1000\n");
        write("memory/a/b/memory.usage_in_bytes", "700\n");
        write(
            "memory/a/b/memory.stat",
            "cache 400\ntotal_inactive_file 200\n",
        );
        assert_eq!(left(first), Some(500.0));
        // version 2: the outer group has the lower limit, and exceeds it
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
