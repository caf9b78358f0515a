//! There and back with noise: errors of peak and fit, and coverage of the band.

mod common;

use common::{Place, Quantity, START, noisy, problem, quantile};
use inverse::{Pulse, infer};

/// Seeds of each row.
const SEEDS: u64 = 50;

struct Row {
    fit: [[f64; 50]; 3],
    peak: Vec<f64>,
    impulse: Vec<f64>,
    inside: [f64; 2],
    window: [f64; 2],
}

#[test]
fn there_and_back() {
    let pulse = Pulse::hertz();
    let mut fails = Vec::new();
    println!(
        "quantity, r/(c2 tc), snr | fit: sd of P, tc, t0 (and claimed) | peak 90 %, impulse 90 % | band in contact, in window"
    );
    for quantity in [Quantity::Displacement, Quantity::Velocity] {
        for distance in [0.5, 2.0, 10.0] {
            let place = Place { quantity, distance };
            let force = |t: f64| pulse.at(t - START)[0];
            let (clean, response) = (place.clean(&force), place.response());
            for snr in [100.0, 30.0, 10.0] {
                let mut row = Row {
                    fit: [[0.0; 50]; 3],
                    peak: vec![],
                    impulse: vec![],
                    inside: [0.0; 2],
                    window: [0.0; 2],
                };
                let mut claimed = [0.0; 3];
                for seed in 0..SEEDS {
                    let found = infer(&problem(&pulse, vec![noisy(&clean, &response, snr, seed)]))
                        .expect("a force");
                    let fit = &found.fit;
                    for (i, (value, exact)) in [
                        (fit.peak_n, 1.0),
                        (fit.duration_s, 1.0),
                        (fit.start_s, START),
                    ]
                    .iter()
                    .enumerate()
                    {
                        row.fit[i][seed as usize] = value.value - exact;
                        claimed[i] += value.sd / SEEDS as f64;
                    }
                    let history = &found.history;
                    row.peak.push((history.peak_n.value - 1.0).abs());
                    row.impulse
                        .push((history.impulse_n_s.value / pulse.mean() - 1.0).abs());
                    for (j, (low, high)) in history.low_n.iter().zip(&history.high_n).enumerate() {
                        let exact = force(history.start_s + j as f64 * history.step_s);
                        let holds =
                            f64::from(u8::from((low - 1e-12..=high + 1e-12).contains(&exact)));
                        row.window[0] += holds;
                        row.window[1] += 1.0;
                        if exact > 0.0 {
                            row.inside[0] += holds;
                            row.inside[1] += 1.0;
                        }
                    }
                }
                let rms = row.fit.map(|errors| {
                    (errors.iter().map(|e| e * e).sum::<f64>() / SEEDS as f64).sqrt()
                });
                let [inside, window] = [row.inside, row.window].map(|[n, all]| n / all);
                let (peak, impulse) = (quantile(&row.peak, 0.9), quantile(&row.impulse, 0.9));
                println!(
                    "{quantity:?} {distance} {snr} | {:.4} {:.4} {:.4} ({:.4} {:.4} {:.4}) | {peak:.4} {impulse:.4} | {inside:.3} {window:.3}",
                    rms[0], rms[1], rms[2], claimed[0], claimed[1], claimed[2]
                );
                let most = match snr {
                    100.0 => 0.02,
                    30.0 => 0.07,
                    _ => 0.2,
                };
                if peak > most
                    || !(0.90..=0.98).contains(&inside)
                    || !(0.9..=0.98).contains(&window)
                {
                    fails.push((quantity, distance, snr, peak, inside, window));
                }
            }
        }
    }
    assert!(fails.is_empty(), "{fails:?}");
}
