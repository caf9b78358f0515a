//! Averages and moments of cells against quadrature of the remainder.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::{Arrivals, Kernel, Medium, Profile, Six};

#[test]
fn averages_and_moments_are_those_of_the_remainder() {
    // Gauss-Legendre with 5 nodes on cells that hold no arrival
    let nodes = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683, 0.478_628_670_499_366_5),
        (-0.538_469_310_105_683, 0.478_628_670_499_366_5),
        (0.906_179_845_938_664, 0.236_926_885_056_189_1),
        (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    ];
    for (nu, r, z) in [
        (0.3, 0.4, 0.6),
        (0.25, 1.0, 0.3),
        (0.1, 2.3, 1.1),
        (0.45, 0.0, 2.0),
        (0.3, 3.0, 0.0),
    ] {
        let medium = Medium::new(nu).unwrap();
        let kernel = Kernel::new(&medium, Profile::Hertz, 1e-11).unwrap();
        let arrivals = Arrivals::new(&medium, Profile::Hertz, r, z)
            .unwrap()
            .sorted();
        let width = 0.05;
        let mut cells = vec![[Six::default(); 3]; 400];
        let trace = kernel.trace(r, z, 400.0 * width).unwrap();
        let done = trace.for_each_cell(width, 400, |j, cell| cells[j] = cell);
        done.unwrap();
        let mut checked = 0;
        for (j, cell) in cells.iter().enumerate() {
            let (from, to) = (j as f64 * width, (j + 1) as f64 * width);
            if arrivals
                .iter()
                .any(|a| *a > from - 4.0 * width && *a < to + 4.0 * width)
            {
                continue;
            }
            checked += 1;
            let mut sums = [Six::default(); 3];
            for (x, w) in nodes {
                let s = 0.5 * x;
                let time = from + width * (0.5 + s);
                let value = kernel.remainder(r, z, time).unwrap().value;
                for (sum, power) in sums.iter_mut().zip([1.0, s, s * s - 1.0 / 12.0]) {
                    for (sum, value) in sum.iter_mut().zip(value) {
                        *sum += 0.5 * w * power * value;
                    }
                }
            }
            let found = cell.as_flattened().iter().zip(sums.as_flattened());
            for (i, (found, sum)) in found.enumerate() {
                let gap = (found - sum).abs();
                let (moment, f) = (i / 6, i % 6);
                assert!(
                    gap < 2e-9,
                    "nu {nu} r {r} z {z} cell {j} moment {moment} field {f}: {found} {sum}"
                );
            }
        }
        assert!(checked > 100, "only {checked} cells clear of arrivals");
    }
}
