//! The single integral over slowness with a fixed number of Gauss nodes a panel.
//!
//! ```text
//! R = 2/(c D'(c)) Re sum_{P,S} N Psi(gamma z - i c t)
//!     + (1/pi) Re int_kappa^inf dw/(i w D) sum_{P,S} N [Psi(gamma z - i w t) + Psi(gamma z + i w t)]
//! ```
//!
//! [`halfspace::Kernel`] without what makes it fast and safe: the panels lie between the singularities on
//! the path, x -> (3 x - x^3)/2 absorbs their square roots, and nothing is adapted; the potentials are the
//! closed forms alone, without the multipole series.
//! It counts what an integral costs and shows where the closed forms lose digits.

use halfspace::gauss::Rule;
use halfspace::{Medium, Six};
use num_complex::Complex64;
use std::f64::consts::PI;

/// Remainder R of the step response by the rule of `points` nodes a panel, and the integrand evaluations.
pub(crate) fn remainder(medium: &Medium, [r, z, t]: [f64; 3], points: usize) -> (Six, u64) {
    let (kappa, c) = (medium.kappa(), medium.rayleigh_speed());
    let mut total = [0.0; 6];
    let q = Complex64::new(0.0, c);
    let residue = 2.0 / (c * medium.rayleigh_slope());
    for wave in [Wave::P, Wave::S] {
        add(&mut total, residue, medium, wave, q, 1.0.into(), [r, z, t]);
    }
    let rule = Rule::new(points);
    let mut count = 4;
    let mut node = |w: f64, weight: f64| {
        // q = i w + 0
        let q = Complex64::new(0.0, w);
        let [a, b, g] = roots(medium, q);
        let d = g * g - 4.0 * a * b;
        let scale = (q * d).inv();
        for wave in [Wave::P, Wave::S] {
            for time in [t, -t] {
                add(
                    &mut total,
                    weight / PI,
                    medium,
                    wave,
                    q,
                    scale,
                    [r, z, time],
                );
            }
        }
        count += 4;
    };
    let mut cuts = singularities(kappa, r, z, t);
    cuts.extend([kappa, 1.0, 1.0 / kappa]);
    cuts.retain(|w| w.is_finite() && *w >= kappa);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
    // 3 x/2 - x^3/2 and its slope
    let smooth = |x: f64| (0.5 * x * (3.0 - x * x), 1.5 * (1.0 - x * x));
    for pair in cuts.windows(2) {
        let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        for (x, weight) in rule.on(-1.0, 1.0) {
            let (place, slope) = smooth(x);
            node(middle + half * place, half * slope * weight);
        }
    }
    // w = 1/v beyond the last
    let half = 0.5 / cuts[cuts.len() - 1];
    for (x, weight) in rule.on(-1.0, 1.0) {
        let (place, slope) = smooth(x);
        let v = half * (1.0 + place);
        node(1.0 / v, half * slope * weight / (v * v));
    }
    (total, count)
}

#[derive(Clone, Copy, PartialEq)]
enum Wave {
    P,
    S,
}

/// a, b and g at q = i w + 0.
fn roots(medium: &Medium, q: Complex64) -> [Complex64; 3] {
    let w = q.im;
    let slow = (w / medium.kappa()).powi(2);
    let root = |square: f64| {
        if square >= 0.0 {
            Complex64::new(square.sqrt(), 0.0)
        } else {
            Complex64::new(0.0, (-square).sqrt())
        }
    };
    [root(1.0 - w * w), root(1.0 - slow), (2.0 - slow).into()]
}

/// Adds `weight` times the real part of `scale` N Psi of one wave.
fn add(
    total: &mut Six,
    weight: f64,
    medium: &Medium,
    wave: Wave,
    q: Complex64,
    scale: Complex64,
    [r, z, t]: [f64; 3],
) {
    let [a, b, g] = roots(medium, q);
    let gamma = if wave == Wave::P { a } else { b };
    let lame = medium.lambda_over_mu() * q * q;
    // amplitudes of w, u, szz, srz, srr, stt and of the hoop term
    let [w, u, zz, rz, rr, tt, hoop] = if wave == Wave::P {
        [
            a * g,
            g,
            -g * g,
            -2.0 * a * g,
            g * (2.0 - lame),
            -lame * g,
            -2.0 * g,
        ]
    } else {
        let ab = a * b;
        [
            -2.0 * a,
            -2.0 * ab,
            4.0 * ab,
            2.0 * a * g,
            -4.0 * ab,
            Complex64::default(),
            4.0 * ab,
        ]
    };
    let shift = gamma * z - q * t;
    let xi = Complex64::new(shift.re.max(0.0), shift.im);
    let [a3, a2, g3, g2] = closed_potentials(xi, r);
    let fields = [
        u * g3 * r,
        w * a3,
        rr * a2 + hoop * g3,
        tt * a2 - hoop * g3,
        zz * a2,
        rz * g2 * r,
    ];
    for (sum, field) in total.iter_mut().zip(fields) {
        *sum += weight * (scale * field).re;
    }
}

/// A_3, A_2, B_3/r and B_2/r of Hertz's pressure in closed form, Re xi >= 0.
///
/// Differences of nearly equal logarithms for |xi| >> 1: the error grows as |xi|^3.
pub(crate) fn closed_potentials(xi: Complex64, r: f64) -> [Complex64; 4] {
    let i = Complex64::i();
    let end = |zeta: Complex64| {
        let rho = (zeta + i * r).sqrt() * (zeta - i * r).sqrt();
        let (sum, r2) = (zeta + rho, r * r);
        let log = sum.ln();
        let e = [
            -log,
            zeta * log - rho,
            0.75 * zeta * rho + (0.25 * r2 - 0.5 * zeta * zeta) * log,
        ];
        let f = [
            sum.inv(),
            -0.5 * (zeta / sum + log),
            0.5 * ((rho * rho + rho * zeta + zeta * zeta) / (3.0 * sum) + zeta * log - rho),
        ];
        [e, f]
    };
    let ([e, f], [e_below, f_below]) = (end(xi - i), end(xi + i));
    let combine = |x: [Complex64; 3], y: [Complex64; 3], n: usize| {
        let difference = (x[n - 1] - y[n - 1]) / (2.0 * i);
        1.5 / PI * (difference - 0.5 * (x[n - 2] + y[n - 2]))
    };
    [
        combine(e, e_below, 3),
        combine(e, e_below, 2),
        combine(f, f_below, 3),
        combine(f, f_below, 2),
    ]
}

/// Places on the path where Im xi = +-1 +- r.
fn singularities(kappa: f64, r: f64, z: f64, t: f64) -> Vec<f64> {
    let mut places = Vec::new();
    for m in [1.0 + r, 1.0 - r, r - 1.0, -1.0 - r] {
        // where gamma is real the path passes beside it
        places.push(m / t);
        for slowness in [1.0, 1.0 / kappa] {
            // z^2 (w^2 slowness^2 - 1) = (m - w t)^2; both senses are among the four m
            let a = (z * slowness).powi(2) - t * t;
            let (half_b, c) = (m * t, -(m * m + z * z));
            let root = half_b * half_b - a * c;
            if root >= 0.0 {
                let root = root.sqrt();
                places.extend([(-half_b + root) / a, (-half_b - root) / a]);
            }
        }
    }
    places
}
