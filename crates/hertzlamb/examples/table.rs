//! A kernel table: computed once, then used for fast lookups.
//!
//! `cargo run --release --package hertzlamb --example table`

use hertzlamb::prelude::*;
use hertzlamb::tabulator::{Grid, Silent, build};
use std::sync::Arc;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("kernels.h5");
    let start = Instant::now();
    let made = build(&Grid::demo(), &path, &Silent)?;
    println!(
        "{} points in {:.1} s",
        made.points,
        start.elapsed().as_secs_f64()
    );

    let steel = HalfSpace::new(Material::named("steel")?)?;
    let ball = Striker::ball(Material::named("bearing-steel")?, 0.005)?;
    let run = Impact::new(steel, ball, 2.0).solve()?;
    let radius_m = run.disc_radius_m;
    let file = TableFile::open(&path)?;
    let table = Arc::new(file.part(0.3, [[0.0; 2], file.reach()])?);
    let looked_up = run
        .excitation()
        .fields_from(KernelSource::Table(Arc::clone(&table)));
    let computed = run.excitation().fields(1e-8)?;
    for depth in [0.5, 1.0, 2.0] {
        let (r_m, z_m) = (0.5 * radius_m, depth * radius_m);
        let start = Instant::now();
        let fast = looked_up.at(r_m, z_m)?;
        let fast_s = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let exact = computed.at(r_m, z_m)?;
        let exact_s = start.elapsed().as_secs_f64();
        let [a, b] = [&fast, &exact].map(|fields| fields[Field::StressZz].peak());
        println!(
            "z = {depth} radii: {a:.6e} Pa looked up, {b:.6e} Pa computed; {:.0} times faster",
            exact_s / fast_s
        );
    }
    Ok(())
}
