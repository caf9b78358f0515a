//! Fields at points from standard input, for comparison with other programs: `scripts/compare-kernels` calls it.
//!
//! ```text
//! echo "0.25 1.0 0.5 2.0" | cargo run --release --example evaluate -- steps hertz 1e-10
//! echo "0.25 1.0 0.5"     | cargo run --release --example evaluate -- cells hertz 1e-10 0.1 300
//! ```
//!
//! `steps` reads lines of Poisson ratio, r, z, t and writes the step responses u, w, srr, stt, szz, srz.
//! `cells` reads lines of Poisson ratio, r, z and writes the static fields and then the cell averages of the remainder.
//! The first line written is the time that one line read takes, in seconds, the least of several.

use halfspace::{DomainError, Kernel, Medium, Profile, Six};
use std::error::Error;
use std::io::Read;
use std::time::Instant;

const REPETITIONS: usize = 7;

fn profile(name: &str) -> Result<Profile, String> {
    match name {
        "hertz" => Ok(Profile::Hertz),
        "punch" => Ok(Profile::Punch),
        "point" => Ok(Profile::Point),
        _ => Err(format!("profile {name} is not hertz, punch or point")),
    }
}

/// Rows that one line of input gives, and the least time that a line takes.
fn timed(
    lines: &[(Kernel, Vec<f64>)],
    f: impl Fn(&Kernel, &[f64]) -> Result<Vec<Six>, DomainError>,
) -> Result<(f64, Vec<Six>), DomainError> {
    let (mut least, mut rows) = (f64::INFINITY, vec![]);
    for _ in 0..REPETITIONS {
        let clock = Instant::now();
        rows.clear();
        for (kernel, numbers) in lines {
            rows.extend(f(kernel, numbers)?);
        }
        least = least.min(clock.elapsed().as_secs_f64() / lines.len() as f64);
    }
    Ok((least, rows))
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let argument = |i: usize| arguments.get(i).ok_or("too few arguments: see the source");
    let (profile, tolerance) = (profile(argument(1)?)?, argument(2)?.parse()?);
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text)?;
    let mut lines = vec![];
    for line in text.lines() {
        let numbers: Vec<f64> = line
            .split_whitespace()
            .map(str::parse)
            .collect::<Result<_, _>>()?;
        let medium = Medium::new(*numbers.first().ok_or("an empty line")?)?;
        lines.push((Kernel::new(&medium, profile, tolerance)?, numbers));
    }
    let (seconds, rows) = match argument(0)?.as_str() {
        "steps" => timed(&lines, |kernel, at| {
            let rest = kernel.static_field(at[1], at[2])?;
            let found = kernel.remainder(at[1], at[2], at[3])?.value;
            Ok(vec![std::array::from_fn(|f| rest[f] + found[f])])
        })?,
        "cells" => {
            let (width, count): (f64, usize) = (argument(3)?.parse()?, argument(4)?.parse()?);
            timed(&lines, |kernel, at| {
                let mut rows = vec![Six::default(); count + 1];
                rows[0] = kernel.static_field(at[1], at[2])?;
                kernel.cell_averages(at[1], at[2], width, &mut rows[1..])?;
                Ok(rows)
            })?
        }
        other => return Err(format!("{other} is not steps or cells").into()),
    };
    println!("{seconds:e}");
    for row in rows {
        println!("{}", row.map(|v| format!("{v:e}")).join(" "));
    }
    Ok(())
}
