//! Several sensors with unknown gains, repeated drops, balls.

mod common;

use common::{Place, Quantity, START, held, noisy, normal, peak, problem};
use contact::CollisionUnits;
use inverse::{Estimate, Gain, Known, Pulse, average, ball, infer, momentum};

const GAINS: [f64; 4] = [1.0, -3.7, 0.02, 140.0];

/// Four sensors with these gains.
fn traces(pulse: &Pulse, snr: f64, seed: u64) -> (Place, Vec<inverse::Trace>) {
    let far = Place {
        quantity: Quantity::Displacement,
        distance: 3.0,
        start: START,
    };
    let traces =
        [0.8, 1.4, 2.2, 3.0]
            .iter()
            .zip(GAINS)
            .enumerate()
            .map(|(k, (&distance, gain))| {
                let place = Place { distance, ..far };
                let clean: Vec<f64> = place.clean(&|t| pulse.at(t - START)[0]);
                let response = coarse(place, far);
                let mut trace = noisy(&clean, &response, snr, 100 * seed + k as u64);
                trace.samples.iter_mut().for_each(|x| *x *= gain);
                if let inverse::Noise::White(sigma) = &mut trace.noise {
                    *sigma *= gain.abs();
                }
                trace.gain = if k == 0 {
                    Gain::Known(gain)
                } else {
                    Gain::Unknown
                };
                trace
            });
    (far, traces.collect())
}

/// The response of a place on the force step of the farthest one.
fn coarse(place: Place, far: Place) -> Vec<f64> {
    let width = 1.0 / (common::SAMPLES * far.oversampling()) as f64;
    let integral = |t: f64| common::pekeris(t / place.distance);
    common::hat(
        integral,
        place.quantity,
        width,
        place.samples() * far.oversampling(),
    )
}

#[test]
fn unknown_gains() {
    let pulse = Pulse::hertz();
    let (mut within, mut all) = (0, 0);
    let (mut errors, mut jack, mut counts) = (0.0, 0.0, [[0.0; 2]; 2]);
    for seed in 0..20 {
        let (place, traces) = traces(&pulse, 50.0, seed);
        let found = infer(&problem(&pulse, place, traces)).expect("a force");
        for gains in [&found.fit.gains, &found.history.gains] {
            assert_eq!(
                gains[0],
                Estimate {
                    value: 1.0,
                    sd: 0.0
                }
            );
            for (gain, exact) in gains.iter().zip(GAINS).skip(1) {
                assert!(
                    (gain.value / exact - 1.0).abs() < 0.05,
                    "{gain:?} instead of {exact}"
                );
                within += usize::from((gain.value - exact).abs() < 2.0 * gain.sd);
                all += 1;
            }
        }
        errors += (found.history.peak_n.value - 1.0).powi(2) / 20.0;
        let more = held(&found.history, &|t| pulse.at(t - START)[0]);
        (0..4).for_each(|i| counts[i / 2][i % 2] += more[i / 2][i % 2]);
        let jackknife = found.jackknife.expect("four traces");
        assert_eq!(jackknife.peak_n.len(), 4);
        jack += jackknife.peak_sd_n / 20.0;
    }
    let [contact, window] = counts.map(|[holds, all]| holds / all);
    println!("band: contact {contact:.3}, window {window:.3}");
    assert!((0.9..0.99).contains(&contact) && (0.9..0.99).contains(&window));
    println!(
        "gains within two standard deviations: {within} of {all}; peak {:.4}, jackknife {jack:.4}",
        errors.sqrt()
    );
    assert!(within as f64 > 0.85 * all as f64, "{within} of {all}");
    assert!(jack > 0.2 * errors.sqrt() && jack < 5.0 * errors.sqrt());
}

#[test]
fn an_impulse_in_place_of_gains() {
    let pulse = Pulse::hertz();
    let (place, mut traces) = traces(&pulse, 50.0, 3);
    traces[0].gain = Gain::Unknown;
    let impulse = pulse.mean();
    let mut problem = problem(&pulse, place, traces);
    let said = infer(&problem).expect_err("no scale").to_string();
    assert!(said.contains("no gain is known"), "{said}");
    problem.impulse_n_s = Some(Estimate {
        value: impulse,
        sd: 0.001 * impulse,
    });
    let found = infer(&problem).expect("a force");
    assert!(
        (found.history.impulse_n_s.value / impulse - 1.0).abs() < 0.003,
        "{:?}",
        found.history.impulse_n_s
    );
    assert!(
        (found.fit.impulse_n_s.value / impulse - 1.0).abs() < 0.003,
        "{:?}",
        found.fit.impulse_n_s
    );
    for gains in [&found.fit.gains, &found.history.gains] {
        for (gain, exact) in gains.iter().zip(GAINS) {
            assert!(
                (gain.value / exact - 1.0).abs() < 0.05,
                "{gain:?} instead of {exact}"
            );
        }
    }
}

#[test]
fn repeated_drops() {
    let pulse = Pulse::hertz();
    let drops = |snr: f64| -> Vec<Vec<Vec<f64>>> {
        (0..16)
            .map(|k| {
                let late = if k == 0 {
                    0.0
                } else {
                    5.37 * (f64::from(k) * 1.7).sin()
                };
                let noise = normal(u64::from(k as u32) + 40, 200);
                let sample = |i: u32| {
                    pulse.at((f64::from(i) - 60.0 - late) / 70.0)[0] + noise[i as usize] / snr
                };
                vec![(0..200).map(sample).collect()]
            })
            .collect()
    };
    let found = average(&drops(30.0), 1e-6).expect("a mean");
    for (k, shift) in found.shifts_s.iter().enumerate().skip(1) {
        let late = 5.37 * (k as f64 * 1.7).sin();
        assert!(
            (shift * 1e6 - late).abs() < 0.6,
            "{k}: {shift:e} instead of {late} us"
        );
    }
    let errors: Vec<f64> = (0..200)
        .map(|i| found.mean[0][i] - pulse.at((i as f64 - 60.0) / 70.0)[0])
        .collect();
    let quiet = (errors[20..50].iter().map(|e| e * e).sum::<f64>() / 30.0).sqrt();
    let claimed = found.sd[0][20..50].iter().sum::<f64>() / 30.0;
    println!(
        "noise of the mean of 16: {quiet:.4}, claimed {claimed:.4}, of one {:.4}",
        1.0 / 30.0
    );
    assert!(quiet < 0.4 / 30.0 && (claimed / quiet - 1.0).abs() < 0.4);
    assert!(peak(&errors) < 0.04, "{}", peak(&errors));

    let mut other = drops(30.0);
    let said = |drops: &[Vec<Vec<f64>>]| average(drops, 1e-6).expect_err("an error").to_string();
    other[5] = vec![normal(9, 200)];
    assert!(said(&other).contains("the correlation of drop 6 with the first = "));
    other[5][0].truncate(150);
    assert!(said(&other).contains("drop 6 = 150 is outside [200, 200]"));
    assert!(average(&other[..1], 1e-6).is_err());
}

/// A sensor with much noise follows the shift that a good one shows.
#[test]
fn sensors_of_a_drop_have_one_shift() {
    let pulse = Pulse::hertz();
    let lates = [0.0, 3.4, -4.7, 1.2, 2.9, -2.2];
    let drop = |(k, late): (usize, f64)| -> Vec<Vec<f64>> {
        let trace = |sensor: usize, sigma: f64| {
            let noise = normal((100 + 10 * k + sensor) as u64, 200);
            let sample = |i: usize| pulse.at((i as f64 - 60.0 - late) / 70.0)[0] + sigma * noise[i];
            (0..200).map(sample).collect()
        };
        vec![trace(0, 0.003), trace(1, 0.3)]
    };
    let drops: Vec<Vec<Vec<f64>>> = lates.into_iter().enumerate().map(drop).collect();
    let both = average(&drops, 1e-6).expect("a mean");
    let noisy: Vec<Vec<Vec<f64>>> = drops.iter().map(|drop| vec![drop[1].clone()]).collect();
    let alone = average(&noisy, 1e-6).expect("a mean");
    let worst = |shifts_s: &[f64]| {
        let late = lates.iter().zip(shifts_s);
        late.fold(0.0, |most: f64, (late, found)| {
            most.max((found * 1e6 - late).abs())
        })
    };
    let [both, alone] = [both, alone].map(|found| worst(&found.shifts_s));
    println!(
        "shifts are off by {both:.2} samples with both sensors, {alone:.2} with the noisy one"
    );
    assert!(both < 0.3 && both < 0.2 * alone, "{both} {alone}");
}

#[test]
fn balls_of_one_known_property() {
    // a steel ball of 2 mm radius at 0.5 m/s, E* = 110 GPa
    let (radius, density, velocity, modulus) = (0.002, 7800.0, 0.5, 110e9);
    let mass = 4.0 / 3.0 * std::f64::consts::PI * density * f64::powi(radius, 3);
    let units = CollisionUnits::new(4.0 / 3.0 * modulus * radius.sqrt(), mass, velocity);
    let pulse = Pulse::hertz();
    let place = Place {
        quantity: Quantity::Displacement,
        distance: 2.0,
        start: START,
    };
    let (clean, response) = (place.clean(&|t| pulse.at(t - START)[0]), place.response());
    let mut deviations = vec![];
    for seed in 0..30 {
        let found = infer(&problem(
            &pulse,
            place,
            vec![noisy(&clean, &response, 100.0, seed)],
        ))
        .expect("a force");
        let mut fit = found.fit;
        // from units of the peak and the duration to SI
        let scale = [
            units.force_n,
            contact::law::hertz::CONTACT_TIME * units.time_s,
            1.0,
        ];
        for (i, value) in [&mut fit.peak_n, &mut fit.duration_s]
            .into_iter()
            .enumerate()
        {
            value.value *= scale[i];
        }
        fit.covariance = std::array::from_fn(|i| {
            std::array::from_fn(|j| fit.covariance[i][j] * scale[i] * scale[j])
        });
        for known in [
            Known::Radius(radius),
            Known::Density(density),
            Known::Mass(mass),
        ] {
            let ball = ball(&fit, modulus, known).expect("a ball");
            for (value, exact) in [
                (ball.radius_m, radius),
                (ball.mass_kg, mass),
                (ball.velocity_m_s, velocity),
            ] {
                assert!(
                    (value.value / exact - 1.0).abs() < 0.05,
                    "{known:?}: {value:?} instead of {exact}"
                );
                if value.sd > 1e-9 * value.value {
                    deviations.push((value.value - exact) / value.sd);
                }
            }
        }
    }
    let rms = (deviations.iter().map(|d| d * d).sum::<f64>() / deviations.len() as f64).sqrt();
    println!("errors over their standard deviations: {rms:.2}");
    assert!((0.7..1.4).contains(&rms), "{rms}");
}

#[test]
fn momentum_and_impossible_balls() {
    let pulse = Pulse::hertz();
    let place = Place {
        quantity: Quantity::Displacement,
        distance: 2.0,
        start: START,
    };
    let clean = place.clean(&|t| pulse.at(t - START)[0]);
    let fit = infer(&problem(
        &pulse,
        place,
        vec![noisy(&clean, &place.response(), 100.0, 1)],
    ))
    .expect("a force")
    .fit;
    let half = momentum(&fit, 1.0).expect("a momentum");
    assert!((half.value - 0.5 * fit.impulse_n_s.value).abs() < 1e-12 && half.sd > 0.0);
    assert!(momentum(&fit, 1.2).is_err());
    assert!(ball(&fit, 0.0, Known::Radius(1.0)).is_err());
    assert!(ball(&fit, 1e9, Known::Density(f64::NAN)).is_err());
}
