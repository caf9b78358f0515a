//! Methods compared.

mod axis_extended;
mod convolution;
mod effort;
mod error;
mod extended;
pub mod figure;
mod gauss;
mod hankel;
pub mod inversion;
pub mod map;
mod marching;
mod measure;
mod pulse_reference;
mod question;
mod record;
mod route;
#[cfg(test)]
mod route_tests;
mod scenes;
pub mod single_integral;
mod surface;
mod tables;
mod transform;

pub use effort::Effort;
pub use error::StudyError;
pub use measure::Timing;
pub use record::{Error, FAILED, Question, Record, pareto_front};

#[test]
fn show_maps() {
    let start = std::time::Instant::now();
    let d: Vec<_> = [0.125].iter().map(|&s| tables::Density::build(0.3, s).unwrap()).collect();
    println!("tables {:?}", start.elapsed());
    for (n, f) in [("marches", map::marches::figures(Effort::Quick, &|| ()).unwrap()),
      ("kernels", map::kernels::figures(Effort::Quick, &|| ()).unwrap()),
      ("lookups", map::lookups::figures(&d, Effort::Quick).unwrap()),
      ("models", map::models::figures(Effort::Quick, &|| ()).unwrap()),
      ("inv", map::inversions::figures(Effort::Quick, &|| ()).unwrap())] {
        println!("{n} {:?}", start.elapsed());
        for f in f { println!("  {} {:?}", f.name, f.caption);
          if let Some(c) = &f.cells { for row in c.class.chunks(c.shape[0]).rev() { println!("    {}", row.iter().map(|c| c.to_string()).collect::<String>()); } }
          for c in &f.curves { if !f.name.starts_with("inv") { println!("   {}: {:?}", c.name, c.points.iter().step_by(5).map(|(x,y)| format!("{x:.1e},{y:.1e}")).collect::<Vec<_>>()); } }
        }
    }
}
