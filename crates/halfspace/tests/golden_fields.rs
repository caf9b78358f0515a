//! The kernels against responses to sin^4 pulses from an independent Laplace-Hankel inversion.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::gauss::rule;
use halfspace::{Arrivals, FIELDS, Kernel, Medium, Profile, Six};
use std::collections::BTreeMap;
use std::f64::consts::PI;

struct Row {
    medium: f64,
    r: f64,
    z: f64,
    pulse: f64,
    t: f64,
    fields: Six,
}

fn rows() -> Vec<Row> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/fields.csv");
    let text = std::fs::read_to_string(path).unwrap();
    text.lines()
        .skip(1)
        .map(|line| {
            let v: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
            Row {
                medium: v[0],
                r: v[1],
                z: v[2],
                pulse: v[3],
                t: v[4],
                // w,u,szz,srz,srr,stt
                fields: [v[6], v[5], v[9], v[10], v[7], v[8]],
            }
        })
        .collect()
}

/// P static + int P'(t - s) R(s) ds, split at the arrivals, with both ends of each part smoothed.
fn response(kernel: &Kernel, row: &Row) -> Six {
    let (r, z, t, pulse) = (row.r, row.z, row.t, row.pulse);
    let force = |s: f64| {
        if (0.0..pulse).contains(&s) {
            (PI * s / pulse).sin().powi(4)
        } else {
            0.0
        }
    };
    let rate = |s: f64| {
        let (sin, cos) = (PI * s / pulse).sin_cos();
        4.0 * PI / pulse * sin.powi(3) * cos
    };
    let rest = kernel.static_field(r, z).unwrap();
    let mut value = rest.map(|s| force(t) * s);
    let start = (t - pulse).max(0.0);
    let arrivals = Arrivals::new(kernel.medium(), Profile::Hertz, r, z)
        .unwrap()
        .sorted();
    let mut ends: Vec<f64> = arrivals
        .into_iter()
        .filter(|a| *a > start && *a < t)
        .collect();
    ends.insert(0, start);
    ends.push(t);
    for pair in ends.windows(2) {
        let pieces = ((pair[1] - pair[0]) / (0.25 * pulse).min(1.0))
            .ceil()
            .max(1.0) as usize;
        for piece in 0..pieces {
            let a = pair[0] + (pair[1] - pair[0]) * piece as f64 / pieces as f64;
            let b = pair[0] + (pair[1] - pair[0]) * (piece + 1) as f64 / pieces as f64;
            for (x, w) in rule(32).on(-1.0, 1.0) {
                // a map flat at both ends, where fronts leave roots and logarithms
                let q = x * x;
                let map = x * (35.0 - q * (35.0 - q * (21.0 - 5.0 * q))) / 16.0;
                let s = 0.5 * (a + b) + 0.5 * (b - a) * map;
                let weight = w * 0.5 * (b - a) * 35.0 / 16.0 * (1.0 - q).powi(3);
                let remainder = kernel.remainder(r, z, s).unwrap().value;
                for f in 0..6 {
                    value[f] += weight * rate(t - s) * remainder[f];
                }
            }
        }
    }
    value
}

#[test]
fn sine_pulses_agree_with_an_independent_inversion() {
    let mut peaks: BTreeMap<String, Six> = BTreeMap::new();
    let key = |row: &Row| format!("{} {} {} {}", row.medium, row.r, row.z, row.pulse);
    for row in rows() {
        let peak = peaks.entry(key(&row)).or_insert([0.0; 6]);
        for (largest, value) in peak.iter_mut().zip(row.fields) {
            *largest = largest.max(value.abs());
        }
    }
    let mut worst: BTreeMap<String, Six> = BTreeMap::new();
    for row in rows() {
        let kernel = Kernel::new(&Medium::new(row.medium).unwrap(), Profile::Hertz, 1e-11).unwrap();
        let value = response(&kernel, &row);
        let peak = peaks[&key(&row)];
        let errors = worst.entry(key(&row)).or_insert([0.0; 6]);
        for f in 0..6 {
            if peak[f] > 1e-12 {
                errors[f] = errors[f].max((value[f] - row.fields[f]).abs() / peak[f]);
            }
        }
    }
    println!("{FIELDS:?}");
    for (key, errors) in &worst {
        println!("{key}: {}", show(errors));
    }
    for (key, errors) in &worst {
        // relative to the peak, or the accuracy of the reference: 1e-10 below the surface, 1e-7 on it
        let floor: f64 = if key.split(' ').nth(2) == Some("0") {
            1e-7
        } else {
            1e-10
        };
        for (error, peak) in errors.iter().zip(peaks[key]) {
            assert!(
                error * peak < floor.max(1e-9 * peak),
                "{key}: {}",
                show(errors)
            );
        }
    }
}

fn show(errors: &Six) -> String {
    errors.map(|e| format!("{e:.1e}")).join(" ")
}
