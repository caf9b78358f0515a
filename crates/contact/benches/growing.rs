//! The growing contact and the area dashpot: time of a random scene, by tolerance.
//!
//! `cargo bench --package hertzlamb-contact --bench growing`

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use contact::law::area_dashpot::AreaDashpot;
use contact::{Accuracy, GrowingContact, PunchWaves, solve_growing};
use criterion::{Criterion, criterion_group, criterion_main};
use halfspace::Medium;
use std::hint::black_box;
use std::time::Instant;

/// Waves, phi and tau of balls and half-spaces of 1 MPa to 400 GPa at 1e-4 to 5e-2 of the shear wave speed.
fn scenes() -> Vec<(PunchWaves, f64, f64)> {
    (1..=300_u32)
        .map(|i| {
            // equidistributed (Kronecker's sequence of square roots)
            let part = |root: f64| (f64::from(i) * root.sqrt()).fract();
            let between = |low: f64, high: f64, x: f64| low * (high / low).powf(x);
            let nu = 0.49 * part(2.0);
            let density = between(0.1, 10.0, part(3.0)) * between(0.3, 10.0, part(5.0));
            let striker = between(2.5e-6, 4e5, part(7.0));
            let velocity = between(1e-4, 5e-2, part(11.0));
            // half-space of shear modulus and density one
            let target = 2.0 / (1.0 - nu);
            let modulus = 1.0 / (1.0 / target + 1.0 / striker);
            let approach = (3.927 * density * velocity * velocity / modulus).powf(0.4);
            let fast = ((2.0 - 2.0 * nu) / (1.0 - 2.0 * nu)).sqrt();
            let waves = PunchWaves::new(&Medium::new(nu).unwrap());
            (waves, modulus / target, velocity / approach.sqrt() / fast)
        })
        .collect()
}

fn growing(c: &mut Criterion) {
    let scenes = scenes();
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let accuracy = Accuracy::of_contact(tolerance, None);
        let solve = |i: usize| {
            let (waves, target_share, wave_time) = &scenes[i];
            let (target_share, wave_time) = (*target_share, *wave_time);
            solve_growing(
                &GrowingContact {
                    waves,
                    target_share,
                    wave_time,
                },
                &accuracy,
            )
            .unwrap()
        };
        let mut times: Vec<f64> = (0..scenes.len())
            .map(|i| {
                let once = || {
                    let start = Instant::now();
                    black_box(solve(i));
                    start.elapsed().as_secs_f64()
                };
                (0..5).map(|_| once()).fold(f64::INFINITY, f64::min)
            })
            .collect();
        times.sort_by(f64::total_cmp);
        println!(
            "growing at {tolerance:e}: median {:.3} ms, 99 % {:.3} ms, largest {:.3} ms",
            1e3 * times[times.len() / 2],
            1e3 * times[times.len() * 99 / 100],
            1e3 * times[times.len() - 1]
        );
        let mut i = 0;
        c.bench_function(
            &format!("growing at {tolerance:e}, all scenes in turn"),
            |b| {
                b.iter(|| {
                    i = (i + 1) % scenes.len();
                    solve(i)
                });
            },
        );
    }
    let terms: Vec<AreaDashpot> = scenes
        .iter()
        .map(|&(ref waves, target_share, wave_time)| {
            AreaDashpot::new(&GrowingContact {
                waves,
                target_share,
                wave_time,
            })
        })
        .collect();
    let mut i = 0;
    c.bench_function("area dashpot", |b| {
        b.iter(|| {
            i = (i + 1) % terms.len();
            terms[i].summary()
        });
    });
    c.bench_function("waves of a Poisson's ratio and their first rules", |b| {
        b.iter(|| {
            let waves = PunchWaves::new(&Medium::new(black_box(0.3)).unwrap());
            solve_growing(
                &GrowingContact {
                    waves: &waves,
                    target_share: 0.5,
                    wave_time: 0.01,
                },
                &Accuracy::of_contact(1e-4, None),
            )
        });
    });
}

criterion_group!(benches, growing);
criterion_main!(benches);
