//! Methods that share their samples among all times of a window: the Fourier series of Dubner and Abate (1968),
//! summed in two ways.

use num_complex::Complex64;
use std::f64::consts::PI;

/// A method of summation: from the samples, the sums for some e^{i pi t/T}.
pub(crate) type Series = fn(&[Complex64], &[Complex64]) -> Vec<f64>;

/// f at some times, for a transform with any number of components that is sampled at a + i k pi/T for all times.
///
/// The times lie up to `longest`: a = -ln(`aliasing`)/(2 T) for an aliasing error of that size, T = 1.25 `longest`.
pub(crate) fn in_window<const N: usize>(
    series: Series,
    samples: usize,
    [longest, aliasing]: [f64; 2],
    times: &[f64],
    transform: impl Fn(&[Complex64]) -> Vec<[Complex64; N]>,
) -> Vec<[f64; N]> {
    let half_period = 1.25 * longest;
    let damping = -aliasing.ln() / (2.0 * half_period);
    let step = PI / half_period;
    let node = |k| Complex64::new(damping, step * k as f64);
    let values = transform(&(0..samples).map(node).collect::<Vec<_>>());
    let turn = |t: &f64| Complex64::from_polar(1.0, PI * t / half_period);
    let turns: Vec<Complex64> = times.iter().map(turn).collect();
    let mut found = vec![[0.0; N]; times.len()];
    for f in 0..N {
        let column: Vec<Complex64> = values.iter().map(|value| value[f]).collect();
        // components that are not needed are zero
        if column.iter().any(|v| v.norm_sqr() > 0.0) {
            let sums = series(&column, &turns).into_iter().zip(times);
            for (found, (sum, t)) in found.iter_mut().zip(sums) {
                found[f] = (damping * t).exp() / half_period * sum;
            }
        }
    }
    found
}

/// Durbin (1974): the series is truncated.
pub(crate) fn durbin(samples: &[Complex64], turns: &[Complex64]) -> Vec<f64> {
    let sum = |turn: &Complex64| {
        // Horner from the last term
        let rest = samples[1..].iter().rev();
        let sum = rest.fold(Complex64::default(), |sum, &sample| (sum + sample) * turn);
        0.5 * samples[0].re + sum.re
    };
    turns.iter().map(sum).collect()
}

/// De Hoog, Knight and Stokes (1982): a continued fraction by the quotient-difference scheme, with the remainder
/// estimate of the authors; from an odd number of samples.
pub(crate) fn de_hoog(samples: &[Complex64], turns: &[Complex64]) -> Vec<f64> {
    let coefficients = fraction(samples);
    let last = coefficients.len() - 1;
    let one = Complex64::new(1.0, 0.0);
    let sum = |z: &Complex64| {
        let (mut a0, mut a1) = (Complex64::default(), coefficients[0]);
        let (mut b0, mut b1) = (one, one);
        for &d in &coefficients[1..last] {
            (a0, a1) = (a1, a1 + d * z * a0);
            (b0, b1) = (b1, b1 + d * z * b0);
        }
        let half = 0.5 * (one + (coefficients[last - 1] - coefficients[last]) * z);
        let rest = -half * (one - (one + coefficients[last] * z / (half * half)).sqrt());
        let (a, b) = (a1 + rest * a0, b1 + rest * b0);
        (a / b).re
    };
    turns.iter().map(sum).collect()
}

/// Coefficients d_0 .. d_2M of the fraction d_0/(1 + d_1 z/(1 + d_2 z/ ...)).
fn fraction(samples: &[Complex64]) -> Vec<Complex64> {
    let count = samples.len() - (1 - samples.len() % 2);
    let order = count / 2;
    let term = |k: usize| if k == 0 { 0.5 * samples[0] } else { samples[k] };
    let mut q: Vec<Complex64> = (0..2 * order).map(|k| term(k + 1) / term(k)).collect();
    let mut e = vec![Complex64::default(); count];
    let mut d = vec![term(0), -q[0]];
    for column in 1..=order {
        for i in 0..2 * (order - column) + 1 {
            e[i] = q[i + 1] - q[i] + e[i + 1];
        }
        d.push(-e[0]);
        if column < order {
            for i in 0..2 * (order - column) {
                q[i] = q[i + 1] * e[i + 1] / e[i];
            }
            d.push(-q[0]);
        }
    }
    d
}
