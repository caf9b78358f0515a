//! Concentrated matrix exponential: Horvath, Horvath, Almousa and Telek (2020).
//!
//! f(t) is smeared with a positive, narrow function of unit mass and mean, so that nothing overshoots:
//!
//! ```text
//! f+(x) = c e^{-x} prod_i cos^2((omega x - phi_i)/2)
//! ```
//!
//! The zeros are placed by the three-parameter heuristic of the authors, equally spaced in the phase
//! outside a window around the peak; frequency, place and width of the window minimise the squared
//! coefficient of variation, which is the error for a function with curvature.

use super::framework::Framework;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// `order` + 1 nodes; the squared coefficient of variation falls as 1/`order`^2.
pub(crate) fn cme(order: usize) -> Framework {
    let best = nelder_mead(coarse(order), |place| variation(order, place));
    let (coefficients, omega) = (coefficients(order, best), best[0].abs());
    let [mass, mean, _] = moments(&coefficients, omega);
    let mean = mean / mass;
    let rate = |k: usize| mean * Complex64::new(1.0, omega * k as f64);
    let share = |k: usize| if k == 0 { 1.0 } else { 2.0 };
    Framework {
        nodes: (0..=order).map(rate).collect(),
        weights: (0..=order)
            .map(|k| share(k) * mean / mass * coefficients[k])
            .collect(),
    }
}

/// A first place: the best of a coarse grid.
fn coarse(order: usize) -> [f64; 3] {
    let mut best = ([1.0, PI, 0.5], f64::INFINITY);
    for omega in [0.4, 0.5, 0.6, 0.7, 0.9] {
        for peak in [2.8, 3.5, 4.2, 4.8, 5.3] {
            for width in [6.0, 12.0, 18.0, 24.0, 32.0] {
                let place = [omega, peak, width / (order as f64 + 1.0)];
                let value = variation(order, place);
                if value < best.1 {
                    best = (place, value);
                }
            }
        }
    }
    best.0
}

/// Fourier coefficients g_k, k = 0 ..= order, of the product as sum_k g_k e^{-i k omega x}, real up to conjugates.
///
/// From samples of the product itself, which are positive: multiplying the factors' series out would
/// cancel digits.
fn coefficients(order: usize, [_, peak, width]: [f64; 3]) -> Vec<Complex64> {
    let count = 2 * order + 1;
    let zeros: Vec<f64> = (0..order)
        .map(|i| {
            let share = if order > 1 {
                i as f64 / (order - 1) as f64
            } else {
                0.5
            };
            peak + 0.5 * width + (TAU - width) * share
        })
        .collect();
    let product = |y: f64| {
        zeros
            .iter()
            .map(|zero| (2.0 * (0.5 * (y - zero)).sin().abs()).ln())
            .sum::<f64>()
    };
    let top = product(peak);
    let samples: Vec<f64> = (0..count)
        .map(|j| (2.0 * (product(TAU * j as f64 / count as f64) - top)).exp())
        .collect();
    let turn = |j: usize| Complex64::from_polar(1.0 / count as f64, TAU * j as f64 / count as f64);
    let turns: Vec<Complex64> = (0..count).map(turn).collect();
    (0..=order)
        .map(|k| {
            let terms = samples.iter().enumerate();
            terms.map(|(j, f)| turns[j * k % count] * f).sum()
        })
        .collect()
}

/// int x^n e^{-x} sum g e^{-i k omega x} dx over x > 0, n = 0, 1, 2.
fn moments(coefficients: &[Complex64], omega: f64) -> [f64; 3] {
    let mut moments = [0.0; 3];
    for (k, &g) in coefficients.iter().enumerate() {
        let share = if k == 0 { 1.0 } else { 2.0 };
        let pole = Complex64::new(1.0, omega * k as f64).inv();
        moments[0] += share * (g * pole).re;
        moments[1] += share * (g * pole * pole).re;
        moments[2] += share * 2.0 * (g * pole * pole * pole).re;
    }
    moments
}

/// Variance over the square of the mean.
fn variation(order: usize, place: [f64; 3]) -> f64 {
    if place[0] <= 0.0 || !(0.0..TAU).contains(&place[1]) || !(0.0..5.0).contains(&place[2]) {
        return f64::INFINITY;
    }
    let [m0, m1, m2] = moments(&coefficients(order, place), place[0]);
    let value = m0 * m2 / (m1 * m1) - 1.0;
    if value > 0.0 && m0 > 0.0 {
        value
    } else {
        f64::INFINITY
    }
}

/// Minimum of a function of three variables: Nelder and Mead (1965).
fn nelder_mead(start: [f64; 3], f: impl Fn([f64; 3]) -> f64) -> [f64; 3] {
    let mut simplex: Vec<([f64; 3], f64)> = (0..4)
        .map(|i| {
            let mut x = start;
            if i > 0 {
                x[i - 1] *= 1.2;
            }
            (x, f(x))
        })
        .collect();
    for _ in 0..300 {
        simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
        let centre: [f64; 3] =
            std::array::from_fn(|d| simplex[..3].iter().map(|(x, _)| x[d] / 3.0).sum());
        let worst = simplex[3];
        let along = |c: f64| {
            let x: [f64; 3] = std::array::from_fn(|d| centre[d] + c * (worst.0[d] - centre[d]));
            (x, f(x))
        };
        let reflected = along(-1.0);
        simplex[3] = if reflected.1 < simplex[0].1 {
            let expanded = along(-2.0);
            if expanded.1 < reflected.1 {
                expanded
            } else {
                reflected
            }
        } else if reflected.1 < simplex[2].1 {
            reflected
        } else {
            let contracted = along(0.5);
            if contracted.1 < worst.1 {
                contracted
            } else {
                let best = simplex[0].0;
                for (x, value) in &mut simplex[1..] {
                    *x = std::array::from_fn(|d| 0.5 * (x[d] + best[d]));
                    *value = f(*x);
                }
                continue;
            }
        };
    }
    simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
    simplex[0].0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_heuristic_is_within_half_of_the_best_known_concentration() {
        // about 2/(2 n + 1)^2 for the kernels optimised one zero at a time
        for order in [5, 10, 20, 50] {
            let place = nelder_mead(coarse(order), |place| variation(order, place));
            let best = 2.0 / (2.0 * order as f64 + 1.0).powi(2);
            let found = variation(order, place);
            assert!(found > best && found < 1.5 * best, "{order}: {found:e}");
        }
    }
}
