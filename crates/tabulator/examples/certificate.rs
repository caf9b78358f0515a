//! Test of the error estimate at random places with random pulses: by the method that built the table, and by values of
//! R, on slices, between them, near the axis and near the surface.
//!
//! `cargo run --release -p hertzlamb-tabulator --example certificate -- TABLE.h5 [PLACES [PULSES]]`

#[path = "../tests/measuring/mod.rs"]
mod measuring;

use lookup::Table;
use measuring::judge::{Region, judge};
use measuring::observe::{Observation, observe};
use std::path::Path;
use tabulator::quantile;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let path = arguments.first().ok_or("TABLE.h5")?;
    let number = |i: usize, default| arguments.get(i).map_or(Ok(default), |n| n.parse());
    let (places, pulses) = (number(1, 1250)?, number(2, 8)?);
    let table = Table::open(Path::new(path))?;
    println!("{places} places, {pulses} pulses each");
    report(
        "anywhere, by the route of the builder",
        &observe(&table, places, pulses, 1)?,
    );
    for region in Region::ALL {
        let found = judge(&table, region, places, pulses, 2)?;
        report(&format!("{region:?}, by values of R"), &found);
    }
    Ok(())
}

fn report(title: &str, found: &[Observation]) {
    println!("\n{title}");
    println!(
        "field            above the estimate   estimate/error 0.1 %, 1 %, 50 %, 99 %   error/peak 50 %, 99 %"
    );
    let mut all = Vec::new();
    for f in 0..6 {
        // a field that is always zero is skipped
        let found = || found.iter().filter(|o| o.peak[f] > 0.0);
        let ratios: Vec<f64> = found().map(|o| o.estimate[f] / o.error[f]).collect();
        let relative = found().map(|o| o.error[f] / o.peak[f]).collect();
        print(lookup::schema::FIELD_NAMES[f], ratios.clone(), relative);
        all.extend(ratios);
    }
    print("all", all, vec![f64::NAN]);
}

fn print(name: &str, mut ratios: Vec<f64>, mut relative: Vec<f64>) {
    ratios.sort_by(f64::total_cmp);
    relative.sort_by(f64::total_cmp);
    let above = ratios.iter().filter(|ratio| **ratio < 1.0).count();
    println!(
        "{name:15} {above:6} of {:6}   {:8.2} {:8.2} {:8.2} {:8.0}   {:.0e} {:.0e}",
        ratios.len(),
        quantile(&ratios, 0.001),
        quantile(&ratios, 0.01),
        quantile(&ratios, 0.5),
        quantile(&ratios, 0.99),
        quantile(&relative, 0.5),
        quantile(&relative, 0.99),
    );
}
