//! The error estimate is a promise: at most 1 in 1000 errors exceeds it, and its median is within 10 times the error.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod measuring;

use lookup::Table;
use measuring::judge::{Region, judge};
use measuring::observe::observe;
use std::path::Path;
use tabulator::{Axis, Grid, Silent, build, quantile};

/// 10,000 random (Poisson ratio, r, z, pulse length) on a table of seven slices about the disc.
/// `scripts/measure-tables` does the same with `standard`.
#[test]
fn the_error_estimate_is_true() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    let table = seven_slices(&path);
    the_builders_own_route(&table);
    values_of_r_alone(&table);
}

fn seven_slices(path: &Path) -> Table {
    let grid = Grid {
        poisson_ratios: vec![0.2, 0.23, 0.26, 0.29, 0.32, 0.35, 0.38],
        cell_width: 0.125,
        r: Axis::graded(1.75, 0.15, 1.0, 0.06, 0.2),
        z: Axis::graded(1.25, 0.15, 0.0, 0.05, 0.2),
        ..Grid::demo()
    };
    build(&grid, path, &Silent).unwrap();
    Table::open(path).unwrap()
}

fn the_builders_own_route(table: &Table) {
    let found = observe(table, 400, 25, 7).unwrap();
    let mut ratios: Vec<f64> = found
        .iter()
        .flat_map(|o| (0..6).map(|f| o.estimate[f] / o.error[f]))
        .collect();
    assert_eq!(ratios.len(), 60_000);
    ratios.sort_by(f64::total_cmp);
    let above = ratios.iter().filter(|ratio| **ratio < 1.0).count();
    let median = quantile(&ratios, 0.5);
    println!("{above} of 60000 above the estimate, median estimate/error {median:.2}");
    assert!(above <= 60, "{above} of 60000 errors above their estimate");
    assert!(
        median > 1.0 && median < 10.0,
        "median estimate/error {median}"
    );
}

/// On slices, between them, near the axis and the surface, by a route that the builder does not share: 99.9 % of the
/// errors of each field lie within their estimate.
fn values_of_r_alone(table: &Table) {
    const PLACES: usize = 100;
    const PULSES: usize = 5;
    let mut above = [0; 6];
    let mut total = 0;
    for region in Region::ALL {
        let found = judge(table, region, PLACES, PULSES, 20_261_122).unwrap();
        total += found.len();
        for (f, above) in above.iter_mut().enumerate() {
            let mut ratios: Vec<f64> = found
                .iter()
                .filter(|o| o.peak[f] > 0.0)
                .map(|o| o.estimate[f] / o.error[f])
                .collect();
            ratios.sort_by(f64::total_cmp);
            let here = ratios.iter().filter(|ratio| **ratio < 1.0).count();
            println!(
                "{region:?} {}: {here} of {} above; estimate/error least {:.2}, median {:.2}",
                lookup::schema::FIELD_NAMES[f],
                ratios.len(),
                quantile(&ratios, 0.0),
                quantile(&ratios, 0.5)
            );
            *above += here;
        }
    }
    assert_eq!(total, Region::ALL.len() * PLACES * PULSES);
    for (f, above) in above.into_iter().enumerate() {
        let name = lookup::schema::FIELD_NAMES[f];
        assert!(1000 * above <= total, "{name}: {above} of {total}");
    }
}
