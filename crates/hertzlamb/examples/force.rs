//! Contact force of a ball on granite at several velocities, without a table or a file.
//!
//! `cargo run --release --package hertzlamb --example force`

use hertzlamb::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let granite = HalfSpace::new(Material::named("granite")?)?;
    let ball = Striker::ball(Material::named("bearing-steel")?, 0.0025)?;
    println!("v m/s   force N   contact us   1 - e^2    model");
    for velocity_m_s in [0.1, 0.3, 1.0, 3.0] {
        let run = Impact::new(granite.clone(), ball.clone(), velocity_m_s).solve()?;
        println!(
            "{velocity_m_s:<6}  {:8.3}  {:10.3}   {:.6}   {}",
            run.peak_force_n,
            1e6 * run.contact_time_s,
            run.loss,
            run.solved.chosen.model.name()
        );
    }
    Ok(())
}
