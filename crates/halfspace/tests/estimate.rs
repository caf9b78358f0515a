//! The error that a kernel states against the error that it has, measured against tolerance 1e-13.
//!
//! `cargo test -p hertzlamb-halfspace --test estimate -- --nocapture` prints both.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod support;

use halfspace::{Arrivals, Kernel, Medium, Profile};
use support::{Stream, heading, line};

const COUNT: usize = 6000;

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

#[test]
fn one_error_in_a_thousand_exceeds_its_estimate() {
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let mut random = Stream::new(99);
        let (mut caution, mut exceeding, mut total) = (vec![], 0, 0);
        for i in 0..COUNT {
            let (medium, r, z, t) = point(&mut random, i);
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
        let share = exceeding as f64 / total as f64;
        heading(&format!(
            "tolerance {tolerance:e}: {exceeding} of {total} errors exceed their estimate"
        ));
        let caution = line("estimate / error", &caution);
        assert!(share < 1e-3, "tolerance {tolerance:e}: {share}");
        assert!(
            (10.0..200.0).contains(&caution.p50),
            "tolerance {tolerance:e}: {caution}"
        );
    }
}
