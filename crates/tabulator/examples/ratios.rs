//! Error of interpolating across Poisson's ratio, for several sets of slices and stencils.
//!
//! `cargo run --release -p hertzlamb-tabulator --example ratios`

use halfspace::{Medium, Six};
use lookup::{PulseSum, Series, Smoothness, Stencil};
use tabulator::{PointPlan, quantile};

const LENGTHS: [f64; 4] = [3.0, 10.0, 40.0, 100.0];
const WIDTH: f64 = 0.1;
/// Number of steps of the fine set of ratios, equal in Rayleigh slowness.
const STEPS: usize = 48;
/// The slowness is almost constant near nu = 0; a share of the ratio keeps the coordinate regular there.
const WEIGHT: f64 = 1.0;

fn slowness(nu: f64) -> Result<f64, halfspace::DomainError> {
    Ok(1.0 / Medium::new(nu)?.rayleigh_speed() + WEIGHT * nu)
}

/// Ratios from 0 to 0.45 at equal steps of the Rayleigh slowness, by bisection.
fn ratios() -> Result<Vec<f64>, halfspace::DomainError> {
    let (first, last) = (slowness(0.0)?, slowness(0.45)?);
    (0..=STEPS)
        .map(|i| {
            let wanted = first + (last - first) * i as f64 / STEPS as f64;
            let (mut low, mut high) = (0.0, 0.45);
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if slowness(middle)? < wanted {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            Ok(0.5 * (low + high))
        })
        .collect()
}

/// Responses of the remainder alone and of the whole, at one ratio, for each pulse.
fn responses(nu: f64, r: f64, z: f64) -> Result<Vec<[Vec<Six>; 2]>, Box<dyn std::error::Error>> {
    let end = 1.5 * (6.0_f64.hypot(6.0) + 1.0) / Medium::new(nu)?.rayleigh_speed();
    let cells = (end / WIDTH).ceil() as usize;
    let plan = PointPlan::new(nu, 1e-8, WIDTH, cells, 12)?;
    let point = plan.compute(r, z)?;
    let flat = |values: &[Six]| {
        (0..6)
            .flat_map(|f| values.iter().map(move |six| six[f]))
            .collect::<Vec<f64>>()
    };
    let series = Series::new(
        WIDTH,
        cells,
        flat(&point.averages),
        flat(&point.moments),
        &flat(&point.tail),
    );
    let rest = plan.kernel().static_field(r, z)?;
    Ok(LENGTHS
        .iter()
        .map(|&length| {
            let coarsening = 0;
            let width = WIDTH * f64::from(1_u32 << coarsening);
            let mut cells = vec![[0.0; 6]; ((length + 40.0) / width) as usize];
            series.fill(Smoothness::Smooth, coarsening, &mut cells);
            let pulse = PulseSum::new(length, width);
            [
                pulse.response(&[0.0; 6], &cells),
                pulse.response(&rest, &cells),
            ]
        })
        .collect())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let fine = ratios()?;
    let coordinate = fine
        .iter()
        .map(|&nu| slowness(nu))
        .collect::<Result<Vec<_>, _>>()?;
    let points = [
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
    let mut all = Vec::new();
    for (r, z) in points {
        all.push(
            fine.iter()
                .map(|&nu| responses(nu, r, z))
                .collect::<Result<Vec<_>, _>>()?,
        );
    }
    let every = |step: usize| (0..=STEPS).step_by(step).collect::<Vec<usize>>();
    let sets = [
        ("9 slices", every(6)),
        ("13 slices", every(4)),
        ("17 slices", every(3)),
        ("25 slices", every(2)),
    ];
    for (name, set) in sets {
        let nodes: Vec<f64> = set.iter().map(|&i| coordinate[i]).collect();
        for points in [4, 6, 8] {
            print!("{name:>10}, {points} points:");
            for (p, length) in LENGTHS.iter().enumerate() {
                let mut ratios = Vec::new();
                for place in &all {
                    for (i, &x) in coordinate
                        .iter()
                        .enumerate()
                        .filter(|(i, _)| !set.contains(i))
                    {
                        let stencil = Stencil::one_sided(&nodes, x, points).ok_or("outside")?;
                        for f in 0..6 {
                            let exact = &place[i][p];
                            let peak = exact[1]
                                .iter()
                                .fold(0.0_f64, |most, six| most.max(six[f].abs()));
                            let error = (0..exact[0].len()).fold(0.0_f64, |most, n| {
                                let sum: f64 = stencil
                                    .nodes()
                                    .iter()
                                    .zip(stencil.even())
                                    .map(|(&k, w)| w * place[set[k]][p][0][n][f])
                                    .sum();
                                most.max((sum - exact[0][n][f]).abs())
                            });
                            ratios.push(error / peak);
                        }
                    }
                }
                ratios.sort_by(f64::total_cmp);
                print!(
                    "  T={length} p50 {:.0e} p99 {:.0e} max {:.0e};",
                    quantile(&ratios, 0.5),
                    quantile(&ratios, 0.99),
                    quantile(&ratios, 1.0)
                );
            }
            println!();
        }
    }
    Ok(())
}
