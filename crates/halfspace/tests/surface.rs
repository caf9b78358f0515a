//! The surface response against the closed form of Kausel (2012) and the numbers of the physics notes.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::{Deflection, Medium, SurfaceResponse, kausel};

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
        let found = medium.kappa() * centre.static_compliance() * centre.relaxation_time();
        assert!((found - j).abs() < 1e-8, "nu = {nu}: J = {found}");
    }
}

#[test]
fn the_integral_is_the_integral_of_the_step() {
    for nu in RATIOS {
        let medium = Medium::new(nu).unwrap();
        for deflection in [Deflection::Centre, Deflection::Mean] {
            let response = SurfaceResponse::new(&medium, deflection);
            let h = 1e-3 * response.memory();
            let fronts: Vec<f64> = [1.0, 1.0 / medium.kappa(), 1.0 / medium.rayleigh_speed()]
                .iter()
                .map(|f| f * response.memory() * medium.rayleigh_speed())
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
            let late = 1.5 * response.memory();
            assert_eq!(response.step(late), 1.0);
            assert!(
                (response.step_integral(late) - late + response.relaxation_time()).abs() < 1e-13
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
                let t = front * response.memory() * medium.rayleigh_speed();
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
        let expected = medium.kappa().powi(2) * z0 / centre.static_compliance();
        let slope = centre.step(1e-6) / 1e-6;
        assert!(
            (slope / expected - 1.0).abs() < 1e-5,
            "nu = {nu}: {slope} {expected}"
        );
    }
}
