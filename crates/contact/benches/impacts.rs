//! Impacts a second of each model, with the accuracy reached; the explicit scheme at equal accuracy beside them.
//!
//! `cargo bench --package hertzlamb-contact --bench impacts`

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use contact::{
    Choice, Collision, HalfSpace, Material, Model, Results, Settings, Solver, StaticShare, Striker,
    Summary, Tabulated, march_explicit, march_implicit,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use halfspace::{Deflection, Medium, SurfaceResponse};
use std::hint::black_box;
use std::time::Instant;

const TARGETS: [&str; 5] = ["steel", "granite", "soda-lime-glass", "aluminium", "pmma"];
const STRIKERS: [&str; 4] = ["steel", "copper", "alumina-99.5", "soda-lime-glass"];

/// A thousand balls of 0.2 to 20 mm at 0.05 to 50 m/s on discs of 0.3 to 3 of their contact radii.
fn scenes(model: Model) -> Vec<(Collision, Settings)> {
    (0..1000_u32)
        .map(|i| {
            // equidistributed in five dimensions (Kronecker's sequence of square roots)
            let part = |root: f64| (f64::from(i) * root).fract();
            let between = |low: f64, high: f64, x: f64| low * (high / low).powf(x);
            let tip = between(2e-4, 2e-2, part(2f64.sqrt()));
            let mass = 4.19 * tip.powi(3) * between(1500.0, 9000.0, part(3f64.sqrt()));
            let velocity = between(0.05, 50.0, part(5f64.sqrt()));
            let disc =
                tip * 0.6 * (velocity / 3000.0).powf(0.4) * between(0.3, 3.0, part(7f64.sqrt()));
            let named = |name: &str| Material::named(name).unwrap();
            let target = HalfSpace::new(named(TARGETS[i as usize % 5])).unwrap();
            let striker = Striker::new(named(STRIKERS[i as usize / 5 % 4]), mass, tip).unwrap();
            let settings = Settings {
                model,
                tolerance: 1e-4,
                loss_tolerance: Some(1e-3),
                disc_radius_m: matches!(model, Model::Wave | Model::Auto).then_some(disc),
                ..Settings::default()
            };
            (Collision::new(&target, &striker, velocity), settings)
        })
        .collect()
}

/// Errors against the same model with a tolerance of 1e-8, of force, time, restitution and of the loss.
fn accuracy(scenes: &[(Collision, Settings)], responses: &Tabulated) -> String {
    let mut solver = Solver::new(responses);
    let mut errors: Vec<(f64, f64)> = scenes
        .iter()
        .filter_map(|(collision, settings)| {
            let closer = Settings {
                tolerance: 1e-8,
                loss_tolerance: Some(1e-6),
                ..*settings
            };
            let exact = solver.solve(collision, &closer).ok()?.summary;
            let found = solver.solve(collision, settings).ok()?.summary;
            Some((found.distance(&exact), found.loss_distance(&exact)))
        })
        .collect();
    let mut quantiles = |of: fn(&(f64, f64)) -> f64| {
        errors.sort_by(|a, b| of(a).total_cmp(&of(b)));
        let at = |share: f64| of(&errors[((errors.len() - 1) as f64 * share) as usize]);
        format!(
            "median {:.1e}, 99 % {:.1e}, largest {:.1e}",
            at(0.5),
            at(0.99),
            at(1.0)
        )
    };
    let contact = quantiles(|e| e.0);
    let loss = quantiles(|e| e.1);
    format!(
        "force, time, restitution: {contact}; loss: {loss}; {} scenes",
        errors.len()
    )
}

fn models(c: &mut Criterion) {
    let responses = Tabulated::default();
    let mut group = c.benchmark_group("impacts");
    for model in [
        Model::Hertz,
        Model::Radiation,
        Model::AreaDashpot,
        Model::Wave,
        Model::Auto,
        Model::Growing,
    ] {
        let all = scenes(model);
        // the growing contact is marched in tenths of milliseconds
        let scenes = if model == Model::Growing {
            &all[..50]
        } else {
            &all[..]
        };
        if model == Model::Wave {
            println!("{}: {}", model.name(), accuracy(scenes, &responses));
        }
        let mut solver = Solver::new(&responses);
        group.throughput(Throughput::Elements(scenes.len() as u64));
        group.bench_function(model.name(), |b| {
            b.iter(|| {
                for (collision, settings) in scenes {
                    let _ = black_box(solver.solve(black_box(collision), settings));
                }
            });
        });
    }
    group.finish();
}

/// Ten thousand copper balls of 4 to 10 mm at 0.1 to 10 m/s on steel, on discs of 0.5 to 2 of their contact radii.
fn alike(model: Model) -> Vec<(Collision, Settings)> {
    let named = |name: &str| Material::named(name).unwrap();
    let target = HalfSpace::new(named("steel")).unwrap();
    (0..10_000_u32)
        .map(|i| {
            let part = |root: f64| (f64::from(i) * root.sqrt()).fract();
            let between = |low: f64, high: f64, x: f64| low * (high / low).powf(x);
            let tip = between(2e-3, 5e-3, part(2.0));
            let mass = 4.19 * tip.powi(3) * between(7000.0, 8500.0, part(3.0));
            let velocity = between(0.1, 10.0, part(5.0));
            let disc = 0.6 * tip * (1.0_f64 / 3000.0).powf(0.4) * between(0.5, 2.0, part(7.0));
            let striker = Striker::new(named("copper"), mass, tip).unwrap();
            let settings = Settings {
                model,
                tolerance: 1e-6,
                disc_radius_m: (model == Model::Wave).then_some(disc),
                ..Settings::default()
            };
            (Collision::new(&target, &striker, velocity), settings)
        })
        .collect()
}

/// Impacts of one pair of materials whose outcomes come from series, with their results and nothing but statistics of
/// them; before, how long the series take to be made, and how good they are against marches to 1e-9.
fn contracted(c: &mut Criterion) {
    let responses = Tabulated::default();
    let mut group = c.benchmark_group("impacts from series");
    for model in [Model::Growing, Model::Wave] {
        let rows = alike(model);
        let mut marches = Solver::new(&responses);
        let outcomes = marches.outcomes(1_000_000, rows.iter().step_by(10).copied());
        let mut solver = Solver::sharing(&responses, &outcomes);
        let start = Instant::now();
        let solved: Vec<_> = rows
            .iter()
            .map(|(collision, settings)| solver.solve(collision, settings).unwrap())
            .collect();
        let made_s = start.elapsed().as_secs_f64();
        let from_series = solved
            .iter()
            .zip(&rows)
            .filter(|(one, _)| one.scheme.is_none());
        let (mut count, mut beyond, mut worst) = (0, 0, 0.0_f64);
        for (found, (collision, settings)) in from_series {
            let exactly = Settings {
                tolerance: 1e-9,
                ..*settings
            };
            if let Ok(exact) = marches.solve(collision, &exactly) {
                let error = found.summary.distance(&exact.summary);
                count += 1;
                beyond += usize::from(error > found.error);
                worst = worst.max(error);
            }
        }
        println!(
            "{}: {made_s:.2} s with the series to be made for 10,000 rows, {count} of them from series; off by {worst:.1e} at most, {beyond} beyond the certificate",
            model.name()
        );
        group.throughput(Throughput::Elements(count as u64));
        let rows: Vec<_> = (rows.iter().zip(&solved))
            .filter(|(_, one)| one.scheme.is_none())
            .map(|(row, _)| *row)
            .collect();
        group.bench_function(
            format!("{}, restitution and peak force", model.name()),
            |b| {
                b.iter(|| {
                    let (mut sum, mut largest) = (0.0, 0.0_f64);
                    for (collision, settings) in black_box(&rows) {
                        let Summary {
                            restitution,
                            peak_force,
                            ..
                        } = solver.solve(collision, settings).unwrap().summary;
                        sum += restitution;
                        largest = largest.max(peak_force);
                    }
                    (sum, largest)
                });
            },
        );
        group.bench_function(format!("{}, all results in SI", model.name()), |b| {
            b.iter(|| {
                let (mut sum, mut largest) = (0.0, 0.0_f64);
                for (collision, settings) in black_box(&rows) {
                    let solved = solver.solve(collision, settings).unwrap();
                    let results = Results::new(collision, settings, &solved);
                    sum += results.restitution;
                    largest = largest.max(results.peak_force_n);
                }
                (sum, largest)
            });
        });
    }
    group.finish();
}

/// How many times slower the explicit scheme is where both reach 1e-4 on force, time and restitution.
fn explicit(c: &mut Criterion) {
    let all = scenes(Model::Wave);
    let responses = Tabulated::default();
    let mut solver = Solver::new(&responses);
    let mut ratios = Vec::new();
    for (collision, settings) in all.iter().step_by(97) {
        let medium = Medium::new(collision.target_poisson_ratio).unwrap();
        let response = SurfaceResponse::new(&medium, Deflection::Centre);
        let disc = settings.disc_radius_m.unwrap();
        let impact = collision.fixed_disc(&response, disc, StaticShare::Full);
        let exact = Summary::new(&march_implicit(&impact, 1e-3).unwrap()).unwrap();
        let start = Instant::now();
        for _ in 0..100 {
            let _ = black_box(solver.solve(collision, settings));
        }
        let implicit_s = start.elapsed().as_secs_f64() / 100.0;
        // first the impulse response, which both schemes have ready
        let _ = response.impulse(0.1);
        let mut steps = 200.0;
        while steps < 1e6 {
            let start = Instant::now();
            let done = march_explicit(&impact, exact.contact_time / steps);
            let explicit_s = start.elapsed().as_secs_f64();
            if let Ok((_, summary)) = done
                && summary.distance(&exact) <= 1e-4
            {
                ratios.push((explicit_s / implicit_s, steps));
                break;
            }
            steps *= 2.0;
        }
    }
    ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
    let middle = ratios[ratios.len() / 2];
    println!(
        "explicit at 1e-4 on force, time, restitution: {:.0} times slower (median of {} scenes, {} steps; {:.0} to {:.0} times)",
        middle.0,
        ratios.len(),
        middle.1,
        ratios[0].0,
        ratios[ratios.len() - 1].0
    );
    // the paper's own case: elsewhere 200 steps may be too few for the scheme to be stable
    let named = |name: &str| Material::named(name).unwrap();
    let block = HalfSpace::new(named("steel")).unwrap();
    let rod = Striker::new(named("copper"), 0.0122, 0.004).unwrap();
    let response = SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Centre);
    let collision = Collision::new(&block, &rod, 100.0);
    let impact = collision.fixed_disc(&response, 0.004, StaticShare::Full);
    let exact = Summary::new(&march_implicit(&impact, 1e-3).unwrap()).unwrap();
    let step = exact.contact_time / 200.0;
    c.bench_function("explicit, the paper's 200 steps", |b| {
        b.iter(|| march_explicit(black_box(&impact), step).unwrap());
    });
}

criterion_group!(benches, models, contracted, explicit);
criterion_main!(benches);
