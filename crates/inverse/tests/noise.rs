//! Coloured noise, as of a resonant sensor, against the same treated as white.

mod common;

use common::{Place, Quantity, held, normal, peak, problem, quantile};
use inverse::{Gain, Noise, Pulse, Trace, Whitening, infer};

/// Quiet durations before the blow.
const QUIET: f64 = 6.313;

/// Noise of a resonance whose period is 16 samples, 0.6 of the contact, with a standard deviation of one.
fn resonance(seed: u64, count: usize) -> Vec<f64> {
    let (radius, angle) = (0.98_f64, 0.4_f64);
    let (mut last, mut before) = (0.0, 0.0);
    let drawn = normal(seed, count + 500).into_iter().map(|e| {
        let next = 2.0 * radius * angle.cos() * last - radius * radius * before + e;
        (before, last) = (last, next);
        next
    });
    let found: Vec<f64> = drawn.skip(500).collect();
    let r2 = radius * radius;
    // variance of the process
    let variance = (1.0 + r2) / ((1.0 - r2) * (1.0 + r2 * r2 - 2.0 * r2 * (2.0 * angle).cos()));
    found.iter().map(|x| x / variance.sqrt()).collect()
}

#[test]
fn coloured_noise_is_whitened() {
    let pulse = Pulse::hertz();
    let place = Place {
        quantity: Quantity::Displacement,
        distance: 2.0,
        start: QUIET,
    };
    let force = |t: f64| pulse.at(t - QUIET)[0];
    let (clean, response) = (place.clean(&force), place.response());
    for snr in [30.0, 10.0] {
        let sigma = peak(&clean) / snr;
        let mut results = [(); 2].map(|()| (0.0, vec![], [[0.0; 2]; 2], 0.0));
        for seed in 0..30 {
            let noise = resonance(seed, clean.len());
            let samples: Vec<f64> = clean
                .iter()
                .zip(noise)
                .map(|(x, n)| x + sigma * n)
                .collect();
            for (kind, result) in [Noise::Quiet(0..150), Noise::White(sigma)]
                .into_iter()
                .zip(&mut results)
            {
                let trace = Trace {
                    samples: samples.clone(),
                    response: response.clone(),
                    noise: kind,
                    gain: Gain::Known(1.0),
                    valid_until_s: None,
                };
                let found = infer(&problem(&pulse, place, vec![trace])).expect("a force");
                result.0 += (found.fit.peak_n.value - 1.0).powi(2) / 30.0;
                result.1.push((found.history.peak_n.value - 1.0).abs());
                let more = held(&found.history, &force);
                (0..4).for_each(|i| result.2[i / 2][i % 2] += more[i / 2][i % 2]);
                result.3 += found.noise[0].order as f64 / 30.0;
            }
        }
        for (name, result) in ["whitened", "as white"].iter().zip(&results) {
            let [contact, window] = result.2.map(|[holds, all]| 100.0 * holds / all);
            println!(
                "{name} {snr}: fit of P {:.2} %, peak {:.1} %, band {contact:.1} % {window:.1} %, order {:.1}",
                100.0 * result.0.sqrt(),
                100.0 * quantile(&result.1, 0.9),
                result.3
            );
        }
        let [ours, white] = &results;
        assert!(ours.0.sqrt() < 0.85 * white.0.sqrt());
        assert!(quantile(&ours.1, 0.9) < 0.85 * quantile(&white.1, 0.9));
        let [held, held_white] = [ours, white].map(|result| result.2[0][0] / result.2[0][1]);
        assert!(
            (0.88..0.98).contains(&held) && held_white < 0.85,
            "{held} {held_white}"
        );
    }
}

#[test]
fn the_filter_whitens() {
    // of a long quiet part the residual is white with a standard deviation of one, also for other noise of the same sensor
    let filter = Whitening::of_quiet(&resonance(1, 4000));
    assert!((filter.sigma - 1.0).abs() < 0.1, "{}", filter.sigma);
    let residual = filter.apply(&resonance(2, 4000), 1);
    let used = &residual[filter.order()..];
    let of = |lag: usize| {
        used[lag..]
            .iter()
            .zip(used)
            .map(|(a, b)| a * b)
            .sum::<f64>()
            / used.len() as f64
    };
    assert!((of(0) - 1.0).abs() < 0.07, "{}", of(0));
    for lag in 1..20 {
        assert!(
            of(lag).abs() < 4.0 / (used.len() as f64).sqrt(),
            "{lag}: {}",
            of(lag)
        );
    }
    // white noise mostly stays as it is
    let orders: Vec<usize> = (0..100)
        .map(|seed| Whitening::of_quiet(&normal(seed, 100)).order())
        .collect();
    assert!(
        orders.iter().filter(|order| **order == 0).count() > 60,
        "{orders:?}"
    );
    // a response between samples is filtered with the step of the trace
    let by_hand = Whitening {
        filter: vec![1.0, -0.5],
        sigma: 1.0,
    };
    assert_eq!(
        by_hand.apply(&[1.0, 0.0, 0.0, 2.0], 2),
        [1.0, 0.0, -0.5, 2.0]
    );
}
