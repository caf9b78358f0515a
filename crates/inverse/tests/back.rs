//! There and back with noise: errors of fit and peak, and the coverage of the band.

mod common;

use common::{Place, Quantity, START, held, noisy, problem, quantile};
use inverse::{Pulse, infer};

const SEEDS: u64 = 50;

/// Standard deviations of peak, duration and start at a signal-to-noise ratio of 100 by the bound of Cramer and Rao: the
/// largest of each that docs/theory.md (T73) has for displacement and velocity.
const BOUNDS: [[f64; 3]; 2] = [[0.0034, 0.0030, 0.0018], [0.0030, 0.0008, 0.0006]];

#[test]
fn there_and_back() {
    let pulse = Pulse::hertz();
    let force = |t: f64| pulse.at(t - START)[0];
    let mut failed = Vec::new();
    println!(
        "quantity, r/(c2 tc), S/N | errors of fit in %: P, tc, t0/tc | 90 % of peak, impulse | band: contact, window"
    );
    for (quantity, bounds) in [
        (Quantity::Displacement, BOUNDS[0]),
        (Quantity::Velocity, BOUNDS[1]),
    ] {
        for distance in [0.5, 2.0, 10.0] {
            let place = Place {
                quantity,
                distance,
                start: START,
            };
            let (clean, response) = (place.clean(&force), place.response());
            for (snr, most) in [(100.0, 0.02), (30.0, 0.07), (10.0, 0.2)] {
                let (mut squares, mut peaks, mut impulses) = ([0.0; 3], vec![], vec![]);
                let mut counts = [[0.0; 2]; 2];
                for seed in 0..SEEDS {
                    let trace = noisy(&clean, &response, snr, seed);
                    let found = infer(&problem(&pulse, place, vec![trace])).expect("a force");
                    let (fit, history) = (&found.fit, &found.history);
                    let errors = [
                        fit.peak_n.value - 1.0,
                        fit.duration_s.value - 1.0,
                        fit.start_s.value - START,
                    ];
                    squares
                        .iter_mut()
                        .zip(errors)
                        .for_each(|(sum, e)| *sum += e * e / SEEDS as f64);
                    peaks.push((history.peak_n.value - 1.0).abs());
                    impulses.push((history.impulse_n_s.value / pulse.mean() - 1.0).abs());
                    let more = held(history, &force);
                    (0..4).for_each(|i| counts[i / 2][i % 2] += more[i / 2][i % 2]);
                }
                let rms = squares.map(f64::sqrt);
                let [peak, impulse] = [&peaks, &impulses].map(|values| quantile(values, 0.9));
                let [contact, window] = counts.map(|[holds, all]| holds / all);
                println!(
                    "{quantity:?} {distance} {snr} | {:.2} {:.2} {:.2} | {:.1} % {:.1} % | {:.1} % {:.1} %",
                    100.0 * rms[0],
                    100.0 * rms[1],
                    100.0 * rms[2],
                    100.0 * peak,
                    100.0 * impulse,
                    100.0 * contact,
                    100.0 * window
                );
                let fitted = rms
                    .iter()
                    .zip(bounds)
                    .all(|(error, bound)| *error < 2.0 * bound * 100.0 / snr);
                let good = fitted
                    && peak < most
                    && [contact, window]
                        .iter()
                        .all(|part| (0.9..=0.98).contains(part));
                if !good {
                    failed.push((quantity, distance, snr));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}
