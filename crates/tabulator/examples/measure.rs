//! Builds a grid and prints size, time and quantiles of its measured errors.
//!
//! `cargo run --release -p hertzlamb-tabulator --example measure -- [GRID.toml]`

use std::path::Path;
use tabulator::{Existing, Grid, Silent, build_over, quantile};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let grid = match std::env::args().nth(1) {
        Some(path) => Grid::from_file(Path::new(&path))?,
        None => Grid::demo(),
    };
    let path = std::env::temp_dir().join("hertzlamb-measure.h5");
    let summary = build_over(&grid, &path, Existing::Replace, &Silent)?;
    println!(
        "{} points, {:.1} MB, {:.1} s, content {}",
        summary.points,
        summary.bytes as f64 / 1e6,
        summary.wall_s,
        &summary.content_sha256[..16]
    );
    let content = lookup::read(&path)?;
    println!("relative error (over the peak in time) off the grid: p50 p99 max");
    for (pulse, length) in content.pulse_lengths.iter().enumerate() {
        print!("T = {length:5}");
        for field in 0..6 {
            let mut ratios = Vec::new();
            for slice in &content.slices {
                let probes = &slice.verification;
                let picked = (pulse * 6 + field..probes.direct.len())
                    .step_by(6 * content.pulse_lengths.len());
                for i in picked {
                    let peak = f64::from(probes.direct[i].abs());
                    if peak > 0.0 {
                        ratios.push(f64::from(probes.error[i]) / peak);
                    }
                }
            }
            ratios.sort_by(f64::total_cmp);
            print!(
                " | {} {:.0e} {:.0e} {:.0e}",
                ["u", "w", "srr", "stt", "szz", "srz"][field],
                quantile(&ratios, 0.5),
                quantile(&ratios, 0.99),
                quantile(&ratios, 1.0)
            );
        }
        println!();
    }
    Ok(())
}
