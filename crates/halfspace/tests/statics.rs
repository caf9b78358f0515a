//! The static field against Huber's closed form and quadrature at 60 digits.
//!
//! `cargo test -p hertzlamb-halfspace --test statics -- --nocapture` prints the errors.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod support;

use halfspace::{Kernel, Medium, Profile};
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
