//! Any number into any public function: a typed error that names argument, value and range, or finite values.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::{
    Arrivals, Deflection, DomainError, Estimate, Kernel, Medium, Profile, SurfaceResponse, kausel,
};
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;

const PROFILES: [Profile; 3] = [Profile::Hertz, Profile::Punch, Profile::Point];

/// Numbers that break code.
const NASTY: [f64; 24] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    f64::MIN_POSITIVE,
    5e-324,
    -5e-324,
    1e-200,
    1e-16,
    f64::EPSILON,
    0.5,
    1.0 - f64::EPSILON / 2.0,
    1.0,
    1.0 + f64::EPSILON,
    -1.0,
    2.0,
    1e6,
    1e12,
    1e100,
    1e160,
    f64::MAX,
    f64::MIN,
    -1e-9,
];

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        prop::sample::select(NASTY.to_vec()),
        any::<u64>().prop_map(f64::from_bits),
        any::<f64>(),
        0.0..20.0_f64,
        (-300.0..300.0_f64).prop_map(|e| 10.0_f64.powf(e)),
    ]
}

/// Special ratios, any, and those next to the ends of the interval.
fn any_medium() -> impl Strategy<Value = Medium> {
    let special = prop::sample::select(vec![
        -0.999,
        -0.5,
        0.0,
        0.25,
        0.263_082_06,
        0.3,
        1.0 / 3.0,
        0.4999,
        0.499_999_9,
    ]);
    let near = (1.0..15.0_f64).prop_map(|e| 10.0_f64.powf(-e));
    prop_oneof![
        3 => special,
        2 => -0.999_999..0.499_999_f64,
        1 => near.clone().prop_map(|gap| 0.5 - gap),
        1 => near.prop_map(|gap| gap - 1.0),
    ]
    .prop_map(|nu| Medium::new(nu).unwrap())
}

fn any_profile() -> impl Strategy<Value = Profile> {
    prop::sample::select(PROFILES.to_vec())
}

/// The error names one of `arguments`, carries its value bit by bit, and states a range.
fn names(error: &DomainError, arguments: &[(&str, f64)]) -> bool {
    let text = error.to_string();
    let DomainError::Range {
        argument,
        value,
        range,
    } = error
    else {
        return false;
    };
    let (_, given) = arguments.iter().find(|(name, _)| name == argument).unwrap();
    given.to_bits() == value.to_bits() && text.contains(argument) && text.contains(range)
}

/// Finite values, and errors that are finite and not negative.
fn sound(estimate: &Estimate) -> bool {
    estimate.value.iter().all(|v| v.is_finite())
        && estimate.error.iter().all(|e| e.is_finite() && *e >= 0.0)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))), ..ProptestConfig::default() })]

    #[test]
    fn a_medium_is_one_or_an_error(nu in any_number()) {
        match Medium::new(nu) {
            Ok(medium) => {
                let numbers = [medium.kappa(), medium.lambda_over_mu(), medium.rayleigh_speed(), medium.rayleigh_slope()];
                prop_assert!(numbers.iter().all(|v| v.is_finite()), "{nu:e} {numbers:?}");
                prop_assert!(medium.rayleigh_speed() < medium.kappa());
            }
            Err(error) => prop_assert!(names(&error, &[("poisson_ratio", nu)])),
        }
    }

    #[test]
    fn a_pressure_is_a_number(profile in any_profile(), r in any_number()) {
        let pressure = profile.pressure(r);
        prop_assert!(pressure >= 0.0 || r.is_nan() && pressure.is_nan(), "{profile:?} {r:e}");
    }

    #[test]
    fn a_kernel_is_one_or_an_error(tolerance in any_number(), profile in any_profile()) {
        let made = Kernel::new(&Medium::new(0.3).unwrap(), profile, tolerance);
        match made {
            Ok(_) => prop_assert!((1e-14..=0.1).contains(&tolerance)),
            Err(error) => prop_assert!(names(&error, &[("tolerance", tolerance)])),
        }
    }

    #[test]
    fn fields_are_finite_or_an_error(
        medium in any_medium(), profile in any_profile(),
        r in any_number(), z in any_number(), t in any_number(), tolerance in prop::sample::select(vec![1e-4, 1e-10]),
    ) {
        let kernel = Kernel::new(&medium, profile, tolerance).unwrap();
        let place = [("r", r), ("z", z)];
        let all = [("r", r), ("z", z), ("t", t)];
        match kernel.static_field(r, z) {
            Ok(fields) => prop_assert!(fields.iter().all(|v| v.is_finite()), "static {all:?} {fields:?}"),
            Err(error) => prop_assert!(names(&error, &place)),
        }
        match kernel.remainder(r, z, t) {
            Ok(found) => prop_assert!(sound(&found), "remainder {all:?} {found:?}"),
            Err(error) => prop_assert!(names(&error, &all)),
        }
        match kernel.step_integral(r, z, t) {
            Ok(found) => prop_assert!(sound(&found), "integral {all:?} {found:?}"),
            Err(error) => prop_assert!(names(&error, &all)),
        }
        match kernel.impulse(r, z, t) {
            Ok(found) => prop_assert!(profile == Profile::Hertz && sound(&found), "{all:?} {found:?}"),
            Err(DomainError::HertzOnly { profile: named, .. }) => {
                prop_assert!(named == profile && profile != Profile::Hertz);
            }
            Err(error) => prop_assert!(names(&error, &all)),
        }
        match Arrivals::new(&medium, profile, r, z) {
            Ok(found) => prop_assert!(found.sorted().iter().all(|a| a.is_finite())),
            Err(error) => prop_assert!(names(&error, &place)),
        }
    }

    #[test]
    fn cells_are_finite_or_an_error(
        medium in any_medium(), profile in any_profile(),
        r in any_number(), z in any_number(), width in any_number(), count in 0..80_usize,
    ) {
        let kernel = Kernel::new(&medium, profile, 1e-8).unwrap();
        // what is reported as t is the end of the trace
        let end = count as f64 * width;
        let all = [("r", r), ("z", z), ("width", width), ("t", end)];
        match kernel.trace(r, z, end) {
            Ok(trace) => {
                prop_assert!(profile == Profile::Hertz, "{all:?}");
                prop_assert!(trace.error.iter().all(|v| v.is_finite()), "{all:?}");
                let mut finite = true;
                let done = trace.for_each_cell(width, count, |_, cell| {
                    finite &= cell.iter().flatten().all(|v| v.is_finite());
                });
                prop_assert!(finite, "{all:?}");
                prop_assert!(done.is_ok() || !(1e-20..=1e20).contains(&width), "{done:?}");
            }
            Err(DomainError::HertzOnly { .. }) => prop_assert!(profile != Profile::Hertz),
            Err(error) => prop_assert!(names(&error, &all)),
        }
    }

}

proptest! {
    // a response takes a millisecond to prepare
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))), ..ProptestConfig::default() })]

    #[test]
    fn surface_responses_are_finite(t in any_number(), medium in any_medium()) {
        for deflection in [Deflection::Centre, Deflection::Mean] {
            let response = SurfaceResponse::new(&medium, deflection);
            let found = [response.step(t), response.impulse(t), response.step_integral(t)];
            if t.is_nan() {
                prop_assert!(found.iter().all(|v| v.is_nan()));
                continue;
            }
            prop_assert!((-1e-12..=1.0 + 1e-12).contains(&found[0]), "step {t:e}");
            prop_assert!(found[1].is_finite(), "impulse {t:e}");
            prop_assert!(found[2].is_finite() || t.is_infinite(), "integral {t:e}");
        }
        let centre = kausel::centre_step(&medium, t);
        prop_assert!(centre.is_finite() || t.is_nan() && centre.is_nan(), "centre {t:e}");
    }
}

/// The exact coincidences of decimal fractions: fronts, edges and their sums meet to the last bit.
#[test]
fn round_numbers_give_finite_fields() {
    let mut count = 0;
    for profile in PROFILES {
        for nu in [0.0, 0.25, 0.3, 1.0 / 3.0] {
            let medium = Medium::new(nu).unwrap();
            let kernel = Kernel::new(&medium, profile, 1e-10).unwrap();
            for i in 0..=16 {
                for z in [0.0, 0.25, 0.5, 1.0, 2.0, 3.75] {
                    let r = 0.25 * f64::from(i);
                    if kernel.static_field(r, z).is_err() {
                        continue;
                    }
                    let arrivals = Arrivals::new(&medium, profile, r, z).unwrap().sorted();
                    let neighbours = arrivals
                        .iter()
                        .flat_map(|a| [a.next_down(), *a, a.next_up()]);
                    let grid = (0..60).map(|j| 0.125 * f64::from(j));
                    for t in neighbours.chain(grid).filter(|t| *t >= 0.0) {
                        count += 1;
                        let found = [
                            kernel.remainder(r, z, t).unwrap(),
                            kernel.step_integral(r, z, t).unwrap(),
                        ];
                        assert!(
                            found.iter().all(sound),
                            "{profile:?} nu {nu} r {r} z {z} t {t}: {found:?}"
                        );
                    }
                }
            }
        }
    }
    println!("{count} points");
}

/// Huge but legal arguments: finite, and tending to the static field or to nothing.
/// Depths whose root is far above the time: the tolerance must not ask for more digits than a double has.
#[test]
fn tiny_depths_and_times_are_answered() {
    let kernel = Kernel::new(&Medium::new(0.3).unwrap(), Profile::Hertz, 1e-10).unwrap();
    for z in [5e-324, 1e-308, 1e-200, 1e-100, 1e-20] {
        for t in [5e-324, 1e-224, 1e-100, 1e-20, 1e-12] {
            let found = kernel.remainder(0.5, z, t).unwrap();
            assert!(sound(&found), "{z:e} {t:e}: {found:?}");
        }
    }
}

#[test]
fn huge_arguments_are_answered() {
    for profile in PROFILES {
        let kernel = Kernel::new(&Medium::new(0.3).unwrap(), profile, 1e-10).unwrap();
        for large in [1e6, 1e12] {
            for (r, z, t) in [
                (large, 0.5, 1.0),
                (0.5, large, 1.0),
                (0.5, 0.5, large),
                (large, large, large),
                (large, 0.5, 1.3 * large),
                (0.5, large, 1.3 * large),
                (large, large, 1.3 * large),
                (large, large, 2.0 * large),
                (large, large, 9.0 * large),
            ] {
                let rest = kernel.static_field(r, z).unwrap();
                let found = kernel.remainder(r, z, t).unwrap();
                assert!(sound(&found), "{profile:?} {r:e} {z:e} {t:e}: {found:?}");
                if t < kernel_first(profile, r, z) {
                    assert_eq!(found.value, rest.map(|s| -s));
                }
            }
        }
    }
}

fn kernel_first(profile: Profile, r: f64, z: f64) -> f64 {
    Arrivals::new(&Medium::new(0.3).unwrap(), profile, r, z)
        .unwrap()
        .first()
}
