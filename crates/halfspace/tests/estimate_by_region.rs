//! The error that a kernel states under Hertz's pressure, region by region, at points that calibrated nothing.
//!
//! `cargo test -p hertzlamb-halfspace --test estimate_by_region -- --nocapture` prints how many errors exceed their
//! estimate and how many times the error the estimate is. `ESTIMATE_SEED=n` in the environment draws other points.
//!
//! The error is taken against the kernel at tolerance 1e-13, which `tests/reference.rs` compares with independent values.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod support;

use halfspace::random::Stream;
use halfspace::{Arrivals, Kernel, Medium, Profile};
use support::{NAMES, Quantiles, heading, line};

/// Points in each region, at each tolerance.
const POINTS: usize = 1500;

/// Where points are drawn.
#[derive(Debug, Clone, Copy)]
enum Region {
    /// Anywhere to 6.
    General,
    /// Anywhere to 6, within 1e-12 to 1e-2 of an arrival.
    Arrival,
    /// 1e-9 to 0.1 from the edge of the disc, at the surface and 1e-9 to 1 below.
    Edge,
    /// r from 1e-9 to 1e-2, and on the axis.
    Axis,
    Surface,
    /// Depths from 1e-9 to 1e-2.
    Shallow,
    /// 30 to 300 from the load.
    Far,
}

const REGIONS: [Region; 7] = [
    Region::General,
    Region::Arrival,
    Region::Edge,
    Region::Axis,
    Region::Surface,
    Region::Shallow,
    Region::Far,
];

fn place(region: Region, random: &mut Stream) -> [f64; 2] {
    let (r, z) = (random.within(0.0, 6.0), random.within(0.0, 6.0));
    let chance = random.next();
    let mut power = |from, to| 10.0_f64.powf(random.within(from, to));
    match region {
        Region::General | Region::Arrival => [r, z],
        Region::Edge => {
            let side = if r < 3.0 { -1.0 } else { 1.0 };
            let depth = if chance < 0.3 { 0.0 } else { power(-9.0, 0.0) };
            [1.0 + side * power(-9.0, -1.0), depth]
        }
        Region::Axis => [if chance < 0.2 { 0.0 } else { power(-9.0, -2.0) }, z],
        Region::Surface => [r, 0.0],
        Region::Shallow => [r, power(-9.0, -2.0)],
        Region::Far => {
            let distance = power(30.0_f64.log10(), 300.0_f64.log10());
            let angle = 0.5 * std::f64::consts::PI * chance;
            let depth = if z < 1.5 { 0.0 } else { angle.sin() };
            [distance * angle.cos().max(0.01), distance * depth]
        }
    }
}

/// A half-space, a place and a time after the first arrival.
fn draw(region: Region, random: &mut Stream) -> (Medium, [f64; 3]) {
    let medium = Medium::new(random.within(-0.5, 0.4999)).unwrap();
    let [r, z] = place(region, random);
    let arrivals = Arrivals::new(&medium, Profile::Hertz, r, z).unwrap();
    let times = arrivals.sorted();
    let chance = random.next();
    let at_front = match region {
        Region::Arrival => true,
        Region::General
        | Region::Edge
        | Region::Axis
        | Region::Surface
        | Region::Shallow
        | Region::Far => chance < 0.15,
    };
    let t = if at_front {
        let gap = 10.0_f64.powf(random.within(-12.0, -2.0));
        let front = times[(random.next() * times.len() as f64) as usize];
        front * (1.0 + random.within(-1.0, 1.0) * gap)
    } else if chance < 0.6 {
        random.within(arrivals.first(), 1.2 * arrivals.last())
    } else {
        arrivals.first() + random.within(0.0, 20.0)
    };
    (medium, [r, z, t])
}

/// Errors and estimates at some points.
#[derive(Default)]
struct Found {
    /// Estimate over error, where there is one.
    caution: Vec<f64>,
    exceeding: usize,
    total: usize,
    /// Largest error over estimate, and where.
    worst: (f64, String),
}

impl Found {
    fn at(&mut self, medium: &Medium, tolerance: f64, [r, z, t]: [f64; 3]) {
        let [exact, found] = [1e-13, tolerance].map(|tolerance| {
            let kernel = Kernel::new(medium, Profile::Hertz, tolerance).unwrap();
            kernel.remainder(r, z, t).unwrap()
        });
        for (f, name) in NAMES.iter().enumerate() {
            let error = (found.value[f] - exact.value[f]).abs();
            self.total += 1;
            if error > found.error[f] {
                self.exceeding += 1;
                let times = error / found.error[f];
                if times > self.worst.0 {
                    let nu = medium.poisson_ratio();
                    self.worst = (times, format!("{name} nu {nu} r {r:e} z {z:e} t {t:e}"));
                }
            }
            if error > 0.0 {
                self.caution.push(found.error[f] / error);
            }
        }
    }

    fn join(&mut self, other: Self) {
        self.caution.extend(other.caution);
        self.exceeding += other.exceeding;
        self.total += other.total;
        if other.worst.0 > self.worst.0 {
            self.worst = other.worst;
        }
    }

    fn line(&self, label: &str) -> Quantiles {
        let share = 100.0 * self.exceeding as f64 / self.total as f64;
        line(&format!("{label}: {share:.3} %"), &self.caution)
    }
}

#[test]
fn one_error_in_a_thousand_exceeds_its_estimate_which_is_a_hundred_times_the_error() {
    let seed = std::env::var("ESTIMATE_SEED").map_or(20_261_122, |text| text.parse().unwrap());
    let mut all = Found::default();
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        heading(&format!(
            "tolerance {tolerance:e}: share that exceeds its estimate; estimate / error"
        ));
        let mut whole = Found::default();
        for (k, region) in REGIONS.into_iter().enumerate() {
            let mut random = Stream::new(seed + 1000 * k as u64);
            let mut here = Found::default();
            for _ in 0..POINTS {
                let (medium, point) = draw(region, &mut random);
                here.at(&medium, tolerance, point);
            }
            here.line(&format!("{region:?}"));
            whole.join(here);
        }
        whole.line("all");
        println!("worst {:.1} times: {}", whole.worst.0, whole.worst.1);
        all.join(whole);
    }
    heading("all tolerances");
    let found = all.line("all");
    assert!(
        1000 * all.exceeding <= all.total,
        "{} of {} errors exceed their estimate",
        all.exceeding,
        all.total
    );
    assert!(found.p50 <= 100.0, "{found}");
}
