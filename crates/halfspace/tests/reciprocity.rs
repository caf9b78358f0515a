//! Betti's reciprocal theorem in time: two loads on the surface do the same work on each other's displacements.
//!
//! ```text
//! int p_1(r) w_2(r, 0, t) 2 pi r dr = int p_2(r) w_1(r, 0, t) 2 pi r dr
//! ```
//!
//! The two sides come from different closed forms, those of the Hertz and of the punch profile.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod support;

use halfspace::gauss::rule;
use halfspace::{Deflection, Field, Kernel, Medium, Profile, SurfaceResponse};
use support::line;

const W: usize = Field::DisplacementZ.index();

/// Mean of w(r, 0, t) of `kernel` over the disc, weighted by the pressure of `profile`, and of its error estimate.
///
/// r = sqrt(1 - s^2) turns the load p 2 pi r dr into 3 s^2 ds for Hertz's pressure and ds for that of a punch. The fronts
/// of the edge at c t = 1 +- r are kinks of w; s is split there.
fn work(kernel: &Kernel, profile: Profile, t: f64) -> [f64; 2] {
    let medium = kernel.medium();
    // halves toward the axis, where the fronts of opposite edges meet
    let mut cuts: Vec<f64> = (0..14).map(|j| 1.0 - 0.5_f64.powi(j)).collect();
    cuts.push(1.0);
    for speed in [1.0, medium.kappa(), medium.rayleigh_speed()] {
        let r = (1.0 - speed * t).abs();
        if r < 1.0 {
            cuts.push((1.0 - r * r).sqrt());
        }
    }
    cuts.sort_by(f64::total_cmp);
    let mut sum = [0.0; 2];
    for pair in cuts.windows(2) {
        let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        for (x, weight) in rule(40).on(-1.0, 1.0) {
            // flat at both ends, where the fronts leave roots and logarithms
            let q = x * x;
            let s = middle + half * x * (35.0 - q * (35.0 - q * (21.0 - 5.0 * q))) / 16.0;
            let slope = half * 35.0 / 16.0 * (1.0 - q).powi(3);
            // the edge itself, infinite pressure of the punch, is left out by one unit in the last place
            let r = ((1.0 - s) * (1.0 + s)).sqrt().min(1.0_f64.next_down());
            let load = match profile {
                Profile::Hertz => 3.0 * s * s,
                Profile::Punch => 1.0,
                Profile::Point => panic!("a point force is no load on a disc"),
            };
            let rest = kernel.static_field(r, 0.0).unwrap()[W];
            let found = kernel.remainder(r, 0.0, t).unwrap();
            sum[0] += weight * slope * load * (rest + found.value[W]);
            sum[1] += weight * slope * load * found.error[W];
        }
    }
    sum
}

/// Near the axis a punch is continued from larger radii, which a front nearby leaves no room: the estimate says so, and
/// elsewhere the two works agree to rounding.
#[test]
fn two_loads_do_the_same_work_on_each_other() {
    for nu in [-0.4, 0.0, 0.25, 0.3, 0.45] {
        let medium = Medium::new(nu).unwrap();
        let [hertz, punch] =
            [Profile::Hertz, Profile::Punch].map(|p| Kernel::new(&medium, p, 1e-12).unwrap());
        let mut gaps = vec![];
        for i in 1..=25 {
            let t = 0.17 * f64::from(i);
            // a front within the radius of continuation: no accuracy is promised there
            let speeds = [1.0, medium.kappa(), medium.rayleigh_speed()];
            if speeds.iter().any(|c| (c * t - 1.0).abs() < 0.05) {
                continue;
            }
            let [one, one_error] = work(&hertz, Profile::Punch, t);
            let [other, other_error] = work(&punch, Profile::Hertz, t);
            let gap = (one - other).abs() / one;
            assert!(
                gap < 1e-11 + (one_error + other_error) / one,
                "nu {nu} t {t}: {gap:e}"
            );
            gaps.push(gap);
        }
        let found = line(&format!("nu {nu}"), &gaps);
        assert!(found.p50 < 1e-12, "nu {nu}: {found}");
    }
}

/// The work of a load on its own displacement is the mean deflection that the impact equation uses.
#[test]
fn a_load_does_the_work_of_the_mean_deflection() {
    for nu in [-0.4, 0.0, 0.25, 0.3, 0.45] {
        let medium = Medium::new(nu).unwrap();
        let kernel = Kernel::new(&medium, Profile::Hertz, 1e-12).unwrap();
        let mean = SurfaceResponse::new(&medium, Deflection::Mean);
        let mut worst = 0.0_f64;
        for i in 1..=25 {
            let t = 0.17 * f64::from(i);
            let expected = mean.disc.static_compliance * mean.step(t);
            worst = worst.max((work(&kernel, Profile::Hertz, t)[0] - expected).abs());
        }
        println!("nu {nu}: {worst:.1e}");
        assert!(worst < 1e-12, "nu {nu}: {worst:e}");
    }
}
