//! A sweep in memory: 10,000 impacts with parameters of your choice.
//!
//! `cargo run --release --package hertzlamb --example sweep`

use hertzlamb::contact::{BodyError, Collision, Solver, Tabulated};
use hertzlamb::impact::sweep::{collide, outcomes};
use hertzlamb::prelude::*;
use rayon::prelude::*;
use std::error::Error;
use std::time::Instant;

const ROWS: usize = 10_000;

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let granite = HalfSpace::new(Material::named("granite")?)?;
    let steel = Material::named("bearing-steel")?;
    let settings = Settings::default();
    // diameters from 1 to 10 mm, velocities from 0.1 to 10 m/s
    let row = |row: usize, _: &mut ()| -> Result<(Collision, Settings), BodyError> {
        let (i, j) = ((row / 100) as f64 / 99.0, (row % 100) as f64 / 99.0);
        let ball = Striker::ball(steel.clone(), 5e-4 * 10_f64.powf(i))?;
        Ok((
            Collision::new(&granite, &ball, 0.1 * 100_f64.powf(j)),
            settings,
        ))
    };
    let start = Instant::now();
    let responses = Tabulated::default();
    let series = outcomes(ROWS, &responses, row);
    let loss =
        |solver: &mut Solver<'_, Tabulated>, i| -> Result<f64, Box<dyn Error + Send + Sync>> {
            let (collision, settings) = row(i, &mut ())?;
            Ok(collide(solver, &collision, &settings)?.results.loss)
        };
    let solver = || Solver::sharing(&responses, &series);
    let found = (0..ROWS).into_par_iter().map_init(solver, loss);
    let losses = found.collect::<Result<Vec<_>, _>>()?;
    let wall_s = start.elapsed().as_secs_f64();
    let range = losses
        .iter()
        .fold([f64::INFINITY, 0.0], |[a, b], &x| [a.min(x), x.max(b)]);
    println!(
        "{} impacts in {:.0} ms; the loss goes from {:.5} to {:.5}",
        losses.len(),
        1e3 * wall_s,
        range[0],
        range[1]
    );
    Ok(())
}
