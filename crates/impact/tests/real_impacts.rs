//! Fields of balls that strike, beside an integral over the force's past: error over the peak of each field at its place.
//!
//! `cargo test --release -p hertzlamb-impact --test real_impacts -- --nocapture`
//!
//! `HERTZLAMB_SCENES=40` draws as many scenes, `HERTZLAMB_TABLE=kernels.h5` looks the kernels up as well.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{HalfSpace, Library, Model, Settings, Striker};
use halfspace::random::Stream;
use impact::{Excitation, Impact, KernelSource};
use lookup::TableFile;
use std::env;
use std::path::Path;
use std::sync::Arc;

/// Of the force and the fields.
const TOLERANCE: f64 = 1e-4;

/// A ball of a library material on a block of another; every other contact on a disc of up to twelve times its largest radius.
fn scene(index: u64, draws: &mut Stream) -> Excitation {
    let library = Library::built_in();
    let dense: Vec<_> = library
        .iter()
        .filter(|m| m.density_kg_m3.is_some() && m.youngs_modulus_pa > 1e9)
        .collect();
    let pick = |x: f64| dense[(x * dense.len() as f64) as usize].clone();
    let target = HalfSpace::new(pick(draws.next())).unwrap();
    let ball = Striker::ball(pick(draws.next()), draws.log(5e-4, 2e-2)).unwrap();
    let speed = target.longitudinal_speed_m_s() * draws.log(1e-5, 5e-2);
    let mut impact = Impact::new(target, ball, speed);
    impact.settings.tolerance = TOLERANCE;
    let free = impact.solve().unwrap();
    if index.is_multiple_of(2) {
        return free.excitation().clone();
    }
    let radius_m = free.excitation().radius().largest_m() * draws.log(0.8, 12.0);
    impact.settings = Settings {
        model: Model::Wave,
        disc_radius_m: Some(radius_m),
        static_share: contact::StaticShare::Dynamic,
        ..impact.settings
    };
    match impact.solve() {
        Ok(run) => run.excitation().clone(),
        Err(_) => free.excitation().on_disc(radius_m),
    }
}

/// Errors over peaks and over estimates of one source, by how long the contact lasts, then of those that follow the load.
#[derive(Default)]
struct Found {
    errors: [Vec<f64>; 6],
    /// Estimates over errors.
    bars: [Vec<f64>; 6],
    warned: usize,
    over_estimate: usize,
}

impl Found {
    fn judge(
        &mut self,
        class: usize,
        excitation: &Excitation,
        source: &KernelSource,
        place: [f64; 2],
    ) {
        let fields = excitation
            .fields_from(source.clone())
            .to_tolerance(TOLERANCE);
        let history = fields.at(place[0], place[1]).unwrap();
        let step = (history.time_s.len() / 24).max(1);
        let instants: Vec<usize> = (0..history.time_s.len()).step_by(step).collect();
        let exact: Vec<_> = instants
            .iter()
            .map(|&n| {
                let found = excitation.instant(place, history.time_s[n], 1e-6).unwrap();
                found.unwrap()
            })
            .collect();
        for field in halfspace::FIELDS {
            let trace = &history[field];
            let peak = trace.peak().abs();
            if peak == 0.0 {
                continue;
            }
            let off = |(&n, x): (&usize, &[f64; 6])| (trace.samples[n] - x[field.index()]).abs();
            let error = instants.iter().zip(&exact).map(off).fold(0.0, f64::max);
            self.errors[class].push(error / peak);
            self.bars[class].push(trace.error / error.max(1e-6 * peak));
            if error > TOLERANCE * peak {
                println!(
                    "{place:?} m, {} of {:.1} a/c1, contact of {:.1}: {field:?} off by {:.1e}",
                    if matches!(excitation.radius(), impact::PressureRadius::Fixed(_)) {
                        "disc"
                    } else {
                        "growing"
                    },
                    place[0].hypot(place[1]) / excitation.units().disc_radius_m,
                    excitation.end_s() / excitation.units().time_s(),
                    error / peak
                );
            }
            self.warned += usize::from(trace.error > TOLERANCE * peak);
            // what the reference itself may be off
            self.over_estimate += usize::from(error > trace.error + 1e-6 * peak);
        }
    }

    fn print(&mut self, name: &str) {
        let lengths = ["below 5", "5 to 15", "above 15"];
        let classes = ["disc", "growing"];
        let classes = classes
            .iter()
            .flat_map(|of| lengths.map(|length| (of, length)));
        let count: usize = self.errors.iter().map(Vec::len).sum();
        let all = self.errors.iter_mut().zip(&mut self.bars);
        for ((of, length), (errors, bars)) in classes.zip(all) {
            errors.sort_by(f64::total_cmp);
            bars.sort_by(f64::total_cmp);
            let at = |of: &[f64], q: f64| {
                let place = (of.len().saturating_sub(1) as f64 * q) as usize;
                of.get(place).copied().unwrap_or(f64::NAN)
            };
            println!(
                "{name}, {of}, contacts of {length} a/c1: {} fields, error over peak p50 {:.1e}, p99 {:.1e}, largest {:.1e}; estimate over error p50 {:.1e}",
                errors.len(),
                at(errors, 0.5),
                at(errors, 0.99),
                at(errors, 1.0),
                at(bars, 0.5)
            );
        }
        println!(
            "{name}: {} of {count} above their estimate; estimates above the tolerance {}",
            self.over_estimate, self.warned
        );
    }
}

#[test]
fn fields_of_real_impacts_hold_the_tolerance() {
    let scenes: u64 = env::var("HERTZLAMB_SCENES").map_or(10, |n| n.parse().unwrap());
    let table = env::var("HERTZLAMB_TABLE").ok();
    let table = table.map(|path| TableFile::open(Path::new(&path)).unwrap());
    let (mut direct, mut looked_up) = (Found::default(), Found::default());
    for index in 0..scenes {
        let mut draws = Stream::new(1000 * index + 5);
        let excitation = scene(index, &mut draws);
        let medium = excitation.medium();
        let radius_m = excitation.units().disc_radius_m;
        let contact = excitation.end_s() / excitation.units().time_s();
        let growing = !matches!(excitation.radius(), impact::PressureRadius::Fixed(_));
        let class = usize::from(contact > 5.0) + usize::from(contact > 15.0);
        let class = class + 3 * usize::from(growing);
        let computed = KernelSource::direct(medium, 1e-5).unwrap();
        for _ in 0..3 {
            let place = [5.5 * draws.next() * radius_m, 5.5 * draws.next() * radius_m];
            direct.judge(class, &excitation, &computed, place);
            if let Some(table) = &table {
                let span = [place.map(|x| x / radius_m), [5.9; 2]];
                let part = table.part(medium.poisson_ratio(), span).unwrap();
                looked_up.judge(
                    class,
                    &excitation,
                    &KernelSource::Table(Arc::new(part)),
                    place,
                );
            }
        }
    }
    direct.print("computed");
    if table.is_some() {
        looked_up.print("looked up");
    }
    let mut all: Vec<f64> = direct.errors.concat();
    all.sort_by(f64::total_cmp);
    assert!(all[(all.len() - 1) * 99 / 100] < TOLERANCE);
    assert!(direct.over_estimate <= all.len() / 100);
}
