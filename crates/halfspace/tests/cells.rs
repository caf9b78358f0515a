//! Cell averages against quadrature of the remainder, and the tail against direct evaluation.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::{Arrivals, Kernel, Medium, Profile, Six};

#[test]
fn averages_are_averages_of_the_remainder() {
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
        let mut cells = vec![Six::default(); 400];
        kernel.cell_averages(r, z, width, &mut cells).unwrap();
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
            let mut mean = Six::default();
            for (x, w) in nodes {
                let value = kernel
                    .remainder(r, z, from + 0.5 * width * (1.0 + x))
                    .unwrap()
                    .value;
                for f in 0..6 {
                    mean[f] += 0.5 * w * value[f];
                }
            }
            for f in 0..6 {
                let gap = (cell[f] - mean[f]).abs();
                assert!(
                    gap < 2e-9,
                    "nu {nu} r {r} z {z} cell {j} field {f}: {} {}",
                    cell[f],
                    mean[f]
                );
            }
        }
        assert!(checked > 100, "only {checked} cells clear of arrivals");
    }
}

#[test]
fn the_tail_is_the_direct_value() {
    for nu in [-0.3, 0.0, 0.25, 0.3, 0.45] {
        let medium = Medium::new(nu).unwrap();
        let kernel = Kernel::new(&medium, Profile::Hertz, 1e-11).unwrap();
        for (r, z) in [
            (0.0, 0.3),
            (0.7, 0.0),
            (1.0, 1.5),
            (4.0, 0.2),
            (3.0, 5.0),
            (0.2, 6.0),
        ] {
            for (width, count) in [(0.1, 600), (2.0, 300)] {
                let mut cells = vec![Six::default(); count];
                let error = kernel.cell_averages(r, z, width, &mut cells).unwrap();
                for j in [count / 3, count / 2, count - 1] {
                    let at = |j: usize| kernel.step_integral(r, z, j as f64 * width).unwrap().value;
                    let (from, to) = (at(j), at(j + 1));
                    for f in 0..6 {
                        let direct = (to[f] - from[f]) / width;
                        let gap = (cells[j][f] - direct).abs();
                        assert!(
                            gap <= error[f] + 1e-12,
                            "nu {nu} r {r} z {z} cell {j} field {f}: {gap:e} {:e}",
                            error[f]
                        );
                        assert!(
                            gap < 1e-9,
                            "nu {nu} r {r} z {z} cell {j} field {f}: {gap:e}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn the_second_integral_is_the_integral_of_the_first() {
    let h = 1e-3;
    for nu in [-0.3, 0.0, 0.3, 0.45] {
        let medium = Medium::new(nu).unwrap();
        let kernel = Kernel::new(&medium, Profile::Hertz, 1e-12).unwrap();
        for (r, z) in [
            (0.0, 0.3),
            (0.02, 0.9),
            (0.7, 0.0),
            (1.0, 1.5),
            (4.0, 0.2),
            (3.0, 5.0),
        ] {
            for i in 1..120 {
                // also across fronts: the first integral is continuous, and the cells are short
                let t = 0.17 * f64::from(i);
                let at = |t: f64| kernel.second_integral(r, z, t).unwrap().value;
                let first = |t: f64| kernel.step_integral(r, z, t).unwrap().value;
                let (before, after) = (at(t - h), at(t + h));
                let (left, middle, right) = (first(t - h), first(t), first(t + h));
                for f in 0..6 {
                    let area = h / 3.0 * (left[f] + 4.0 * middle[f] + right[f]);
                    let gap = (after[f] - before[f] - area).abs();
                    assert!(
                        gap < 1e-6,
                        "nu {nu} r {r} z {z} t {t} field {f}: {gap:e} {} {area}",
                        after[f] - before[f]
                    );
                }
            }
        }
    }
}

/// Moments against int R dt sampled finely across the fronts: width^2 M = width (S_0 + S_1)/2 - int S dt.
#[test]
fn first_moments_of_cells() {
    let width = 0.1;
    for (nu, r, z) in [
        (0.3, 0.4, 0.7),
        (0.0, 2.0, 0.0),
        (0.45, 3.0, 1.5),
        (0.25, 0.0, 2.0),
    ] {
        let kernel = Kernel::new(&Medium::new(nu).unwrap(), Profile::Hertz, 1e-11).unwrap();
        let mut averages = vec![Six::default(); 120];
        let mut moments = averages.clone();
        kernel.cell_averages(r, z, width, &mut averages).unwrap();
        let floor = [1e-8; 6];
        kernel
            .cell_moments(r, z, width, &averages, &floor, &mut moments)
            .unwrap();
        let integral = |t: f64| kernel.step_integral(r, z, t).unwrap().value;
        let mut most = 0.0_f64;
        for (j, moment) in moments.iter().enumerate() {
            const PARTS: usize = 200;
            let at = |i: usize| integral((j as f64 + i as f64 / PARTS as f64) * width);
            let (start, end) = (at(0), at(PARTS));
            let mut area = Six::default();
            for i in 0..=PARTS {
                let weight = if i == 0 || i == PARTS { 0.5 } else { 1.0 } / PARTS as f64;
                for (a, s) in area.iter_mut().zip(at(i)) {
                    *a += weight * s;
                }
            }
            for f in 0..6 {
                let fine = (0.5 * (start[f] + end[f]) - area[f]) / width;
                let gap = (moment[f] - fine).abs();
                assert!(
                    gap < 5e-7,
                    "nu {nu} r {r} z {z} cell {j} field {f}: {} {fine}",
                    moment[f]
                );
                most = most.max(fine.abs());
            }
        }
        assert!(most > 1e-4, "nothing was tested: {most}");
    }
}
