//! Fields under a measured force, without a striker.
//!
//! `cargo run --release --package hertzlamb --example record`

use hertzlamb::prelude::*;
use std::f64::consts::PI;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // half a sine to the power 3/2, 100 N and 20 us, as sampled by a transducer every 0.2 us
    let time_s: Vec<f64> = (0..=100).map(|i| 2e-7 * f64::from(i)).collect();
    let force_n = time_s
        .iter()
        .map(|t| 100.0 * (PI * t / 2e-5).sin().max(0.0).powf(1.5))
        .collect();
    let record = ForceRecord::new(time_s, force_n)?;
    println!("impulse {:.4e} N s", record.impulse_n_s());

    let aluminium = HalfSpace::new(Material::named("aluminium")?)?;
    let excitation = Excitation::of_record(&aluminium, 5e-4, record)?;
    let fields = excitation.fields(1e-8)?;
    for r_m in [0.01, 0.02, 0.05] {
        let here = fields.at(r_m, 0.0)?;
        println!(
            "r = {:.0} mm: surface displacement {:+.4e} m, Rayleigh wave at {:.2} us",
            1e3 * r_m,
            here[Field::DisplacementZ].peak(),
            1e6 * here.arrival_s[2]
        );
    }
    Ok(())
}
