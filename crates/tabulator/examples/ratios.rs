//! Error of interpolating across Poisson's ratio, for several sets of slices, stencils and units of time.
//!
//! `cargo run --release -p hertzlamb-tabulator --example ratios`

use halfspace::{Medium, Six};
use lookup::{PulseSum, Series, Smoothness, Stencil};
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
    let series = Series::new(width, cells, point);
    let mut out = vec![[0.0; 6]; count];
    series.fill(Smoothness::Smooth, 0, &mut out);
    Ok((out, plan.kernel().static_field(r, z)?))
}

/// Where errors are looked at, (r, z) in r0.
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

/// Cells and static parts of all fine ratios at all points, with coordinate and cell width of each ratio.
struct Fine {
    places: Vec<(f64, f64)>,
    points: Vec<Vec<(Vec<Six>, Six)>>,
    count: usize,
}

impl Fine {
    fn new(
        clock: Clock,
        coordinate: impl Fn(f64) -> Result<f64, Failure>,
    ) -> Result<Self, Failure> {
        let fine = ratios(&coordinate)?;
        let places: Vec<(f64, f64)> = fine
            .iter()
            .map(|&nu| Ok((coordinate(nu)?, clock.width(nu)?)))
            .collect::<Result<_, Failure>>()?;
        let count = ((100.0 + 40.0) / places[0].1) as usize;
        let points = POINTS
            .par_iter()
            .map(|&(r, z)| {
                fine.iter()
                    .zip(&places)
                    .map(|(&nu, &(_, width))| series(nu, width, r, z, count))
                    .collect::<Result<_, _>>()
            })
            .collect::<Result<_, _>>()?;
        Ok(Self {
            places,
            points,
            count,
        })
    }

    /// Sorted errors over the peak for pulses of a length, of slices `step` apart and a stencil.
    fn errors(&self, step: usize, stencil: usize, length: f64) -> Result<Vec<f64>, Failure> {
        let set: Vec<usize> = (0..=STEPS).step_by(step).collect();
        let nodes: Vec<f64> = set.iter().map(|&i| self.places[i].0).collect();
        let mut errors = Vec::new();
        for point in &self.points {
            for i in (0..=STEPS).filter(|i| i % step == step / 2) {
                let (x, width) = self.places[i];
                let interval = lookup::locate(&nodes, x).ok_or("outside")?;
                let stencil = Stencil::one_sided(&nodes, interval, x, stencil);
                let samples = (((length + 40.0) / width) as usize).min(self.count);
                let exact = &point[i];
                let mixed = |n: usize, f: usize| {
                    let nodes = stencil.nodes().iter().zip(stencil.even());
                    nodes.map(|(&k, w)| w * point[set[k]].0[n][f]).sum::<f64>()
                };
                let difference: Vec<Six> = (0..samples)
                    .map(|n| std::array::from_fn(|f| mixed(n, f) - exact.0[n][f]))
                    .collect();
                let pulse = PulseSum::new(length, width);
                let whole = pulse.response(&exact.1, &exact.0[..samples]);
                let wrong = pulse.response(&[0.0; 6], &difference);
                let most = |list: &[Six], f: usize| {
                    list.iter().fold(0.0_f64, |m, six| m.max(six[f].abs()))
                };
                errors.extend((0..6).map(|f| most(&wrong, f) / most(&whole, f)));
            }
        }
        errors.sort_by(f64::total_cmp);
        Ok(errors)
    }
}

fn main() -> Result<(), Failure> {
    for (clock, clock_name) in [
        (Clock::Longitudinal, "c1"),
        (Clock::Shear, "c2"),
        (Clock::Rayleigh, "cR"),
    ] {
        for (kind, kind_name) in [(0, "slowness + nu"), (1, "-speed"), (2, "nu")] {
            if matches!(clock, Clock::Longitudinal) && kind != 0 {
                continue;
            }
            let fine = Fine::new(clock, |nu| match kind {
                0 => slowness(nu, 1.0),
                1 => speed(nu, 0.2),
                _ => Ok(nu),
            })?;
            for (step, stencil) in [8, 6, 4, 3].into_iter().flat_map(|s| [(s, 6), (s, 8)]) {
                let slices = STEPS / step + 1;
                print!("{clock_name} {kind_name:>14} {slices:>2} slices, {stencil} points:");
                for length in LENGTHS {
                    let errors = fine.errors(step, stencil, length)?;
                    let [median, most, all] = [0.5, 0.99, 1.0].map(|q| quantile(&errors, q));
                    print!("  T={length} {median:.0e} {most:.0e} {all:.0e};");
                }
                println!();
            }
        }
    }
    Ok(())
}
