//! Error over the size of a table and the time of a lookup, for several spacings, axes, stencils and storage types.
//!
//! `cargo run --release -p hertzlamb-tabulator --example density > density.csv`; `scripts/plot_table_density.py` draws it.

#[path = "../tests/measuring/mod.rs"]
mod measuring;

use lookup::{Content, Table};
use measuring::observe::observe_lengths;
use measuring::sample::{Storage, sample_errors};
use std::path::Path;
use std::time::Instant;
use tabulator::{Axis, Existing, Grid, Silent, build_over, quantile};

type Failure = Box<dyn std::error::Error>;

const LENGTHS: [f64; 3] = [3.0, 10.0, 40.0];

fn main() -> Result<(), Failure> {
    println!("axes,spacing,stencil_points,storage,megabytes,lookup_us,pulse_length,p50,p99");
    // a separate folder, without files of an interrupted run
    let folder = tempfile::tempdir()?;
    for spacing in [0.4, 0.3, 0.2, 0.15, 0.1] {
        for (name, grid) in [("uniform", uniform(spacing)), ("graded", graded(spacing))] {
            let path = folder.path().join("density.h5");
            let bytes = build_over(&grid, &path, Existing::Replace, &Silent)?.bytes as f64;
            let content = lookup::read(&path)?;
            for points in [2, 4, 6, 8] {
                stencils(
                    &content,
                    points,
                    &format!("{name},{spacing},{points},f32,{:.2}", bytes / 1e6),
                )?;
            }
            std::fs::remove_file(Path::new(&path))?;
            // 64 bits take twice the bytes, since the additional ones hardly compress
            for (storage, label, factor) in
                [(Storage::Single, "f32", 1.0), (Storage::Double, "f64", 2.0)]
            {
                let sampled = sample_errors(&grid, &LENGTHS, storage)?;
                for (length, errors) in LENGTHS.into_iter().zip(&sampled) {
                    let size = factor * bytes / 1e6;
                    row(
                        &format!("{name} sampled,{spacing},8,{label},{size:.2},nan"),
                        length,
                        errors,
                    );
                }
            }
        }
    }
    Ok(())
}

fn uniform(spacing: f64) -> Grid {
    Grid {
        r: Axis::uniform(6.0, spacing),
        z: Axis::uniform(6.0, spacing),
        ..Grid::demo()
    }
}

fn graded(spacing: f64) -> Grid {
    Grid {
        r: Axis::graded(6.0, spacing, 1.0, 0.25 * spacing, 0.12),
        z: Axis::graded(6.0, spacing, 0.0, 0.2 * spacing, 0.12),
        ..Grid::demo()
    }
}

fn row(label: &str, length: f64, sorted: &[f64]) {
    println!(
        "{label},{length},{:.3e},{:.3e}",
        quantile(sorted, 0.5),
        quantile(sorted, 0.99)
    );
}

/// Errors at random places, the same for all tables, with stencils of `points` points.
fn stencils(content: &Content, points: usize, label: &str) -> Result<(), Failure> {
    let mut content = content.clone();
    content.stencil_points = points;
    let table = Table::new(content)?;
    let mut cells = vec![[0.0; 6]; 300];
    let mut times: Vec<f64> = (0..400)
        .map(|i| {
            let place = [0.1 + 0.0137 * f64::from(i), 5.9 - 0.0141 * f64::from(i)];
            let start = Instant::now();
            let done = table.trace(
                lookup::Smoothness::Linear,
                0.3,
                place[0],
                place[1],
                0,
                &mut cells,
            );
            (start.elapsed().as_secs_f64() * 1e6, done)
        })
        .map(|(time, done)| done.map(|_| time))
        .collect::<Result<_, _>>()?;
    times.sort_by(f64::total_cmp);
    let observed = observe_lengths(&table, 120, &LENGTHS, 3)?;
    for length in LENGTHS {
        let mut errors = Vec::new();
        for o in observed.iter().filter(|o| o.pulse_length == length) {
            errors.extend((0..6).map(|f| o.error[f] / o.peak[f]));
        }
        errors.sort_by(f64::total_cmp);
        row(
            &format!("{label},{:.1}", quantile(&times, 0.5)),
            length,
            &errors,
        );
    }
    Ok(())
}
