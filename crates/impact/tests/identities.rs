//! What must hold for every impact: momentum, energy, scaling, limits.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::{Deflection, Medium, SurfaceResponse};
use impact::contact::radiation::{self, radiation};
use impact::march::{GrowingDisc, PunchResponse, Summary, march_growing};
use impact::{KernelChoice, Outcome, Scene, simulate};
use proptest::prelude::{ProptestConfig, proptest};
use std::path::Path;

fn scene(scale: &Scale, more: &str) -> String {
    let Scale {
        length,
        density,
        modulus,
    } = *scale;
    // lengths by `length`, moduli by `modulus`, densities by `density`: velocities by sqrt(modulus/density)
    let velocity = 20.0 * (modulus / density).sqrt();
    format!(
        "[target]\nyoungs_modulus_pa = {:e}\npoisson_ratio = 0.27\ndensity_kg_m3 = {:e}\n\
         [striker]\nyoungs_modulus_pa = {:e}\npoisson_ratio = 0.31\nmass_kg = {:e}\ntip_radius_m = {:e}\n\
         velocity_m_s = {velocity:e}\n[contact]\n{more}\n",
        70e9 * modulus,
        2700.0 * density,
        110e9 * modulus,
        0.01 * density * length.powi(3),
        0.005 * length,
    )
}

#[derive(Debug, Clone, Copy)]
struct Scale {
    length: f64,
    density: f64,
    modulus: f64,
}

const ONE: Scale = Scale {
    length: 1.0,
    density: 1.0,
    modulus: 1.0,
};

fn run(text: &str) -> Outcome {
    simulate(
        &Scene::from_toml(text, Path::new(".")).unwrap(),
        &KernelChoice::Direct,
    )
    .unwrap()
}

#[test]
fn the_ledger_balances_with_the_mean_deflection() {
    for share in ["full", "dynamic"] {
        for tolerance in ["1e-5", "1e-7"] {
            let found = run(&scene(&ONE, &format!(
                "model = \"wave\"\ndisc_radius_m = 0.002\ndeflection = \"mean\"\nstatic_share = \"{share}\"\ntolerance = {tolerance}"
            ))).results;
            println!(
                "{share} {tolerance}: radiated {:.6} residual {:.1e}",
                found.radiated_energy_j / found.initial_energy_j,
                found.energy_residual
            );
            let limit = if tolerance == "1e-5" { 1e-4 } else { 1e-5 };
            assert!(found.energy_residual.abs() < limit, "{found:?}");
        }
    }
}

#[test]
fn the_centre_deflection_has_a_known_defect() {
    let found = run(&scene(
        &ONE,
        "model = \"wave\"\ndisc_radius_m = 0.002\ntolerance = 1e-6",
    ))
    .results;
    let radiated = found.radiated_energy_j / found.initial_energy_j;
    println!(
        "radiated {radiated:.6}, residual {:.2e}",
        found.energy_residual
    );
    assert!(found.energy_residual.abs() > 1e-5, "{found:?}");
    assert!(found.energy_residual.abs() < 0.2 * radiated, "{found:?}");
}

#[test]
fn the_force_takes_the_strikers_momentum() {
    for model in ["wave", "growing", "hertz", "radiation"] {
        let found = run(&scene(&ONE, &format!("model = \"{model}\"")));
        let s = &found.series;
        let impulse: f64 = s
            .force_n
            .windows(2)
            .map(|p| 0.5 * (p[0] + p[1]))
            .sum::<f64>()
            * s.time_s[1];
        let momentum = 0.01 * (20.0 + found.results.rebound_velocity_m_s);
        assert!(
            (found.results.impulse_n_s / momentum - 1.0).abs() < 1e-10,
            "{model}"
        );
        assert!(
            (impulse / momentum - 1.0).abs() < 2e-3,
            "{model}: {impulse} {momentum}"
        );
        assert!(s.force_n.iter().all(|&p| p >= 0.0));
    }
}

#[test]
fn growing_tends_to_the_radiation_law() {
    let response = SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Centre);
    let punch = PunchResponse::new(&response);
    let mut before = f64::INFINITY;
    for wave_time in [3e-2, 1e-2, 3e-3, 1e-3] {
        // equal materials: half of the compliance is the half-space's
        let impact = GrowingDisc {
            punch: &punch,
            target_share: 0.5,
            wave_time,
        };
        let found = Summary::new(&march_growing(&impact, 3.0 / 512.0).unwrap()).unwrap();
        let law = radiation(0.5 * wave_time * response.relaxation_time());
        let difference = (found.loss / law.loss - 1.0).abs();
        println!(
            "loss {:.6}, law {:.6}, difference {difference:.1e}",
            found.loss, law.loss
        );
        assert!(difference < 0.6 * before);
        assert!(law.loss > 0.01 || difference < 0.01);
        assert!(law.loss > 0.01 || (found.contact_time / law.contact_time - 1.0).abs() < 1e-4);
        assert!(law.loss > 0.01 || (found.peak_force / law.peak_force - 1.0).abs() < 1e-4);
        before = difference;
    }
}

#[test]
fn the_radiation_law_in_si_units() {
    // 1 - e^2 = 3.80583978 (J/(mu c2)) K^(6/5) m^(-1/5) V0^(3/5), J(0.3) = 0.13722707
    let text = "[target]\nyoungs_modulus_pa = 2.08e11\npoisson_ratio = 0.3\ndensity_kg_m3 = 7800\n\
        [striker]\nyoungs_modulus_pa = 2.08e11\npoisson_ratio = 0.3\nmass_kg = 0.004084\ntip_radius_m = 0.005\n\
        velocity_m_s = 0.7\n[contact]\nmodel = \"radiation\"\n";
    let mu: f64 = 2.08e11 / 2.6;
    let e_star = 2.08e11 / (2.0 * 0.91);
    let k = 4.0 / 3.0 * e_star * 0.005_f64.sqrt();
    let law = 3.805_839_78 * 0.137_227_07 / (mu * (mu / 7800.0).sqrt())
        * k.powf(1.2)
        * 0.004_084_f64.powf(-0.2)
        * 0.7_f64.powf(0.6);
    let found = run(text).results;
    assert!(
        ((1.0 - found.restitution.powi(2)) / law - 1.0).abs() < 1e-6,
        "{found:?} {law}"
    );
    // equal materials, sphere of that density: 1.1318 (V0/c0)^(3/5)
    let c0 = (2.08e11_f64 / 7800.0).sqrt();
    assert!((law / (1.1318 * (0.7 / c0).powf(0.6)) - 1.0).abs() < 1e-3);
}

#[test]
fn loss_tolerance_is_heeded_by_auto() {
    let slow = scene(&ONE, "").replace("velocity_m_s = 2e1", "velocity_m_s = 1e-4");
    assert_eq!(
        run(&slow.replace("[contact]\n", "[contact]\ntolerance = 1e-2\n"))
            .choices
            .model,
        "hertz"
    );
    let asked = slow.replace(
        "[contact]\n",
        "[contact]\ntolerance = 1e-2\nloss_tolerance = 1e-1\n",
    );
    assert_ne!(run(&asked).choices.model, "hertz");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn results_scale_with_the_units(a in -3.0_f64..3.0, b in -2.0_f64..2.0, c in -3.0_f64..3.0) {
        let scale = Scale { length: 10_f64.powf(a), density: 10_f64.powf(b), modulus: 10_f64.powf(c) };
        for model in ["wave", "growing"] {
            let contact = format!("model = \"{model}\"");
            let (one, other) = (run(&scene(&ONE, &contact)).results, run(&scene(&scale, &contact)).results);
            let velocity = (scale.modulus / scale.density).sqrt();
            let close = |x: f64, y: f64| (x / y - 1.0).abs() < 1e-9;
            assert!(close(other.peak_force_n, one.peak_force_n * scale.modulus * scale.length.powi(2)));
            assert!(close(other.contact_time_s, one.contact_time_s * scale.length / velocity));
            assert!(close(other.restitution, one.restitution));
            assert!(close(other.peak_deflection_m, one.peak_deflection_m * scale.length));
            assert!(close(other.radiated_energy_j, one.radiated_energy_j * scale.modulus * scale.length.powi(3)));
        }
    }
}

#[test]
fn the_smallest_loss_of_the_law_is_proportional_to_the_lag() {
    assert!((radiation(1e-6).loss / 1e-6 - radiation::LOSS).abs() < 1e-9);
}
