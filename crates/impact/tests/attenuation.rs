//! Fields of a block with attenuation: against frequency responses, and without attenuation in its limit.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{HalfSpace, Material, Settings, Striker};
use halfspace::{Attenuation, Kernel, Medium, Profile, gauss};
use impact::{ForceRecord, KernelChoice, Load, Outcome, Probe, Quantity, Scene, Strike, simulate};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

const NU: f64 = 0.3;
const REFERENCE_HZ: f64 = 2e5;

fn block(quality_factor: Option<f64>) -> HalfSpace {
    let mut block = HalfSpace::new(Material::elastic(70e9, NU, 2700.0).unwrap()).unwrap();
    block.attenuation = quality_factor.map(|q| Attenuation::new(q, REFERENCE_HZ).unwrap());
    block
}

fn scene(target: HalfSpace, load: Load, places: &[[f64; 2]]) -> Scene {
    Scene {
        target,
        load,
        settings: Settings {
            tolerance: 1e-5,
            disc_radius_m: None,
            ..Settings::default()
        },
        probes: places
            .iter()
            .map(|&[r_m, z_m]| Probe { r_m, z_m })
            .collect(),
        section: None,
        sensors: Vec::new(),
        quantities: vec![Quantity::VelocityR, Quantity::VelocityZ],
        peaks: false,
        duration_s: None,
        low_pass_hz: None,
    }
}

fn ball(velocity_m_s: f64) -> Load {
    Load::Strike(Strike {
        striker: Striker::ball(Material::named("bearing-steel").unwrap(), 0.002).unwrap(),
        velocity_m_s,
    })
}

/// sin^4 over a length, in many lines.
fn pulse(length_s: f64) -> Load {
    let time_s: Vec<f64> = (0..=4000)
        .map(|i| length_s * f64::from(i) / 4000.0)
        .collect();
    let force_n = time_s
        .iter()
        .map(|t| (PI * t / length_s).sin().powi(4))
        .collect();
    Load::Record(ForceRecord::new(time_s, force_n).unwrap())
}

/// Its Fourier transform at the angular frequency omega.
fn transform(length_s: f64, omega: f64) -> Complex64 {
    let rule = gauss::rule(60);
    let i = Complex64::i();
    (rule.on(0.0, length_s))
        .map(|(t, weight)| weight * (PI * t / length_s).sin().powi(4) * (-i * omega * t).exp())
        .sum()
}

/// All eight outputs of a probe at a sample.
fn found(outcome: &Outcome, probe: usize, sample: usize) -> ([f64; 8], [f64; 8]) {
    let probes = outcome.probes.as_ref().unwrap();
    let value = std::array::from_fn(|k| probes.values[k][probe][sample]);
    (value, std::array::from_fn(|k| probes.errors[k][probe]))
}

#[test]
fn damped_fields_are_those_of_spectra() {
    let (length_s, quality, radius_m) = (3e-6, 30.0, 1e-3);
    let places = [[0.01, 0.0], [0.002, 0.005], [0.02, 0.004]];
    let mut asked = scene(block(Some(quality)), pulse(length_s), &places);
    asked.settings.disc_radius_m = Some(radius_m);
    let outcome = simulate(&asked, &KernelChoice::Direct).unwrap();
    assert!(
        outcome
            .warnings
            .iter()
            .any(|one| one.contains("quality_factor"))
    );
    let kernel = Kernel::new(&Medium::new(NU).unwrap(), Profile::Hertz, 1e-10).unwrap();
    let c1 = asked.target.longitudinal_speed_m_s();
    let unit_s = radius_m / c1;
    let law = Attenuation::new(quality, REFERENCE_HZ * unit_s).unwrap();
    let stress = 1.0 / (radius_m * radius_m);
    let displacement = radius_m * stress / asked.target.material().shear_modulus_pa();
    let times = &outcome.series.time_s;
    for (probe, [r_m, z_m]) in places.into_iter().enumerate() {
        let samples = [0.3, 0.4, 0.55, 0.7, 0.95].map(|part| (part * times.len() as f64) as usize);
        let mut wanted = [[0.0; 8]; 5];
        let ends = [
            0.0, 1e-3, 0.02, 0.1, 0.3, 0.6, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0,
            13.0, 16.0,
        ];
        for pair in ends.windows(2) {
            for (frequency, weight) in gauss::rule(32).on(pair[0] / length_s, pair[1] / length_s) {
                let omega = TAU * frequency;
                let own = kernel.spectrum(
                    r_m / radius_m,
                    z_m / radius_m,
                    frequency * unit_s,
                    Some(&law),
                );
                let own = own.unwrap().value;
                let force = transform(length_s, omega);
                for (wanted, sample) in wanted.iter_mut().zip(samples) {
                    let phase =
                        2.0 * weight * force * Complex64::from_polar(1.0, omega * times[sample]);
                    for f in 0..6 {
                        let unit = if f < 2 { displacement } else { stress };
                        wanted[f] += unit * (own[f] * phase).re;
                    }
                    for f in 0..2 {
                        let rate = Complex64::i() * omega;
                        wanted[6 + f] += displacement * (rate * own[f] * phase).re;
                    }
                }
            }
        }
        for (sample, wanted) in samples.into_iter().zip(wanted) {
            let (value, error) = found(&outcome, probe, sample);
            for k in 0..8 {
                let off = (value[k] - wanted[k]).abs();
                println!(
                    "{probe} {sample} {k}: {off:.1e} of {:.1e}, {:.1e}",
                    wanted[k], error[k]
                );
                // tractions of the surface are zero but for rounding
                let rounding = if (2..6).contains(&k) {
                    1e-14 * stress
                } else {
                    0.0
                };
                assert!(
                    off <= error[k] + rounding,
                    "{probe} {sample} {k}: {off:.1e} above {:.1e}",
                    error[k]
                );
            }
        }
    }
}

#[test]
fn without_attenuation_fields_are_elastic() {
    let places = [[0.01, 0.0], [0.001, 0.002], [1e-4, 0.0]];
    for load in [ball(1.0), pulse(4e-6)] {
        let [elastic, damped, none] = [None, Some(9e11), Some(1e12)].map(|quality| {
            let mut asked = scene(block(quality), load.clone(), &places);
            asked.settings.tolerance = 1e-4;
            if matches!(load, Load::Record(_)) {
                asked.settings.disc_radius_m = Some(3e-4);
            }
            simulate(&asked, &KernelChoice::Direct).unwrap()
        });
        assert_eq!(elastic.probes, none.probes);
        let count = elastic.series.time_s.len().min(damped.series.time_s.len());
        for probe in 0..places.len() {
            for sample in 0..count {
                let (a, b) = (
                    found(&elastic, probe, sample),
                    found(&damped, probe, sample),
                );
                for k in 0..8 {
                    let off = (a.0[k] - b.0[k]).abs();
                    let allowed = a.1[k] + b.1[k];
                    // the fronts of rates are sharper than discs alone resolve
                    let allowed = if k < 6 { allowed } else { 3.0 * allowed };
                    assert!(
                        off <= allowed,
                        "{probe} {sample} {k}: {off:.1e} above {allowed:.1e}"
                    );
                }
            }
        }
    }
}

/// Far from a small contact only the history of its force counts: a ball and its force on a disc of fixed radius.
#[test]
fn damped_waves_of_a_ball_are_those_of_its_force_far_away() {
    let mut of_ball = scene(block(Some(40.0)), ball(0.05), &[[0.06, 0.0], [0.02, 0.05]]);
    of_ball.settings.tolerance = 1e-4;
    let ball = simulate(&of_ball, &KernelChoice::Direct).unwrap();
    let record = ForceRecord::new(ball.series.time_s.clone(), ball.series.force_n.clone());
    let mut of_record = scene(
        of_ball.target,
        Load::Record(record.unwrap()),
        &[[0.06, 0.0], [0.02, 0.05]],
    );
    of_record.settings.tolerance = 1e-4;
    of_record.settings.disc_radius_m = Some(2e-5);
    of_record.duration_s = ball.series.time_s.last().copied();
    of_record.settings.step_s = Some(ball.series.time_s[1]);
    let record = simulate(&of_record, &KernelChoice::Direct).unwrap();
    for probe in 0..2 {
        for component in [0, 1, 6, 7] {
            let [a, b] = [&ball, &record].map(|run| {
                let values = &run.probes.as_ref().unwrap().values[component][probe];
                move |t: f64| at(&run.series.time_s, values, t)
            });
            let times = &ball.series.time_s;
            let peak = times.iter().map(|&t| a(t).abs()).fold(0.0, f64::max);
            let off = times
                .iter()
                .map(|&t| (a(t) - b(t)).abs())
                .fold(0.0, f64::max);
            println!("{probe} {component}: {:.1e}", off / peak);
            // the radius of the contact is seen at the fronts of velocities
            let allowed = if component < 2 { 1e-3 } else { 2e-2 };
            assert!(
                off < allowed * peak,
                "{probe} {component}: {:.1e}",
                off / peak
            );
        }
    }
}

/// Linear between samples.
fn at(time_s: &[f64], values: &[f64], t: f64) -> f64 {
    let after = time_s
        .partition_point(|own| *own <= t)
        .clamp(1, time_s.len() - 1);
    let part = (t - time_s[after - 1]) / (time_s[after] - time_s[after - 1]);
    values[after - 1] + part * (values[after] - values[after - 1])
}
