//! One pole or zero in discrete time.
//!
//! ```text
//! 1/(s - a) over one step:  y_n = e^q y_{n-1} + dt sum_i w_i x_{n+i},   q = a dt
//! w_i = int_{-1}^0 e^{-q t} L_i(t) dt,                                   L_i of the nodes -2..2
//! ```
//!
//! The polynomial through five samples around n is integrated exactly, so that a pole far above the sampling rate is as
//! good as a slow one.
//! A polynomial through an even number of samples would have a zero at half the sampling rate, one through samples of the
//! past alone zeros outside the unit circle, and neither could be inverted. This sum has two zeros inside the circle and
//! two outside (the test `the_sum_has_no_zero_on_the_circle`), so that it is a causal filter times one that looks ahead,
//! both with a bounded inverse. Past and future are two passes over the samples. The causal ones
//! come first, which makes the product exact for a record that begins at any time.

use num_complex::Complex64;

/// Coefficients of L_i in powers of -t.
const LAGRANGE: [[f64; 5]; 5] = [
    [0.0, -2.0 / 24.0, -1.0 / 24.0, 2.0 / 24.0, 1.0 / 24.0],
    [0.0, 4.0 / 6.0, 4.0 / 6.0, -1.0 / 6.0, -1.0 / 6.0],
    [1.0, 0.0, -5.0 / 4.0, 0.0, 1.0 / 4.0],
    [0.0, -4.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, -1.0 / 6.0],
    [0.0, 2.0 / 24.0, -1.0 / 24.0, -2.0 / 24.0, 1.0 / 24.0],
];

/// Largest number of steps to both factors of the sum: 25 are enough for every root below the sampling rate (the test
/// `the_sum_has_no_zero_on_the_circle` fails at 10).
const MOST_STEPS: usize = 100;
/// Change of a coefficient at which they end: far above rounding.
const FACTORED: f64 = 1e-13;

/// One pole, which integrates over a step, or one zero, whose inverse does.
pub(super) struct FilterSection {
    is_pole: bool,
    /// e^q - 1.
    growth: Complex64,
    /// Coefficients at x_n, x_{n-1} and x_{n-2} of the causal factor of the sum.
    past: [Complex64; 3],
    /// Coefficients at x_n, x_{n+1} and x_{n+2} of the other; the first is one.
    ahead: [Complex64; 3],
}

/// From the input to the output of a response, or back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    Forward,
    Back,
}

impl FilterSection {
    /// Of a root in rad/s; none if the steps are too coarse for it.
    pub(super) fn new(root: Complex64, is_pole: bool, step_s: f64) -> Option<Self> {
        let q = root * step_s;
        let moments = moments(q);
        let weight = |row: [f64; 5]| row.iter().zip(moments).map(|(c, m)| step_s * c * m).sum();
        let (past, ahead) = factors(LAGRANGE.map(weight))?;
        // without the digits that e^q loses next to one
        let half = (0.5 * q.im).sin();
        let real = q.re.exp_m1() * q.im.cos() - 2.0 * half * half;
        let growth = Complex64::new(real, q.re.exp() * q.im.sin());
        Some(Self {
            is_pole,
            growth,
            past,
            ahead,
        })
    }

    fn integrates(&self, way: Way) -> bool {
        self.is_pole == (way == Way::Forward)
    }

    /// The part that depends on the past.
    pub(super) fn causal(&self, samples: &mut [Complex64], way: Way) {
        let mut before = Complex64::default();
        if self.integrates(way) {
            convolve(self.past, samples.iter_mut());
            for sample in samples {
                before += self.growth * before + *sample;
                *sample = before;
            }
        } else {
            for sample in samples.iter_mut() {
                let own = *sample;
                *sample = (own - before) - self.growth * before;
                before = own;
            }
            deconvolve(self.past, samples.iter_mut());
        }
    }

    /// The part that looks ahead.
    pub(super) fn looking_ahead(&self, samples: &mut [Complex64], way: Way) {
        if self.integrates(way) {
            convolve(self.ahead, samples.iter_mut().rev());
        } else {
            deconvolve(self.ahead, samples.iter_mut().rev());
        }
    }
}

/// int_0^1 e^{q u} u^j du for j = 0..4.
fn moments(q: Complex64) -> [Complex64; 5] {
    let mut found = [Complex64::default(); 5];
    let end = q.exp();
    if q.norm() < 2.0 {
        // downwards, where errors shrink: 2^35 4!/39! is below rounding
        let mut moment = Complex64::default();
        for j in (1..40).rev() {
            moment = (end - q * moment) / j as f64;
            found[(j - 1).min(4)] = moment;
        }
    } else {
        found[0] = (end - 1.0) / q;
        for j in 1..5 {
            found[j] = (end - j as f64 * found[j - 1]) / q;
        }
    }
    found
}

/// The causal factor of a sum over -2..2 and the one that looks ahead, by fixed-point steps; none if there is no such
/// product, or if the inverse of the causal one would grow.
fn factors(sum: [Complex64; 5]) -> Option<([Complex64; 3], [Complex64; 3])> {
    let one = Complex64::new(1.0, 0.0);
    let mut ahead = [one, Complex64::default(), Complex64::default()];
    for _ in 0..MOST_STEPS {
        let last = sum[0];
        let middle = sum[1] - ahead[1] * last;
        let past = [sum[2] - ahead[1] * middle - ahead[2] * last, middle, last];
        let far = sum[4] / past[0];
        let next = [one, (sum[3] - far * past[1]) / past[0], far];
        let change = (next[1] - ahead[1]).norm() + (next[2] - ahead[2]).norm();
        ahead = next;
        if change < FACTORED {
            // Schur's condition for two zeros inside the circle
            let [b, c] = [past[1] / past[0], past[2] / past[0]];
            let is_bounded = (b - c * b.conj()).norm() < 1.0 - c.norm_sqr();
            return is_bounded.then_some((past, ahead));
        }
    }
    None
}

/// y_n = c_0 x_n + c_1 x_{n-1} + c_2 x_{n-2}.
fn convolve<'a>(c: [Complex64; 3], samples: impl Iterator<Item = &'a mut Complex64>) {
    let mut before = [Complex64::default(); 2];
    for sample in samples {
        let own = *sample;
        *sample = c[0] * own + c[1] * before[0] + c[2] * before[1];
        before = [own, before[0]];
    }
}

/// The inverse of [`convolve`].
fn deconvolve<'a>(c: [Complex64; 3], samples: impl Iterator<Item = &'a mut Complex64>) {
    let mut before = [Complex64::default(); 2];
    for sample in samples {
        *sample = (*sample - c[1] * before[0] - c[2] * before[1]) / c[0];
        before = [*sample, before[0]];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_has_no_zero_on_the_circle() {
        let turn = |q: Complex64| FilterSection::new(q, true, 1.0);
        for damping in [0.0, 1e-6, 1e-3, 0.03, 0.5, 1.0] {
            for i in -60..=50 {
                let size = 10_f64.powf(f64::from(i) * 0.1).min(3.1 + 100.0 * damping);
                let q = Complex64::new(-damping, (1.0_f64 - damping * damping).sqrt()) * size;
                assert!(turn(q).is_some(), "{q}");
                let real = Complex64::new(-size, 0.0);
                assert!(turn(real).is_some(), "{real}");
            }
        }
        assert!(turn(Complex64::default()).is_some());
        // a resonance above the sampling rate, where the sum has as many zeros inside as shifts to the future
        assert!(turn(Complex64::new(-1e-3, 8.5)).is_none());
    }

    #[test]
    fn moments_of_both_formulas_agree() {
        for angle in [0.0, 1.0, 2.0, 3.1, -2.0] {
            let [a, b] = [1.999_999, 2.000_001].map(|r| moments(Complex64::from_polar(r, angle)));
            for (a, b) in a.iter().zip(b) {
                assert!((a - b).norm() < 1e-5 * a.norm(), "{a} {b}");
            }
        }
        // int_0^1 e^u u^4 du = 9 e - 24
        let exact = 9.0 * std::f64::consts::E - 24.0;
        assert!((moments(Complex64::new(1.0, 0.0))[4].re - exact).abs() < 1e-14);
    }
}
