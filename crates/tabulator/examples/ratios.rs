//! Error of interpolating across Poisson's ratio, for several sets of slices, stencils and units of time.
//!
//! `cargo run --release -p hertzlamb-tabulator --example ratios`

use halfspace::{Medium, Six};
use lookup::{Numbers, PulseSum, Series, Smoothness, Stencil};
use rayon::prelude::*;
use tabulator::{PointPlan, quantile};

type Failure = Box<dyn std::error::Error + Send + Sync>;

/// In r0/c1.
const LENGTHS: [f64; 4] = [3.0, 10.0, 40.0, 100.0];
/// Width of a cell at nu = 0.3, in r0/c1.
const WIDTH: f64 = 0.1;
/// Number of steps of the fine set of ratios.
const STEPS: usize = 48;
const LAST: f64 = 0.45;

/// Unit of time that is kept the same in all slices.
#[derive(Clone, Copy)]
enum Clock {
    Longitudinal,
    Shear,
    Rayleigh,
}

impl Clock {
    fn unit(self, nu: f64) -> Result<f64, Failure> {
        let medium = Medium::new(nu)?;
        Ok(match self {
            Self::Longitudinal => 1.0,
            Self::Shear => 1.0 / medium.kappa(),
            Self::Rayleigh => 1.0 / medium.rayleigh_speed(),
        })
    }

    fn width(self, nu: f64) -> Result<f64, Failure> {
        Ok(WIDTH * self.unit(nu)? / self.unit(0.3)?)
    }
}

fn slowness(nu: f64, weight: f64) -> Result<f64, Failure> {
    Ok(1.0 / Medium::new(nu)?.rayleigh_speed() + weight * nu)
}

fn speed(nu: f64, weight: f64) -> Result<f64, Failure> {
    Ok(-Medium::new(nu)?.rayleigh_speed() + weight * nu)
}

fn ratios(coordinate: impl Fn(f64) -> Result<f64, Failure>) -> Result<Vec<f64>, Failure> {
    let (first, last) = (coordinate(0.0)?, coordinate(LAST)?);
    (0..=STEPS)
        .map(|i| {
            let wanted = first + (last - first) * i as f64 / STEPS as f64;
            let (mut low, mut high) = (0.0, LAST);
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if coordinate(middle)? < wanted {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            Ok(0.5 * (low + high))
        })
        .collect()
}

/// Cells of the remainder at one ratio, and the static part.
fn series(nu: f64, width: f64, r: f64, z: f64, count: usize) -> Result<(Vec<Six>, Six), Failure> {
    let end = 1.2 * (6.0_f64.hypot(6.0) + 1.0) / Medium::new(nu)?.rayleigh_speed();
    let cells = (end / width).ceil() as usize;
    let plan = PointPlan::new(nu, 1e-8, width, cells, 12)?;
    let point = plan.compute(r, z)?;
    let flat = |values: &[Six]| {
        (0..6)
            .flat_map(|f| values.iter().map(move |six| six[f]))
            .collect::<Vec<f64>>()
    };
    let numbers = Numbers {
        averages: flat(&point.averages),
        moments: flat(&point.moments),
        curvatures: flat(&point.curvatures),
        tail: flat(&point.tail),
    };
    let series = Series::new(width, cells, numbers);
    let mut out = vec![[0.0; 6]; count];
    series.fill(Smoothness::Smooth, 0, &mut out);
    Ok((out, plan.kernel().static_field(r, z)?))
}

/// Places (r, z) in r0.
const POINTS: [(f64, f64); 10] = [
    (0.1, 0.3),
    (0.5, 0.6),
    (1.05, 0.1),
    (1.5, 1.2),
    (0.2, 3.1),
    (3.1, 0.2),
    (3.0, 3.0),
    (5.5, 0.3),
    (0.4, 5.6),
    (5.5, 5.5),
];

/// Coordinate in which slices are interpolated.
#[derive(Clone, Copy, PartialEq)]
enum Coordinate {
    Slowness,
    Speed,
    Ratio,
}

impl Coordinate {
    fn of(self, nu: f64) -> Result<f64, Failure> {
        match self {
            Self::Slowness => slowness(nu, 1.0),
            Self::Speed => speed(nu, 0.2),
            Self::Ratio => Ok(nu),
        }
    }
}

fn main() -> Result<(), Failure> {
    for (clock, clock_name) in [
        (Clock::Longitudinal, "c1"),
        (Clock::Shear, "c2"),
        (Clock::Rayleigh, "cR"),
    ] {
        for (coordinate, name) in [
            (Coordinate::Slowness, "slowness + nu"),
            (Coordinate::Speed, "-speed"),
            (Coordinate::Ratio, "nu"),
        ] {
            if matches!(clock, Clock::Longitudinal) && coordinate != Coordinate::Slowness {
                continue;
            }
            let fine = ratios(|nu| coordinate.of(nu))?;
            let places: Vec<(f64, f64)> = fine
                .iter()
                .map(|&nu| Ok((coordinate.of(nu)?, clock.width(nu)?)))
                .collect::<Result<_, Failure>>()?;
            let count = ((100.0 + 40.0) / places[0].1) as usize;
            let all: Vec<Vec<(Vec<Six>, Six)>> = POINTS
                .par_iter()
                .map(|&(r, z)| {
                    fine.iter()
                        .zip(&places)
                        .map(|(&nu, &(_, width))| series(nu, width, r, z, count))
                        .collect::<Result<_, _>>()
                })
                .collect::<Result<_, _>>()?;
            for step in [8, 6, 4, 3] {
                for points in [6, 8] {
                    let slices = STEPS / step + 1;
                    print!("{clock_name} {name:>14} {slices:>2} slices, {points} points:");
                    for length in LENGTHS {
                        let errors = errors(&all, &places, step, points, length)?;
                        let [p50, p99, most] = [0.5, 0.99, 1.0].map(|q| quantile(&errors, q));
                        print!("  T={length} {p50:.0e} {p99:.0e} {most:.0e};");
                    }
                    println!();
                }
            }
        }
    }
    Ok(())
}

/// Errors over peaks, sorted, in the middle between slices that are every `step`-th of the fine set.
fn errors(
    all: &[Vec<(Vec<Six>, Six)>],
    places: &[(f64, f64)],
    step: usize,
    points: usize,
    length: f64,
) -> Result<Vec<f64>, Failure> {
    let set: Vec<usize> = (0..=STEPS).step_by(step).collect();
    let nodes: Vec<f64> = set.iter().map(|&i| places[i].0).collect();
    let mut errors = Vec::new();
    for place in all {
        for i in (0..=STEPS).filter(|i| i % step == step / 2) {
            let (x, width) = places[i];
            let interval = lookup::locate(&nodes, x).ok_or("outside")?;
            let stencil = Stencil::one_sided(&nodes, interval, x, points);
            let (exact, rest) = &place[i];
            let samples = (((length + 40.0) / width) as usize).min(exact.len());
            let found = |n: usize, f: usize| -> f64 {
                let weighted = stencil.nodes().iter().zip(stencil.even());
                weighted.map(|(&k, w)| w * place[set[k]].0[n][f]).sum()
            };
            let difference: Vec<Six> = (0..samples)
                .map(|n| std::array::from_fn(|f| found(n, f) - exact[n][f]))
                .collect();
            let pulse = PulseSum::new(length, width);
            let whole = pulse.response(rest, &exact[..samples]);
            let wrong = pulse.response(&[0.0; 6], &difference);
            let most =
                |list: &[Six], f: usize| list.iter().fold(0.0_f64, |m, six| m.max(six[f].abs()));
            errors.extend((0..6).map(|f| most(&wrong, f) / most(&whole, f)));
        }
    }
    errors.sort_by(f64::total_cmp);
    Ok(errors)
}
