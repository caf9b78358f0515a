//! Impacts a second and core that yield, by law: with a dashpot, as a sweep of a million rows solves them, and with memory.
//!
//! `cargo bench --package hertzlamb-contact --bench plastic`

#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use contact::{
    Choice, Collision, HalfSpace, Material, Model, Plasticity, Settings, Solver, Striker, Tabulated,
};
use std::hint::black_box;
use std::time::Instant;

/// Steel balls of 1 to 10 mm on aluminium at 2 to 500 times the velocity at which yield begins.
fn collisions() -> Vec<Collision> {
    let block = HalfSpace::new(Material::named("aluminium-6061-t6").unwrap()).unwrap();
    (0..1000_u32)
        .map(|i| {
            let part = |root: f64| (f64::from(i) * root).fract();
            let tip = 1e-3 * 10f64.powf(part(2f64.sqrt()));
            let ball = Striker::ball(Material::named("bearing-steel").unwrap(), tip).unwrap();
            Collision::new(&block, &ball, 0.2 * 250f64.powf(part(3f64.sqrt())))
        })
        .collect()
}

/// All laws, or the law, the model and the count of impacts given.
fn main() {
    let collisions = collisions();
    let responses = Tabulated::default();
    let speed = |plasticity: Plasticity, model: Model, count: usize| {
        let settings = Settings {
            plasticity,
            model,
            ..Settings::default()
        };
        let rows = collisions.iter().map(|collision| (*collision, settings));
        let outcomes = Solver::new(&responses).outcomes(1_000_000, rows);
        let mut solver = Solver::sharing(&responses, &outcomes);
        let mut solve = |collision: &Collision| {
            let found = solver.solve(collision, &settings).unwrap();
            assert!(found.flow.is_some());
            black_box(found);
        };
        // the series are made
        collisions.iter().take(count).for_each(&mut solve);
        let start = Instant::now();
        for i in 0..count {
            solve(&collisions[i % collisions.len()]);
        }
        let seconds = start.elapsed().as_secs_f64();
        println!(
            "{:14} {:12} {:10.0} impacts/s",
            plasticity.name(),
            model.name(),
            count as f64 / seconds
        );
    };
    let given: Vec<String> = std::env::args()
        .skip(1)
        .filter(|one| one != "--bench")
        .collect();
    if let [law, model, count] = &given[..] {
        let (law, model) = (
            Plasticity::named(law).unwrap(),
            Model::named(model).unwrap(),
        );
        return speed(law, model, count.parse().unwrap());
    }
    for law in [
        Plasticity::Thornton,
        Plasticity::Recovery,
        Plasticity::JacksonGreen,
    ] {
        speed(law, Model::AreaDashpot, 200_000);
    }
    for law in [Plasticity::Thornton, Plasticity::Recovery] {
        speed(law, Model::Growing, 500);
    }
}
