//! Stress and displacement at points in the block, with arrivals and errors.
//!
//! `cargo run --release --package hertzlamb --example inside`

use hertzlamb::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let steel = HalfSpace::new(Material::named("steel")?)?;
    let ball = Striker::ball(Material::named("bearing-steel")?, 0.005)?;
    let run = Impact::new(steel, ball, 2.0).solve()?;
    let fields = run.excitation().fields(1e-8)?;
    for (r_m, z_m) in [(0.0, 0.001), (0.0, 0.004), (0.003, 0.004), (0.02, 0.0)] {
        let here = fields.at(r_m, z_m)?;
        let stress = &here[Field::StressZz];
        let displacement = &here[Field::DisplacementZ];
        println!(
            "r {:4.1} mm, z {:4.1} mm: P at {:6.3} us, stress_zz {:+.4e} Pa ({:.0e}), displacement_z {:+.4e} m ({:.0e})",
            1e3 * r_m,
            1e3 * z_m,
            1e6 * here.arrival_s[0],
            stress.peak(),
            stress.error,
            displacement.peak(),
            displacement.error
        );
    }
    Ok(())
}
