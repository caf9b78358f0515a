//! Methods compared.

mod axis_extended;
mod convolution;
mod effort;
mod error;
mod extended;
mod gauss;
mod hankel;
pub mod inversion;
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
fn show_fields() {
    let d: Vec<_> = [0.25, 0.125].iter().map(|&s| tables::Density::build(0.3, s).unwrap()).collect();
    let records = question::fields::measure(Effort::Full, &d, &|| ()).unwrap();
    for r in &records {
        println!("{:28} {:28} {:28} {:>12.0} +-{:<8.0} max {:.1e} rms {:.1e} work {:?} {:?}", r.scene, r.method, r.setting, r.cost.median_ns, r.cost.spread_ns, r.error.max, r.error.rms, r.work, r.refusal);
    }
}
