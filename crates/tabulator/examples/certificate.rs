//! Whether the error estimate is true: random points and pulses against the exact kernels.
//!
//! `cargo run --release -p hertzlamb-tabulator --example certificate -- TABLE.h5 [COUNT]`

use lookup::{PulseSum, Series, Smoothness, Table};
use rayon::prelude::*;
use std::path::Path;
use tabulator::{PointPlan, quantile};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("TABLE.h5")?;
    let count: u64 = arguments.next().map_or(Ok(1000), |n| n.parse())?;
    let table = Table::open(Path::new(&path))?;
    let width = table.cell_width();
    let plans = table
        .content()
        .slices
        .iter()
        .map(|slice| PointPlan::new(slice.poisson_ratio, 1e-9, width, slice.cells, 12))
        .collect::<Result<Vec<_>, _>>()?;
    let rows: Vec<[(f64, f64); 6]> = (0..count)
        .into_par_iter()
        .map(|i| {
            let index = (uniform(4 * i) * plans.len() as f64) as usize;
            let (r, z) = (
                uniform(4 * i + 1) * table.r_max(),
                uniform(4 * i + 2) * table.z_max(),
            );
            let length = 100.0_f64.powf(uniform(4 * i + 3));
            probe(&table, index, &plans[index], r, z, length).unwrap_or([(f64::NAN, f64::NAN); 6])
        })
        .collect();
    println!(
        "field: share of errors above the estimate, ratio estimate/error p01 p50 p99, largest error/estimate"
    );
    let mut all = Vec::new();
    for f in 0..6 {
        let mut ratios: Vec<f64> = rows
            .iter()
            .map(|row| row[f].1 / row[f].0.max(1e-15))
            .collect();
        all.extend(ratios.clone());
        print(lookup::schema::FIELD_NAMES[f], &mut ratios);
    }
    print("all", &mut all);
    Ok(())
}

fn print(name: &str, ratios: &mut [f64]) {
    ratios.sort_by(f64::total_cmp);
    let above = ratios.iter().filter(|ratio| **ratio < 1.0).count() as f64 / ratios.len() as f64;
    println!(
        "{name:15} {above:.4}  {:8.2} {:8.2} {:8.1}  {:.2}",
        quantile(ratios, 0.01),
        quantile(ratios, 0.5),
        quantile(ratios, 0.99),
        1.0 / ratios[0]
    );
}

/// Observed error and estimate of each field.
fn probe(
    table: &Table,
    index: usize,
    plan: &PointPlan,
    r: f64,
    z: f64,
    length: f64,
) -> Result<[(f64, f64); 6], Box<dyn std::error::Error>> {
    let nu = table.poisson_ratios()[index];
    let width = table.cell_width();
    let point = plan.compute(r, z)?;
    let cells = table.content().slices[index].cells;
    let flat = |values: &[halfspace::Six]| {
        (0..6)
            .flat_map(|f| values.iter().map(move |six| six[f]))
            .collect::<Vec<f64>>()
    };
    let series = Series::new(
        width,
        cells,
        flat(&point.averages),
        flat(&point.moments),
        &flat(&point.tail),
    );
    let count = cells * 2 / 3 + (length / width) as usize + 1;
    let (mut exact, mut found) = (vec![[0.0; 6]; count], vec![[0.0; 6]; count]);
    series.fill(Smoothness::Smooth, 0, &mut exact);
    table.trace_for(Smoothness::Smooth, nu, r, z, 0, &mut found)?;
    for (a, b) in found.iter_mut().zip(&exact) {
        for f in 0..6 {
            a[f] -= b[f];
        }
    }
    let difference = PulseSum::new(length, width).response(&[0.0; 6], &found);
    let estimate = table.error(nu, r, z, length)?;
    Ok(std::array::from_fn(|f| {
        (
            difference
                .iter()
                .fold(0.0, |most: f64, six| most.max(six[f].abs())),
            estimate[f],
        )
    }))
}

/// Number `index` of a fixed sequence in [0, 1) (SplitMix64).
fn uniform(index: u64) -> f64 {
    let mut x = (index + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}
