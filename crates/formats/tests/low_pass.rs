//! A record treated as a scene asks: a noisy one of a million rows, what a pulse keeps, and where it is told.
//!
//! `cargo test -p hertzlamb-formats --test low_pass -- --nocapture` prints times and errors.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use formats::schema::results::TREATMENT;
use formats::{Existing, json_report, parse_scene, resolved, write_results};
use halfspace::random::Stream;
use impact::{ForceRecord, KernelChoice, Load, Scene, simulate};
use std::f64::consts::PI;
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

const PULSE_S: f64 = 2e-5;
const PEAK_N: f64 = 1000.0;

/// sin^4 from `from_s`.
fn pulse(time_s: f64, from_s: f64) -> f64 {
    let x = (time_s - from_s) / PULSE_S;
    if (0.0..1.0).contains(&x) {
        PEAK_N * (PI * x).sin().powi(4)
    } else {
        0.0
    }
}

fn scene(folder: &Path, force: &str) -> Result<Scene, String> {
    let text = format!(
        "[target]\nmaterial = \"steel\"\n[contact]\ndisc_radius_m = 0.004\n[force]\nfile = \"force.csv\"\n{force}"
    );
    parse_scene(&text, folder).map_err(|error| error.to_string())
}

fn record(scene: &Scene) -> &ForceRecord {
    match &scene.load {
        Load::Record(record) => record,
        Load::Strike(_) => panic!("a record was given"),
    }
}

/// Sum of twelve even numbers, of mean zero and variance one.
fn gauss(stream: &mut Stream) -> f64 {
    (0..12).map(|_| stream.next()).sum::<f64>() - 6.0
}

/// 10 ms in a million rows: a pulse, noise of 1 % of its peak, an offset of 5 %.
#[test]
fn a_million_noisy_rows_are_read_and_filtered() {
    const ROWS: u32 = 1_000_000;
    const STEP_S: f64 = 1e-8;
    const CUTOFF_HZ: f64 = 5e5;
    let (noise_n, offset_n, from_s) = (0.01 * PEAK_N, 0.05 * PEAK_N, 4e-3);
    let mut noise = Stream::new(2026);
    let mut text = String::from("time_s,force_n\n");
    for i in 0..ROWS {
        let time_s = f64::from(i) * STEP_S;
        let force_n = pulse(time_s, from_s) + offset_n + noise_n * gauss(&mut noise);
        writeln!(text, "{time_s:.8},{force_n:.6}").unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("force.csv"), text).unwrap();

    let clock = Instant::now();
    let raw = scene(folder.path(), "").unwrap();
    let read = clock.elapsed();
    let keys = format!("low_pass_hz = {CUTOFF_HZ:?}\nbaseline_s = 0.003\n");
    let treated = scene(folder.path(), &keys).unwrap();
    let both = clock.elapsed().saturating_sub(read);
    println!("1e6 rows: read in {read:.2?}, read and treated in {both:.2?}");

    let (raw, found) = (record(&raw), record(&treated));
    let done = found.treated.unwrap();
    // the mean of 3e5 rows of noise
    assert!((done.baseline_n - offset_n).abs() < 4.0 * noise_n / 3e5_f64.sqrt());
    // power left of white noise: 2 step fc int_0^inf G(x)^2 dx = 2 step fc 7/8 (pi/8)/sin(pi/8)
    let share = (2.0 * STEP_S * CUTOFF_HZ * 0.875 * (PI / 8.0) / (PI / 8.0).sin()).sqrt();
    let rows = found.time_s().iter().zip(found.force_n());
    let errors: Vec<(f64, f64)> = rows
        .filter(|(t, _)| (1e-4..9.9e-3).contains(*t))
        .map(|(&t, &p)| (t, p - pulse(t, from_s)))
        .collect();
    let rms = (errors.iter().map(|e| e.1 * e.1).sum::<f64>() / errors.len() as f64).sqrt();
    let most = errors.iter().fold(0.0_f64, |most, e| most.max(e.1.abs()));
    println!(
        "noise {:.2e} of the peak: left {:.3e} rms, expected {:.3e}, largest {:.2e}",
        0.01,
        rms / PEAK_N,
        0.01 * share,
        most / PEAK_N
    );
    assert!((rms / (noise_n * share) - 1.0).abs() < 0.05, "{rms}");
    assert!(most < 6.0 * noise_n * share, "{most}");
    // lines between rows of noise have 2/3 of its power
    assert!(
        (done.removed_rms_n / (noise_n * (2.0_f64 / 3.0 - share * share).sqrt()) - 1.0).abs()
            < 0.01
    );
    let span_s = raw.span_s()[1] - raw.span_s()[0];
    let before = raw.impulse_n_s() - span_s * done.baseline_n;
    let after = found.impulse_n_s() + done.before_zero_n_s;
    println!("impulse changed by {:.1e} of itself", after / before - 1.0);
    assert!((after / before - 1.0).abs() < 1e-5, "{before} {after}");
}

/// What a pulse of length T keeps at a cutoff of 5, 10, 20 and 40 over T, with its impulse.
#[test]
fn a_pulse_keeps_its_shape_and_its_impulse() {
    let from_s = 1e-3;
    let time_s: Vec<f64> = (0..=4000)
        .map(|i| from_s + f64::from(i) / 4000.0 * PULSE_S)
        .collect();
    let force_n: Vec<f64> = time_s.iter().map(|&t| pulse(t, from_s)).collect();
    let clean = ForceRecord::new(time_s, force_n).unwrap();
    for (cutoff, promised) in [(5.0, 4e-4), (10.0, 2e-5), (20.0, 2e-6), (40.0, 3e-7)] {
        let found = clean.clone().treat(None, Some(cutoff / PULSE_S)).unwrap();
        let rows = found.time_s().iter().zip(found.force_n());
        let error = rows.fold(0.0_f64, |most, (&t, p)| {
            most.max((p - pulse(t, from_s)).abs())
        });
        let impulse = found.impulse_n_s() / clean.impulse_n_s() - 1.0;
        println!(
            "cutoff {cutoff}/T: shape {:.1e} of the peak, impulse {impulse:.1e}",
            error / PEAK_N
        );
        assert!(error < promised * PEAK_N, "{cutoff}: {error:e}");
        assert!(impulse.abs() < 1e-7, "{cutoff}: {impulse:e}");
    }
}

/// A record that begins in the middle of a force loses to the time before zero what it says.
#[test]
fn what_goes_before_zero_is_counted() {
    let time_s: Vec<f64> = (0..=2000).map(|i| f64::from(i) * 5e-9).collect();
    let force_n: Vec<f64> = time_s.iter().map(|&t| pulse(t + 1e-5, 0.0)).collect();
    let cut = ForceRecord::new(time_s, force_n).unwrap();
    let found = cut.clone().treat(None, Some(5.0 / PULSE_S)).unwrap();
    let lost = found.treated.unwrap().before_zero_n_s;
    let whole = (found.impulse_n_s() + lost) / cut.impulse_n_s();
    println!(
        "{:.1e} of the impulse is before zero",
        lost / cut.impulse_n_s()
    );
    assert!(lost > 0.01 * cut.impulse_n_s(), "{lost}");
    assert!((whole - 1.0).abs() < 1e-4, "{whole}");
}

#[test]
fn what_was_done_is_told_everywhere() {
    let folder = tempfile::tempdir().unwrap();
    let rows: Vec<String> = (0..400)
        .map(|i| {
            format!(
                "{:e},{}",
                f64::from(i) * 1e-6,
                pulse(f64::from(i) * 1e-6, 1e-4) + 3.0
            )
        })
        .collect();
    let text = format!("time_s,force_n\n{}\n", rows.join("\n"));
    std::fs::write(folder.path().join("force.csv"), text).unwrap();
    let path = folder.path().join("out.h5");
    let treated = scene(folder.path(), "baseline_s = 5e-5\nlow_pass_hz = 2e5\n").unwrap();
    let outcome = simulate(&treated, &KernelChoice::Direct).unwrap();
    write_results(&path, &treated, &outcome, Existing::Keep).unwrap();
    let file = hdf5::File::open(&path).unwrap();
    let force = file.dataset("force").unwrap();
    let number = |name: &str| force.attr(name).unwrap().read_scalar::<f64>().unwrap();
    assert_eq!((number("baseline_s"), number("low_pass_hz")), (5e-5, 2e5));
    assert!((number("baseline_n") - 3.0).abs() < 1e-12);
    assert!(number("removed_rms_n") > 0.0);
    let document = include_str!("../../../data-schema/results.md");
    let described = TREATMENT
        .iter()
        .all(|name| document.contains(&format!("`{name}`")));
    assert!(described && force.attr_names().unwrap().len() >= TREATMENT.len());
    let report = json_report(&treated, &outcome, 0.0);
    assert_eq!(report["force_treatment"]["low_pass_hz"], 2e5);
    assert_eq!(
        report["force_treatment"]["removed_rms_n"],
        number("removed_rms_n")
    );
    // the scene that was computed says it, and gives the same again
    let again = parse_scene(&resolved(&treated), Path::new("/")).unwrap();
    assert_eq!(record(&again), record(&treated));

    // one without: nothing is said, nothing is done
    let plain = scene(folder.path(), "").unwrap();
    let outcome = simulate(&plain, &KernelChoice::Direct).unwrap();
    assert!(json_report(&plain, &outcome, 0.0)["force_treatment"].is_null());
    assert_eq!(record(&plain).treated, None);
    assert_eq!(record(&plain).force_n()[0], 3.0);
}

#[test]
fn what_a_low_pass_loses_before_the_time_zero_is_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let at_once = "time_s,force_n\n0,0\n1e-5,100\n2e-5,0\n";
    let rested = "time_s,force_n\n0,0\n2e-4,0\n2.1e-4,100\n2.2e-4,0\n";
    for (text, warned) in [(at_once, true), (rested, false)] {
        std::fs::write(folder.path().join("force.csv"), text).unwrap();
        let treated = scene(folder.path(), "low_pass_hz = 1e5\n").unwrap();
        let outcome = simulate(&treated, &KernelChoice::Direct).unwrap();
        let found = outcome
            .warnings
            .iter()
            .any(|w| w.contains("times before zero"));
        assert_eq!(found, warned, "{:?}", outcome.warnings);
    }
}

#[test]
fn what_the_record_cannot_have_is_refused_with_key_value_and_range() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("force.csv"),
        "time_s,force_n\n0,0\n1e-5,100\n2e-5,0\n",
    )
    .unwrap();
    for (keys, part) in [
        (
            "low_pass_hz = 1e4",
            "force.low_pass_hz = 10000 is outside (49999.99",
        ),
        (
            "low_pass_hz = -1.0",
            "force.low_pass_hz = -1 is outside (0, inf)",
        ),
        ("low_pass_hz = nan", "force.low_pass_hz = NaN is outside"),
        (
            "baseline_s = 1.0",
            "force.baseline_s = 1 is outside (0, 0.00002], the length of the record",
        ),
        ("low_pas_hz = 1.0", "did you mean low_pass_hz?"),
    ] {
        let message = scene(folder.path(), keys).unwrap_err();
        assert!(message.contains(part), "{message}");
    }
}
