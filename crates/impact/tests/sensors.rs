//! Sensors: means over faces against finer sums, against points, and against the closed form of a point force.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{Choice, HalfSpace, Material, Settings, Striker};
use halfspace::{Arc, Face, random};
use impact::{
    Allowance, FaceMean, ForceRecord, KernelChoice, Load, Measured, Outcome, Probe, Quantity,
    Scene, Section, Sensor, Strike, simulate, simulate_within,
};
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

fn block(poisson_ratio: f64) -> HalfSpace {
    HalfSpace::new(Material::elastic(70e9, poisson_ratio, 2700.0).unwrap()).unwrap()
}

fn ball(diameter_m: f64, velocity_m_s: f64) -> Load {
    let steel = Material::elastic(209e9, 0.3, 7800.0).unwrap();
    let mass_kg = 7800.0 * PI / 6.0 * diameter_m.powi(3);
    Load::Strike(Strike {
        striker: Striker::new(steel, mass_kg, 0.5 * diameter_m).unwrap(),
        velocity_m_s,
    })
}

fn scene(target: HalfSpace, load: Load, tolerance: f64) -> Scene {
    Scene {
        target,
        load,
        settings: Settings {
            tolerance,
            ..Settings::default()
        },
        quantities: vec![Quantity::VelocityZ, Quantity::VelocityR],
        peaks: false,
        low_pass_hz: None,
        duration_s: None,
        probes: vec![],
        sensors: vec![],
        section: None,
    }
}

fn sensor(r_m: f64, z_m: f64, face_radius_m: f64, measured: Measured) -> Sensor {
    Sensor {
        r_m,
        z_m,
        face_radius_m,
        measured,
        response: None,
    }
}

fn run(scene: &Scene) -> Outcome {
    simulate(scene, &KernelChoice::Direct).unwrap()
}

/// A face of no size measures what a probe does.
#[test]
fn a_point_sensor_is_a_probe() {
    let mut asked = scene(block(0.25), ball(5e-3, 1.0), 1e-3);
    let (r_m, z_m) = (0.02, 0.004);
    asked.probes = vec![Probe { r_m, z_m }];
    asked.sensors = [
        Measured::DisplacementZ,
        Measured::StressZz,
        Measured::VelocityR,
    ]
    .map(|measured| sensor(r_m, z_m, 0.0, measured))
    .to_vec();
    let found = run(&asked);
    let probes = found.probes.unwrap();
    for (sensor, quantity) in found.sensors.iter().zip([1, 4, 7]) {
        assert_eq!(sensor.mean.samples, probes.values[quantity][0]);
        assert_eq!(sensor.mean.error, probes.errors[quantity][0]);
        assert_eq!(
            (sensor.face, &sensor.output),
            (FaceMean::Point, &sensor.mean.samples)
        );
        assert_eq!(sensor.arrival_s, probes.arrival_s[0]);
        let first = sensor.output_error.iter().position(|e| *e > 0.0).unwrap();
        assert!(found.series.time_s[first] >= sensor.arrival_s[0]);
    }
}

/// `tests/reference/face.py`, through a scene: a record of 20,000 rows on a disc of 1e-6 r. Its lines between rows cost 1e-8.
#[test]
fn means_are_those_of_a_closed_form() {
    const ROWS: usize = 20_000;
    let rows = include_str!("../../../tests/golden/face.csv").lines();
    let rows = rows
        .skip(1)
        .map(|row| row.split(',').map(|x| x.parse().unwrap()));
    let rows: Vec<Vec<f64>> = rows.map(Iterator::collect).collect();
    let r_m = 0.05;
    for case in rows.chunk_by(|one, other| one[..2] == other[..2]).take(2) {
        let target = block(0.25);
        let shear_pa = 70e9 / 2.5;
        let unit_s = r_m / (shear_pa / target.density_kg_m3()).sqrt();
        let length_s = case[0][1] * unit_s;
        let part = |i: usize| i as f64 / ROWS as f64;
        let time_s: Vec<f64> = (0..=ROWS).map(|i| length_s * part(i)).collect();
        let force_n = (0..=ROWS).map(|i| (PI * part(i)).sin().max(0.0).powf(1.5));
        let record = ForceRecord::new(time_s, force_n.collect()).unwrap();
        let mut asked = scene(target, Load::Record(record), 1e-8);
        asked.quantities.clear();
        asked.settings.disc_radius_m = Some(1e-6 * r_m);
        asked.settings.step_s = Some(length_s / 2000.0);
        asked.duration_s = Some(case.last().unwrap()[2] * unit_s);
        asked.sensors = vec![sensor(r_m, 0.0, case[0][0] * r_m, Measured::DisplacementZ)];
        let found = run(&asked);
        let (times_s, history) = (&found.series.time_s, &found.sensors[0]);
        let peak = case.iter().map(|row| row[3].abs()).fold(0.0, f64::max);
        let mut most = 0.0_f64;
        for row in case {
            let samples = &history.mean.samples;
            let after = times_s.partition_point(|t| *t < row[2] * unit_s);
            let first = after.saturating_sub(3).min(times_s.len() - 6);
            // of the fifth degree between samples
            let at = |k: usize| times_s[first + k];
            let value: f64 = (0..6)
                .map(|k| {
                    let others = (0..6).filter(|i| *i != k);
                    let factors = others.map(|i| (row[2] * unit_s - at(i)) / (at(k) - at(i)));
                    samples[first + k] * factors.product::<f64>()
                })
                .sum();
            most = most.max((value * shear_pa * r_m - row[3]).abs() / peak);
        }
        let estimate = history.mean.error * shear_pa * r_m / peak;
        println!(
            "face {} r: {most:.1e}, estimate {estimate:.1e}, {:?}",
            case[0][0], history.face
        );
        assert!(most < 2e-8, "{most:e}");
    }
}

/// A random face at a random place, beside or below the load, under a contact or a record.
fn drawn(round: usize, random: &mut random::Stream) -> Scene {
    let mut uniform = |from: f64, to: f64| random.within(from, to);
    let load = match round % 3 {
        0 | 1 => ball(uniform(1e-3, 8e-3), uniform(0.1, 3.0)),
        _ => {
            let length_s = uniform(2e-6, 2e-5);
            let time_s: Vec<f64> = (0..=200).map(|i| length_s * f64::from(i) / 200.0).collect();
            let force = time_s
                .iter()
                .map(|t| (PI * t / length_s).sin().max(0.0).powf(1.5));
            Load::Record(ForceRecord::new(time_s.clone(), force.collect()).unwrap())
        }
    };
    let tolerance = [1e-3, 1e-4][round % 2];
    let mut asked = scene(block(uniform(0.1, 0.4)), load, tolerance);
    if asked.record().is_some() {
        asked.settings.disc_radius_m = Some(uniform(1e-4, 1e-3));
    }
    let face_m = uniform(5e-4, 4e-3);
    let is_deep = round % 4 >= 2;
    let z_m = if is_deep { uniform(0.005, 0.02) } else { 0.0 };
    let measured = Measured::ALL[round % 5];
    // on the axis, where radial quantities vanish
    let is_below = is_deep && round % 8 == 2 && round % 5 != 1 && round % 5 != 3;
    let r_m = if is_below {
        0.0
    } else {
        face_m + uniform(0.002, 0.03)
    };
    asked.sensors = vec![sensor(r_m, z_m, face_m, measured)];
    asked.settings.step_s = Some(2e-7);
    asked.quantities.clear();
    asked.duration_s = Some(4e-5);
    asked
}

/// The mean by a sum over 60 to 1,200 circles ten times more accurate, and the largest error of these.
fn by_circles(asked: &Scene) -> (Vec<f64>, f64) {
    let Sensor {
        r_m,
        z_m,
        face_radius_m,
        measured,
        ..
    } = asked.sensors[0];
    let face = Face::new(r_m, face_radius_m).unwrap();
    // velocities just behind a Rayleigh wave are as narrow as the contact
    let is_needle = z_m == 0.0 && measured.unit() != "m" && asked.record().is_none();
    let arcs = face.arcs(match (r_m < 1.5 * face_radius_m, is_needle) {
        (true, _) => 60,
        (false, false) => 160,
        (false, true) => 1200,
    });
    let mut fine = asked.clone();
    (fine.settings.tolerance, fine.sensors) = (0.1 * asked.settings.tolerance, vec![]);
    fine.quantities = Quantity::named(measured.name()).into_iter().collect();
    fine.probes = arcs.iter().map(|arc| Probe { r_m: arc.r, z_m }).collect();
    let probes = run(&fine).probes.unwrap();
    let quantity = match measured {
        Measured::DisplacementR => 0,
        Measured::DisplacementZ => 1,
        Measured::StressZz => 4,
        _ => 6,
    };
    let weight = |arc: &Arc| match measured {
        Measured::DisplacementR | Measured::VelocityR | Measured::AccelerationR => arc.odd,
        _ => arc.even,
    };
    let rows = &probes.values[quantity];
    let at = |i: usize| {
        arcs.iter()
            .zip(rows)
            .map(|(arc, row)| weight(arc) * row[i])
            .sum()
    };
    let error = probes.errors[quantity]
        .iter()
        .fold(0.0, |a: f64, b| a.max(*b));
    ((0..rows[0].len()).map(at).collect(), error)
}

/// `drawn` faces against `by_circles`.
#[test]
fn means_over_faces_are_within_their_estimates() {
    let mut random = random::Stream::new(7);
    let (mut above, mut ratios) = (0, Vec::new());
    for round in 0..15 {
        let asked = drawn(round, &mut random);
        let found = run(&asked);
        let mean = &found.sensors[0].mean;
        let (wanted, own) = by_circles(&asked);
        let apart = mean.samples.iter().zip(&wanted).map(|(a, b)| (a - b).abs());
        let apart = apart.fold(0.0, f64::max);
        let relative = [apart, mean.error, own].map(|x| x / mean.peak().abs());
        let Sensor {
            r_m,
            z_m,
            face_radius_m,
            measured,
            ..
        } = asked.sensors[0];
        println!(
            "{round} r {r_m:.4} z {z_m:.4} face {face_radius_m:.4} {measured:?}: {:?}, error {:.1e}, estimate {:.1e}, of the finer {:.1e}",
            found.sensors[0].face, relative[0], relative[1], relative[2]
        );
        above += usize::from(apart > mean.error);
        ratios.push(mean.error / apart);
    }
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    println!(
        "{above} of {} above their estimates, in the median {median:.0} times the error",
        ratios.len()
    );
    assert!(above == 0, "{above}");
    assert!(median < 100.0, "{median}");
}

/// Progress is that of the points, with or without peaks, whose further instants are not points.
#[test]
fn each_point_counts_once() {
    let mut asked = scene(block(0.3), ball(2e-3, 0.5), 1e-2);
    asked.probes = vec![
        Probe {
            r_m: 0.01,
            z_m: 0.0,
        },
        Probe {
            r_m: 0.0,
            z_m: 0.01,
        },
    ];
    asked.sensors = vec![sensor(0.02, 0.0, 2e-3, Measured::VelocityZ)];
    asked.section = Some(Section {
        r_max_m: 0.01,
        z_max_m: 0.01,
        points: [3, 2],
        frames: 4,
        times_s: vec![],
    });
    for peaks in [false, true] {
        asked.peaks = peaks;
        let seen = AtomicUsize::new(0);
        let allowance = Allowance {
            watch: &|| {
                seen.fetch_add(1, Ordering::Relaxed);
            },
            ..Allowance::default()
        };
        simulate_within(&asked, &KernelChoice::Direct, &allowance).unwrap();
        assert_eq!(seen.into_inner(), asked.points());
    }
}
