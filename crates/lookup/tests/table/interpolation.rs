//! Accuracy of lookups at nodes, at edges, across the axis, in coarser cells and after the last cell.

use crate::stand_in::{CELLS, WIDTH, average, cells, content, table};
use halfspace::FIELDS;
use lookup::{LookupError, Smoothness, Table};

#[test]
fn nodes_return_the_stored_numbers() {
    let content = content();
    let table = Table::new(content.clone()).unwrap();
    let stored = &content.slices[0].remainder;
    for (i, &r) in content.r.iter().enumerate() {
        for (k, &z) in content.z.iter().enumerate() {
            let found = cells(&table, r, z, 0, CELLS);
            for (j, cell) in found.iter().enumerate() {
                for (field, &value) in cell.iter().enumerate() {
                    let exact = stored[((i * content.z.len() + k) * 6 + field) * CELLS + j];
                    assert_eq!(
                        value,
                        f64::from(exact),
                        "r = {r}, z = {z}, field {field}, cell {j}"
                    );
                }
            }
        }
    }
}

#[test]
fn one_ulp_to_either_side_of_a_node_changes_nothing_much() {
    let content = content();
    let table = Table::new(content.clone()).unwrap();
    let (last_r, last_z) = (table.content().r_max, table.content().z_max);
    for &r in &content.r {
        for &z in &content.z {
            let centre = cells(&table, r, z, 0, 3);
            for (r, z) in [
                (r.next_up().min(last_r), z),
                (r.next_down().max(0.0), z),
                (r, z.next_up().min(last_z)),
                (r, z.next_down().max(0.0)),
            ] {
                for (a, b) in cells(&table, r, z, 0, 3)
                    .iter()
                    .flatten()
                    .zip(centre.iter().flatten())
                {
                    assert!((a - b).abs() < 1e-12);
                }
            }
        }
    }
}

#[test]
fn between_nodes_the_field_is_interpolated_to_high_order_also_beside_the_axis_and_at_the_edges() {
    let table = table();
    for r in [0.0, 1e-9, 0.01, 0.07, 0.3, 1.0, 1.99, table.content().r_max] {
        for z in [0.0, 0.03, 0.2, 0.77, table.content().z_max.next_down()] {
            for (j, cell) in cells(&table, r, z, 0, CELLS).iter().enumerate() {
                for (field, &value) in cell.iter().enumerate() {
                    let exact = average(r, z, field, j as f64 * WIDTH, (j + 1) as f64 * WIDTH);
                    let error = (value - exact).abs();
                    assert!(
                        error < 2e-5 * (1.0 + field as f64),
                        "r = {r}, z = {z}, field {field}, cell {j}: {error:.1e}"
                    );
                }
            }
        }
    }
}

#[test]
fn fields_that_are_odd_in_r_vanish_on_the_axis() {
    let table = table();
    for cell in cells(&table, 0.0, 0.123, 0, 60) {
        for field in FIELDS.into_iter().filter(|field| field.is_odd_in_r()) {
            assert_eq!(cell[field.index()], 0.0);
        }
    }
}

#[test]
fn a_coarse_cell_is_the_mean_of_its_halves() {
    let table = table();
    for coarsening in 1..=4 {
        let halves = cells(&table, 0.4, 0.3, coarsening - 1, 40);
        let whole = cells(&table, 0.4, 0.3, coarsening, 20);
        for (j, cell) in whole.iter().enumerate() {
            for (field, value) in cell.iter().enumerate() {
                let mean = 0.5 * (halves[2 * j][field] + halves[2 * j + 1][field]);
                assert!(
                    (value - mean).abs() < 1e-14,
                    "coarsening {coarsening}, cell {j}"
                );
            }
        }
    }
}

#[test]
fn the_tail_continues_the_cells() {
    let table = table();
    let found = cells(&table, 0.45, 0.31, 0, 4000);
    for j in (0..4000).step_by(7) {
        for (field, &value) in found[j].iter().enumerate() {
            let exact = average(0.45, 0.31, field, j as f64 * WIDTH, (j + 1) as f64 * WIDTH);
            assert!(
                (value - exact).abs() < 2e-6 * (1.0 + field as f64),
                "cell {j}, field {field}: {value} against {exact}"
            );
        }
    }
}

/// A smooth force sampled at the cells: second order with plain averages, fourth with moments.
#[test]
fn moments_raise_the_order_in_the_cell_width() {
    let table = table();
    let force = |t: f64| {
        if t > 0.0 {
            t.powi(6) * (-t).exp() / 30.0
        } else {
            0.0
        }
    };
    let at = 14.0;
    let error = |smoothness, coarsening: u32| {
        let width = WIDTH * f64::from(1_u32 << coarsening);
        let count = (at / width).ceil() as usize;
        let mut found = vec![[0.0; 6]; count];
        table
            .trace(smoothness, 0.3, 0.45, 0.0, coarsening, &mut found)
            .unwrap();
        let response: f64 = found
            .iter()
            .enumerate()
            .map(|(j, cell)| {
                (force(at - j as f64 * width) - force(at - (j + 1) as f64 * width)) * cell[1]
            })
            .sum();
        // The reference: a thousand times finer, with exact averages.
        let fine = 0.000_5;
        let exact: f64 = (0..(at / fine) as usize)
            .map(|j| {
                let (near, far) = (j as f64 * fine, (j + 1) as f64 * fine);
                (force(at - near) - force(at - far)) * average(0.45, 0.0, 1, near, far)
            })
            .sum();
        (response - exact).abs()
    };
    let order = |smoothness| (error(smoothness, 2) / error(smoothness, 1)).log2();
    let (linear, smooth) = (order(Smoothness::Linear), order(Smoothness::Smooth));
    assert!((linear - 2.0).abs() < 0.3, "plain averages: order {linear}");
    assert!(smooth > 3.7, "with moments: order {smooth}");
    assert!(error(Smoothness::Smooth, 1) < 0.1 * error(Smoothness::Linear, 1));
}

#[test]
fn outside_is_an_error_that_names_axis_value_and_range() {
    let table = table();
    let mut cells = vec![[0.0; 6]; 4];
    let mut message = |nu, r, z| {
        table
            .trace(Smoothness::Linear, nu, r, z, 0, &mut cells)
            .unwrap_err()
            .to_string()
    };
    let (r, z) = (table.content().r_max, table.content().z_max);
    assert_eq!(
        message(0.3, 7.0, 0.0),
        format!("r/r0 = 7 is outside the table's range [0, {r}]")
    );
    assert_eq!(
        message(0.3, 0.0, -0.5),
        format!("z/r0 = -0.5 is outside the table's range [0, {z}]")
    );
    assert_eq!(
        message(0.31, 0.0, 0.0),
        "poisson_ratio = 0.31 is outside the table's range [0.3, 0.3]"
    );
    for bad in [f64::NAN, f64::INFINITY, r.next_up(), (0.0_f64).next_down()] {
        assert!(message(0.3, bad, 0.0).starts_with("r/r0 = "), "{bad}");
    }
    assert!(message(0.3, 0.0, z.next_up()).starts_with("z/r0 = "));
    assert!(message(f64::NAN, 0.0, 0.0).starts_with("poisson_ratio = "));
    let coarse = table
        .trace(Smoothness::Linear, 0.3, 0.0, 0.0, 40, &mut cells)
        .unwrap_err();
    assert_eq!(coarse, LookupError::Coarsening { value: 40, max: 20 });
}

#[test]
fn the_estimate_follows_the_measured_errors() {
    let table = table();
    let error = table.error(0.3, 0.4, 0.4, 10.0).unwrap();
    for (field, value) in error.iter().enumerate() {
        let measured = 1e-5 * (1.0 + field as f64);
        assert!((value / (lookup::SAFETY * measured) - 1.0).abs() < 1e-6);
    }
    assert!(matches!(
        table.error(0.3, 0.4, 0.4, 0.0),
        Err(LookupError::PulseLength { .. })
    ));
}

/// Between two measured pulses the estimate lies between theirs, nearer to that of the nearer, and it never falls below
/// the rounding of what is stored.
#[test]
fn the_estimate_is_interpolated_between_pulses() {
    let mut three = content();
    three.pulse_lengths = vec![3.0, 10.0, 40.0];
    three.origin.accuracy_reached = vec![1e-2, 1e-4, 0.0];
    let probes = &mut three.slices[0].verification;
    let (places, peak) = (probes.direct.len() / 6, 8.0);
    probes.direct = vec![peak; 18 * places];
    probes.looked_up = vec![peak; 18 * places];
    let measured = [1e-2_f32, 1e-4, 0.0];
    let of = |i: usize| measured[i / 6 % 3];
    probes.error = (0..18 * places).map(of).collect();
    let table = Table::new(three).unwrap();
    let at = |length: f64| table.error(0.3, 0.4, 0.4, length).unwrap()[2];
    let is = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 1e-5;
    assert!(is(at(3.0), 1e-2 * lookup::SAFETY) && is(at(1.0), at(3.0)));
    assert!(is(at(10.0), 1e-4 * lookup::SAFETY));
    // a quarter of the way in the logarithm of the length is one of the error's
    assert!(is(
        at(3.0 * (10.0_f64 / 3.0).powf(0.25)),
        at(3.0) * 0.01_f64.powf(0.25)
    ));
    // single precision
    assert!(is(at(40.0), 6e-8 * f64::from(peak)) && is(at(1e3), at(40.0)));
}

#[test]
fn a_table_is_shared_between_threads() {
    fn shared<T: Send + Sync>() {}
    shared::<Table>();
}

/// Moments of wide cells compared with those gathered from narrow ones: the averages of the table's cells alone
/// determine them.
#[test]
fn wide_cells_need_averages_alone() {
    let table = table();
    let (narrow, wide) = (8, 16);
    for (r, z) in [(0.0, 0.3), (0.7, 0.2), (1.5, 1.1)] {
        let count = CELLS / wide - 1;
        let of = |part: usize, count: usize| {
            table
                .moments(0.3, r, z, part as f64 * WIDTH, count)
                .unwrap()
                .1
        };
        let (found, fine) = (of(wide, count), of(narrow, 2 * count));
        for j in 0..count {
            for f in 0..FIELDS.len() {
                let [a, b] = [2 * j, 2 * j + 1].map(|i| [fine.averages[i][f], fine.first[i][f]]);
                let average = 0.5 * (a[0] + b[0]);
                let first = 0.125 * (b[0] - a[0]) + 0.25 * (a[1] + b[1]);
                let height = (a[0].abs()).max(b[0].abs()).max(1e-6);
                assert!((found.averages[j][f] - average).abs() < 1e-9 * height);
                assert!((found.first[j][f] - first).abs() < 1e-3 * height, "{j} {f}");
            }
        }
    }
}
