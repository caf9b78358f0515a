use contact::*;
fn main() {
    let block = HalfSpace::new(Material::named("aluminium-6061-t6").unwrap()).unwrap();
    let ball = Striker::ball(Material::named("bearing-steel").unwrap(), 0.005).unwrap();
    let responses = Tabulated::new(Ratios::Few);
    let mut solver = Solver::new(&responses);
    for (law, model, tol, n) in [(Plasticity::None, Model::AreaDashpot, 1e-4, 400000), (Plasticity::Thornton, Model::AreaDashpot, 1e-4, 400000), (Plasticity::Recovery, Model::AreaDashpot, 1e-4, 2000), (Plasticity::JacksonGreen, Model::AreaDashpot, 1e-4, 2000),
        (Plasticity::Thornton, Model::Growing, 1e-4, 200), (Plasticity::Recovery, Model::Growing, 1e-4, 200), (Plasticity::Thornton, Model::Growing, 1e-6, 50), (Plasticity::None, Model::Growing, 1e-4, 400)] {
        let settings = Settings { plasticity: law, model, tolerance: tol, ..Settings::default() };
        let mut fails = 0;
        let t = std::time::Instant::now();
        let mut sum = 0.0;
        for i in 0..n {
            let v = 0.1 * (200f64).powf(i as f64 / n as f64);
            let c = Collision::new(&block, &ball, v);
            match solver.solve(&c, &settings) { Ok(s) => { let r = solver.radiated(&c, &settings, &s).unwrap(); sum += Results::new(&c, &settings, &s, r).checked().unwrap().restitution; }, Err(e) => { if fails == 0 { println!("{v} {e}"); } fails += 1; } }
        }
        println!("{law:?} {model:?} {tol:e} {:.0}/s fails {fails} {sum}", n as f64 / t.elapsed().as_secs_f64());
    }
}
