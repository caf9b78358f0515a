//! The impulse response is the slope of the step response between fronts.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::{Arrivals, Kernel, Medium, Profile};

/// Slopes of the step response at a time by differences to fourth order.
fn slopes(kernel: &Kernel, [r, z]: [f64; 2], t: f64) -> [f64; 6] {
    const H: f64 = 1e-4;
    let at = |steps: f64| kernel.remainder(r, z, t + steps * H).unwrap().value;
    let [far, near] = [2.0, 1.0].map(|steps| [at(-steps), at(steps)]);
    std::array::from_fn(|f| (8.0 * (near[1][f] - near[0][f]) - far[1][f] + far[0][f]) / (12.0 * H))
}

#[test]
fn the_impulse_is_the_slope_of_the_step_response() {
    for nu in [-0.3, 0.0, 0.25, 0.3, 0.45] {
        let medium = Medium::new(nu).unwrap();
        let kernel = Kernel::new(&medium, Profile::Hertz, 1e-12).unwrap();
        for (r, z) in [
            (0.0, 0.8),
            (0.01, 0.8),
            (0.5, 0.3),
            (1.0, 0.7),
            (1.7, 0.0),
            (2.4, 1.9),
            (0.4, 5.0),
        ] {
            let arrivals = Arrivals::new(&medium, Profile::Hertz, r, z).unwrap();
            let mut checked = 0;
            for i in 1..80 {
                let t = 0.193 * f64::from(i);
                if arrivals.sorted().iter().any(|a| (a - t).abs() < 0.05) {
                    continue;
                }
                checked += 1;
                let impulse = kernel.impulse(r, z, t).unwrap();
                for (f, slope) in slopes(&kernel, [r, z], t).into_iter().enumerate() {
                    let gap = (slope - impulse.value[f]).abs();
                    assert!(
                        gap < 2e-6,
                        "nu {nu} r {r} z {z} t {t} field {f}: {slope} {}",
                        impulse.value[f]
                    );
                }
            }
            assert!(checked > 40, "only {checked} times clear of fronts");
        }
    }
}

#[test]
fn the_impulse_of_displacements_is_their_slope_under_any_profile() {
    for nu in [-0.3, 0.0, 0.25, 0.3, 0.45] {
        let medium = Medium::new(nu).unwrap();
        for profile in [Profile::Hertz, Profile::Punch, Profile::Point] {
            let kernel = Kernel::new(&medium, profile, 1e-12).unwrap();
            for (r, z) in [
                (0.0, 0.8),
                (0.01, 0.8),
                (0.5, 0.3),
                (1.0, 0.7),
                (1.7, 0.1),
                (2.4, 1.9),
                (9.0, 0.4),
                (40.0, 30.0),
            ] {
                let arrivals = Arrivals::new(&medium, profile, r, z).unwrap();
                let (mut checked, last) = (0, arrivals.sorted()[arrivals.sorted().len() - 1]);
                for i in 1..80 {
                    let t = 0.02 * f64::from(i) * last;
                    if arrivals.sorted().iter().any(|a| (a - t).abs() < 0.05) {
                        continue;
                    }
                    checked += 1;
                    let found = kernel.displacement_impulse(r, z, t).unwrap();
                    let slopes = slopes(&kernel, [r, z], t);
                    for (f, (found, slope)) in found.into_iter().zip(slopes).enumerate() {
                        // the differences show the noise of steps that are continued to the axis, or of a point force
                        let noisy = r < 0.05 || profile == Profile::Point;
                        let noise = if noisy { 1e-5 } else { 2e-7 };
                        assert!(
                            (slope - found).abs() < noise * (1.0 + 10.0 * slope.abs()),
                            "nu {nu} {profile:?} r {r} z {z} t {t} field {f}: {slope} {found}"
                        );
                    }
                }
                assert!(checked > 40, "only {checked} times clear of fronts");
            }
        }
    }
}

#[test]
fn other_profiles_are_refused() {
    let medium = Medium::new(0.3).unwrap();
    for profile in [Profile::Punch, Profile::Point] {
        let kernel = Kernel::new(&medium, profile, 1e-8).unwrap();
        let message = kernel.impulse(0.5, 0.5, 2.0).unwrap_err().to_string();
        assert_eq!(
            message,
            format!(
                "the impulse response is defined for the Hertz profile only, not for {profile:?}"
            )
        );
    }
}

/// Shorter times than 1e-20 are taken as that: what follows would be rounding, whose error overflows.
#[test]
fn times_too_short_to_tell_apart_give_the_same() {
    let medium = Medium::new(0.3).unwrap();
    let kernel = Kernel::new(&medium, Profile::Hertz, 1e-10).unwrap();
    for (r, z) in [(0.5, 0.0), (0.3, 1e-12), (0.0, 0.0)] {
        let [short, shorter] = [1e-20, 1e-86].map(|t| kernel.impulse(r, z, t).unwrap());
        assert_eq!(short.value, shorter.value);
        assert!(
            shorter
                .error
                .iter()
                .chain(&shorter.value)
                .all(|x| x.is_finite())
        );
    }
}
