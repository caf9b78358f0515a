//! The force at each instant of ordinary impacts: against the same contact at a tolerance of 1e-8.
//!
//! `cargo test -p hertzlamb-contact --test history -- --nocapture` prints the errors.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{Collision, Exact, HalfSpace, Material, Model, Settings, Solver, Striker};
use contact::{Resampler, work_until_j};
use std::f64::consts::PI;

/// Half-space, ball, its radius in m, velocity in m/s.
const IMPACTS: [(&str, &str, f64, f64); 6] = [
    ("soda-lime-glass", "bearing-steel", 0.005, 1.0),
    ("granite", "bearing-steel", 0.005, 2.0),
    ("steel", "bearing-steel", 0.01, 0.5),
    ("pmma", "bearing-steel", 0.003, 1.0),
    ("steel", "copper", 0.005, 1.0),
    ("steel", "alumina-99.5", 0.004, 3.0),
];

/// Samples, denser toward both ends.
const SAMPLES: u32 = 3000;

/// Parts of the contact at its ends within which rates are not compared.
const ENDS: f64 = 0.002;

/// A contact's force at any time, its estimated error, and its duration.
fn solved(
    (target, striker, radius_m, velocity_m_s): (&str, &str, f64, f64),
    model: Model,
    tolerance: f64,
) -> (Resampler, f64, f64) {
    let block = HalfSpace::new(Material::named(target).unwrap()).unwrap();
    let ball = Striker::ball(Material::named(striker).unwrap(), radius_m).unwrap();
    let settings = Settings {
        model,
        tolerance,
        disc_radius_m: (model == Model::Wave).then_some(0.2 * radius_m),
        ..Settings::default()
    };
    let collision = Collision::new(&block, &ball, velocity_m_s);
    let (solved, history) = Solver::new(&Exact)
        .solve_with_history(&collision, &settings)
        .unwrap();
    let error = history.error;
    (Resampler::new(history), error, solved.summary.contact_time)
}

/// Largest differences of force, rate and second rate over the peaks of the first two; the latter two without the very
/// ends, within which they have no bound.
fn differences(found: &Resampler, exact: &Resampler, duration: f64) -> [f64; 3] {
    let (mut largest, mut peaks) = ([0.0_f64; 3], [0.0_f64; 2]);
    for i in 1..SAMPLES {
        let part = (0.5 * PI * f64::from(i) / f64::from(SAMPLES)).sin().powi(2);
        let (a, b) = (found.force(part * duration), exact.force(part * duration));
        let inside = part > ENDS && part < 1.0 - ENDS;
        for k in 0..3 {
            if k == 0 || inside {
                largest[k] = largest[k].max((a[k] - b[k]).abs());
            }
        }
        peaks = [0, 1].map(|k| peaks[k].max(b[k].abs()));
    }
    let [force, rate, second] = largest;
    [force / peaks[0], rate / peaks[1], second / peaks[1]]
}

#[test]
fn the_force_is_within_its_estimate_at_each_instant() {
    for model in [Model::Wave, Model::Growing, Model::AreaDashpot] {
        for impact in IMPACTS {
            let (exact, ..) = solved(impact, model, 1e-8);
            for tolerance in [1e-3, 1e-4] {
                let (found, estimate, duration) = solved(impact, model, tolerance);
                let [force, rate, second] = differences(&found, &exact, duration);
                println!(
                    "{model:?} {impact:?} {tolerance:e}: force {force:.1e} (estimate {estimate:.1e}), rate {rate:.1e}, second rate {second:.1e}"
                );
                assert!(force < tolerance && force < estimate, "{impact:?}");
                assert!(
                    estimate < 100.0 * force,
                    "{impact:?}: {estimate:e} {force:e}"
                );
                assert!(rate < 10.0 * tolerance, "{impact:?}: {rate:e}");
            }
        }
    }
}

/// Largest difference of the deflection over the largest, and that of its work.
fn of_deflections(found: &Resampler, exact: &Resampler, duration: f64) -> [f64; 2] {
    let times = (0..SAMPLES).map(|i| duration * f64::from(i) / f64::from(SAMPLES));
    let of = |one: &Resampler| -> [Vec<f64>; 2] {
        let states: Vec<_> = times.clone().map(|time| one.at(time)).collect();
        [
            states.iter().map(|now| now.force).collect(),
            states.iter().map(|now| now.deflection).collect(),
        ]
    };
    let ([force, found], [exact_force, exact]) = (of(found), of(exact));
    let largest = exact.iter().fold(0.0_f64, |most, w| most.max(w.abs()));
    let pairs = found.iter().zip(&exact);
    let off = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let work = |p: &[f64], w: &[f64]| work_until_j(p, w).last().copied().unwrap();
    let works = [work(&force, &found), work(&exact_force, &exact)];
    [off / largest, (works[0] / works[1] - 1.0).abs()]
}

/// The energy that is radiated until an instant comes from the deflection.
#[test]
fn the_deflection_of_the_area_dashpot_is_within_a_percent() {
    let model = Model::AreaDashpot;
    for impact in IMPACTS {
        let (exact, ..) = solved(impact, model, 1e-8);
        for tolerance in [1e-2, 1e-3, 1e-4, 1e-5] {
            let (found, _, duration) = solved(impact, model, tolerance);
            let [off, work] = of_deflections(&found, &exact, duration);
            println!("{impact:?} {tolerance:e}: deflection {off:.1e}, work {work:.1e}");
            assert!(off < 1e-2 && work < 1e-3, "{impact:?}: {off:e} {work:e}");
        }
    }
}

#[test]
fn rates_are_those_of_the_force() {
    for model in [
        Model::Wave,
        Model::Growing,
        Model::AreaDashpot,
        Model::QuasiStaticRadiation,
    ] {
        let (found, _, duration) = solved(IMPACTS[1], model, 1e-4);
        let [begin, .., end] = &found.breaks[..] else {
            panic!("{:?}", found.breaks)
        };
        assert!(*begin == 0.0 && (end / duration - 1.0).abs() < 1e-4);
        for part in [0.01, 0.1, 0.37, 0.8, 0.97] {
            let (time, step) = (part * duration, 1e-5 * duration);
            let at = |k: usize, time: f64| found.force(time)[k];
            for k in [0, 1] {
                let slope = (at(k, time + step) - at(k, time - step)) / (2.0 * step);
                let size = at(k + 1, 0.1 * duration).abs();
                let error = (at(k + 1, time) - slope).abs() / size;
                assert!(error < 1e-4, "{model:?} {part} {k}: {error:e}");
            }
            let now = found.at(time);
            assert_eq!(now.force, found.force(time)[0]);
            let indentation = now.displacement - now.deflection;
            assert!((indentation.powf(1.5) - now.force).abs() < 1e-9);
            // v' = -(5/4) p, and the power 3/2 at the touch
            let later = found.at(time + step).velocity - found.at(time - step).velocity;
            let missed = (later / (2.0 * step) + 1.25 * now.force).abs();
            assert!(missed < 2e-4, "{model:?} {part}: {missed:e}");
        }
        // 4^(3/2) on a disc; waves or a dashpot make a layer there in contacts whose radius follows the load
        let early = |part: f64| found.force(part * duration)[0];
        let growth = early(4e-6) / early(1e-6);
        let power = (growth / 8.0 - 1.0).abs() < 0.05;
        assert!(power || model != Model::Wave, "{model:?}: {growth}");
        assert_eq!(found.force(1.001 * duration), [0.0; 3]);
    }
}

#[test]
fn forces_at_many_times_are_those_at_each() {
    for impact in IMPACTS {
        for model in [Model::Growing, Model::AreaDashpot, Model::Wave] {
            let (found, _, duration) = solved(impact, model, 1e-5);
            let step = 1.1 * duration / f64::from(SAMPLES);
            let times: Vec<f64> = (-20..i32::try_from(SAMPLES).unwrap())
                .map(|i| f64::from(i) * step)
                .collect();
            let peaks = times.iter().map(|&time| found.force(time));
            let peaks = peaks.fold([0.0_f64; 2], |most, own| {
                [most[0].max(own[0]), most[1].max(own[1].abs())]
            });
            for (own, &time) in found.forces(&times).iter().zip(&times) {
                let alone = found.force(time);
                for k in 0..2 {
                    let off = (own[k] - alone[k]).abs() / peaks[k];
                    assert!(
                        off < 1e-11,
                        "{impact:?} {model:?} {}: {off:.1e}",
                        time / duration
                    );
                }
            }
        }
    }
}
