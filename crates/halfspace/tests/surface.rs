//! The surface response against the closed form of Kausel (2012) and the numbers of the physics notes.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::gauss::rule;
use halfspace::{Deflection, Medium, Profile, SurfaceResponse, kausel};

const RATIOS: [f64; 12] = [
    -0.5,
    -0.2,
    0.0,
    0.1,
    0.2,
    0.25,
    0.263_082_06,
    0.263_082_061,
    0.3,
    0.4,
    0.45,
    0.49,
];

#[test]
fn centre_agrees_with_the_closed_form() {
    for nu in RATIOS {
        let medium = Medium::new(nu).unwrap();
        let centre = SurfaceResponse::new(&medium, Deflection::Centre);
        let mut worst = 0.0_f64;
        for i in 1..400 {
            let big_t = 1.2 * f64::from(i) / 400.0;
            let value = centre.step(big_t / medium.kappa());
            let d = (value - kausel::centre_step(&medium, big_t)).abs();
            worst = worst.max(d);
        }
        // the closed form, not the response, loses digits where its poles meet
        let bound = if (nu - 0.263_082_06_f64).abs() < 1e-6 {
            1e-9
        } else {
            2e-14
        };
        assert!(worst < bound, "nu = {nu}: {worst:e}");
    }
}

#[test]
fn published_values_are_reproduced() {
    let table = [
        (
            0.25,
            [
                0.09795187690274,
                0.4829324247467,
                0.924305551263,
                0.9666997726221,
            ],
        ),
        (
            0.30,
            [
                0.0971890924979,
                0.4834211245802,
                0.9334967005035,
                0.9754028581314,
            ],
        ),
    ];
    for (nu, values) in table {
        let medium = Medium::new(nu).unwrap();
        let centre = SurfaceResponse::new(&medium, Deflection::Centre);
        for (big_t, w) in [0.1, 0.5, 1.0, 1.05].into_iter().zip(values) {
            let value = centre.step(big_t / medium.kappa());
            assert!((value - w).abs() < 2e-13, "nu = {nu}, T = {big_t}: {value}");
        }
    }
    let memory = [
        (0.0, 0.21396398),
        (0.2, 0.15986440),
        (0.25, 0.14813388),
        (0.3, 0.13722707),
        (1.0 / 3.0, 0.13045234),
        (0.4, 0.11824355),
        (0.45, 0.11047434),
    ];
    for (nu, j) in memory {
        let medium = Medium::new(nu).unwrap();
        let centre = SurfaceResponse::new(&medium, Deflection::Centre);
        let found = medium.kappa() * centre.disc.static_compliance * centre.disc.relaxation_time;
        assert!((found - j).abs() < 1e-8, "nu = {nu}: J = {found}");
    }
}

#[test]
fn the_integral_is_the_integral_of_the_step() {
    for nu in RATIOS {
        let medium = Medium::new(nu).unwrap();
        for deflection in [Deflection::Centre, Deflection::Mean] {
            let response = SurfaceResponse::new(&medium, deflection);
            let h = 1e-3 * response.disc.memory;
            let fronts: Vec<f64> = [1.0, 1.0 / medium.kappa(), 1.0 / medium.rayleigh_speed()]
                .iter()
                .map(|f| f * response.disc.memory * medium.rayleigh_speed())
                .collect();
            for i in 1..1500 {
                // Simpson's rule over one small interval away from the fronts
                let t = f64::from(i) * h;
                if fronts.iter().any(|f| (f - t).abs() < 3.0 * h) {
                    continue;
                }
                let slope =
                    (response.step_integral(t + h) - response.step_integral(t - h)) / (2.0 * h);
                let mean =
                    (response.step(t - h) + 4.0 * response.step(t) + response.step(t + h)) / 6.0;
                assert!(
                    (slope - mean).abs() < 2e-6,
                    "nu = {nu}, {deflection:?}, t = {t}: {slope} {mean}"
                );
            }
            let late = 1.5 * response.disc.memory;
            assert_eq!(response.step(late), 1.0);
            assert!(
                (response.step_integral(late) - late + response.disc.relaxation_time).abs() < 1e-13
            );
        }
    }
}

#[test]
fn response_rises_from_zero_and_joins_smoothly() {
    for nu in RATIOS {
        let medium = Medium::new(nu).unwrap();
        for deflection in [Deflection::Centre, Deflection::Mean] {
            let response = SurfaceResponse::new(&medium, deflection);
            assert_eq!(response.step(0.0), 0.0);
            assert!(response.step(1e-9).abs() < 1e-8);
            for front in [1.0, 1.0 / medium.kappa(), 1.0 / medium.rayleigh_speed()] {
                let t = front * response.disc.memory * medium.rayleigh_speed();
                let jump = response.step(t * (1.0 + 1e-12)) - response.step(t * (1.0 - 1e-12));
                assert!(jump.abs() < 1e-10, "nu = {nu}, front at {t}: {jump:e}");
            }
        }
    }
}

#[test]
fn initial_slope_is_the_plane_wave_impedance() {
    // (32): the impulse response starts at kappa^2 Z(0), so dW/dt(0+) = kappa^2 Z(0)/S0
    for nu in RATIOS {
        let medium = Medium::new(nu).unwrap();
        let centre = SurfaceResponse::new(&medium, Deflection::Centre);
        let z0 = 1.5 / std::f64::consts::PI;
        let expected = medium.kappa().powi(2) * z0 / centre.disc.static_compliance;
        let slope = centre.step(1e-6) / 1e-6;
        assert!(
            (slope / expected - 1.0).abs() < 1e-5,
            "nu = {nu}: {slope} {expected}"
        );
    }
}

/// Gauss nodes on [a, b], mapped so that both ends are flat to fourth order: roots and logarithms there cost nothing.
fn smooth_nodes(a: f64, b: f64) -> impl Iterator<Item = (f64, f64)> {
    rule(40).on(-1.0, 1.0).map(move |(x, w)| {
        let q = x * x;
        let map = x * (35.0 - q * (35.0 - q * (21.0 - 5.0 * q))) / 16.0;
        let slope = 35.0 / 16.0 * (1.0 - q).powi(3);
        let half = 0.5 * (b - a);
        // from the nearer end, so that no digit of the distance is lost
        (0.5 * (a + b) + half * map, w * half * slope)
    })
}

/// Splits [a, b] at the given places and halves every piece `halvings` times toward both of its ends.
fn graded(a: f64, b: f64, cuts: &[f64], halvings: i32) -> Vec<[f64; 2]> {
    let mut ends = vec![a, b];
    ends.extend(cuts.iter().filter(|&&c| c > a && c < b));
    ends.sort_by(f64::total_cmp);
    ends.dedup_by(|b, a| *b - *a < 1e-9 * *b);
    let mut pieces = vec![];
    for pair in ends.windows(2) {
        let (from, length) = (pair[0], pair[1] - pair[0]);
        let lower = (1..=halvings).rev().map(|j| 0.5_f64.powi(j));
        let upper = (2..=halvings).map(|j| 1.0 - 0.5_f64.powi(j));
        let marks: Vec<f64> = [0.0]
            .into_iter()
            .chain(lower)
            .chain(upper)
            .chain([1.0])
            .collect();
        pieces.extend(
            marks
                .windows(2)
                .map(|m| [from + length * m[0], from + length * m[1]]),
        );
    }
    pieces
}

const LIMITS: [f64; 4] = [-0.5, 0.499, 0.4999, -0.499_999];

/// The mean deflection is a mean of centre deflections: with phi the chord functions of physics,
///
/// ```text
/// phi_mean(eta) = int_0^2 phi_centre(eta/a) (15/16) a^2 (1 - a^2/4) da     so     W_mean(t) = int_0^2 W_centre(t/a) ... da
/// ```
///
/// which differentiating (phi'/eta)' twice shows; W_centre is Kausel's closed form.
#[test]
fn both_deflections_hold_1e_13_on_the_whole_range() {
    for nu in RATIOS.into_iter().chain(LIMITS) {
        if (nu - 0.263_082_06_f64).abs() < 1e-6 {
            // where the poles of the closed form meet it is the reference that loses digits
            continue;
        }
        let medium = Medium::new(nu).unwrap();
        let [centre, mean] =
            [Deflection::Centre, Deflection::Mean].map(|d| SurfaceResponse::new(&medium, d));
        let kappa = medium.kappa();
        let fronts = [1.0, 1.0 / kappa, 1.0 / medium.rayleigh_speed()];
        let mut worst = [0.0_f64; 2];
        for i in 1..60 {
            let t = mean.disc.memory * 1.05 * f64::from(i) / 60.0;
            let exact = |t: f64| kausel::centre_step(&medium, kappa * t);
            worst[0] = worst[0].max((centre.step(0.5 * t) - exact(0.5 * t)).abs());
            let cuts = fronts.map(|f| t / f);
            let mut sum = 0.0;
            for [from, to] in graded(0.0, 2.0, &cuts, 6) {
                for (a, weight) in smooth_nodes(from, to) {
                    sum += weight * 15.0 / 16.0 * a * a * (1.0 - 0.25 * a * a) * exact(t / a);
                }
            }
            worst[1] = worst[1].max((mean.step(t) - sum).abs());
        }
        println!("nu {nu}: centre {:.1e}, mean {:.1e}", worst[0], worst[1]);
        assert!(worst[0] < 1e-13 && worst[1] < 1e-13, "nu {nu}: {worst:?}");
    }
}

/// The impulse response integrates to the step response, and its value at zero is that of a plane wave.
///
/// Its mean over intervals graded toward the fronts is (W(b) - W(a))/(b - a) to 1e-11 of W'(0).
#[test]
fn the_impulse_holds_1e_11() {
    const ROUNDING: f64 = 5e-15;
    for nu in RATIOS.into_iter().chain(LIMITS) {
        let medium = Medium::new(nu).unwrap();
        for deflection in [Deflection::Centre, Deflection::Mean] {
            let response = SurfaceResponse::new(&medium, deflection);
            let size = response.impulse(0.0);
            let scale = response.disc.memory * medium.rayleigh_speed();
            let fronts =
                [1.0, 1.0 / medium.kappa(), 1.0 / medium.rayleigh_speed()].map(|f| f * scale);
            let mut worst = 0.0_f64;
            for [from, to] in graded(0.0, response.disc.memory, &fronts, 5) {
                let mean: f64 = smooth_nodes(from, to)
                    .map(|(t, weight)| weight * response.impulse(t))
                    .sum();
                let rise = response.step(to) - response.step(from);
                // less what rounding leaves of the difference
                let gap = ((mean - rise).abs() - ROUNDING).max(0.0);
                worst = worst.max(gap / (to - from) / size);
            }
            println!("nu {nu} {deflection:?}: {worst:.1e}");
            assert!(worst < 1e-11, "nu {nu} {deflection:?}: {worst:e}");
        }
    }
}

/// NaN is answered by NaN, what is before the load by nothing.
#[test]
fn nan_is_not_swallowed() {
    let medium = Medium::new(0.3).unwrap();
    assert!(kausel::centre_step(&medium, f64::NAN).is_nan());
    for profile in [Profile::Hertz, Profile::Punch, Profile::Point] {
        assert!(profile.pressure(f64::NAN).is_nan());
    }
    for deflection in [Deflection::Centre, Deflection::Mean] {
        let response = SurfaceResponse::new(&medium, deflection);
        for f in [
            SurfaceResponse::step,
            SurfaceResponse::step_integral,
            SurfaceResponse::impulse,
        ] {
            assert!(f(&response, f64::NAN).is_nan());
            assert_eq!(f(&response, -1e-9), 0.0);
            assert_eq!(f(&response, f64::NEG_INFINITY), 0.0);
        }
    }
}
