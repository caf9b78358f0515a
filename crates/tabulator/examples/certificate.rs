//! Whether the error estimate is true: random places and pulses against the exact kernels.
//!
//! `cargo run --release -p hertzlamb-tabulator --example certificate -- TABLE.h5 [PLACES [PULSES]]`

use lookup::Table;
use std::path::Path;
use tabulator::{observe, quantile};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let path = arguments.first().ok_or("TABLE.h5")?;
    let number = |i: usize, default| arguments.get(i).map_or(Ok(default), |n| n.parse());
    let (places, pulses) = (number(1, 1250)?, number(2, 8)?);
    let table = Table::open(Path::new(path))?;
    let found = observe(&table, places, pulses, 1)?;
    println!("{places} places, {pulses} pulses each");
    println!(
        "field            above the estimate   estimate/error 0.1 %, 1 %, 50 %, 99 %   error/peak 50 %, 99 %"
    );
    let mut all = Vec::new();
    for f in 0..6 {
        let ratios: Vec<f64> = found.iter().map(|o| o.estimate[f] / o.error[f]).collect();
        let relative = found.iter().map(|o| o.error[f] / o.peak[f]).collect();
        print(lookup::schema::FIELD_NAMES[f], ratios.clone(), relative);
        all.extend(ratios);
    }
    print("all", all, vec![f64::NAN]);
    Ok(())
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
