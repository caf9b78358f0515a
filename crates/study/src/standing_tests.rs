//! Where the default path stands, by errors and work counts.

use crate::effort::Effort;
use crate::question;
use crate::record::{Question, Record};
use crate::standing::{LEVELS, Measure, standings};
use crate::tables::{Density, Spacing};
use std::sync::OnceLock;
use tabulator::Silent;

/// Measured once for all tests.
fn kernels() -> &'static [Record] {
    static RECORDS: OnceLock<Vec<Record>> = OnceLock::new();
    RECORDS.get_or_init(|| question::kernels::measure(Effort::Quick, &[], &Silent).unwrap())
}

#[test]
fn the_single_integral_meets_its_tolerance_and_no_inversion_comes_near_its_work() {
    let records = kernels();
    for record in records.iter().filter(|r| r.method == "single integral") {
        let tolerance: f64 = record.setting.replace("tolerance ", "").parse().unwrap();
        assert!(record.error.max <= 3.0 * tolerance, "{record:?}");
        assert!(!record.failed());
    }
    // the adaptive rule has no counter; the fixed rule bounds what one integral needs
    let scenes: Vec<&str> = crate::work_precision::distinct(records.iter().map(|r| r.scene));
    for scene in scenes {
        let rows: Vec<&Record> = records.iter().filter(|r| r.scene == scene).collect();
        for level in LEVELS {
            let least = |fixed: bool| {
                rows.iter()
                    .filter(|r| (r.method == "single integral, fixed rule") == fixed)
                    .filter(|r| r.error.max <= level)
                    .filter_map(|r| r.work)
                    .fold(f64::INFINITY, f64::min)
            };
            let (fixed, inversions) = (least(true), least(false));
            assert!(
                inversions == f64::INFINITY || inversions > 2.0 * fixed,
                "{scene} at {level:e}: {inversions} against {fixed}"
            );
        }
    }
}

#[test]
fn talbot_leaves_the_numbers_before_the_last_front_and_not_after() {
    let records = kernels();
    let worst = |scene: &str| {
        records
            .iter()
            .filter(|r| r.method == "fixed Talbot" && r.scene == scene)
            .map(|r| (r.error.max, r.failed()))
            .fold((f64::INFINITY, false), |a, b| if b.0 < a.0 { b } else { a })
    };
    let (across, failed) = worst("interior point, across the fronts");
    assert!(across > 1e10 && failed);
    let (after, failed) = worst("interior point, after the last front");
    assert!(after < 1e-3 && !failed, "{after:e}");
}

#[test]
fn the_implicit_march_is_on_the_front_by_work() {
    let records = question::force::measure(Effort::Quick, &|| ()).unwrap();
    for standing in standings(&records, Measure::Work) {
        // nothing that counts its work is more than a tenth below the default
        assert!(
            standing.own.is_none() || standing.on_front(1.1),
            "{standing:?}"
        );
    }
    let reached = |level: f64| {
        standings(&records, Measure::Work)
            .iter()
            .any(|s| s.scene == question::force::DISC && s.level == level && s.own.is_some())
    };
    assert!(reached(1e-3) && reached(1e-6));
    let explicit: Vec<&Record> = records
        .iter()
        .filter(|r| r.method.starts_with("wave explicit"))
        .collect();
    assert!(explicit.len() >= 3 && explicit.iter().all(|r| r.error.max > 1e-4));
    // hertz has no error of its own to show: it is right only where nothing is radiated
    let hertz = |scene: &str| {
        records
            .iter()
            .find(|r| r.scene == scene && r.method == "hertz")
            .map(|r| r.error.max)
            .unwrap()
    };
    assert!(hertz(question::force::DISC) > 0.1);
    assert!(hertz(question::force::BALL) < 0.01);
}

#[test]
fn smooth_cells_beat_linear_ones_and_the_remainder_the_whole_response() {
    let density = Density::build(0.3, Spacing::Own).unwrap();
    let records = question::fields::measure(Effort::Quick, &[density], &|| ()).unwrap();
    let errors = |method: &str, part: &str| -> f64 {
        records
            .iter()
            .filter(|r| r.method == method && r.setting.contains(part))
            .map(|r| r.error.max)
            .fold(f64::INFINITY, f64::min)
    };
    let (linear, smooth) = (
        errors("table", "step 0.1,"),
        errors("table, smooth cells", "step 0.1,"),
    );
    assert!(smooth < 0.2 * linear, "{smooth:e} {linear:e}");
    let whole = errors("interpolated whole response", "");
    let remainder = errors("interpolated remainder", "");
    assert!(remainder < 0.3 * whole, "{remainder:e} {whole:e}");
    // the three ways to sum are one number
    let (direct, transform) = (errors("table, direct sums", ""), errors("table, FFT", ""));
    assert!((direct / linear - 1.0).abs() < 1e-6 && (transform / linear - 1.0).abs() < 1e-6);
    assert!(
        records
            .iter()
            .all(|r| r.question == Question::Fields && r.work.is_some())
    );
    // second order: a step four times as long costs a factor of about sixteen
    let coarse = errors("table", "step 0.4,");
    assert!(
        (4.0..64.0).contains(&(coarse / linear)),
        "{coarse:e} {linear:e}"
    );
}
