//! Spectra against the formula of the far field and against superposed traces; tiles that are the same on any number of threads.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{
    Collision, Exact, HalfSpace, Material, Resampler, Results, Settings, Solver, Striker,
};
use halfspace::Attenuation;
use halfspace::random::Stream;
use noise::{Area, Blow, Ground, Motion, Noise, Pulse, Pulses, Receiver, Recording, Source, Tiles};
use realfft::RealFftPlanner;
use std::f64::consts::{PI, TAU};

/// Granite with nu 0.25.
fn block() -> HalfSpace {
    let mut rock = Material::named("granite").unwrap();
    rock.poisson_ratio = 0.25;
    HalfSpace::new(rock).unwrap()
}

/// Balls of some diameters at 1 m/s.
fn blows(diameters_m: &[f64]) -> (Vec<Blow>, Pulses) {
    let collision = |i: usize| {
        let ball = Striker::ball(Material::named("steel").unwrap(), 0.5 * diameters_m[i]);
        Collision::new(&block(), &ball.unwrap(), 1.0)
    };
    let settings = Settings::default();
    let blows: Vec<Blow> = (0..diameters_m.len())
        .map(|i| {
            let solved = Solver::new(&Exact).solve(&collision(i), &settings).unwrap();
            let results = Results::new(&collision(i), &settings, &solved);
            Blow {
                impulse_n_s: results.impulse_n_s,
                contact_time_s: results.contact_time_s,
                peak_at: results.peak_force_time_s / results.contact_time_s,
                radiated_energy_j: results.radiated_energy_j,
                contact_radius_m: results.contact_radius_m,
            }
        })
        .collect();
    let pulses = Pulses::new(&blows, |i| {
        let mut solver = Solver::new(&Exact);
        let (solved, history) = solver.solve_with_history(&collision(i), &settings)?;
        let (contact, contact_time) = (Resampler::new(history), solved.summary.contact_time);
        let force = |t: f64| contact.force(t * contact_time)[0];
        Ok::<_, contact::ContactError>(Pulse::new(force, contact.end() / contact_time))
    });
    (blows, pulses.unwrap())
}

fn noise(source: Source, receivers: &[[f64; 3]], quality_factor: Option<f64>) -> Noise {
    let mut damped = block();
    damped.attenuation = quality_factor.map(|q| Attenuation::new(q, 100.0).unwrap());
    let (blows, pulses) = blows(&[0.01, 0.012, 0.02, 0.05]);
    Noise {
        ground: Ground::new(&damped).unwrap(),
        source,
        nearest_m: 0.0,
        receivers: receivers
            .iter()
            .map(|[x, y, z]| Receiver {
                name: "geophone".to_owned(),
                place_m: [*x, *y],
                depth_m: *z,
            })
            .collect(),
        blows,
        pulses,
    }
}

fn ring(centre_m: [f64; 2], inner_radius_m: f64, radius_m: f64) -> Area {
    Area::Disc {
        centre_m,
        radius_m,
        inner_radius_m,
    }
}

/// kr from 30 on: |G| = N k/(8 rho c_R^2) sqrt(2/(pi k r)) with N = 0.6204 for nu 0.25 (Tsai et al. 2012, with the exact N).
#[test]
fn far_away_it_is_the_rayleigh_wave() {
    let (near_m, far_m, rate) = (300.0, 900.0, 3.0);
    let source = Source::Poisson {
        area: ring([0.0, 0.0], near_m, far_m),
        rate_per_m2_s: rate,
    };
    let noise = noise(source, &[[0.0, 0.0, 0.0]], None);
    let ground = Ground::new(&block()).unwrap();
    let frequency_hz = [50.0, 100.0, 200.0, 500.0];
    let spectra = noise.spectra(&frequency_hz).unwrap();
    let power = spectra.power(0, Motion::Vertical, 0);
    for (i, f) in frequency_hz.into_iter().enumerate() {
        let k = TAU * f / ground.rayleigh_speed_m_s(f);
        let stiffness = 8.0 * block().density_kg_m3() * ground.rayleigh_speed_m_s(f).powi(2);
        let squared = (0.6204 * k / stiffness).powi(2) * 2.0 / (PI * k);
        let rayleigh = 2.0 * rate * spectra.force_n2_s2[i] * squared * TAU * (far_m - near_m);
        let off_db = 10.0 * (power[i] / rayleigh).log10();
        println!("kr {:.0}: {off_db:.4} dB", k * near_m);
        assert!(k * near_m < 30.0 || off_db.abs() < 0.1);
    }
}

/// Powers of listed impacts: those of the kernel, one by one, and of many at random those of their area.
#[test]
fn listed_impacts_add_their_powers() {
    let places_m: Vec<[f64; 2]> = (0..4).map(|i| [5.0 + 3.0 * f64::from(i), 1.0]).collect();
    let source = Source::Listed {
        times_s: vec![0.0; 4],
        places_m: places_m.clone(),
        duration_s: 2.0,
    };
    let all = noise(source, &[[0.0, 0.0, 0.0], [0.0, 1.0, 0.4]], Some(20.0));
    let frequency_hz: Vec<f64> = (1..9).map(|i| 220.0 * f64::from(i)).collect();
    let together = all.spectra(&frequency_hz).unwrap();
    for receiver in 0..2 {
        let mut sum = vec![0.0; frequency_hz.len()];
        for (i, place_m) in places_m.iter().enumerate() {
            let r_m = place_m[0].hypot(place_m[1] - all.receivers[receiver].place_m[1]);
            // a thin ring around the receiver, with the body of this impact
            let [x, y] = all.receivers[receiver].place_m;
            let area = ring([x, y], r_m - 1e-3, r_m + 1e-3);
            let source = Source::Poisson {
                area,
                rate_per_m2_s: 0.5 / area.size_m2(),
            };
            let mut one = noise(
                source,
                &[[x, y, all.receivers[receiver].depth_m]],
                Some(20.0),
            );
            let (own, pulses) = blows(&[[0.01, 0.012, 0.02, 0.05][i]]);
            (one.blows, one.pulses) = (own, pulses);
            let spectra = one.spectra(&frequency_hz).unwrap();
            for (sum, power) in sum.iter_mut().zip(spectra.power(0, Motion::Vertical, 1)) {
                *sum += power;
            }
        }
        let found = together.power(receiver, Motion::Vertical, 1);
        let off = found.iter().zip(&sum).map(|(a, b)| (a / b - 1.0).abs());
        let worst = off.fold(0.0, f64::max);
        println!("receiver {receiver}: {worst:.1e}");
        assert!(worst < 1e-4);
    }
}

/// The spectrum of listed impacts is the mean of periodograms of their traces: within four standard deviations in bands.
#[test]
fn traces_have_the_spectrum() {
    let (samples, step_s) = (32768, 2.5e-4);
    let duration_s = step_s * f64::from(samples);
    let mut random = Stream::new(5);
    let mut places = || [random.within(2.0, 40.0), random.within(-20.0, 20.0)];
    let places_m: Vec<[f64; 2]> = (0..8000).map(|_| places()).collect();
    let times_s = (0..8000)
        .map(|i| duration_s * f64::from(i * 3001 % 8000) / 8000.0)
        .collect();
    let source = Source::Listed {
        times_s,
        places_m,
        duration_s,
    };
    for quality in [None, Some(20.0)] {
        let mut noise = noise(
            source.clone(),
            &[[0.0, 0.0, 0.0], [20.0, 0.0, 0.4]],
            quality,
        );
        let own = blows(&[0.02]);
        noise.blows = vec![own.0[0]; 8000];
        noise.pulses = Pulses::new(&noise.blows, |_| Ok::<_, ()>(own.1.pulse(0).clone())).unwrap();
        let recording = Recording {
            duration_s,
            step_s,
            seed: 3,
        };
        let tiles = Tiles::new(&noise, recording).unwrap();
        let mut traces = vec![0.0; 2 * samples as usize];
        for tile in 0..tiles.count() {
            tiles.add(tile, &tiles.tile(tile).unwrap(), &mut traces);
        }
        let segment = 1024;
        let bands_hz = [[50.0, 200.0], [200.0, 700.0], [700.0, 1900.0]];
        let frequency_hz: Vec<f64> = (1..segment / 2)
            .map(|j| f64::from(j) / (f64::from(segment) * step_s))
            .collect();
        let spectra = noise.spectra(&frequency_hz).unwrap();
        for receiver in 0..2 {
            let trace = &traces[receiver * samples as usize..][..samples as usize];
            let measured = periodogram(trace, segment as usize, step_s);
            let expected = spectra.power(receiver, Motion::Vertical, 1);
            for [from, to] in bands_hz {
                let inside = |f: &f64| (from..to).contains(f);
                let sum = |own: &[f64]| -> f64 {
                    frequency_hz
                        .iter()
                        .zip(own)
                        .filter(|(f, _)| inside(f))
                        .map(|(_, x)| x)
                        .sum()
                };
                let count = frequency_hz.iter().filter(|f| inside(f)).count() as f64;
                let off = sum(&measured[1..]) / sum(&expected) - 1.0;
                // segments overlap by a half under Hann's window
                let sd = (1.4 / (count * f64::from(2 * samples / segment))).sqrt();
                println!("receiver {receiver}, {from} to {to} Hz: {off:.4} +- {sd:.4}");
                assert!(off.abs() < 4.0 * sd + 0.002);
            }
        }
    }
}

/// One-sided power of a trace by Welch's method: Hann windows that overlap by a half.
fn periodogram(trace: &[f64], segment: usize, step_s: f64) -> Vec<f64> {
    let forward = RealFftPlanner::<f64>::new().plan_fft_forward(segment);
    let window: Vec<f64> = (0..segment)
        .map(|i| (PI * (i as f64 + 0.5) / segment as f64).sin().powi(2))
        .collect();
    let unit: f64 = window.iter().map(|w| w * w).sum::<f64>() / step_s;
    let starts = (0..=trace.len() - segment).step_by(segment / 2);
    let mut sum = vec![0.0; segment / 2 + 1];
    let mut count = 0.0;
    for start in starts {
        let mut own: Vec<f64> = trace[start..start + segment]
            .iter()
            .zip(&window)
            .map(|(x, w)| x * w)
            .collect();
        let mut spectrum = forward.make_output_vec();
        forward.process(&mut own, &mut spectrum).unwrap();
        sum.iter_mut()
            .zip(&spectrum)
            .for_each(|(s, x)| *s += x.norm_sqr());
        count += 1.0;
    }
    sum.into_iter().map(|s| 2.0 * s / (count * unit)).collect()
}
