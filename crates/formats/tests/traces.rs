//! Forces from traces: there and back through a scene, with noise, a response, and traces that are rejected.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use formats::parse_scene;
use formats::traces::{Given, KnownOf, Traces, infer_force, read_traces};
use halfspace::random::Stream;
use impact::{KernelChoice, Scene, simulate};
use std::io::Write;
use std::path::Path;

const BLOCK: &str = "[target]\nmaterial = \"aluminium\"\nthickness_m = 0.1\n[striker]\nmaterial = \"steel\"\nshape = \"ball\"\ndiameter_m = 3e-3\nvelocity_m_s = 0.3\n";
const RESPONSE: &str = "[sensor.response]\npoles = [[-8.886e4, 8.886e4], [-8.886e4, -8.886e4], [-4.712e4, 9.413e5], [-4.712e4, -9.413e5]]\nzeros = [0, 0]\ngain = 8.883e13\n";

fn scene(sensors: &str) -> Scene {
    parse_scene(&format!("{BLOCK}{sensors}"), Path::new(".")).unwrap()
}

fn sensor(r_m: f64, face_radius_m: f64, quantity: &str) -> String {
    format!(
        "[[sensor]]\nr_m = {r_m}\nz_m = 0\nface_radius_m = {face_radius_m}\nquantity = \"{quantity}\"\n"
    )
}

/// Traces from before a blow at 40 us until after its waves, with noise of a fraction of each peak; and the true peak force, duration
/// and impulse.
fn traces(scene: &Scene, noise: f64, seed: u64) -> (Traces, [f64; 3]) {
    let outcome = simulate(scene, &KernelChoice::Direct).unwrap();
    let times_s = &outcome.series.time_s;
    let mut random = Stream::new(seed);
    let mut normal = || (0..12).map(|_| random.next()).sum::<f64>() - 6.0;
    let time_s: Vec<f64> = (0..340).map(|i| 2e-7 * f64::from(i)).collect();
    let samples = outcome.sensors.iter().map(|own| {
        let peak = own.output.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        let at = |t: f64| {
            let after = times_s
                .partition_point(|own| *own < t)
                .clamp(1, times_s.len() - 1);
            let part = (t - times_s[after - 1]) / (times_s[after] - times_s[after - 1]);
            let [before, next] = [after - 1, after].map(|i| own.output[i]);
            if t <= 0.0 {
                0.0
            } else {
                before + part.min(1.0) * (next - before)
            }
        };
        let of = |t: &f64| at(t - 4e-5) + noise * peak * normal();
        time_s.iter().map(of).collect::<Vec<f64>>()
    });
    let samples = samples.collect();
    let results = outcome.results().unwrap();
    let truth = [
        results.peak_force_n,
        results.contact_time_s,
        results.impulse_n_s,
    ];
    (Traces::new(&time_s, samples).unwrap(), truth)
}

#[test]
fn a_force_comes_back() {
    let cases = [
        (sensor(0.04, 3e-3, "velocity_z") + RESPONSE, 0.01, 0.02),
        (sensor(0.04, 0.0, "displacement_z"), 0.01, 0.02),
        (sensor(0.03, 2e-3, "velocity_z"), 0.03, 0.05),
    ];
    for (seed, (sensors, noise, allowed)) in (1..).zip(cases) {
        let scene = scene(&sensors);
        let (traces, [peak_n, duration_s, impulse_n_s]) = traces(&scene, noise, seed);
        let found = infer_force(&scene, &[traces], &Given::default()).unwrap();
        let fit = &found.found.fit;
        let off = [
            fit.peak_n.value / peak_n,
            fit.duration_s.value / duration_s,
            fit.impulse_n_s.value / impulse_n_s,
            found.found.history.peak_n.value / peak_n,
        ]
        .map(|x| (x - 1.0).abs());
        println!("{seed}: {off:?}");
        assert!(
            off[0] < allowed && off[1] < allowed && off[3] < 1.5 * allowed,
            "{off:?}"
        );
        assert!((fit.start_s.value - 4e-5).abs() < 2e-7, "{:?}", fit.start_s);
        assert!(found.warnings.iter().any(|own| own.contains("yield")));
        assert!(
            !found.warnings.iter().any(|own| own.contains("explain")),
            "{:?}",
            found.warnings
        );
        let ball = found.ball.unwrap();
        assert!((ball.velocity_m_s.value / 0.3 - 1.0).abs() < 2.0 * allowed);
        let mass_kg = scene.strike().unwrap().striker.mass_kg;
        assert!((ball.mass_kg.value / mass_kg - 1.0).abs() < 4.0 * allowed);
    }
}

#[test]
fn several_sensors_and_repeated_drops() {
    let scene = scene(&(sensor(0.03, 2e-3, "displacement_z") + &sensor(0.05, 2e-3, "velocity_z")));
    let (mut first, [peak_n, ..]) = traces(&scene, 0.02, 3);
    // the second sensor has a gain that nobody knows
    first.samples[1].iter_mut().for_each(|x| *x *= -2.5);
    let given = Given {
        unknown_gains: vec![2],
        known: Some(KnownOf::Density),
        ..Given::default()
    };
    let found = infer_force(&scene, std::slice::from_ref(&first), &given).unwrap();
    assert!((found.found.fit.peak_n.value / peak_n - 1.0).abs() < 0.03);
    assert!((found.found.fit.gains[1].value / -2.5 - 1.0).abs() < 0.03);
    assert!((found.ball.unwrap().radius_m.value / 1.5e-3 - 1.0).abs() < 0.03);
    let mut drops: Vec<Traces> = (10..14).map(|seed| traces(&scene, 0.05, seed).0).collect();
    drops.iter_mut().for_each(|drop| drop.samples.truncate(2));
    let mean = infer_force(&scene, &drops, &Given::default()).unwrap();
    assert_eq!(mean.shifts_s.len(), 4);
    assert!((mean.found.fit.peak_n.value / peak_n - 1.0).abs() < 0.03);
}

/// A sensor of another radius and quantity than its scene says, and one of the wrong sign: no force explains the traces, and it says
/// so or finds none.
#[test]
fn traces_that_are_not_explained_cause_a_warning() {
    let (near, far) = (
        sensor(0.04, 2e-3, "velocity_z"),
        sensor(0.044, 2e-3, "velocity_z"),
    );
    let scene_of = scene(&near);
    let (moved, _) = traces(&scene(&far), 0.003, 9);
    let (mut turned, _) = traces(&scene_of, 0.01, 9);
    turned.samples[0].iter_mut().for_each(|x| *x = -*x);
    let told =
        [moved, turned].map(
            |traces| match infer_force(&scene_of, &[traces], &Given::default()) {
                Ok(found) => found.warnings.join("; "),
                Err(error) => error.to_string(),
            },
        );
    println!("{told:?}");
    for own in &told {
        assert!(
            own.contains("explains the traces") || own.contains("in the traces"),
            "{own}"
        );
    }
}

#[test]
fn traces_that_cannot_tell_are_rejected_in_a_sentence() {
    let scene_of = scene(&sensor(0.04, 0.0, "displacement_z"));
    let (good, _) = traces(&scene_of, 0.01, 5);
    let rejected = |traces: Traces, given: &Given| {
        let error = infer_force(&scene_of, &[traces], given)
            .unwrap_err()
            .to_string();
        println!("{error}");
        assert!(error.lines().count() == 1 && error.len() > 30);
        error
    };
    let mut later = good.clone();
    later.samples[0].drain(..250);
    assert!(rejected(later, &Given::default()).contains("before the trigger"));
    let mut two = good.clone();
    two.samples.push(good.samples[0].clone());
    assert!(rejected(two, &Given::default()).contains("2 traces"));
    let window_s = Some([3.9e-5, 9e-5]);
    assert!(
        rejected(
            good.clone(),
            &Given {
                window_s,
                ..Given::default()
            }
        )
        .contains("valid until")
    );
    let unknown_gains = vec![2];
    let given = Given {
        unknown_gains,
        ..Given::default()
    };
    assert!(rejected(good.clone(), &given).contains("numbered from 1 to 1"));
    let unknown_gains = vec![1];
    assert!(
        rejected(
            good,
            &Given {
                unknown_gains,
                ..Given::default()
            }
        )
        .contains("gain")
    );
    let uneven = Traces::new(&[0.0, 1e-6, 3e-6], vec![vec![0.0; 3]]);
    assert!(uneven.unwrap_err().to_string().contains("not equidistant"));
}

#[test]
fn traces_are_read_from_text() {
    let folder = tempfile::tempdir().unwrap();
    let read = |text: &str| {
        let path = folder.path().join("trace.csv");
        std::fs::File::create(&path)
            .unwrap()
            .write_all(text.as_bytes())
            .unwrap();
        read_traces(&path)
    };
    let found = read("# scope\nTime [us];A (V);B (V)\n-1;0,5;2\n0;1;3\n1;1,5;4\n").unwrap();
    assert_eq!(
        (found.start_s, found.samples),
        (-1e-6, vec![vec![0.5, 1.0, 1.5], vec![2.0, 3.0, 4.0]])
    );
    assert!((read("time_ns,a\n0,1\n50,2\n").unwrap().step_s - 5e-8).abs() < 1e-20);
    for (text, wanted) in [
        ("0,1\n1,2\n", "header"),
        ("time_h,a\n0,1\n1,2\n", "time_h"),
        ("time_s,a\n0,1\n1\n", "fields"),
        ("time_s,a\n0,1\n1,x\n", "finite number"),
        ("time_s,a\n", "no rows"),
    ] {
        let error = read(text).unwrap_err().to_string();
        assert!(
            error.contains(wanted) && error.contains("trace.csv"),
            "{error}"
        );
    }
}
