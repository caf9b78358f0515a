//! Times the library calls that the Python package wraps, for `scripts/time-python`.
//!
//! `calls TABLE.h5 CALL` prints the median time in seconds. CALL is `impact`, a force-only scene from its text; `trace`,
//! 10,000 points of the table; or `sweep`, 200,000 contacts.

use formats::sweep::{Spec, run_rows};
use formats::{Existing, parse_scene};
use impact::{KernelChoice, simulate};
use lookup::{Smoothness, Table, TraceInfo};
use rayon::prelude::*;
use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

const SCENE: &str = "[target]\nmaterial = \"granite\"\n[striker]\nmaterial = \"bearing-steel\"\nmass_kg = 1.105e-4\n\
    tip_radius_m = 1.5e-3\nvelocity_m_s = 0.2\n";
const SWEEP: &str = "[product.striker]\nvelocity_m_s = { from = 0.1, to = 10.0, count = 200000 }\n[scene.target]\n\
    material = \"granite\"\n[scene.striker]\nmaterial = \"bearing-steel\"\nmass_kg = 1.105e-4\ntip_radius_m = 1.5e-3\n";
const POINTS: usize = 10_000;
const GRAIN: usize = 16;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, table, what] = arguments.as_slice() else {
        return Err("usage: calls TABLE.h5 impact|trace|sweep".into());
    };
    let times = match what.as_str() {
        "impact" => repeated(100, impact)?,
        "trace" => {
            let table = Table::open(Path::new(table))?;
            repeated(5, || trace(&table))?
        }
        "sweep" => repeated(3, sweep)?,
        other => return Err(format!("{other} is not one of impact, trace, sweep").into()),
    };
    println!("{}", times[times.len() / 2]);
    Ok(())
}

/// Times in seconds of `count` calls after a first one, in ascending order.
fn repeated(
    count: usize,
    call: impl Fn() -> Result<(), Box<dyn Error>>,
) -> Result<Vec<f64>, Box<dyn Error>> {
    call()?;
    let mut times = Vec::new();
    for _ in 0..count {
        let start = Instant::now();
        call()?;
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    Ok(times)
}

fn impact() -> Result<(), Box<dyn Error>> {
    let scene = parse_scene(SCENE, Path::new("."))?;
    black_box(simulate(&scene, &KernelChoice::Direct)?);
    Ok(())
}

/// Step responses: the remainder and the static field.
fn trace(table: &Table) -> Result<(), Box<dyn Error>> {
    let cells = table.content().slices[0].cells;
    let points: Vec<[f64; 2]> = (0..POINTS)
        .map(|i| {
            let share = i as f64 / POINTS as f64;
            [
                table.content().r_max * share,
                table.content().z_max * (1.0 - share),
            ]
        })
        .collect();
    let mut values = vec![[0.0; 6]; POINTS * cells];
    let none = TraceInfo {
        static_part: [0.0; 6],
        cell_width: 0.0,
        error: [0.0; 6],
    };
    let mut infos = vec![none; POINTS];
    values
        .par_chunks_mut(GRAIN * cells)
        .zip(infos.par_chunks_mut(GRAIN))
        .zip(points.par_chunks(GRAIN))
        .try_for_each(|((values, infos), points)| {
            table.traces(Smoothness::Linear, 0.3, points, 0, values, infos)
        })?;
    black_box((values, infos));
    Ok(())
}

fn sweep() -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let spec = Spec::from_toml(SWEEP, Path::new("."))?;
    let part = folder.path().join("sweep.part");
    black_box(run_rows(&spec, &part, Existing::Keep, |_| true)?);
    Ok(())
}
