//! Where the default path stands, by errors and work counts.

use crate::ComparedMethod;
use crate::measure::Effort;
use crate::question;
use crate::ranking::{LEVELS, rankings};
use crate::record::{Question, Record};
use crate::scenes::Density;
use contact::Choice;
use std::sync::OnceLock;
use tabulator::Silent;

/// Measured once for all tests.
fn kernels() -> &'static [Record] {
    static RECORDS: OnceLock<Vec<Record>> = OnceLock::new();
    RECORDS.get_or_init(|| question::kernels::measure(Effort::Quick, &[], &Silent).unwrap())
}

#[test]
fn the_single_integral_meets_its_tolerance_and_no_inversion_comes_near_it_across_the_fronts() {
    let records = kernels();
    for record in records
        .iter()
        .filter(|r| r.method == ComparedMethod::SingleIntegral)
    {
        let tolerance: f64 = record.setting.replace("tolerance ", "").parse().unwrap();
        assert!(record.error_max <= 3.0 * tolerance, "{record:?}");
        assert!(!record.failed());
    }
    let inversions = records.iter().filter(|r| r.work.is_some_and(|n| n > 0.0));
    let across = inversions.filter(|r| !r.scene.contains("after the last front"));
    let least = across.map(|r| r.error_max).fold(f64::INFINITY, f64::min);
    assert!((1e-4..1e-2).contains(&least), "{least:e}");
}

#[test]
fn talbot_leaves_the_numbers_before_the_last_front_and_not_after() {
    let records = kernels();
    let worst = |scene: &str| {
        records
            .iter()
            .filter(|r| r.method == ComparedMethod::FixedTalbot && r.scene == scene)
            .map(|r| (r.error_max, r.failed()))
            .fold((f64::INFINITY, false), |a, b| if b.0 < a.0 { b } else { a })
    };
    let (across, failed) = worst("interior point, across the fronts");
    assert!(across > 1e10 && failed);
    let (after, failed) = worst("interior point, after the last front");
    assert!(after < 1e-3 && !failed, "{after:e}");
}

/// Least work of a method in a scene at an accuracy.
fn least_work(records: &[Record], scene: &str, method: ComparedMethod, level: f64) -> f64 {
    let rows = records.iter().filter(|r| r.scene == scene);
    let rows = rows.filter(|r| r.method == method && !r.failed() && r.error_max <= level);
    rows.filter_map(|r| r.work).fold(f64::INFINITY, f64::min)
}

#[test]
fn the_implicit_march_is_on_the_front_by_work() {
    let records = question::force::measure(Effort::Quick, &|| ()).unwrap();
    let disc = question::force::DISC;
    for level in LEVELS {
        let of = |method: ComparedMethod| least_work(&records, disc, method, level);
        // the scheme alone, at a number of steps: nothing needs less than a tenth below it
        for other in [
            ComparedMethod::ImplicitFirst,
            ComparedMethod::ImplicitSecond,
            ComparedMethod::WaveExplicit,
        ] {
            let (own, other) = (of(ComparedMethod::WaveImplicit), of(other));
            assert!(other == f64::INFINITY || own <= 1.1 * other, "{level:e}");
        }
    }
    for ranking in rankings(&records) {
        // every method that is ahead of the program's own, which finds its step, has a reason
        assert_eq!(ranking.unexplained(), None, "{ranking:?}");
    }
    let reached = |level: f64| {
        rankings(&records)
            .iter()
            .any(|s| s.scene == question::force::DISC && s.level == level && s.own.is_some())
    };
    assert!(reached(1e-3) && reached(1e-6));
    let explicit: Vec<&Record> = records
        .iter()
        .filter(|r| r.method == ComparedMethod::WaveExplicit)
        .collect();
    assert!(explicit.len() >= 3 && explicit.iter().all(|r| r.error_max > 1e-4));
    // hertz has no error of its own to show: it is right only where nothing is radiated
    let hertz = |scene: &str| {
        records
            .iter()
            .find(|r| r.scene == scene && r.method == ComparedMethod::Hertz)
            .map(|r| r.error_max)
            .unwrap()
    };
    assert!(hertz(question::force::DISC) > 0.1);
    assert!(hertz(question::force::BALL) < 0.01);
}

/// The program's own table, built once for all tests.
fn density() -> &'static Density {
    static DENSITY: OnceLock<Density> = OnceLock::new();
    DENSITY.get_or_init(|| Density::build(0.3, None).unwrap())
}

fn fields() -> &'static [Record] {
    static RECORDS: OnceLock<Vec<Record>> = OnceLock::new();
    RECORDS.get_or_init(|| {
        let densities = std::slice::from_ref(density());
        question::fields::measure(Effort::Quick, densities, &|| ()).unwrap()
    })
}

#[test]
fn smooth_cells_beat_linear_ones_and_the_remainder_the_whole_response() {
    let records = fields();
    let errors = |method: ComparedMethod, part: &str| -> f64 {
        records
            .iter()
            .filter(|r| r.method == method && r.setting.contains(part))
            .map(|r| r.error_max)
            .fold(f64::INFINITY, f64::min)
    };
    let linear = errors(ComparedMethod::TableLinear, "step 0.1,");
    let smooth = errors(ComparedMethod::TableTransform, "step 0.1,");
    assert!(smooth < 0.01 * linear, "{smooth:e} {linear:e}");
    // second order against fourth: a step four times as long
    let ratio = errors(ComparedMethod::TableLinear, "step 0.4,") / linear;
    assert!((4.0..64.0).contains(&ratio), "{ratio}");
    let ratio = errors(ComparedMethod::TableTransform, "step 0.4,") / smooth;
    assert!((64.0..1024.0).contains(&ratio), "{ratio}");
    let whole = errors(ComparedMethod::WholeResponse, "");
    let remainder = errors(ComparedMethod::RemainderAlone, "");
    assert!(remainder < 0.3 * whole, "{remainder:e} {whole:e}");
    // the three ways to sum are one number
    for method in [
        ComparedMethod::TableDirectSums,
        ComparedMethod::TableOfPulse,
    ] {
        assert!((errors(method, "step 0.1,") / smooth - 1.0).abs() < 1e-6);
    }
    assert!(
        records
            .iter()
            .all(|r| r.question == Question::Fields && r.work.is_some())
    );
    // cells computed for the point itself: fourth order with first and second moments
    let orders = [ComparedMethod::DirectLinear, ComparedMethod::Direct];
    let [linear, cubic] = orders.map(|method| errors(method, "step 0.2,"));
    assert!(cubic < 0.01 * linear, "{linear:e} {cubic:e}");
}

#[test]
fn the_default_path_is_on_the_front_by_work_or_the_report_says_why_not() {
    for ranking in rankings(fields()) {
        assert_eq!(ranking.unexplained(), None, "{ranking:?}");
    }
}

#[test]
fn a_table_knows_its_errors_near_the_edge_and_for_short_pulses() {
    use lookup::{PulseSum, Smoothness};
    let table = density().with_stencil(Density::points()).unwrap();
    let width = table.cell_width(0.3).unwrap();
    let count = 1200;
    let plan = tabulator::PointPlan::new(0.3, 1e-11, width, count + 4, 4).unwrap();
    let mut largest = [0.0_f64; 2];
    for (r, z) in [
        (0.97, 0.02),
        (1.03, 0.02),
        (1.06, 0.11),
        (0.45, 0.35),
        (1.62, 0.53),
    ] {
        let exact = question::fields::series(&plan.compute(r, z).unwrap(), width, count);
        let mut cells = vec![[0.0; 6]; count];
        table
            .trace(Smoothness::Smooth, 0.3, r, z, 0, &mut cells)
            .unwrap();
        for (cell, exact) in cells.iter_mut().zip(&exact) {
            for f in 0..6 {
                cell[f] -= exact[f];
            }
        }
        for length in [1.0, 2.0, 5.0, 10.0, 30.0, 100.0] {
            let pulse = PulseSum::new(length, width);
            let errors = pulse.response(&[0.0; 6], &cells);
            let promised = table.error(0.3, r, z, length).unwrap();
            for (f, promised) in promised.iter().enumerate() {
                let error = errors.iter().fold(0.0_f64, |most, e| most.max(e[f].abs()));
                // the table's kernels are computed to 1e-8 themselves
                assert!(
                    error <= promised + 2e-9,
                    "({r}, {z}), pulse {length}, field {f}: {error:e} above {promised:e}"
                );
                let slot = usize::from(length > 20.0);
                largest[slot] = largest[slot].max(error);
            }
        }
    }
    // as in the map, errors are hundreds of times smaller for slow pulses
    assert!(largest[0] > 100.0 * largest[1], "{largest:?}");
}

#[test]
fn whole_impacts_hold_their_tolerance_and_cells_alone_do_not() {
    let records = question::impacts::measure(Effort::Quick, &[], &|| ()).unwrap();
    for r in &records {
        println!(
            "{} {} {} {:.1e}",
            r.scene,
            r.method.name(),
            r.setting,
            r.error_max
        );
    }
    for record in records
        .iter()
        .filter(|r| r.method == ComparedMethod::Computed)
    {
        let tolerance: f64 = record.setting.replace("tolerance ", "").parse().unwrap();
        assert!(record.error_max <= 3.0 * tolerance, "{record:?}");
    }
    let alone = records
        .iter()
        .filter(|r| r.method == ComparedMethod::CellsAlone);
    let least = alone.map(|r| r.error_max).fold(f64::INFINITY, f64::min);
    assert!(least > 1e-5, "{least:e}");
}
