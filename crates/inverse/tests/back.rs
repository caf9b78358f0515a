//! There and back with noise: errors of fit and peak, and the coverage of the band.

mod common;

use common::{Place, Quantity, START, held, noisy, problem, quantile};
use inverse::{Pulse, infer};

const SEEDS: u64 = 50;

/// Quantity, distance in c2 tc, and the standard deviations in % of peak, duration and start (over the duration) at a
/// signal-to-noise ratio of 100 by the bound of Cramer and Rao, see docs/theory.md (T73) and scripts/theory/inversion.py.
const PLACES: [(Quantity, f64, [f64; 3]); 6] = [
    (Quantity::Displacement, 0.5, [0.34, 0.30, 0.18]),
    (Quantity::Displacement, 2.0, [0.33, 0.22, 0.13]),
    (Quantity::Displacement, 10.0, [0.31, 0.22, 0.13]),
    (Quantity::Velocity, 0.5, [0.27, 0.06, 0.03]),
    (Quantity::Velocity, 2.0, [0.29, 0.07, 0.05]),
    (Quantity::Velocity, 10.0, [0.29, 0.07, 0.05]),
];

#[test]
fn there_and_back() {
    let pulse = Pulse::hertz();
    let force = |t: f64| pulse.at(t - START)[0];
    let mut failed = Vec::new();
    println!(
        "quantity, r/(c2 tc), S/N | errors of fit in %: P, tc, t0/tc | 90 % of peak, impulse | band: contact, window"
    );
    for (quantity, distance, bounds) in PLACES {
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
                .all(|(error, bound)| *error < 2.0 * bound / snr);
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
    assert!(failed.is_empty(), "{failed:?}");
}
