//! Histories against closed forms, an independent inversion, and identities.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{Choice, HalfSpace, Material};
use oracle::{COMPONENTS, History, Lines, Load, Quantity, TimeFunction, Wavelet, histories};
use std::collections::BTreeMap;
use std::f64::consts::PI;

const ALL: [Quantity; 3] = [Quantity::Displacement, Quantity::Velocity, Quantity::Stress];
const UZ: usize = 1;

/// A block with mu = c1 = 1.
fn block(nu: f64) -> HalfSpace {
    let density = (2.0 - 2.0 * nu) / (1.0 - 2.0 * nu);
    HalfSpace::new(Material::elastic(2.0 * (1.0 + nu), nu, density).unwrap()).unwrap()
}

fn smooth(wavelet: Wavelet, frequency_hz: f64) -> TimeFunction {
    let delay_s = 1.5 / frequency_hz;
    TimeFunction::Smooth {
        wavelet,
        frequency_hz,
        delay_s,
        force_n: 1.0,
    }
}

fn component(name: &str) -> usize {
    COMPONENTS.iter().position(|row| row.1 == name).unwrap()
}

fn peak(found: &History, c: usize) -> f64 {
    found
        .values
        .iter()
        .fold(0.0, |most, values| values[c].abs().max(most))
}

/// Lines of a file of numbers.
fn rows(name: &str) -> Vec<Vec<String>> {
    let path = format!("{}/../../tests/golden/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let split = |line: &str| line.split(',').map(str::to_owned).collect();
    text.lines().skip(1).map(split).collect()
}

/// `tests/reference/lamb.py`: closed forms convolved by another rule.
#[test]
fn a_point_force_is_that_of_pekeris() {
    let mut groups: BTreeMap<String, Vec<Vec<String>>> = BTreeMap::new();
    for row in rows("lamb.csv") {
        let key = [&row[0], &row[1], &row[3], &row[4], &row[6]]
            .map(String::as_str)
            .join(",");
        groups.entry(key).or_default().push(row);
    }
    for (key, rows) in groups {
        let number = |row: &[String], i: usize| row[i].parse::<f64>().unwrap();
        let first = &rows[0];
        let force = smooth(Wavelet::named(&first[3]).unwrap(), number(first, 4));
        let times: Vec<f64> = rows.iter().map(|row| number(row, 5)).collect();
        let place = [number(first, 1), number(first, 2)];
        let found = histories(
            &block(number(first, 0)),
            Load::Point,
            &force,
            place,
            &times,
            &ALL,
        )
        .unwrap();
        let c = component(&first[6]);
        let expected: Vec<f64> = rows.iter().map(|row| number(row, 7)).collect();
        let size = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let off = expected
            .iter()
            .zip(&found.values)
            .map(|(x, values)| (x - values[c]).abs());
        let off = off.fold(0.0, f64::max);
        let estimate = found.errors[c];
        println!(
            "{key:40} error {:.1e}, estimate {:.1e} of the peak",
            off / size,
            estimate / size
        );
        assert!(off <= estimate, "{key}: {:.1e}", off / size);
        assert!(estimate < 1.1e-7 * size, "{key}: {:.1e}", estimate / size);
        if place[1] == 0.0 {
            assert!(off < 1e-9 * size, "{key}: {:.1e}", off / size);
        }
    }
}

/// Durbin inversion of the Hankel integrals under sin^4, linear between 40,001 samples.
#[test]
fn a_record_of_a_hertz_disc_is_that_of_the_inversion() {
    let mut worst = 0.0_f64;
    let mut groups: BTreeMap<String, Vec<Vec<f64>>> = BTreeMap::new();
    for row in rows("fields.csv") {
        let key = row[..4].join(",");
        groups
            .entry(key)
            .or_default()
            .push(row.iter().map(|x| x.parse().unwrap()).collect());
    }
    for (key, rows) in groups {
        let [nu, r, z, length] = [0, 1, 2, 3].map(|i| rows[0][i]);
        let time: Vec<f64> = (0..=4000).map(|i| length * f64::from(i) / 4000.0).collect();
        let pulse: Vec<f64> = time
            .iter()
            .map(|t| (PI * t / length).sin().powi(4))
            .collect();
        let force = TimeFunction::Lines(Lines::of_samples(&time, &pulse, Vec::new()));
        let times: Vec<f64> = rows.iter().map(|row| row[4]).collect();
        let asked = [Quantity::Displacement, Quantity::Stress];
        let load = Load::Hertz { radius_m: 1.0 };
        let found = histories(&block(nu), load, &force, [r, z], &times, &asked).unwrap();
        let columns = [
            ("uz", 5),
            ("ur", 6),
            ("szz", 7),
            ("srz", 8),
            ("srr", 9),
            ("stt", 10),
        ];
        for (name, column) in columns {
            let c = component(name);
            for (row, values) in rows.iter().zip(&found.values) {
                let off = (values[c] - row[column]).abs();
                worst = worst.max(if z > 0.0 { off } else { 0.0 });
                assert!(
                    off < if z > 0.0 { 1e-6 } else { 2e-6 },
                    "{key} {name}: {off:.1e}"
                );
            }
        }
    }
    println!("largest difference below the surface {worst:.1e}");
}

#[test]
fn a_small_disc_is_a_point_force() {
    let times: Vec<f64> = (0..200).map(|i| 0.03 * f64::from(i)).collect();
    let force = smooth(Wavelet::Ricker, 0.7);
    for place in [[1.0, 0.0], [0.6, 0.8], [0.0, 1.0]] {
        let of = |load| histories(&block(0.3), load, &force, place, &times, &ALL).unwrap();
        let point = of(Load::Point);
        for (load, square) in [
            (Load::Hertz { radius_m: 1e-3 }, 0.4),
            (Load::Uniform { radius_m: 1e-3 }, 0.5),
        ] {
            let disc = of(load);
            for c in 0..8 {
                let off = disc
                    .values
                    .iter()
                    .zip(&point.values)
                    .map(|(a, b)| (a[c] - b[c]).abs());
                let off = off.fold(0.0, f64::max);
                // the mean of r^2 over the load, times second derivatives
                assert!(
                    off <= 60.0 * square * 1e-6 * peak(&point, c) + 1e-12,
                    "{load:?} {place:?} {c}: {off:e} of {:e}",
                    peak(&point, c)
                );
            }
        }
    }
}

/// Hertz's pressure is a mean of uniform ones: sqrt(1 - r^2) = int_r^1 a/sqrt(1 - a^2) da over discs of radius a.
#[test]
fn a_uniform_pressure_is_a_sum_of_hertz_pressures() {
    let times: Vec<f64> = (0..30).map(|i| 0.2 * f64::from(i)).collect();
    let force = smooth(Wavelet::Ricker, 0.6);
    // stresses take longer
    let with_stress = [Quantity::Displacement, Quantity::Stress];
    for (place, asked, discs) in [
        ([1.4, 0.0], &with_stress[..1], 18),
        ([0.5, 0.7], &with_stress, 12),
    ] {
        let of = |load| histories(&block(0.25), load, &force, place, &times, asked).unwrap();
        let hertz = of(Load::Hertz { radius_m: 1.0 });
        // of unit forces, with a = sin x: the weight of a disc is 3/2 a^3/sqrt(1 - a^2) da
        let mut sum = vec![[0.0; 8]; times.len()];
        for (x, weight) in halfspace::gauss::rule(discs).on(0.0, 0.5 * PI) {
            let uniform = of(Load::Uniform { radius_m: x.sin() });
            for (sum, values) in sum.iter_mut().zip(&uniform.values) {
                for c in 0..8 {
                    sum[c] += weight * 1.5 * x.sin().powi(3) * values[c];
                }
            }
        }
        for c in 0..6 {
            let off = sum
                .iter()
                .zip(&hertz.values)
                .map(|(a, b)| (a[c] - b[c]).abs())
                .fold(0.0, f64::max);
            println!(
                "{place:?} {}: {:.1e}",
                COMPONENTS[c].1,
                off / peak(&hertz, c)
            );
            assert!(
                off <= 1e-8 * peak(&hertz, c) + 1e-13,
                "{place:?} {c}: {off:e}"
            );
        }
    }
}

#[test]
fn a_step_and_its_record_agree_with_the_closed_form() {
    // r = 2 m: before the shear wave, Pekeris' uz at c2 t/r = 0.9, from its formula
    let tau: f64 = 0.9;
    let time = 2.0 * tau * 3.0_f64.sqrt();
    let root = 3.0_f64.sqrt();
    let rayleigh = (3.0 * root + 5.0).sqrt() / (0.75 + 0.25 * root - tau * tau).sqrt();
    let bound = (3.0 * root - 5.0).sqrt() / (tau * tau + 0.25 * root - 0.75).sqrt();
    let expected = (6.0 - root / (tau * tau - 0.25).sqrt() - rayleigh + bound) / (32.0 * PI) / 2.0;
    let asked = [Quantity::Displacement];
    for force in [
        Lines::step(0.5, 1.0),
        Lines::of_samples(&[0.5, 90.0], &[1.0, 1.0], vec![[0.5, 1.0], [90.0, -1.0]]),
    ] {
        let force = TimeFunction::Lines(force);
        let found = histories(
            &block(0.25),
            Load::Point,
            &force,
            [2.0, 0.0],
            &[0.5 + time],
            &asked,
        )
        .unwrap();
        assert!(
            (found.values[0][UZ] - expected).abs() < 1e-11,
            "{} {expected}",
            found.values[0][UZ]
        );
    }
}

#[test]
fn a_ricker_is_the_second_derivative_of_a_gaussian() {
    // R = -G''/(2 (pi f)^2)
    let (f, step) = (0.8, 1e-3);
    let times: Vec<f64> = (0..400).map(|i| 4.0 + step * f64::from(i)).collect();
    let load = Load::Hertz { radius_m: 0.3 };
    let of = |wavelet| {
        histories(
            &block(0.2),
            load,
            &smooth(wavelet, f),
            [1.0, 0.4],
            &times,
            &ALL,
        )
        .unwrap()
    };
    let [ricker, gaussian] = [Wavelet::Ricker, Wavelet::Gaussian].map(of);
    for c in 0..8 {
        for i in 1..399 {
            let second = (gaussian.values[i + 1][c] - 2.0 * gaussian.values[i][c]
                + gaussian.values[i - 1][c])
                / (step * step);
            let expected = -second / (2.0 * (PI * f).powi(2));
            assert!(
                (ricker.values[i][c] - expected).abs() < 1e-5 * peak(&ricker, c),
                "{c} {i}: {:.1e}",
                (ricker.values[i][c] - expected).abs() / peak(&ricker, c)
            );
        }
    }
}

#[test]
fn distributions_and_infinite_places_are_rejected() {
    let step = TimeFunction::Lines(Lines::step(0.0, 1.0));
    let ricker = smooth(Wavelet::Ricker, 1.0);
    let disc = Load::Uniform { radius_m: 1.0 };
    for (load, force, place, word) in [
        (Load::Point, &step, [1.0, 0.0], "distributions"),
        (Load::Point, &ricker, [0.0, 0.0], "infinite displacement"),
        (disc, &ricker, [0.5, 0.0], "under a uniform pressure"),
        (disc, &step, [3.0, 0.0], "needs a smooth"),
    ] {
        let error = histories(&block(0.25), load, force, place, &[1.0], &ALL).unwrap_err();
        assert!(error.to_string().contains(word), "{error}");
    }
}
