//! Comparisons of histories whose differences are known.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use oracle::{Comparison, Limits, OracleError, Record, Wavelet, compare};

const LIMITS: Limits = Limits {
    tolerance: 0.05,
    time_tolerance_s: None,
};

/// A Ricker wavelet of 1 Hz around 5 s on equidistant times.
fn ricker(step: f64, end: f64, delay: f64, factor: f64) -> [Vec<f64>; 2] {
    let time: Vec<f64> = (0..(end / step) as usize)
        .map(|i| i as f64 * step)
        .collect();
    let value = |t: &f64| factor * Wavelet::Ricker.at(std::f64::consts::PI * (t - 5.0 - delay))[0];
    let values = time.iter().map(value).collect();
    [time, values]
}

fn compared(
    theirs: &[Vec<f64>; 2],
    ours: &[Vec<f64>; 2],
    limits: Limits,
) -> Result<Comparison, OracleError> {
    let [a, b] = [theirs, ours].map(|own| Record {
        time_s: &own[0],
        values: &own[1],
    });
    compare(a, b, limits)
}

#[test]
fn a_shift_between_samples_is_found() {
    let ours = ricker(0.01, 10.0, 0.0, 1.0);
    for (step, delay, factor) in [
        (0.01, 0.0237, 1.0),
        (0.037, -0.0519, 1.3),
        (0.004, 0.3, -0.7),
        (0.01, 1e-5, 1.0),
    ] {
        let theirs = ricker(step, 9.5, delay, factor);
        let found = compared(&theirs, &ours, LIMITS).unwrap();
        // cubics on 27 samples of a period are good to 1e-4
        let bound = 1e-4 * (step / 0.037).powi(3) + 1e-6;
        assert!(
            (found.shift_s - delay).abs() < bound,
            "{step} {delay}: {}",
            found.shift_s
        );
        assert!(
            (found.amplitude - factor).abs() < 10.0 * bound,
            "{}",
            found.amplitude
        );
        let left = (factor - 1.0).abs();
        assert!(
            (found.shifted_error - left).abs() < 20.0 * bound,
            "{}",
            found.shifted_error
        );
    }
}

#[test]
fn errors_are_those_of_the_definition() {
    let ours = ricker(0.01, 10.0, 0.0, 1.0);
    let theirs = ricker(0.01, 10.0, 0.0, 1.1);
    let found = compared(&theirs, &ours, LIMITS).unwrap();
    for error in [found.error, found.shifted_error, found.spectral_error] {
        assert!((error - 0.1).abs() < 1e-6, "{error}");
    }
    assert!(!found.passed);
    // the spectrum f^2 exp(-f^2) of a Ricker wavelet has 90 % of its energy around 1 Hz
    assert!(
        found.band_hz[0] > 0.4 && found.band_hz[0] < 0.9,
        "{:?}",
        found.band_hz
    );
    assert!(
        found.band_hz[1] > 1.3 && found.band_hz[1] < 1.9,
        "{:?}",
        found.band_hz
    );
}

#[test]
fn a_shift_passes_within_its_own_limit() {
    let (ours, theirs) = (ricker(0.01, 10.0, 0.0, 1.0), ricker(0.01, 10.0, 0.05, 1.0));
    let limited = |time_tolerance_s| Limits {
        time_tolerance_s,
        ..LIMITS
    };
    let passed = |limit| compared(&theirs, &ours, limited(limit)).unwrap().passed;
    assert_eq!(
        [None, Some(0.04), Some(0.06)].map(passed),
        [false, false, true]
    );
}

#[test]
fn a_step_that_does_not_return_to_zero_has_a_shift() {
    let step = |delay: f64| {
        let time: Vec<f64> = (0..1000).map(|i| 0.01 * f64::from(i)).collect();
        let values = time
            .iter()
            .map(|t| (4.0 * (t - 5.0 - delay)).tanh())
            .collect();
        [time, values]
    };
    let found = compared(&step(0.123), &step(0.0), LIMITS).unwrap();
    assert!((found.shift_s - 0.123).abs() < 1e-5, "{}", found.shift_s);
    assert!(found.shifted_error < 1e-5);
}

#[test]
fn histories_that_cannot_be_compared_are_rejected() {
    let ours = ricker(0.01, 10.0, 0.0, 1.0);
    let changed = |change: fn(&mut [Vec<f64>; 2])| {
        let mut theirs = ricker(0.01, 10.0, 0.0, 1.0);
        change(&mut theirs);
        compared(&theirs, &ours, LIMITS).unwrap_err().to_string()
    };
    let cases = [
        (changed(|own| own[1].fill(3.0)), "theirs is 3 at all times"),
        (
            changed(|own| own[1][7] = f64::NAN),
            "theirs is NaN at 7e-2 s",
        ),
        (
            changed(|own| own[0][7] = 0.0),
            "the times of theirs must ascend",
        ),
        (
            changed(|own| own[0].iter_mut().for_each(|t| *t += 20.0)),
            "only 0 samples in the common time",
        ),
        (
            changed(|own| own.iter_mut().for_each(|x| x.truncate(3))),
            "theirs has 3 samples",
        ),
    ];
    for (sentence, part) in cases {
        assert!(sentence.contains(part), "{sentence}");
    }
}
