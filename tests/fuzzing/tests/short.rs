//! A short campaign of each target: no panic, nothing that takes long.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use fuzzing::{Seeds, Target, Verdict, campaign};
use std::path::{Path, PathBuf};

fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus")
}

/// Inputs of each target.
fn count(target: Target) -> usize {
    match target {
        Target::Impact => 300,
        Target::Part | Target::Shard | Target::Table | Target::Sealed => 1000,
        Target::Sweep | Target::Results | Target::Journal => 2000,
        Target::Scene | Target::Grid | Target::Materials | Target::Record | Target::Response => {
            5000
        }
    }
}

#[test]
fn every_seed_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let seeds = Seeds::new(&corpus(), folder.path()).unwrap();
    for target in Target::ALL {
        for (index, seed) in seeds.of(target).iter().enumerate() {
            // one shard of two is no table
            let whole = target != Target::Shard;
            let verdict = target.judge(seed, folder.path());
            assert_eq!(verdict == Verdict::Read, whole, "{} {index}", target.name());
        }
    }
}

#[test]
fn damaged_and_invented_inputs_are_read_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let seeds = Seeds::new(&corpus(), folder.path()).unwrap();
    for target in Target::ALL {
        let report = campaign(target, &seeds, count(target), 1);
        if let Some((input, what)) = report.faults.first() {
            panic!(
                "{}: {what} on {:?}",
                target.name(),
                String::from_utf8_lossy(input)
            );
        }
        assert_eq!(report.tried, count(target));
        assert!(
            report.read < report.tried,
            "{}: nothing refused",
            target.name()
        );
    }
}
