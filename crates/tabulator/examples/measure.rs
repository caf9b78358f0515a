//! Quantiles of the errors stored in a table, by pulse, region and field; a grid is built first.
//!
//! `cargo run --release -p hertzlamb-tabulator --example measure -- [TABLE.h5 | GRID.toml]`

use lookup::{Content, Verification};
use std::path::{Path, PathBuf};
use tabulator::{Existing, Grid, Silent, build_over, quantile};

/// A name and whether a place (r, z) belongs to it.
type Region = (&'static str, fn(f64, f64) -> bool);

const REGIONS: [Region; 6] = [
    ("everywhere", |_, _| true),
    ("disc edge", |r, z| (r - 1.0).hypot(z) < 0.5),
    ("surface", |r, z| z < 0.3 && r > 1.5),
    ("axis", |r, z| r < 0.3 && z > 0.5),
    ("under the disc", |r, z| r < 0.9 && z < 0.5),
    ("elsewhere", |r, z| r > 1.5 && z > 0.5),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let argument = std::env::args().nth(1);
    let path = match argument {
        Some(path) if path.ends_with(".h5") => PathBuf::from(path),
        Some(path) => build(&Grid::from_file(Path::new(&path))?)?,
        None => build(&Grid::demo())?,
    };
    let content = lookup::read(&path)?;
    println!("error over the peak in time: p50, p99, p99 of u w srr stt szz srz");
    let slices: Vec<&Verification> = content.slices.iter().map(|s| &s.verification).collect();
    let between: Vec<&Verification> = content.between.iter().map(|b| &b.verification).collect();
    for (pulse, length) in content.pulse_lengths.iter().enumerate() {
        println!("pulses of {length} r0/c1");
        for (name, inside) in REGIONS {
            let measured = errors(&content, &slices, &content.probes(), pulse, inside);
            print(&format!("slices, {name}"), measured);
        }
        for slice in content.slices.iter().filter(|_| content.slices.len() > 1) {
            let one = [&slice.verification];
            let measured = errors(&content, &one, &content.probes(), pulse, |_, _| true);
            print(&format!("slice nu = {}", slice.poisson_ratio), measured);
        }
        if !between.is_empty() {
            let places = [content.between_r.clone(), content.between_z.clone()];
            let measured = errors(&content, &between, &places, pulse, |_, _| true);
            print("between slices", measured);
        }
    }
    Ok(())
}

fn build(grid: &Grid) -> Result<PathBuf, Box<dyn std::error::Error>> {
    let path = std::env::temp_dir().join("hertzlamb-measure.h5");
    let summary = build_over(grid, &path, Existing::Replace, &Silent)?;
    println!(
        "{} points, {:.1} MB, {:.1} s, content {}",
        summary.points,
        summary.bytes as f64 / 1e6,
        summary.wall_s,
        &summary.content_sha256[..16]
    );
    Ok(path)
}

/// Errors over peaks of each field.
fn errors(
    content: &Content,
    measured: &[&Verification],
    [r, z]: &[Vec<f64>; 2],
    pulse: usize,
    inside: fn(f64, f64) -> bool,
) -> [Vec<f64>; 6] {
    let mut lists: [Vec<f64>; 6] = Default::default();
    for probes in measured {
        for (i, &r) in r.iter().enumerate() {
            for (k, &depth) in z.iter().enumerate() {
                if !inside(r, depth) {
                    continue;
                }
                let place = (i * z.len() + k) * content.pulse_lengths.len() + pulse;
                for (field, list) in lists.iter_mut().enumerate() {
                    let peak = f64::from(probes.direct[6 * place + field]).abs();
                    if peak > 0.0 {
                        list.push(f64::from(probes.error[6 * place + field]) / peak);
                    }
                }
            }
        }
    }
    lists
}

fn print(name: &str, mut lists: [Vec<f64>; 6]) {
    let mut all: Vec<f64> = lists.concat();
    all.sort_by(f64::total_cmp);
    print!(
        "  {name:24} {:.1e} {:.1e}  ",
        quantile(&all, 0.5),
        quantile(&all, 0.99)
    );
    for list in &mut lists {
        list.sort_by(f64::total_cmp);
        print!(" {:.0e}", quantile(list, 0.99));
    }
    println!();
}
