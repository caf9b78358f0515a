//! Processor time of a contact's history, by model: results alone and with the force at every instant.
//!
//! `cargo bench --package hertzlamb-contact --bench histories`

#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use contact::{Choice, Collision, Exact, HalfSpace, Material, Model, Settings, Solver, Striker};
use std::hint::black_box;
use std::time::Instant;

/// Half-space and velocity in m/s of a steel ball of 6 mm.
const IMPACTS: [(&str, f64); 4] = [
    ("steel", 1.0),
    ("soda-lime-glass", 3.0),
    ("granite", 2.0),
    ("pmma", 1.0),
];

/// Shortest time of a call in us among groups of calls.
fn microseconds(mut call: impl FnMut()) -> f64 {
    let group = |_| {
        let start = Instant::now();
        (0..20).for_each(|_| call());
        start.elapsed().as_secs_f64() / 20.0
    };
    1e6 * (0..10).map(group).fold(f64::INFINITY, f64::min)
}

fn main() {
    for (target, velocity_m_s) in IMPACTS {
        let block = HalfSpace::new(Material::named(target).unwrap()).unwrap();
        let ball = Striker::ball(Material::named("bearing-steel").unwrap(), 0.003).unwrap();
        let collision = Collision::new(&block, &ball, velocity_m_s);
        let mut solver = Solver::new(&Exact);
        for &model in Model::ALL {
            let settings = Settings {
                model,
                ..Settings::default()
            };
            let alone = microseconds(|| {
                black_box(solver.solve(&collision, &settings).unwrap());
            });
            let with_history = microseconds(|| {
                black_box(solver.solve_with_history(&collision, &settings).unwrap());
            });
            let name = model.name();
            println!("{target}, {name}: results {alone:.1} us, with history {with_history:.1} us");
        }
    }
}
