//! Responses of sensors: closed forms, reference data, error estimates, and the way back.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use impact::response::{Fir, Output, PolesZeros, Response, ResponseError, Tabulated, band_pass};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

fn roots(pairs: &[[f64; 2]]) -> Vec<Complex64> {
    pairs
        .iter()
        .map(|&[re, im]| Complex64::new(re, im))
        .collect()
}

/// Poles -(h -+ i sqrt(1 - h^2)) 2 pi fc, as ObsPy's cornFreq2Paz.
fn corner(corner_hz: f64, damping: f64) -> Vec<Complex64> {
    let pole = -Complex64::new(damping, (1.0 - damping * damping).sqrt()) * TAU * corner_hz;
    vec![pole, pole.conj()]
}

fn rational(poles: Vec<Complex64>, zeros: Vec<Complex64>, gain: f64) -> Response {
    Response::PolesZeros(PolesZeros::new(poles, zeros, gain).unwrap())
}

fn high_pass(corner_hz: f64, damping: f64) -> Response {
    rational(corner(corner_hz, damping), roots(&[[0.0, 0.0]; 2]), 1.0)
}

fn resonance(corner_hz: f64, damping: f64) -> Response {
    let gain = (TAU * corner_hz).powi(2);
    rational(corner(corner_hz, damping), Vec::new(), gain)
}

/// Responses as sensors have them, with one to six poles more than zeros.
fn sensors() -> Vec<Response> {
    let mut accelerometer = corner(1e5, 0.05);
    accelerometer.extend(corner(2.5e5, 0.1));
    accelerometer.extend(roots(&[[-2.5e6, 0.0]]));
    let mut geophone = corner(1e3, 0.7);
    geophone.push(Complex64::new(-2e3, 0.0));
    let mut notch = corner(1.5e5, 0.02);
    notch.push(Complex64::new(-6e6, 0.0));
    vec![
        high_pass(1e3, 0.5),
        resonance(1.5e5, 0.05),
        rational(geophone, roots(&[[0.0, 0.0]; 3]), 30.0),
        rational(accelerometer, roots(&[[0.0, 0.0]]), 1e24),
        rational(notch, corner(2e5, 0.01), 6e6),
        rational(roots(&[[-1e9, 0.0]]), Vec::new(), 1e9),
    ]
}

/// Random numbers in [0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }
}

fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    values.into_iter().fold(0.0, |a: f64, b| a.max(b.abs()))
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .fold(0.0, |most, (a, b)| (a - b).abs().max(most))
}

fn sampled(step_s: f64, count: usize, of: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..count).map(|n| of(n as f64 * step_s)).collect()
}

/// sin^2 over a time, zero outside.
fn pulse(length_s: f64, t: f64) -> f64 {
    match (0.0..=length_s).contains(&t) {
        true => (PI * t / length_s).sin().powi(2),
        false => 0.0,
    }
}

/// Rows of the reference data of one instrument: times, outputs, the response and the length of its pulse.
fn reference(instrument: &str, corner_hz: f64) -> (Vec<f64>, Vec<f64>, Response, f64) {
    let text = include_str!("../../../tests/golden/sensor_paz.csv");
    let rows = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect::<Vec<_>>());
    let rows: Vec<Vec<&str>> = rows
        .filter(|row| row[0] == instrument && row[1].parse() == Ok(corner_hz))
        .collect();
    let number = |row: &[&str], i: usize| row[i].parse::<f64>().unwrap();
    let damping = number(&rows[0], 2);
    let response = match instrument {
        "highpass" => high_pass(corner_hz, damping),
        _ => resonance(corner_hz, damping),
    };
    let column = |i: usize| rows.iter().map(|row| number(row, i)).collect();
    (column(4), column(5), response, number(&rows[0], 3))
}

#[test]
fn pulses_agree_with_the_differential_equation() {
    for (instrument, corner_hz) in [("highpass", 1e3), ("highpass", 1e5), ("resonant", 1.5e5)] {
        let (times, outputs, response, length_s) = reference(instrument, corner_hz);
        let peak = largest(&outputs);
        // steps a pulse, and the error allowed relative to the peak
        for (steps, allowed) in [(20.0, 5e-4), (40.0, 5e-5), (80.0, 6e-6), (320.0, 2e-7)] {
            let step_s = length_s / steps;
            let count = (times[times.len() - 1] / step_s).round() as usize + 1;
            let input = sampled(step_s, count, |t| pulse(length_s, t));
            let found = response.apply(step_s, &input).unwrap();
            let mut error: f64 = 0.0;
            for (time, exact) in times.iter().zip(&outputs) {
                let n = (time / step_s).round() as usize;
                if (n as f64 * step_s - time).abs() < 1e-6 * step_s {
                    let here = (found.samples[n] - exact).abs();
                    // the reference has ten digits
                    assert!(
                        here <= found.error[n] + 1e-10,
                        "{instrument} {steps} {time}"
                    );
                    error = error.max(here);
                }
            }
            assert!(
                error < allowed * peak,
                "{instrument} {corner_hz} {steps}: {error:e}"
            );
            println!(
                "{instrument} {corner_hz} Hz, {steps} steps: error {error:.1e} of {peak:.2}, estimate {:.1e}",
                largest(&found.error)
            );
            assert!(largest(&found.error) < 100.0 * allowed * peak);
        }
    }
}

#[test]
fn a_low_pass_follows_a_ramp_late() {
    let (tau, start) = (1e-5, 3e-5);
    let response = rational(roots(&[[-1.0 / tau, 0.0]]), Vec::new(), 1.0 / tau);
    let exact = |t: f64| {
        let t = (t - start).max(0.0);
        t - tau * (1.0 - (-t / tau).exp())
    };
    let errors = [1e-6, 5e-7, 2.5e-7].map(|step_s| {
        let count = (2e-4 / step_s) as usize;
        let input = sampled(step_s, count, |t| (t - start).max(0.0));
        let found = response.apply(step_s, &input).unwrap();
        let exact = sampled(step_s, count, exact);
        let error = difference(&found.samples, &exact);
        assert!(error <= largest(&found.error), "{error:e}");
        error / tau
    });
    // second order at a jump of the slope
    assert!(errors[0] < 1e-3, "{errors:?}");
    assert!(errors.windows(2).all(|e| e[1] < 0.27 * e[0]), "{errors:?}");
}

#[test]
fn a_resonance_under_a_step_begins_half_a_step_before_its_first_sample() {
    let (h, w) = (0.2, TAU * 1e4);
    let response = resonance(1e4, h);
    let damped = w * f64::sqrt(1.0 - h * h);
    let exact = |t: f64| {
        let (sine, cosine) = (damped * t).sin_cos();
        1.0 - (-h * w * t).exp() * (cosine + h * w / damped * sine)
    };
    let errors = [2e-6, 1e-6, 5e-7].map(|step_s| {
        let input = vec![1.0; (4e-4 / step_s) as usize];
        let found = response.apply(step_s, &input).unwrap();
        let shifted = sampled(step_s, input.len(), |t| exact(t + 0.5 * step_s));
        let at_start = sampled(step_s, input.len(), exact);
        // the estimate counts half a step
        assert!(difference(&found.samples, &at_start) <= largest(&found.error));
        difference(&found.samples, &shifted)
    });
    assert!(errors[0] < 1e-3, "{errors:?}");
    assert!(errors.windows(2).all(|e| e[1] < 0.3 * e[0]), "{errors:?}");
}

#[test]
fn the_convention_is_that_of_obspy() {
    // obspy.signal.invsim.corn_freq_2_paz(1.0, 0.707) and paz_2_amplitude_value_of_freq_resp
    let poles = corner(1.0, 0.707);
    assert!((poles[0] - Complex64::new(-4.442_212_1, -4.443_554_9)).norm() < 1e-4);
    let response = high_pass(1.0, 0.707);
    let phase = |f: f64| response.at(f).arg();
    assert!((response.at(1e6).norm() - 1.0).abs() < 1e-6);
    // e^{i w t}: far below the corner the output is the second derivative of the input, ahead of it by half a turn
    assert!((phase(1e-4).abs() - PI).abs() < 1e-3);
    assert!((phase(1.0) - PI / 2.0).abs() < 1e-12, "{}", phase(1.0));
    let w = 0.3;
    let exact = -w * w / Complex64::new(1.0 - w * w, 2.0 * 0.707 * w);
    assert!((response.at(w) - exact).norm() < 1e-14);
}

/// Of the step, and of steps that are far too large or too small, from noise and from a pulse.
#[test]
fn removing_a_response_returns_the_input_in_its_band() {
    let band_hz = [2e3, 5e3, 3e5, 6e5];
    let mut random = Random(7);
    for (place, response) in sensors().iter().enumerate() {
        for (count, step_s) in [(1000, 2e-7), (6000, 1e-7), (97, 7e-7)] {
            let noise: Vec<f64> = (0..count).map(|_| random.between(-1.0, 1.0)).collect();
            let smooth = sampled(step_s, count, |t| pulse(8e-6, t));
            for input in [noise, smooth] {
                let output = response.apply(step_s, &input).unwrap().samples;
                let back = response.remove(step_s, &output, band_hz).unwrap();
                let expected = band_pass(step_s, &input, band_hz).unwrap();
                let error = difference(&back, &expected) / largest(&expected);
                assert!(error < 1e-10, "sensor {place}, {count}: {error:e}");
            }
        }
    }
}

#[test]
fn the_end_of_the_record_changes_nothing_before_it() {
    let wave = |t: f64| (TAU * 1e4 * t).sin().powi(2);
    for response in sensors() {
        let whole = response.apply(1e-6, &sampled(1e-6, 400, wave)).unwrap();
        let cut = response.apply(1e-6, &sampled(1e-6, 310, wave)).unwrap();
        let error = difference(&cut.samples, &whole.samples[..310]);
        assert!(error < 1e-4 * largest(&whole.samples), "{error:e}");
        assert!(
            difference(&cut.samples[..280], &whole.samples[..280])
                < 1e-12 * largest(&whole.samples)
        );
    }
}

/// Of inputs with jumps of a derivative, compared with sampling sixteen times finer.
#[test]
fn the_estimate_holds() {
    let mut random = Random(50);
    let mut ratios = Vec::new();
    for case in 0..1500 {
        let mut poles = Vec::new();
        let mut zeros = Vec::new();
        for _ in 0..1 + (random.next() * 3.0) as usize {
            let corner_hz = 10_f64.powf(random.between(3.0, 6.0));
            poles.extend(corner(corner_hz, random.between(0.02, 1.0)));
            let origin = Complex64::default();
            let many = (random.next() * 3.0) as usize;
            zeros.extend(match random.next() < 0.3 {
                true => corner(
                    corner_hz * random.between(0.5, 2.0),
                    random.between(0.01, 0.9),
                ),
                false => vec![origin; many],
            });
        }
        let response = rational(poles, zeros, 1.0);
        let (length_s, start_s) = (
            2e-5 * random.between(0.5, 2.0),
            1e-5 * random.between(0.0, 2.0),
        );
        let power = [1.0, 1.5, 2.0, 4.0][case % 4];
        let of = |t: f64| {
            let x = (t - start_s) / length_s;
            if (0.0..1.0).contains(&x) {
                (PI * x).sin().powf(power)
            } else {
                0.0
            }
        };
        let (step_s, count) = (2e-5 / random.between(15.0, 200.0), 300);
        let found = response.apply(step_s, &sampled(step_s, count, of)).unwrap();
        let fine = response
            .apply(step_s / 16.0, &sampled(step_s / 16.0, 16 * count, of))
            .unwrap();
        let mut error: f64 = 0.0;
        for n in 0..count {
            let here = (found.samples[n] - fine.samples[16 * n]).abs();
            let allowed = found.error[n] + fine.error[16 * n];
            assert!(
                here <= allowed,
                "case {case}, sample {n}: {here:e} {allowed:e}"
            );
            error = error.max(here);
        }
        ratios.push(largest(&found.error) / error);
    }
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    println!(
        "estimate over error: least {:.2}, median {median:.2}, largest {:.2}",
        ratios[0], ratios[199]
    );
    assert!(median < 30.0, "{median}");
}

#[test]
fn the_largest_gain_bounds_the_output() {
    let mut random = Random(3);
    for response in sensors() {
        let mut most: f64 = 0.0;
        for _ in 0..200 {
            let input: Vec<f64> = (0..60).map(|_| random.next().round() * 2.0 - 1.0).collect();
            let Output {
                samples,
                largest_gain,
                ..
            } = response.apply(1e-6, &input).unwrap();
            assert!(largest(&samples) <= largest_gain, "{largest_gain}");
            most = most.max(largest(&samples) / largest_gain);
        }
        assert!(most > 0.05, "{most}");
    }
}

#[test]
fn the_phase_of_a_low_pass_follows_from_its_amplitudes() {
    let corner_hz = 1e4;
    let exact = |f: f64| 1.0 / Complex64::new(1.0, f / corner_hz);
    let frequencies: Vec<f64> = (0..=1200)
        .map(|i| 10_f64.powf(f64::from(i) * 0.005 + 1.0))
        .collect();
    let amplitudes: Vec<f64> = frequencies.iter().map(|&f| exact(f).norm()).collect();
    let table = Tabulated::new(frequencies.clone(), amplitudes.clone(), None).unwrap();
    assert!(table.is_minimum_phase());
    let table = Response::Tabulated(table);
    for &f in &frequencies {
        // the table ends at 1e7 Hz, where the amplitude is taken as constant
        let error = (table.at(f).arg() - exact(f).arg()).abs();
        assert!(error < 2e-5 + 0.8 * f / 1e7, "{f}: {error:e}");
    }
    // a table from 0 with a resonance, whose phase is known as well
    let resonance = resonance(5e4, 0.1);
    let frequencies: Vec<f64> = (0..=8000).map(|i| f64::from(i) * 250.0).collect();
    let amplitudes = frequencies
        .iter()
        .map(|&f| resonance.at(f).norm())
        .collect();
    let table = Response::Tabulated(Tabulated::new(frequencies, amplitudes, None).unwrap());
    for f in [1e3, 2e4, 4.9e4, 5e4, 6e4] {
        let error = (table.at(f).arg() - resonance.at(f).arg()).abs();
        assert!(error < 2e-2 * f / 1e4, "{f}: {error:e}");
    }
    let given = Tabulated::new(
        vec![1e3, 2e3, 3e3],
        vec![1.0; 3],
        Some(vec![3.0, -3.0, 3.0]),
    )
    .unwrap();
    assert!(!given.is_minimum_phase());
    // between 3 and -3 rad is half a turn, not 0
    let between = Response::Tabulated(given).at(1.5e3);
    assert!((between + 1.0).norm() < 1e-15, "{between}");
}

#[test]
fn a_table_of_a_delay_delays() {
    let (step_s, count, delay_s) = (1e-7, 1000, 7e-6);
    let of = |t: f64| (-((t - 2e-5) / 3e-6).powi(2)).exp();
    let frequencies: Vec<f64> = (0..=1000).map(|i| f64::from(i) * 2e3).collect();
    let phases = frequencies.iter().map(|f| -TAU * f * delay_s).collect();
    let table = Tabulated::new(frequencies, vec![2.5; 1001], Some(phases)).unwrap();
    let table = Response::Tabulated(table);
    let input = sampled(step_s, count, of);
    let found = table.apply(step_s, &input).unwrap();
    let exact = sampled(step_s, count, |t| 2.5 * of(t - delay_s));
    assert!(difference(&found.samples, &exact) < 1e-12);
    assert!(difference(&found.samples, &exact) <= largest(&found.error));
    let band_hz = [1e3, 1e4, 5e5, 1e6];
    let back = table.remove(step_s, &found.samples, band_hz).unwrap();
    let expected = band_pass(step_s, &input, band_hz).unwrap();
    assert!(difference(&back, &expected) < 1e-10 * largest(&expected));
    assert!(table.outside(step_s, &input).unwrap() < 1e-12);
}

#[test]
fn a_table_that_begins_late_leaves_energy_out() {
    let table = Tabulated::new(vec![1e5, 1e6], vec![1.0, 1.0], None).unwrap();
    let table = Response::Tabulated(table);
    let wave = |f: f64| sampled(1e-7, 4000, |t| (TAU * f * t).sin() * pulse(4e-4, t));
    let outside = |f: f64| table.outside(1e-7, &wave(f)).unwrap();
    assert!(outside(5e4) > 0.999 && outside(3e5) < 1e-6 && outside(2e6) > 0.999);
    assert_eq!(table.at(9.9e4), Complex64::default());
    assert_eq!(resonance(1e4, 0.1).outside(1e-7, &wave(5e4)).unwrap(), 0.0);
}

#[test]
fn a_filter_at_the_rate_of_the_samples_is_a_sum() {
    let mut random = Random(11);
    let coefficients: Vec<f64> = (0..31).map(|_| random.between(-1.0, 1.0)).collect();
    let filter = Response::Fir(Fir::new(coefficients.clone(), 1e7).unwrap());
    let input: Vec<f64> = (0..200).map(|_| random.between(-1.0, 1.0)).collect();
    let found = filter.apply(1e-7, &input).unwrap();
    let sum = |n: usize| -> f64 {
        let terms = coefficients.iter().enumerate().take(n + 1);
        terms.map(|(k, c)| c * input[n - k]).sum()
    };
    let exact: Vec<f64> = (0..200).map(sum).collect();
    assert!(
        difference(&found.samples, &exact) < 1e-13,
        "{:e}",
        difference(&found.samples, &exact)
    );
    let total: f64 = coefficients.iter().map(|c| c.abs()).sum();
    assert!((found.largest_gain / total - 1.0).abs() < 1e-12);
    // the filter has nothing above half its rate
    assert_eq!(filter.at(6e6), Complex64::default());
}

#[test]
fn impossible_responses_are_refused_with_the_key() {
    let sentence = |error: ResponseError| error.to_string();
    let poles =
        |list: &[[f64; 2]]| sentence(PolesZeros::new(roots(list), Vec::new(), 1.0).unwrap_err());
    assert!(poles(&[[3.0, 0.0]]).starts_with("response.poles contains 3+0i"));
    assert!(poles(&[[0.0, 0.0]]).contains("outside (-inf, 0)"));
    assert!(poles(&[[-1.0, 2.0]]).contains("without its conjugate -1-2i"));
    assert!(poles(&[[f64::NAN, 0.0]]).starts_with("response.poles = NaN"));
    let zeros = PolesZeros::new(roots(&[[-1.0, 0.0]]), roots(&[[0.0, 0.0]; 2]), 1.0);
    let zeros = sentence(zeros.unwrap_err());
    assert!(
        zeros.starts_with("response.zeros has 2 zeros")
            && zeros.contains("velocity or acceleration")
    );
    assert!(PolesZeros::new(roots(&[[-1.0, 0.0]]), Vec::new(), 0.0).is_err());
    let table =
        |f: &[f64], a: &[f64]| sentence(Tabulated::new(f.to_vec(), a.to_vec(), None).unwrap_err());
    assert!(table(&[], &[]).starts_with("response.frequency_hz has 0 elements"));
    assert!(table(&[2.0, 1.0], &[1.0, 1.0]).contains("1 does not follow 2"));
    assert!(table(&[-1.0, 1.0], &[1.0, 1.0]).contains("response.frequency_hz = -1"));
    assert!(table(&[0.0, 1.0], &[1.0, -1.0]).contains("response.amplitude = -1"));
    assert!(table(&[0.0, 1.0], &[1.0, 0.0]).contains("0 at 1 Hz"));
    assert!(
        sentence(Fir::new(Vec::new(), 1.0).unwrap_err()).starts_with("response.coefficients has 0")
    );
    assert!(sentence(Fir::new(vec![1.0], -1.0).unwrap_err()).starts_with("response.rate_hz = -1"));
    let slow = Response::Fir(Fir::new(vec![1.0; 100], 1.0).unwrap());
    assert!(sentence(slow.apply(1e-8, &[1.0; 9]).unwrap_err()).contains("too small for a filter"));
    let far = resonance(1.353e6, 1e-4)
        .apply(1e-6, &[1.0; 20])
        .unwrap_err();
    assert!(sentence(far).contains("use a step of at most 7.391e-8 s"));
    let band = |band_hz| {
        sentence(
            high_pass(1e3, 0.5)
                .remove(1e-6, &[1.0; 20], band_hz)
                .unwrap_err(),
        )
    };
    assert!(band([1e3, 2e3, 3e5, 6e5]).contains("within [0, 500000]"));
    assert!(band([2e3, 1e3, 3e5, 4e5]).contains("must ascend"));
    let growing = rational(corner(1e4, 0.5), roots(&[[3.0, 0.0]]), 1.0);
    assert!(growing.apply(1e-6, &[1.0; 20]).is_ok());
    let back = growing
        .remove(1e-6, &[1.0; 20], [1e3, 2e3, 3e5, 4e5])
        .unwrap_err();
    assert!(sentence(back).contains("response.zeros contains 3+0i"));
}

#[test]
fn the_shortest_histories_have_an_output() {
    for response in sensors() {
        for count in 0..8 {
            let input = vec![1.0; count];
            let found = response.apply(1e-7, &input).unwrap();
            assert_eq!((found.samples.len(), found.error.len()), (count, count));
            assert!(
                found
                    .samples
                    .iter()
                    .chain(&found.error)
                    .all(|x| x.is_finite())
            );
        }
        assert!(response.apply(0.0, &[1.0]).is_err() && response.apply(1.0, &[f64::NAN]).is_err());
    }
}
