//! Facts of physics that the kernels satisfy without knowing them, at random points.
//!
//! `cargo test -p hertzlamb-halfspace --test identities -- --nocapture` prints what is measured.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod support;

use halfspace::random::Stream;
use halfspace::{Arrivals, FIELDS, Kernel, Medium, Profile, Six};
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use support::{NAMES, heading, line, peaks, step};

const PROFILES: [Profile; 3] = [Profile::Hertz, Profile::Punch, Profile::Point];

fn kernel(nu: f64, profile: Profile, tolerance: f64) -> Kernel {
    Kernel::new(&Medium::new(nu).unwrap(), profile, tolerance).unwrap()
}

fn arrivals(kernel: &Kernel, r: f64, z: f64) -> Arrivals {
    Arrivals::new(kernel.medium(), kernel.profile(), r, z).unwrap()
}

fn any_profile() -> impl Strategy<Value = Profile> {
    prop::sample::select(PROFILES.to_vec())
}

/// Distance in time from the nearest arrival.
fn gap(kernel: &Kernel, r: f64, z: f64, t: f64) -> f64 {
    let all = arrivals(kernel, r, z).sorted();
    all.iter().map(|a| (a - t).abs()).fold(f64::MAX, f64::min)
}

/// Central difference of fourth order.
fn slope(h: f64, f: impl Fn(f64) -> Six) -> Six {
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| f(k * h));
    std::array::from_fn(|i| ((a[i] - d[i]) + 8.0 * (c[i] - b[i])) / (12.0 * h))
}

/// Second difference of fourth order.
fn curvature(h: f64, f: impl Fn(f64) -> Six) -> Six {
    let [a, b, c, d, e] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| f(k * h));
    std::array::from_fn(|i| (16.0 * (b[i] + d[i]) - a[i] - e[i] - 30.0 * c[i]) / (12.0 * h * h))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, max_global_rejects: 20_000, failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))), ..ProptestConfig::default() })]

    #[test]
    fn nothing_moves_before_the_first_arrival(
        nu in -0.5..0.499_f64, profile in any_profile(), r in 0.0..20.0_f64, z in 1e-6..20.0_f64, part in 0.0..1.0_f64,
    ) {
        let kernel = kernel(nu, profile, 1e-10);
        let t = part * arrivals(&kernel, r, z).first();
        let total = step(&kernel, r, z, t);
        prop_assert_eq!(total, Six::default());
    }

    /// The integral itself is causal too: before the first arrival the Rayleigh wave, the spectrum and the
    /// static field cancel, which `step_integral` does not impose after it.
    #[test]
    fn the_response_starts_from_nothing(
        nu in -0.5..0.49_f64, r in 0.0..5.0_f64, z in 0.1..5.0_f64,
    ) {
        let kernel = kernel(nu, Profile::Hertz, 1e-10);
        let first = arrivals(&kernel, r, z).first();
        let second = arrivals(&kernel, r, z).sorted()[1];
        prop_assume!(r > 1.1 && second - first > 1e-3);
        // just after the front of an edge a field is small: it starts as a power of the time since
        let total = step(&kernel, r, z, first + 1e-6 * (second - first));
        let peak = peaks(&kernel, r, z, &[]);
        for f in 0..6 {
            prop_assert!(total[f].abs() < 1e-3 * peak[f] + 1e-12, "{}: {:e} of {:e}", NAMES[f], total[f], peak[f]);
        }
    }

    #[test]
    fn the_surface_is_exactly_static_after_the_last_rayleigh_wave(
        nu in -0.5..0.499_f64, profile in any_profile(), r in 0.01..20.0_f64, later in 1e-6..3.0_f64,
    ) {
        prop_assume!((r - 1.0).abs() > 1e-3);
        let kernel = kernel(nu, profile, 1e-10);
        let last = (r + profile.radius()) / kernel.medium().rayleigh_speed();
        let value = kernel.remainder(r, 0.0, last * (1.0 + later)).unwrap().value[1];
        let rest = kernel.static_field(r, 0.0).unwrap()[1];
        prop_assert!(value.abs() < 1e-12 * rest + 1e-15, "{value:e} of {rest:e}");
    }

    #[test]
    fn the_surface_carries_the_load_and_no_shear(
        nu in -0.5..0.499_f64, profile in any_profile(), r in 0.0..5.0_f64, t in 0.0..20.0_f64,
    ) {
        prop_assume!((r - 1.0).abs() > 1e-3 && r > 1e-3);
        let kernel = kernel(nu, profile, 1e-10);
        let on = step(&kernel, r, 0.0, t.max(1e-3));
        prop_assert_eq!(on[4], -profile.pressure(r));
        prop_assert_eq!(on[5], 0.0);
        // on the surface that is imposed; just below it is not
        if profile == Profile::Hertz && gap(&kernel, r, 0.0, t) > 1e-2 {
            let below = step(&kernel, r, 1e-12, t.max(1e-3));
            prop_assert!((below[4] + profile.pressure(r)).abs() < 1e-9, "szz {:e}", below[4]);
            prop_assert!(below[5].abs() < 1e-9, "srz {:e}", below[5]);
        }
    }

    /// Hooke's law by differences of the displacements, with mu = 1.
    #[test]
    fn stresses_follow_from_displacements(
        nu in -0.4..0.45_f64, profile in any_profile(), r in 0.2..5.0_f64, z in 0.3..5.0_f64, t in 0.3..15.0_f64,
    ) {
        const H: f64 = 4e-3;
        let kernel = kernel(nu, profile, 1e-12);
        prop_assume!(gap(&kernel, r, z, t) > 0.15 && t > arrivals(&kernel, r, z).first());
        let here = step(&kernel, r, z, t);
        let along_r = slope(H, |d| step(&kernel, r + d, z, t));
        let along_z = slope(H, |d| step(&kernel, r, z + d, t));
        let lame = kernel.medium().lambda_over_mu();
        let spread = lame * (along_r[0] + here[0] / r + along_z[1]);
        let hooke = [
            spread + 2.0 * along_r[0],
            spread + 2.0 * here[0] / r,
            spread + 2.0 * along_z[1],
            along_z[0] + along_r[1],
        ];
        let size = here[2..].iter().map(|v| v.abs()).fold(1e-3, f64::max);
        // a point force is less accurate: see point_load.rs
        let bound = if profile == Profile::Point { 1e-4 } else { 3e-6 };
        for f in 0..4 {
            let error = (here[2 + f] - hooke[f]).abs();
            prop_assert!(error < bound * size, "{profile:?} {}: {:e} {:e}", NAMES[2 + f], here[2 + f], hooke[f]);
        }
    }

    /// (1): the divergence of stress is density times acceleration; rho = (lambda + 2 mu)/c1^2 = 1/kappa^2.
    #[test]
    fn the_equations_of_motion_hold(
        nu in -0.4..0.45_f64, inside in any::<bool>(), r in 0.2..5.0_f64, z in 0.3..5.0_f64, t in 0.3..15.0_f64,
    ) {
        const H: f64 = 1e-2;
        let profile = if inside { Profile::Hertz } else { Profile::Punch };
        let kernel = kernel(nu, profile, 1e-13);
        prop_assume!(gap(&kernel, r, z, t) > 0.2 && t > arrivals(&kernel, r, z).first());
        let here = step(&kernel, r, z, t);
        let along_r = slope(H, |d| step(&kernel, r + d, z, t));
        let along_z = slope(H, |d| step(&kernel, r, z + d, t));
        let acceleration = curvature(H, |d| step(&kernel, r, z, t + d));
        let density = kernel.medium().kappa().powi(-2);
        let radial = [along_r[2], along_z[5], (here[2] - here[3]) / r, -density * acceleration[0]];
        let vertical = [along_r[5], along_z[4], here[5] / r, -density * acceleration[1]];
        for terms in [radial, vertical] {
            let size: f64 = terms.iter().map(|v| v.abs()).sum();
            let sum: f64 = terms.iter().sum();
            prop_assert!(sum.abs() < 3e-5 * size + 3e-6 * density, "{profile:?} {sum:e} of {terms:?}");
        }
    }
}

/// The remainder dies as t^-2, the stresses on planes parallel to the surface as t^-4.
#[test]
fn the_remainder_decays() {
    println!("\nlog2 of R(t)/R(2 t) at 32 and 128 times the last arrival");
    for profile in PROFILES {
        for (nu, r, z) in [
            (0.3, 0.5, 0.8),
            (0.0, 2.0, 0.0),
            (0.45, 4.0, 3.0),
            (-0.4, 0.3, 5.0),
        ] {
            let kernel = kernel(nu, profile, 1e-13);
            let last = arrivals(&kernel, r, z).last();
            let at = |factor: f64| kernel.remainder(r, z, factor * last).unwrap();
            let [a, b, c, d] = [32.0, 64.0, 128.0, 256.0].map(at);
            let mut text = String::new();
            for (f, name) in NAMES.iter().enumerate() {
                // a power of 1/t is seen where there is more than rounding
                if a.value[f].abs() < 1e-12 || d.value[f].abs() < 1e-13 {
                    text += &format!(" {}: {:.0e} ", name, d.value[f]);
                    continue;
                }
                let early = (a.value[f] / b.value[f]).abs().log2();
                let late = (c.value[f] / d.value[f]).abs().log2();
                text += &format!(" {name}: {early:.3} {late:.3}");
                // sigma_zz and sigma_rz lose the first term of the series
                let order = if f < 4 { 2.0 } else { 4.0 };
                assert!(
                    (late - order).abs() < 0.05,
                    "{profile:?} nu {nu} r {r} z {z} {name}"
                );
            }
            println!("{profile:?} nu {nu} r {r} z {z}: {text}");
        }
    }
}

/// Far from a disc only the force counts: the error against a point force falls as the square of the distance.
#[test]
fn a_distant_disc_is_a_point() {
    let mut random = Stream::new(3);
    let distances = [30.0, 300.0, 3000.0];
    for profile in [Profile::Hertz, Profile::Punch] {
        let mut errors = distances.map(|_| [vec![], vec![]]);
        for _ in 0..100 {
            let nu = random.within(-0.4, 0.45);
            let (disc, point) = (
                kernel(nu, profile, 1e-12),
                kernel(nu, Profile::Point, 1e-12),
            );
            let (r, z) = (random.within(0.2, 1.0), random.within(0.2, 1.0));
            let t = random.within(0.8, 4.0) * r.hypot(z);
            if gap(&point, r, z, t) < 0.25 {
                continue;
            }
            let limit = step(&point, r, z, t);
            for (distance, errors) in distances.iter().zip(&mut errors) {
                let found = step(&disc, distance * r, distance * z, distance * t);
                for (group, fields) in [0..2, 2..6].into_iter().enumerate() {
                    let size = fields.clone().map(|f| limit[f].abs()).fold(1e-3, f64::max);
                    let power = distance.powi(group as i32 + 1);
                    let error = fields.map(|f| (power * found[f] - limit[f]).abs());
                    errors[group].push(error.fold(0.0, f64::max) / size);
                }
            }
        }
        heading(&format!("{profile:?} at a distance against a point force"));
        for (group, name) in ["displacement", "stress"].iter().enumerate() {
            let found =
                [0, 1, 2].map(|i| line(&format!("{name} at {}", distances[i]), &errors[i][group]));
            let order = (found[0].p50 / found[1].p50).log10();
            assert!((order - 2.0).abs() < 0.1, "{name}: observed order {order}");
            assert!(
                found[2].p90 < if group == 0 { 1e-5 } else { 1e-4 },
                "{name}: {}",
                found[2]
            );
        }
    }
}

/// Errors fall with the tolerance, and by about as much.
#[test]
fn accuracy_follows_the_tolerance() {
    let tolerances = [1e-4, 1e-6, 1e-8, 1e-10];
    for profile in [Profile::Hertz, Profile::Punch] {
        let mut random = Stream::new(11);
        let mut errors = tolerances.map(|_| vec![]);
        for _ in 0..60 {
            let medium = Medium::new(random.within(-0.5, 0.49)).unwrap();
            let [exact, rough] =
                [1e-13, 1e-4].map(|tol| Kernel::new(&medium, profile, tol).unwrap());
            let kernels = tolerances.map(|tol| Kernel::new(&medium, profile, tol).unwrap());
            let (r, z) = (random.within(0.0, 6.0), random.within(0.0, 6.0));
            let peak = peaks(&rough, r, z, &[]);
            for _ in 0..10 {
                let t = random.within(0.0, 20.0);
                let best = exact.remainder(r, z, t).unwrap().value;
                for (kernel, errors) in kernels.iter().zip(&mut errors) {
                    let value = kernel.remainder(r, z, t).unwrap().value;
                    for f in 0..FIELDS.len() {
                        errors.push((value[f] - best[f]).abs() / peak[f]);
                    }
                }
            }
        }
        heading(&format!(
            "{profile:?}: error against tolerance 1e-13, relative to the peak"
        ));
        let found: Vec<_> = tolerances
            .iter()
            .zip(&errors)
            .map(|(tol, e)| line(&format!("tolerance {tol:e}"), e))
            .collect();
        for (tol, q) in tolerances.iter().zip(&found) {
            assert!(q.p99 < *tol, "{profile:?} at {tol:e}: {q}");
        }
        for pair in found.windows(2) {
            assert!(
                pair[1].p90 < 0.1 * pair[0].p90 && pair[1].p99 < 0.1 * pair[0].p99,
                "{pair:?}"
            );
        }
    }
}

/// Under the disc the plane longitudinal front arrives as the jump sigma_zz = -Z(r), sigma_rr = nu/(1 - nu) sigma_zz,
/// to the last bit of the time: nothing at t = z, the whole of it one unit in the last place later.
#[test]
fn the_plane_front_is_a_sharp_jump() {
    let mut random = Stream::new(17);
    for _ in 0..300 {
        let nu = random.within(-0.5, 0.499);
        let kernel = kernel(nu, Profile::Hertz, 1e-10);
        let (r, z) = (random.within(0.0, 0.95), random.within(0.05, 20.0));
        assert_eq!(step(&kernel, r, z, z), Six::default());
        let jump = -Profile::Hertz.pressure(r);
        let lateral = nu / (1.0 - nu) * jump;
        for t in [z.next_up(), z.next_up().next_up(), z * (1.0 + 1e-14)] {
            let found = step(&kernel, r, z, t);
            let expected = [0.0, 0.0, lateral, lateral, jump, 0.0];
            for f in 0..6 {
                let gap = (found[f] - expected[f]).abs();
                assert!(
                    gap < 1e-10,
                    "nu {nu} r {r} z {z} t {t} {}: {gap:e}",
                    NAMES[f]
                );
            }
        }
    }
}
