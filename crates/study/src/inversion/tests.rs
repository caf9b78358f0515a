//! Each inversion by itself, against the single integral and the closed form, and where it fails.

use super::Inversion;
use super::framework::{euler, invert, stehfest, talbot};
use super::hankel::Hankel;
use super::series::{Series, de_hoog, durbin, in_window};
use crate::ComparedMethod;
use crate::measure::Effort;
use crate::question::kernels::{KernelScene, POISSON_RATIO};
use halfspace::{Kernel, Medium, Profile, Six, kausel};
use num_complex::Complex64;

/// f(t) of a transform.
fn inverted(rule: &[[Complex64; 2]], t: f64, transform: impl Fn(Complex64) -> Complex64) -> f64 {
    invert(rule, t, |s| s.iter().map(|&s| [transform(s)]).collect())[0]
}

/// 1 - e^{-t} cos 2t.
fn smooth(s: Complex64) -> Complex64 {
    s.inv() - (s + 1.0) / ((s + 1.0) * (s + 1.0) + 4.0)
}

fn smooth_at(t: f64) -> f64 {
    1.0 - (-t).exp() * (2.0 * t).cos()
}

const TIMES: [f64; 5] = [0.3, 0.9, 1.7, 3.1, 4.9];

fn worst(rule: &[[Complex64; 2]]) -> f64 {
    TIMES.iter().fold(0.0, |most: f64, &t| {
        most.max((inverted(rule, t, smooth) - smooth_at(t)).abs())
    })
}

#[test]
fn a_smooth_function_is_inverted_to_the_accuracy_of_each_method() {
    for (name, rule, expected) in [
        ("talbot", talbot(24), 1e-9),
        ("euler", euler(16), 1e-8),
        ("stehfest", stehfest(14), 2e-2),
    ] {
        let error = worst(&rule);
        assert!(error < expected, "{name}: {error:e}");
    }
}

#[test]
fn more_terms_are_better() {
    for (name, coarse, fine) in [
        ("talbot", talbot(8), talbot(20)),
        ("euler", euler(6), euler(12)),
        ("stehfest", stehfest(6), stehfest(14)),
    ] {
        assert!(worst(&fine) < 0.3 * worst(&coarse), "{name}");
    }
}

#[test]
fn series_share_their_samples() {
    let all: [(Series, usize, f64, f64); 2] =
        [(de_hoog, 81, 1e-10, 1e-8), (durbin, 4001, 1e-6, 2e-2)];
    for (series, samples, aliasing, promised) in all {
        let transform = |s: &[Complex64]| s.iter().map(|&s| [smooth(s)]).collect();
        let found = in_window(series, samples, [5.0, aliasing], &TIMES, transform);
        for ([found], t) in found.into_iter().zip(TIMES) {
            assert!(
                (found - smooth_at(t)).abs() < promised,
                "{promised:e} at {t}"
            );
        }
    }
}

fn distance(a: &Six, b: &Six) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |most, (x, y)| most.max((x - y).abs()))
}

#[test]
fn the_surface_centre_by_inversion_is_the_closed_form() {
    let medium = Medium::new(0.3).unwrap();
    let hankel = Hankel::new(&medium, [0.0, 0.0], 13.0);
    let transform = |s| hankel.surface(s);
    for (t, promised) in [
        (0.5, 1e-9),
        (1.0, 1e-4),
        (2.5, 5e-3),
        (4.0, 1e-4),
        (8.0, 1e-6),
    ] {
        let exact = kausel::centre_step(&medium, medium.kappa() * t);
        let euler = inverted(&euler(16), t, transform);
        assert!((euler - exact).abs() < promised, "t = {t}: {euler} {exact}");
    }
    for (t, promised) in [(2.5, 1e-7), (4.0, 1e-11), (8.0, 1e-11)] {
        let talbot = inverted(&talbot(24), t, transform);
        assert!((talbot - 1.0).abs() < promised, "t = {t}: {talbot}");
    }
}

#[test]
fn the_interior_by_inversion_is_the_single_integral() {
    let medium = Medium::new(0.3).unwrap();
    let (r, z) = (0.5, 0.6);
    let kernel = Kernel::new(&medium, Profile::Hertz, 1e-13).unwrap();
    let rest = kernel.static_field(r, z).unwrap();
    let hankel = Hankel::new(&medium, [r, z], 13.0);
    for (t, promised) in [(2.0, 3e-5), (5.0, 1e-11), (9.0, 1e-11), (16.0, 1e-11)] {
        let value = kernel.remainder(r, z, t).unwrap().value;
        let exact: Six = std::array::from_fn(|f| value[f] + rest[f]);
        let transform = |s: &[Complex64]| hankel.values(s);
        let series = in_window(de_hoog, 161, [20.0, 1e-11], &[t], transform)[0];
        assert!(distance(&series, &exact) < promised, "de Hoog at {t}");
        if t >= 5.0 {
            let continued = invert(&talbot(24), t, |s| hankel.values(s));
            assert!(distance(&continued, &exact) < promised, "Talbot at {t}");
        }
    }
}

/// Largest error within 3 % of the last front, and from four times its time on.
fn errors(scene: &KernelScene, values: &[Six]) -> [f64; 2] {
    let front = scene.arrivals.last().copied().unwrap();
    let mut worst = [0.0_f64; 2];
    for (t, error) in scene.times.iter().zip(scene.errors_over_time(values)) {
        if (t / front - 1.0).abs() < 0.03 {
            worst[0] = worst[0].max(error);
        } else if *t > 4.0 * front {
            worst[1] = worst[1].max(error);
        }
    }
    worst
}

#[test]
fn every_inversion_fails_at_the_front_and_recovers_as_far_as_it_can() {
    let medium = Medium::new(POISSON_RATIO).unwrap();
    let scene = KernelScene::axis(&medium, 24, &[-0.02, -0.01, 0.0, 0.01, 0.02]).unwrap();
    let mut found = Vec::new();
    for method in Inversion::pictured(Effort::Full) {
        let (values, _) = method.run(&medium, scene.place, &scene.times).unwrap();
        found.push((method.method, errors(&scene, &values)));
    }
    // at the front at least, and long after at most
    for (method, [front, late]) in found {
        let [least, most] = match method {
            ComparedMethod::FixedTalbot => [1e-3, 1e-11],
            ComparedMethod::GaverStehfest => [1e-2, 1e-3],
            ComparedMethod::Euler => [1e-4, 1e-6],
            ComparedMethod::Durbin => [1e-4, 2e-3],
            ComparedMethod::DeHoog => [1e-5, 1e-10],
            other => panic!("{other:?} is no inversion"),
        };
        assert!(
            front > least && late < most,
            "{method:?}: {front:e}, {late:e}"
        );
    }
}
