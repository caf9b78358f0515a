//! Forces that are not the pulse of the fit.

mod common;

use common::{Place, Quantity, START, held, noisy, problem, quantile};
use inverse::{Pulse, infer};

/// Name and force over time. Forces with a corner, such as a triangle, are not smooth: their bands hold less than that.
type Shape = (&'static str, fn(&Pulse, f64) -> f64);

const SHAPES: [Shape; 2] = [
    // as of a contact that yields: longer in loading, steep in unloading
    ("plastic", |_, t| {
        let half_pi = std::f64::consts::FRAC_PI_2;
        match t {
            0.0..0.68 => (half_pi * t / 0.68).sin().powf(1.2),
            0.68..1.0 => (half_pi * (1.0 - t) / 0.32).sin().powf(1.5),
            _ => 0.0,
        }
    }),
    ("double", |pulse, t| {
        pulse.at(t / 0.6)[0] + 0.6 * pulse.at((t - 0.75) / 0.6)[0]
    }),
];

/// The other shapes are found whole and within their bands, though the fit is of Hertz's pulse.
#[test]
fn a_double_blow_is_found_whole() {
    let pulse = Pulse::hertz();
    let mut failed = Vec::new();
    for (name, shape) in SHAPES {
        let force = |t: f64| shape(&pulse, t - START);
        let largest = (0..2000)
            .map(|i| force(0.001 * f64::from(i)))
            .fold(0.0, f64::max);
        for quantity in [Quantity::Displacement, Quantity::Velocity] {
            for distance in [0.5, 10.0] {
                let place = Place {
                    quantity,
                    distance,
                    start: START + 0.4,
                };
                let (clean, response) = (place.clean(&force), place.response());
                for (snr, most) in [(100.0, 0.03), (10.0, 0.2)] {
                    let (mut peaks, mut counts, mut spans) = (vec![], [[0.0; 2]; 2], vec![]);
                    for seed in 0..10 {
                        let trace = noisy(&clean, &response, snr, seed);
                        let found = infer(&problem(&pulse, place, vec![trace])).expect("a force");
                        let history = &found.history;
                        peaks.push((history.peak_n.value / largest - 1.0).abs());
                        let more = held(history, &force);
                        (0..4).for_each(|i| counts[i / 2][i % 2] += more[i / 2][i % 2]);
                        spans.push(history.start_s + history.step_s * history.force_n.len() as f64);
                    }
                    let peak = quantile(&peaks, 0.9);
                    let [contact, window] = counts.map(|[holds, all]| holds / all);
                    println!(
                        "{name} {quantity:?} {distance} {snr}: peak {:.1} %, band {:.1} % {:.1} %, until {:.2}",
                        100.0 * peak,
                        100.0 * contact,
                        100.0 * window,
                        quantile(&spans, 0.1)
                    );
                    if peak > most || contact < 0.88 || quantile(&spans, 0.0) < START + 1.0 {
                        failed.push((name, quantity, distance, snr));
                    }
                }
            }
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}
