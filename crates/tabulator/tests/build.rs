//! Building: bytes, interruptions, files in the way, bad settings.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use tabulator::{Axis, BuildError, Existing, Extension, Grid, OutputError, Progress};
use tabulator::{
    Shard, Silent, build, build_over, build_shard, check_table, differences, extend, merge,
};

/// Two slices of 8 by 8 nodes and three beyond each outer edge.
fn small() -> Grid {
    Grid {
        poisson_ratios: vec![0.25, 0.3],
        cell_width: 0.25,
        r: Axis::uniform(0.875, 0.125),
        z: Axis::uniform(0.875, 0.125),
        tail_terms: 8,
        tolerance: 1e-7,
        ..Grid::demo()
    }
}

fn journal(path: &Path) -> PathBuf {
    PathBuf::from(format!("{}.journal", path.display()))
}

/// Panics after some blocks, as a killed process would end.
struct Interrupt(Mutex<u64>);

impl Progress for Interrupt {
    fn total(&self, _stage: &str, _total: u64) {}
    fn advance(&self, done: u64) {
        let mut left = self.0.lock().unwrap();
        *left = left.saturating_sub(done);
        assert!(*left > 0, "interrupted on purpose");
    }
}

#[test]
fn an_interrupted_build_goes_on_and_gives_the_same_content() {
    let folder = tempfile::tempdir().unwrap();
    let (straight, broken) = (
        folder.path().join("straight.h5"),
        folder.path().join("broken.h5"),
    );
    let summary = build(&small(), &straight, &Silent).unwrap();
    assert_eq!(summary.resumed_blocks, 0);
    assert!(!journal(&straight).exists());

    let interrupt = Interrupt(Mutex::new(9));
    let crash = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        build(&small(), &broken, &interrupt)
    }));
    assert!(crash.is_err());
    assert!(!broken.exists());
    // The last record was cut short by the power failure.
    let bytes = std::fs::read(journal(&broken)).unwrap();
    std::fs::write(journal(&broken), &bytes[..bytes.len() - 5]).unwrap();

    let resumed = build(&small(), &broken, &Silent).unwrap();
    assert!(
        resumed.resumed_blocks >= 7,
        "{} blocks kept",
        resumed.resumed_blocks
    );
    assert_eq!(resumed.content_sha256, summary.content_sha256);
    let (a, b) = (
        lookup::read(&straight).unwrap(),
        lookup::read(&broken).unwrap(),
    );
    assert!(differences(&a, &b).is_empty());
    assert!(!journal(&broken).exists());
}

/// An extension depends on the numbers of its table, so its journal is not part of a build with the same settings.
#[test]
fn a_build_takes_nothing_that_an_interrupted_extension_left() {
    let folder = tempfile::tempdir().unwrap();
    let (path, straight) = (
        folder.path().join("t.h5"),
        folder.path().join("straight.h5"),
    );
    build(&small(), &path, &Silent).unwrap();
    std::fs::copy(&path, &straight).unwrap();
    let higher = Extension {
        z_max: Some(1.0),
        ..Extension::default()
    };
    let expected = extend(&straight, &higher, &Silent).unwrap();
    let interrupt = Interrupt(Mutex::new(30));
    let crash = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        extend(&path, &higher, &interrupt)
    }));
    assert!(crash.is_err());
    let mut grid = small();
    grid.z.extended_to = Some(1.0);
    let fresh = folder.path().join("fresh.h5");
    std::fs::copy(journal(&path), journal(&fresh)).unwrap();
    assert!(matches!(
        build(&grid, &fresh, &Silent),
        Err(BuildError::Output(OutputError::Begun(..)))
    ));
    // Nor does the extension of another table with these settings.
    let mut other = lookup::read(&path).unwrap();
    let kept = std::fs::read(&path).unwrap();
    other.slices[0].remainder[0] += 1e-3;
    std::fs::remove_file(&path).unwrap();
    lookup::write(&path, &other).unwrap();
    assert!(matches!(
        extend(&path, &higher, &Silent),
        Err(BuildError::Output(OutputError::Begun(..)))
    ));
    std::fs::write(&path, kept).unwrap();
    let resumed = extend(&path, &higher, &Silent).unwrap();
    assert!(resumed.resumed_blocks > 0);
    assert_eq!(resumed.content_sha256, expected.content_sha256);
}

#[test]
fn an_extension_by_nothing_writes_the_same_table_without_computing() {
    struct None;
    impl Progress for None {
        fn total(&self, stage: &str, total: u64) {
            assert!(stage != "kernels" || total == 0, "{total} blocks computed");
        }
        fn advance(&self, _done: u64) {}
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    let first = build(&small(), &path, &Silent).unwrap();
    let again = extend(&path, &Extension::default(), &None).unwrap();
    assert_eq!(first.content_sha256, again.content_sha256);
}

#[test]
fn the_number_of_threads_does_not_change_the_content() {
    let folder = tempfile::tempdir().unwrap();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let path = folder.path().join(format!("{threads}.h5"));
        pool.install(|| build(&small(), &path, &Silent))
            .unwrap()
            .content_sha256
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn a_finished_table_passes_its_check_and_a_wrong_one_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    build(&small(), &path, &Silent).unwrap();
    let report = check_table(&path, 12, 3).unwrap();
    assert_eq!(report.nodes_checked, 12);
    assert!(report.bad.is_empty(), "{:?}", report.bad);

    let mut content = lookup::read(&path).unwrap();
    let (cells, depths) = (content.slices[1].cells, content.z.len());
    // Node r[2], z[3], field stress_zz, cell 4.
    content.slices[1].remainder[((2 * depths + 3) * 6 + 4) * cells + 4] += 1e-3;
    std::fs::remove_file(&path).unwrap();
    lookup::write(&path, &content).unwrap();
    let report = check_table(&path, usize::MAX, 3).unwrap();
    let [bad] = report.bad.as_slice() else {
        panic!("{:?}", report.bad);
    };
    let place = "nu = 0.3, r/r0 = 0.25, z/r0 = 0.375: stress_zz (remainder) differs by ";
    assert!(bad.starts_with(place), "{bad}");
}

#[test]
fn files_in_the_way_are_kept_unless_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    std::fs::write(&path, "precious").unwrap();
    assert!(matches!(
        build(&small(), &path, &Silent),
        Err(BuildError::Output(OutputError::Exists { .. }))
    ));
    assert_eq!(std::fs::read(&path).unwrap(), b"precious");
    build_over(&small(), &path, Existing::Replace, &Silent).unwrap();
    lookup::Table::open(&path).unwrap();

    // The journal of other settings is not touched.
    let other = folder.path().join("other.h5");
    std::fs::write(
        journal(&other),
        "hertzlamb kernel blocks 1, settings 0123456789abcdef\n",
    )
    .unwrap();
    assert!(matches!(
        build(&small(), &other, &Silent),
        Err(BuildError::Output(OutputError::Begun(..)))
    ));
    build_over(&small(), &other, Existing::Replace, &Silent).unwrap();
    assert!(!journal(&other).exists());

    // A link under the name of the journal is not written through.
    #[cfg(unix)]
    {
        let linked = folder.path().join("linked.h5");
        std::fs::write(&path, "precious").unwrap();
        std::os::unix::fs::symlink(&path, journal(&linked)).unwrap();
        let message = build(&small(), &linked, &Silent).unwrap_err().to_string();
        assert!(message.contains("linked.h5.journal"), "{message}");
        assert_eq!(std::fs::read(&path).unwrap(), b"precious");
        assert!(journal(&linked).is_symlink());
    }

    let nowhere = folder.path().join("no/such/folder/t.h5");
    let message = build(&small(), &nowhere, &Silent).unwrap_err().to_string();
    assert!(
        message.starts_with("cannot write ") && message.contains("no/such/folder"),
        "{message}"
    );
}

#[test]
fn settings_outside_their_range_are_named() {
    let message = |change: fn(&mut Grid)| {
        let mut grid = small();
        change(&mut grid);
        grid.validate().unwrap_err().to_string()
    };
    assert_eq!(
        message(|g| g.cell_width = 0.0),
        "grid: cell_width = 0 is outside [0.005, 1]"
    );
    assert_eq!(
        message(|g| g.poisson_ratios = vec![0.5]),
        "grid: poisson_ratios = 0.5 is outside [-0.95, 0.495]"
    );
    assert_eq!(
        message(|g| g.poisson_ratios.clear()),
        "grid: poisson_ratios = NaN is outside a list of at least one"
    );
    assert_eq!(
        message(|g| g.r.max = f64::NAN),
        "grid: r.max = NaN is outside [0.25, 100]"
    );
    assert_eq!(
        message(|g| g.stencil_points = 5),
        "grid: stencil_points = 5 is outside {2, 4, 6, 8}"
    );
    let message_of_a_large_one = message(|g| {
        g.r = Axis::uniform(100.0, 0.055);
        g.z = Axis::uniform(100.0, 0.055);
        g.cell_width = 0.01;
    });
    assert!(
        message_of_a_large_one.starts_with("grid: size of the table in memory in GB = 20625."),
        "{message_of_a_large_one}"
    );
    assert_eq!(
        message(|g| g.z.spacing = 0.5),
        "grid: z: number of nodes = 3 is outside [8, 2000]"
    );
}

#[test]
fn a_grid_file_is_read_back_and_unknown_keys_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grid.toml");
    std::fs::write(&path, small().to_toml().unwrap()).unwrap();
    assert_eq!(Grid::from_file(&path).unwrap(), small());
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/kernel-grid.toml");
    assert_eq!(Grid::from_file(Path::new(example)).unwrap().r.max, 3.0);
    std::fs::write(&path, "poisson_ratios = [0.3]\nspacng = 1\n").unwrap();
    let message = Grid::from_file(&path).unwrap_err().to_string();
    assert!(
        message.contains("grid.toml") && message.contains("line 2") && message.contains("spacng"),
        "{message}"
    );
    assert!(!message.contains('\n'), "{message}");
    let text = small()
        .to_toml()
        .unwrap()
        .replace("cell_width = 0.25", "cell_width = 25.0");
    std::fs::write(&path, text).unwrap();
    let message = Grid::from_file(&path).unwrap_err().to_string();
    assert!(
        message.ends_with("grid.toml: grid: cell_width = 25 is outside [0.005, 1]"),
        "{message}"
    );
}

#[test]
fn shards_make_the_same_table_and_gaps_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, joined) = (
        folder.path().join("whole.h5"),
        folder.path().join("joined.h5"),
    );
    let summary = build(&small(), &whole, &Silent).unwrap();
    let shards: Vec<PathBuf> = (1..=3)
        .map(|i| folder.path().join(format!("{i}.shard")))
        .collect();
    for (i, path) in shards.iter().enumerate() {
        build_shard(
            &small(),
            Shard {
                index: i + 1,
                count: 3,
            },
            path,
            &Silent,
        )
        .unwrap();
    }
    let message = merge(&shards[1..], &joined, Existing::Keep, &Silent)
        .unwrap_err()
        .to_string();
    assert!(
        message
            .starts_with("15 of 43 blocks are missing, the first for poisson_ratio = 0.25, row 0"),
        "{message}"
    );
    assert!(!joined.exists());
    let merged = merge(&shards, &joined, Existing::Keep, &Silent).unwrap();
    assert_eq!(merged.content_sha256, summary.content_sha256);

    let other = Grid {
        tail_terms: 9,
        ..small()
    };
    let stranger = folder.path().join("stranger.shard");
    build_shard(
        &other,
        Shard {
            index: 1,
            count: 30,
        },
        &stranger,
        &Silent,
    )
    .unwrap();
    let mixed = [shards[0].clone(), stranger];
    assert!(matches!(
        merge(&mixed, &joined, Existing::Replace, &Silent),
        Err(BuildError::Refused { culprit, sentence })
            if culprit.file.as_deref() == Some(&mixed[1]) && sentence.contains("other settings")
    ));
    assert!(matches!(
        merge(&[whole], &joined, Existing::Replace, &Silent),
        Err(BuildError::Refused { sentence, .. }) if sentence.contains("is not a shard")
    ));
}
