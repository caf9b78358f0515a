//! Far away and less than 0.01 r0 deep, tractions change while the Rayleigh wave goes as far as the place is deep: rounding
//! of c t would be seen as noise of eps r/z.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::{Field, Kernel, Medium, Profile};

/// Second differences over instants sixteen roundings apart, over the peak in time; rounding of c t gives 0.6 eps r/z and more.
#[test]
fn tractions_at_the_rayleigh_front_have_a_tenth_of_the_rounding_of_its_distance() {
    for (nu, r, z) in [
        (0.25, 270.207_892, 1.18e-4),
        (0.25, 270.207_892, 1e-3),
        (0.3, 41.3, 2e-4),
        (0.3, 270.2, 5e-3),
    ] {
        let medium = Medium::new(nu).unwrap();
        let kernel = Kernel::new(&medium, Profile::Hertz, 1e-10).unwrap();
        let speed = medium.rayleigh_speed();
        let at = |t: f64| kernel.remainder(r, z, t).unwrap().value;
        let passing: Vec<_> = (0..400)
            .map(|i| at((r - 1.5 + 0.0075 * f64::from(i)) / speed))
            .collect();
        for field in [Field::StressZz, Field::StressRz] {
            let peak = passing
                .iter()
                .map(|v| v[field.index()].abs())
                .fold(0.0, f64::max);
            let mut noise = 0.0_f64;
            for (edge, depths) in [(-1.0, -0.5), (-1.0, 0.5), (1.0, -0.5), (1.0, 0.5)] {
                let front: f64 = (r + edge + depths * z) / speed;
                let values: Vec<f64> = (0..24)
                    .map(|i| at(f64::from_bits(front.to_bits() + 16 * i))[field.index()])
                    .collect();
                for near in values.windows(3) {
                    noise = noise.max((near[0] - 2.0 * near[1] + near[2]).abs());
                }
            }
            let rounding = f64::EPSILON * r / z;
            assert!(
                noise < 0.1 * rounding * peak,
                "nu {nu}, r {r}, z {z}, {field:?}: {:.1e} of eps r/z",
                noise / peak / rounding
            );
        }
    }
}
