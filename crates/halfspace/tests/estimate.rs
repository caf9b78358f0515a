//! The error that a kernel states against the error that it has, measured against tolerance 1e-13.
//!
//! `cargo test -p hertzlamb-halfspace --test estimate -- --nocapture` prints both.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod support;

use halfspace::random::Stream;
use halfspace::{Arrivals, Kernel, Medium, Profile};
use support::{heading, line};

const COUNT: usize = 12000;

const RATIOS: [f64; 6] = [-0.5, 0.0, 0.25, 0.263_082_06, 0.3, 0.4999];

/// Any place, far ones, the axis, the surface, below the edge, just below the surface, and close to an arrival.
fn point(random: &mut Stream, i: usize) -> (Medium, f64, f64, f64) {
    let nu = if i % 12 < 6 {
        RATIOS[i % 6]
    } else {
        random.within(-0.5, 0.499)
    };
    let medium = Medium::new(nu).unwrap();
    let (r, z) = (random.within(0.0, 6.0), random.within(0.0, 6.0));
    let (r, z) = match i % 7 {
        1 => (20.0 * r / 6.0, 20.0 * z / 6.0),
        2 => (0.0, z),
        3 => (r, 0.0),
        4 => (1.0, z),
        5 => (r, 10.0_f64.powf(random.within(-9.0, -3.0))),
        _ => (r, z),
    };
    let arrivals = Arrivals::new(&medium, Profile::Hertz, r, z).unwrap();
    let times = arrivals.sorted();
    let t = if i % 7 == 6 {
        let gap = 10.0_f64.powf(random.within(-12.0, -2.0));
        let front = times[(random.next() * times.len() as f64) as usize];
        front * (1.0 + random.within(-1.0, 1.0) * gap)
    } else if i.is_multiple_of(2) {
        random.within(arrivals.first(), 1.2 * arrivals.last())
    } else {
        arrivals.first() + random.within(0.0, 20.0)
    };
    (medium, r, z, t)
}

/// A stretch of the domain where a load other than Hertz's is hard.
#[derive(Debug, Clone, Copy)]
enum Region {
    /// Anywhere to 6.
    Any,
    /// r < 0.01 r0, down to 1e-9.
    NearAxis,
    Surface,
    /// Depths from 1e-9 to 1e-2 of the radius.
    Shallow,
    /// 1e-9 to 0.1 from the edge of the disc, depths 1e-9 to 1, and on the surface.
    NearEdge,
}

fn point_in(region: Region, profile: Profile, random: &mut Stream, i: usize) -> (Kernel, [f64; 3]) {
    let nu = if i % 12 < 6 {
        RATIOS[i % 6]
    } else {
        random.within(-0.5, 0.499)
    };
    let (r, z) = (random.within(0.0, 6.0), random.within(0.0, 6.0));
    let mut power = |from, to| 10.0_f64.powf(random.within(from, to));
    let (r, z) = match region {
        Region::Any => (r, z),
        Region::NearAxis => (r * power(-9.0, -2.0), z),
        Region::Surface => (r, 0.0),
        Region::Shallow => (r, r * power(-9.0, -2.0)),
        Region::NearEdge => {
            let side = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
            let depth = if i.is_multiple_of(3) {
                0.0
            } else {
                power(-9.0, 0.0)
            };
            (1.0 + side * power(-9.0, -1.0), depth)
        }
    };
    let medium = Medium::new(nu).unwrap();
    let arrivals = Arrivals::new(&medium, profile, r, z).unwrap();
    let times = arrivals.sorted();
    let t = if i % 7 == 6 {
        let gap = 10.0_f64.powf(random.within(-12.0, -2.0));
        let front = times[(random.next() * times.len() as f64) as usize];
        front * (1.0 + random.within(-1.0, 1.0) * gap)
    } else if i.is_multiple_of(2) {
        random.within(arrivals.first(), 1.2 * arrivals.last())
    } else {
        arrivals.first() + random.within(0.0, 20.0)
    };
    (Kernel::new(&medium, profile, 1e-13).unwrap(), [r, z, t])
}

/// Stresses of these loads are infinite at fronts, so errors are in units of the static field, median and quantiles.
#[test]
fn one_error_in_a_thousand_exceeds_its_estimate_for_a_punch_and_a_point() {
    use Region::{Any, NearAxis, NearEdge, Shallow, Surface};
    const POINTS: usize = 2000;
    const SEEDS: [u64; 3] = [5, 77, 2026];
    for (profile, region) in [
        (Profile::Punch, Any),
        (Profile::Punch, Surface),
        (Profile::Punch, Shallow),
        (Profile::Punch, NearEdge),
        (Profile::Point, Any),
        (Profile::Point, NearAxis),
        (Profile::Point, Surface),
        (Profile::Point, Shallow),
    ] {
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let (mut caution, mut relative, mut exceeding) = (vec![], [vec![], vec![]], 0);
            let mut streams = SEEDS.map(Stream::new);
            for i in 0..SEEDS.len() * POINTS {
                let random = &mut streams[i % SEEDS.len()];
                let (fine, [r, z, t]) = point_in(region, profile, random, i);
                let kernel = Kernel::new(fine.medium(), profile, tolerance).unwrap();
                let rest = fine.static_field(r, z).unwrap();
                let exact = fine.remainder(r, z, t).unwrap();
                let found = kernel.remainder(r, z, t).unwrap();
                for f in 0..6 {
                    let observed = (found.value[f] - exact.value[f]).abs();
                    exceeding += usize::from(observed > found.error[f]);
                    if observed > 0.0 {
                        caution.push(found.error[f] / observed);
                        let size = rest[f].abs() + exact.value[f].abs();
                        relative[usize::from(f > 1)].push(observed / size);
                    }
                }
            }
            let fraction = exceeding as f64 / (6 * SEEDS.len() * POINTS) as f64;
            heading(&format!(
                "{profile:?} {region:?}, tolerance {tolerance:e}: {exceeding} of {} errors exceed their estimate",
                6 * SEEDS.len() * POINTS
            ));
            line("estimate / error", &caution);
            line("displacement, error/size", &relative[0]);
            line("stress, error/size", &relative[1]);
            assert!(
                fraction <= 1e-3,
                "{profile:?} {region:?} {tolerance:e}: {fraction}"
            );
        }
    }
}

#[test]
fn one_error_in_a_thousand_exceeds_its_estimate() {
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let mut streams = [99, 3, 41].map(Stream::new);
        let (mut caution, mut exceeding, mut total) = (vec![], 0, 0);
        for i in 0..COUNT {
            let (medium, r, z, t) = point(&mut streams[i % 3], i);
            let [exact, kernel] = [1e-13, tolerance].map(|tolerance| {
                let kernel = Kernel::new(&medium, Profile::Hertz, tolerance).unwrap();
                kernel.remainder(r, z, t).unwrap()
            });
            for f in 0..6 {
                let observed = (kernel.value[f] - exact.value[f]).abs();
                total += 1;
                exceeding += usize::from(observed > kernel.error[f]);
                if observed > 0.0 {
                    caution.push(kernel.error[f] / observed);
                }
            }
        }
        let fraction = exceeding as f64 / total as f64;
        heading(&format!(
            "tolerance {tolerance:e}: {exceeding} of {total} errors exceed their estimate"
        ));
        let caution = line("estimate / error", &caution);
        assert!(fraction < 1e-3, "tolerance {tolerance:e}: {fraction}");
        assert!(
            (10.0..200.0).contains(&caution.p50),
            "tolerance {tolerance:e}: {caution}"
        );
    }
}
