//! The static field against Huber's closed form and quadrature at 60 digits.
//!
//! `cargo test -p hertzlamb-halfspace --test statics -- --nocapture` prints the errors.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod support;

use halfspace::gauss::rule;
use halfspace::random::Stream;
use halfspace::{Kernel, Medium, Profile};
use std::f64::consts::PI;
use support::{NAMES, heading, line, read_csv};

#[test]
fn static_fields_hold_the_promised_accuracy() {
    let (header, rows) = read_csv("static_field.csv");
    assert_eq!(header[3..9], NAMES);
    assert!(rows.len() >= 300);
    let mut errors: [Vec<f64>; 6] = Default::default();
    let mut worst: [(f64, String); 6] = Default::default();
    for row in &rows {
        let v: Vec<f64> = row.iter().map(|x| x.parse().unwrap()).collect();
        let kernel = Kernel::new(&Medium::new(v[0]).unwrap(), Profile::Hertz, 1e-4).unwrap();
        let found = kernel.static_field(v[1], v[2]).unwrap();
        let largest =
            |fields: std::ops::Range<usize>| fields.map(|f| v[3 + f].abs()).fold(0.0, f64::max);
        let sizes = [largest(0..2), largest(2..6)];
        for f in 0..6 {
            let error = (found[f] - v[3 + f]).abs() / sizes[usize::from(f >= 2)];
            errors[f].push(error);
            if error > worst[f].0 {
                worst[f] = (error, format!("nu {} r {} z {}", v[0], v[1], v[2]));
            }
        }
    }
    heading("static field, relative to the largest of the same unit");
    for f in 0..6 {
        let found = line(NAMES[f], &errors[f]);
        println!("{:24} worst at {}", "", worst[f].1);
        assert!(found.max < 2e-15, "{}: {found}", NAMES[f]);
    }
}

/// Boussinesq's solution (1885): R^2 = r^2 + z^2, mu = 1.
#[test]
fn the_static_field_of_a_point_force_is_that_of_boussinesq() {
    let mut worst = 0.0_f64;
    for nu in [-0.5, 0.0, 0.3, 0.4999] {
        let kernel = Kernel::new(&Medium::new(nu).unwrap(), Profile::Point, 1e-4).unwrap();
        let mut random = Stream::new(8);
        for _ in 0..500 {
            let (r, z) = (random.within(0.0, 6.0), random.within(0.01, 6.0));
            let far = r.hypot(z);
            let force = 0.5 / PI;
            let cubed = far.powi(3);
            let expected = [
                0.5 * force * (r * z / cubed - (1.0 - 2.0 * nu) * r / (far * (far + z))),
                force * ((1.0 - nu) / far + 0.5 * z * z / cubed),
                -3.0 * force * z.powi(3) / (cubed * far * far),
                -3.0 * force * r * z * z / (cubed * far * far),
            ];
            let found = kernel.static_field(r, z).unwrap();
            for (e, f) in [(0, 0), (1, 1), (2, 4), (3, 5)] {
                let size = if e < 2 {
                    force / far
                } else {
                    force / (far * far)
                };
                worst = worst.max((found[f] - expected[e]).abs() / size);
            }
        }
    }
    println!("point force: {worst:.1e}");
    assert!(worst < 1e-13, "{worst:e}");
}

/// Hertz's pressure is a sum of those of punches of all radii a up to one, int_0^1 3 a^2 punch(r/a)/a^2 da.
#[test]
fn punches_of_all_radii_add_up_to_the_hertz_load() {
    let mut worst = 0.0_f64;
    for nu in [-0.5, 0.0, 0.3, 0.4999] {
        let medium = Medium::new(nu).unwrap();
        let [hertz, punch] =
            [Profile::Hertz, Profile::Punch].map(|p| Kernel::new(&medium, p, 1e-4).unwrap());
        let mut random = Stream::new(9);
        for _ in 0..100 {
            let (r, z) = (random.within(0.0, 6.0), random.within(0.3, 6.0));
            let expected = hertz.static_field(r, z).unwrap();
            let mut sum = [0.0; 6];
            for half in [0.0, 0.5] {
                for (a, weight) in rule(40).on(half, half + 0.5) {
                    let found = punch.static_field(r / a, z / a).unwrap();
                    for f in 0..6 {
                        sum[f] += weight * 3.0 * if f < 2 { a } else { 1.0 } * found[f];
                    }
                }
            }
            for f in 0..6 {
                let all = if f < 2 { 0..2 } else { 2..6 };
                let size = all.map(|f| expected[f].abs()).fold(0.0, f64::max);
                worst = worst.max((sum[f] - expected[f]).abs() / size);
            }
        }
    }
    println!("punches: {worst:.1e}");
    assert!(worst < 1e-12, "{worst:e}");
}
