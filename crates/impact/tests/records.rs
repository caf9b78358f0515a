//! A short pulse in records of any length, beside the same pulse alone and beside exact superposition.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::{FIELDS, Kernel, Medium, Profile};
use impact::{
    ForceRecord, HalfSpace, KernelChoice, Load, Material, Outcome, Probe, Scene, Settings, simulate,
};
use std::f64::consts::PI;

const RADIUS_M: f64 = 0.004;
const PULSE_S: f64 = 2e-5;
const TOLERANCE: f64 = 1e-4;

/// sin^4 in 100 rows from `from_s`, within a record that ends at `to_s`.
fn record(from_s: f64, to_s: f64) -> ForceRecord {
    let mut rows: Vec<(f64, f64)> = (0..=100)
        .map(|i| {
            let x = f64::from(i) / 100.0;
            (from_s + x * PULSE_S, 1000.0 * (PI * x).sin().powi(4))
        })
        .collect();
    rows[100].1 = 0.0;
    if from_s > 0.0 {
        rows.insert(0, (0.0, 0.0));
    }
    if to_s > from_s + PULSE_S {
        rows.push((to_s, 0.0));
    }
    let (time_s, force_n) = rows.into_iter().unzip();
    ForceRecord::new(time_s, force_n).unwrap()
}

fn scene(record: ForceRecord, duration_s: Option<f64>) -> Scene {
    let probe = |r_m: f64, z_m: f64| Probe { r_m, z_m };
    Scene {
        target: HalfSpace::new(Material::named("steel").unwrap()).unwrap(),
        load: Load::Record(record),
        settings: Settings {
            disc_radius_m: Some(RADIUS_M),
            tolerance: TOLERANCE,
            ..Settings::default()
        },
        probes: vec![probe(0.0, 0.004), probe(0.004, 0.004), probe(0.02, 0.0)],
        section: None,
        sensors: Vec::new(),
        quantities: Vec::new(),
        peaks: false,
        duration_s,
        low_pass_hz: None,
    }
}

fn fields(record: ForceRecord, duration_s: Option<f64>) -> Outcome {
    simulate(&scene(record, duration_s), &KernelChoice::Direct).unwrap()
}

/// A field over time at a probe, linear between its samples.
fn at(outcome: &Outcome, field: usize, probe: usize, time_s: f64) -> f64 {
    let (times, values) = (
        &outcome.series.time_s,
        &outcome.probes.as_ref().unwrap().values[field][probe],
    );
    let i = times
        .partition_point(|&t| t <= time_s)
        .clamp(1, times.len() - 1);
    let x = (time_s - times[i - 1]) / (times[i] - times[i - 1]);
    values[i - 1] + x * (values[i] - values[i - 1])
}

fn peak(outcome: &Outcome, field: usize, probe: usize) -> f64 {
    let values = &outcome.probes.as_ref().unwrap().values[field][probe];
    values.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
}

#[test]
fn a_pulse_in_a_long_record_gives_the_fields_of_the_pulse_alone() {
    let alone = fields(record(0.0, 0.0), Some(6e-5));
    for length_s in [1e-3, 1e-2, 0.1, 1.0] {
        let from_s = 0.37 * length_s;
        let found = fields(record(from_s, length_s), None);
        let samples = found.series.time_s.len();
        let mut worst = 0.0_f64;
        for probe in 0..3 {
            for field in 0..FIELDS.len() {
                let size = peak(&alone, field, probe);
                if size == 0.0 {
                    continue;
                }
                for &time_s in &alone.series.time_s {
                    let a = at(&alone, field, probe, time_s);
                    let b = at(&found, field, probe, from_s + time_s);
                    worst = worst.max((a - b).abs() / size);
                }
            }
        }
        println!("record of {length_s} s: {samples} samples, differs by {worst:.1e} of the peak");
        assert!(worst < TOLERANCE, "{length_s}: {worst:e}");
        assert!(samples < 50_000, "quiet parts cost {samples} samples");
    }
}

#[test]
fn the_fields_are_those_of_exact_superposition_within_their_estimates() {
    // three rows and uneven spacing: corners anywhere in a cell
    let triangle = || ForceRecord::new(vec![0.0, 7.3e-6, 2e-5], vec![0.0, 1000.0, 0.0]).unwrap();
    let found = fields(triangle(), Some(4e-5));
    let steel = HalfSpace::new(Material::named("steel").unwrap()).unwrap();
    let (c1, mu) = (
        steel.longitudinal_speed_m_s(),
        steel.material().shear_modulus_pa(),
    );
    let kernel = Kernel::new(&Medium::new(0.3).unwrap(), Profile::Hertz, 1e-10).unwrap();
    let probes = found.probes.as_ref().unwrap();
    let mut worst = 0.0_f64;
    for probe in 0..3 {
        let (r, z) = (probes.r_m[probe] / RADIUS_M, probes.z_m[probe] / RADIUS_M);
        let fixed = kernel.static_field(r, z).unwrap();
        for i in (20..found.series.time_s.len()).step_by(173) {
            let t = found.series.time_s[i] * c1 / RADIUS_M;
            // int P' R by int R dt, between the corners
            let mut exact = fixed.map(|x| x * triangle().at(found.series.time_s[i]));
            let rows = [0.0, 7.3e-6, 2e-5].map(|s: f64| s * c1 / RADIUS_M);
            for (k, slope) in [1000.0 / (rows[1] - rows[0]), -1000.0 / (rows[2] - rows[1])]
                .into_iter()
                .enumerate()
            {
                let (from, to) = ((t - rows[k + 1]).max(0.0), (t - rows[k]).max(0.0));
                let integral = |until: f64| kernel.step_integral(r, z, until).unwrap().value;
                let (a, b) = (integral(from), integral(to));
                for field in 0..6 {
                    exact[field] += slope * (b[field] - a[field]);
                }
            }
            for (field, &exact) in exact.iter().enumerate() {
                let unit = if field < 2 {
                    1.0 / (mu * RADIUS_M)
                } else {
                    1.0 / (RADIUS_M * RADIUS_M)
                };
                let size = peak(&found, field, probe);
                if size == 0.0 {
                    continue;
                }
                let error = (probes.values[field][probe][i] - exact * unit).abs();
                assert!(
                    error <= probes.errors[field][probe] + 1e-9 * size,
                    "probe {probe}, field {field}: {error:e} {:e}",
                    probes.errors[field][probe]
                );
                worst = worst.max(error / size);
            }
        }
    }
    println!("triangle of three rows: within {worst:.1e} of the peak");
    assert!(worst < TOLERANCE, "{worst:e}");
}

#[test]
fn what_a_lasting_change_leaves_beyond_a_gap_is_within_the_errors() {
    // on, a plateau of 0.9 s, off: the second run takes the fields of the plateau as static
    let rows = vec![0.0, 1e-6, 0.9, 0.900_001, 1.0];
    let record = ForceRecord::new(rows, vec![0.0, 500.0, 500.0, 0.0, 0.0]).unwrap();
    let found = fields(record, None);
    let times = &found.series.time_s;
    let gap = (1..times.len())
        .find(|&i| times[i] - times[i - 1] > 0.1)
        .unwrap();
    let probes = found.probes.as_ref().unwrap();
    for probe in 0..3 {
        for field in 0..FIELDS.len() {
            let values = &probes.values[field][probe];
            let jump = (values[gap] - values[gap - 1]).abs();
            assert!(
                jump <= probes.errors[field][probe],
                "probe {probe}, field {field}: {jump:e} {:e}",
                probes.errors[field][probe]
            );
        }
    }
}

#[test]
fn an_output_that_ends_before_the_pulse_is_still() {
    let found = fields(record(0.37, 1.0), Some(1e-3));
    assert_eq!(found.series.time_s.len(), 2);
    let values = found.probes.unwrap().values;
    assert!(values.iter().flatten().flatten().all(|&x| x == 0.0));
}

#[test]
fn a_constant_force_has_its_static_field() {
    let step = ForceRecord::new(vec![0.0, 1e-6, 1.0], vec![0.0, 500.0, 500.0]).unwrap();
    let found = fields(step, None);
    let runs = found
        .series
        .time_s
        .windows(2)
        .filter(|t| t[1] - t[0] > 1e-2);
    assert_eq!(runs.count(), 1, "the plateau is quiet");
    let last = found.series.time_s.partition_point(|&t| t < 0.5) - 1;
    let values = &found.probes.as_ref().unwrap().values[1][1];
    let kernel = Kernel::new(&Medium::new(0.3).unwrap(), Profile::Hertz, 1e-10).unwrap();
    let steel = Material::named("steel").unwrap();
    let fixed =
        500.0 * kernel.static_field(1.0, 1.0).unwrap()[1] / (steel.shear_modulus_pa() * RADIUS_M);
    assert!(
        (values[last] / fixed - 1.0).abs() < 1e-3,
        "{} {fixed}",
        values[last]
    );
}

#[test]
fn the_rest_after_a_pulse_has_no_samples() {
    let [short, long] = [1e-2, 1.0].map(|end_s| fields(record(0.0, end_s), None));
    let times_s = &long.series.time_s;
    assert_eq!(&short.series.time_s, times_s);
    assert!(times_s.len() < 50_000 && times_s[times_s.len() - 1] < 1e-3);
    assert_eq!(long.step_s(), times_s[1]);
    // at rest first: the first two samples are not a step apart
    let later = fields(record(0.5, 1.0), None);
    assert!((later.step_s() / long.step_s() - 1.0).abs() < 1e-6);
}

#[test]
fn a_disc_that_waves_do_not_cross_is_refused() {
    let mut wide = scene(record(0.0, PULSE_S), None);
    wide.settings.disc_radius_m = Some(1e6);
    let refused = simulate(&wide, &KernelChoice::Direct).unwrap_err();
    let said = refused.to_string();
    assert!(
        said.starts_with("disc_radius_m = 1000000 is outside (0, 1.1"),
        "{said}"
    );
}
