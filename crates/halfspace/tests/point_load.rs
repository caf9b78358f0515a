//! The point force against published closed forms and against an independent package.
//!
//! `cargo test -p hertzlamb-halfspace --test point_load -- --nocapture` prints the differences.
//!
//! - Surface, vertical: C. L. Pekeris, Proc. Natl. Acad. Sci. 41 (1955) 469, nu = 1/4; H. M. Mooney,
//!   Bull. Seism. Soc. Am. 64 (1974) 473 and E. Kausel, Proc. R. Soc. A 469 (2012) 20120462, any nu.
//! - Surface, radial: Pekeris (1955), elliptic integrals, nu = 1/4.
//! - Axis, vertical displacement and stress: Cagniard's substitution t = z sqrt(p^2 + 1/c^2), which is
//!   algebraic at r = 0.
//! - Everywhere: `tests/reference/point_load.csv`.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod support;

use halfspace::random::Stream;
use halfspace::{Field, Kernel, Medium, Profile};
use num_complex::Complex64;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use support::{NAMES, heading, line, read_csv, step};

const U: usize = Field::DisplacementR.index();
const W: usize = Field::DisplacementZ.index();
const SZZ: usize = Field::StressZz.index();

const PUBLISHED_RATIOS: [f64; 3] = [0.25, 0.3, 1.0 / 3.0];

fn point(nu: f64, tolerance: f64) -> Kernel {
    Kernel::new(&Medium::new(nu).unwrap(), Profile::Point, tolerance).unwrap()
}

/// (c2/c1)^2.
fn a2(nu: f64) -> f64 {
    (1.0 - 2.0 * nu) / (2.0 - 2.0 * nu)
}

/// w of a unit step force at the surface at distance one, mu = 1, tau = c2 t/r: Kausel (2012).
fn kausel_vertical(nu: f64, tau: f64) -> f64 {
    let a2 = a2(nu);
    let roots = cubic_roots(a2);
    let x3 = roots[2].re;
    let weight = |j: usize, root: Complex64| {
        let others: Complex64 = (0..3)
            .filter(|&k| k != j)
            .map(|k| roots[j] - roots[k])
            .product();
        (roots[j] - 0.5).powi(2) * root / others
    };
    let rayleigh = weight(2, (x3 - a2).sqrt().into()).re;
    let statics = (1.0 - nu) / (2.0 * PI);
    let square = tau * tau;
    let surface = |weight: f64| weight - weight * rayleigh / (x3 - square).sqrt();
    if square < a2 {
        0.0
    } else if tau < 1.0 {
        let leaky: Complex64 = (0..2)
            .map(|j| weight(j, (a2 - roots[j]).sqrt()) / (square - roots[j]).sqrt())
            .sum();
        statics * (surface(0.5) - 0.5 * leaky.re)
    } else if square < x3 {
        statics * surface(1.0)
    } else {
        statics
    }
}

/// Roots of -16 (1 - a2) x^3 + 8 (3 - 2 a2) x^2 - 8 x + 1, the largest real one last (Durand-Kerner).
fn cubic_roots(a2: f64) -> [Complex64; 3] {
    let lead = -16.0 * (1.0 - a2);
    let [c2, c1, c0] = [8.0 * (3.0 - 2.0 * a2), -8.0, 1.0].map(|c| c / lead);
    let mut roots = [0, 1, 2].map(|k| Complex64::new(0.4, 0.9).powi(k));
    for _ in 0..200 {
        for j in 0..3 {
            let x = roots[j];
            let others: Complex64 = (0..3).filter(|&k| k != j).map(|k| x - roots[k]).product();
            roots[j] = x - (((x + c2) * x + c1) * x + c0) / others;
        }
    }
    roots.sort_by(|a, b| a.re.total_cmp(&b.re));
    roots
}

/// The same at nu = 1/4: Pekeris (1955), equation for the vertical displacement, sign of a downward force.
fn pekeris_vertical(tau: f64) -> f64 {
    let (root3, square) = (3.0_f64.sqrt(), tau * tau);
    let rayleigh = (3.0 * root3 + 5.0).sqrt() / (0.75 + 0.25 * root3 - square).sqrt();
    let bound = (3.0 * root3 - 5.0).sqrt() / (square + 0.25 * root3 - 0.75).sqrt();
    if 3.0 * square < 1.0 {
        0.0
    } else if tau < 1.0 {
        (6.0 - root3 / (square - 0.25).sqrt() - rayleigh + bound) / (32.0 * PI)
    } else if square < 0.75 + 0.25 * root3 {
        (6.0 - rayleigh) / (16.0 * PI)
    } else {
        3.0 / (8.0 * PI)
    }
}

/// u at nu = 1/4: Pekeris (1955), with Pi(n, k) = int dtheta/((1 + n sin^2) sqrt(1 - k^2 sin^2)).
fn pekeris_radial(tau: f64) -> f64 {
    let root3 = 3.0_f64.sqrt();
    let k2 = 0.5 * (3.0 * tau * tau - 1.0);
    if k2 <= 0.0 {
        return 0.0;
    }
    let (modulus, factor, scale) = if tau < 1.0 {
        (k2, k2, 1.0)
    } else {
        (1.0 / k2, 1.0, 1.0 / k2.sqrt())
    };
    let third = |n: f64| complete_elliptic(n * factor, modulus);
    let sum = 6.0 * third(0.0) - 18.0 * third(8.0)
        + (6.0 - 4.0 * root3) * third(-(12.0 * root3 - 20.0))
        + (6.0 + 4.0 * root3) * third(12.0 * root3 + 20.0);
    let body = -6.0_f64.sqrt() * tau * scale / (32.0 * PI * PI) * sum;
    let late = tau * tau - 0.25 * (3.0 + root3);
    if late > 0.0 {
        body - tau / (8.0 * PI * late.sqrt())
    } else {
        body
    }
}

/// Pi(n, k) by the midpoint rule, which converges geometrically for a periodic function.
fn complete_elliptic(n: f64, modulus: f64) -> f64 {
    const NODES: usize = 2000;
    let width = 0.5 * PI / NODES as f64;
    let nodes = (0..NODES).map(|i| ((i as f64 + 0.5) * width).sin().powi(2));
    nodes
        .map(|s| width / ((1.0 + n * s) * (1.0 - modulus * s).sqrt()))
        .sum()
}

/// Displacement and stress zz on the axis at depth one, mu = c1 = 1, from the Laplace transform
///
/// ```text
/// w^ = 1/(2 pi) int p A [(2 p^2 + K) e^{-s A z} - 2 p^2 e^{-s B z}]/R dp,   A^2 = p^2 + 1, B^2 = p^2 + K
/// szz^ = -s/(2 pi) int p [(2 p^2 + K)^2 e^{-s A z} - 4 p^2 A B e^{-s B z}]/R dp
/// ```
///
/// where A z or B z is time. The factor s is a derivative, taken with an imaginary step.
fn axis(nu: f64, t: f64) -> [f64; 2] {
    const STEP: f64 = 1e-30;
    let k = 1.0 / a2(nu);
    let rayleigh = |p2: Complex64, a: Complex64, b: Complex64| {
        (2.0 * p2 + k) * (2.0 * p2 + k) - 4.0 * p2 * a * b
    };
    let time = Complex64::new(t, STEP);
    let mut w = 0.0;
    let mut szz = Complex64::default();
    if t > 1.0 {
        let p2 = time * time - 1.0;
        let g = 2.0 * p2 + k;
        let r = rayleigh(p2, time, (p2 + k).sqrt());
        w += (time * time * g / r).re;
        szz += time * g * g / r;
    }
    if t > k.sqrt() {
        let p2 = time * time - k;
        let a = (p2 + 1.0).sqrt();
        let r = rayleigh(p2, a, time);
        w -= (2.0 * p2 * a * time / r).re;
        szz -= time * 4.0 * p2 * a * time / r;
    }
    [w / (2.0 * PI), -szz.im / STEP / (2.0 * PI)]
}

#[test]
fn the_formula_of_kausel_is_that_of_pekeris_at_one_quarter() {
    for i in 1..300 {
        let tau = 0.005 * f64::from(i);
        let (a, b) = (kausel_vertical(0.25, tau), pekeris_vertical(tau));
        assert!(
            (a - b).abs() < 1e-12 * (1.0 + a.abs()),
            "tau = {tau}: {a} {b}"
        );
    }
    // static values: (1 - nu)/(2 pi) and -(1 - 2 nu)/(4 pi)
    assert!((pekeris_vertical(2.0) - 0.75 / (2.0 * PI)).abs() < 1e-15);
    assert!((pekeris_radial(1e4) + 0.5 / (4.0 * PI)).abs() < 1e-8);
}

/// Times between the fronts, at least `gap` away from each relative to it.
fn clear(tau: f64, fronts: &[f64], gap: f64) -> bool {
    fronts.iter().all(|f| (tau - f).abs() > gap * f)
}

#[test]
fn the_surface_response_is_the_published_one() {
    heading("surface, point force, relative to the static value or the value");
    for nu in PUBLISHED_RATIOS {
        let kernel = point(nu, 1e-12);
        let kappa = kernel.medium().kappa();
        let fronts = [kappa, 1.0, kappa / kernel.medium().rayleigh_speed()];
        let (mut vertical, mut radial) = (vec![], vec![]);
        for i in 1..=600 {
            let tau = 0.0025 * f64::from(i);
            if !clear(tau, &fronts, 1e-4) {
                continue;
            }
            // unit distance is arbitrary for a point force
            let r = [0.01, 0.7, 1.0, 40.0][i as usize % 4];
            let found = step(&kernel, r, 0.0, tau * r / kappa);
            let expected = kausel_vertical(nu, tau) / r;
            let scale = (0.5 * (1.0 - nu) / PI / r).max(expected.abs());
            assert!(found[W].is_finite(), "nu {nu} r {r} tau {tau} {expected}");
            assert!(
                expected.is_finite(),
                "EXP nu {nu} r {r} tau {tau} {expected}"
            );
            vertical.push((found[W] - expected).abs() / scale);
            if nu == 0.25 && clear(tau, &fronts, 3e-3) {
                let expected = pekeris_radial(tau) / r;
                let scale = (0.125 / PI / r).max(expected.abs());
                radial.push((found[U] - expected).abs() / scale);
            }
        }
        let found = line(&format!("w nu {nu:.4}"), &vertical);
        assert!(found.max < 1e-10, "nu = {nu}: {found}");
        if nu == 0.25 {
            let found = line("u nu 0.25", &radial);
            assert!(found.p90 < 1e-10 && found.max < 1e-9, "{found}");
        }
    }
}

#[test]
fn the_response_on_the_axis_is_algebraic() {
    heading("axis, point force, relative to the static value or the value");
    for nu in [0.05, 0.25, 0.3, 1.0 / 3.0, 0.45] {
        let kernel = point(nu, 1e-12);
        let fronts = [1.0, 1.0 / kernel.medium().kappa()];
        // the axis is a continuation from larger radii, which a front leaves less and less room
        // p90 and largest of w, then of szz
        for (label, near, far, bounds) in [
            (
                "clear of fronts by 5 %",
                0.05,
                f64::INFINITY,
                [[5e-9, 2e-8], [1e-5, 2e-3]],
            ),
            (
                "within 0.5 to 5 %",
                0.005,
                0.05,
                [[1e-8, 2e-8], [1e-4, 1e-3]],
            ),
        ] {
            let mut errors = [vec![], vec![]];
            for i in 1..=1200 {
                let t = 0.005 * f64::from(i);
                if !clear(t, &fronts, near) || clear(t, &fronts, far) {
                    continue;
                }
                let z = [0.05, 1.0, 3.0][i as usize % 3];
                let found = step(&kernel, 0.0, z, t * z);
                let rest = kernel.static_field(0.0, z).unwrap();
                let [w, szz] = axis(nu, t);
                for (e, f, expected) in [(0, W, w / z), (1, SZZ, szz / (z * z))] {
                    let scale = rest[f].abs().max(expected.abs());
                    errors[e].push((found[f] - expected).abs() / scale);
                }
                assert_eq!(found[U], 0.0);
            }
            println!("nu = {nu:.4}, {label}");
            for ((name, errors), [p90, max]) in ["w", "szz"].iter().zip(&errors).zip(bounds) {
                let found = line(name, errors);
                assert!(
                    found.p90 < p90 && found.max < max,
                    "nu = {nu}, {name}, {label}: {found}"
                );
            }
        }
    }
}

#[test]
fn the_package_agrees_to_its_accuracy() {
    let (header, rows) = read_csv("point_load.csv");
    assert_eq!(header[4..10], NAMES);
    let mut errors: BTreeMap<(String, usize), Vec<f64>> = BTreeMap::new();
    for row in &rows {
        let v: Vec<f64> = row[..4].iter().map(|x| x.parse().unwrap()).collect();
        let (r, z, t) = (v[1], v[2], v[3]);
        let kernel = point(v[0], 1e-12);
        let found = step(&kernel, r, z, t);
        let rest = kernel.static_field(r, z).unwrap();
        let largest = |fields: std::ops::Range<usize>| {
            let sizes = fields.map(|f| found[f].abs().max(rest[f].abs()));
            sizes.fold(0.0, f64::max)
        };
        let scales = [largest(0..2), largest(2..6)];
        for f in 0..6 {
            if let Ok(value) = row[4 + f].parse::<f64>() {
                let error = (found[f] - value).abs() / scales[usize::from(f >= 2)];
                let key = (row[10].clone(), f);
                errors.entry(key).or_default().push(error);
            }
        }
    }
    heading("difference from pygrt-kit, relative to the largest field of the same unit");
    for ((function, f), e) in &errors {
        let found = line(&format!("{function} {}", NAMES[*f]), e);
        // what the package itself holds: point_load.md
        let (p50, max) = match (function.as_str(), *f >= 2) {
            ("lamb1", _) => (2e-10, 5e-9),
            (_, false) => (1e-8, 1e-6),
            (_, true) => (2e-7, 2e-5),
        };
        assert!(found.p50 < p50 && found.max < max, "{function}: {found}");
    }
}

/// Rounding is all that may differ. For displacements it is small; the stresses are finite parts of integrals
/// with a singularity of power -3/2, which multiplies the rounding error of the distance from the front.
///
/// This pins a shortfall: stresses of a point force hold 1e-7 at the 90th percentile and 1e-5 at the 99th,
/// whatever the tolerance, and their error estimate does not count it.
#[test]
fn length_is_arbitrary() {
    let mut random = Stream::new(5);
    let mut errors = [vec![], vec![]];
    for _ in 0..400 {
        let kernel = point(random.within(-0.4, 0.45), 1e-12);
        let (r, z) = (random.within(0.1, 3.0), random.within(0.1, 3.0));
        let t = random.within(0.2, 4.0) * r.hypot(z);
        let scale = 10.0_f64.powf(random.within(-4.0, 4.0));
        let one = step(&kernel, r, z, t);
        let other = step(&kernel, scale * r, scale * z, scale * t);
        let rest = kernel.static_field(r, z).unwrap();
        let largest = |fields: std::ops::Range<usize>| {
            let sizes = fields.map(|f| one[f].abs().max(rest[f].abs()));
            sizes.fold(0.0, f64::max)
        };
        let sizes = [largest(0..2), largest(2..6)];
        for f in 0..6 {
            let group = usize::from(f >= 2);
            let factor = [scale, scale * scale][group];
            errors[group].push((one[f] - factor * other[f]).abs() / sizes[group]);
        }
    }
    heading("the same point in other units of length");
    let displacement = line("displacement", &errors[0]);
    let stress = line("stress", &errors[1]);
    assert!(displacement.max < 1e-9, "{displacement}");
    assert!(stress.p90 < 1e-7 && stress.p99 < 1e-5, "{stress}");
}

/// The time integral of a stress jumps at the first arrival; before it the integral is that of minus the static field, with the
/// same constant, as displacements show, which do not jump.
#[test]
fn integrals_before_the_first_arrival_are_of_the_static_field() {
    for nu in [0.1, 0.3] {
        let kernel = point(nu, 1e-10);
        for [r, z] in [[0.6, 0.8], [0.3, 2.0], [2.0, 0.5]] {
            let (arrival, rest) = (f64::hypot(r, z), kernel.static_field(r, z).unwrap());
            let before = kernel.step_integral(r, z, 0.7 * arrival).unwrap().value;
            let after = kernel
                .step_integral(r, z, arrival * (1.0 + 1e-9))
                .unwrap()
                .value;
            for f in 0..6 {
                assert!(
                    (before[f] + 0.7 * arrival * rest[f]).abs() < 1e-14 * (1.0 + rest[f].abs())
                );
            }
            for f in [U, W] {
                let off = (after[f] + arrival * rest[f]).abs();
                assert!(off < 1e-7, "{nu} {r} {z} {f}: {off:.1e}");
            }
        }
    }
}
