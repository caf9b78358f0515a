//! Scenes that break naive schemes: a right answer or a clear error, never NaN or an endless loop.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{Choice, HalfSpace, Material, Model, Scheme, Settings, StaticShare, Striker};
use halfspace::Deflection;
use hertzlamb::{contact, halfspace, impact};
use impact::{KernelChoice, Load, Scene, Strike, simulate};

#[derive(Debug)]
struct Hard {
    target: (f64, f64, f64),
    striker: (f64, f64),
    mass_kg: f64,
    tip_radius_m: f64,
    velocity_m_s: f64,
}

const STEEL_ON_STEEL: Hard = Hard {
    target: (209e9, 0.3, 7830.0),
    striker: (209e9, 0.3),
    mass_kg: 0.01,
    tip_radius_m: 0.005,
    velocity_m_s: 1.0,
};

fn material((youngs_modulus_pa, poisson_ratio): (f64, f64), density_kg_m3: f64) -> Material {
    Material::elastic(youngs_modulus_pa, poisson_ratio, density_kg_m3).unwrap()
}

fn attempt(hard: &Hard, settings: Settings) -> Result<f64, String> {
    let (modulus, ratio, density) = hard.target;
    let target = HalfSpace::new(material((modulus, ratio), density)).unwrap();
    let tip = material(hard.striker, density);
    let scene = Scene {
        target,
        load: Load::Strike(Strike {
            striker: Striker::new(tip, hard.mass_kg, hard.tip_radius_m).unwrap(),
            velocity_m_s: hard.velocity_m_s,
        }),
        settings,
        probes: Vec::new(),
        section: None,
        quantities: Vec::new(),
        peaks: false,
        duration_s: None,
    };
    match simulate(&scene, &KernelChoice::Direct) {
        Ok(found) => {
            let r = *found.results().unwrap();
            for value in [
                r.peak_force_n,
                r.contact_time_s,
                r.peak_displacement_m,
                r.impulse_n_s,
            ] {
                assert!(
                    value.is_finite() && value > 0.0,
                    "{r:?}\n{hard:?} {settings:?}"
                );
            }
            assert!(
                r.restitution.is_finite() && r.restitution > 0.0 && r.restitution <= 1.0 + 1e-6,
                "{r:?}\n{hard:?} {settings:?}"
            );
            assert!(
                found
                    .series
                    .force_n
                    .iter()
                    .all(|p| p.is_finite() && *p >= 0.0)
            );
            Ok(r.restitution)
        }
        Err(error) => {
            let message = error.to_string();
            assert!(!message.contains("NaN"), "{message}\n{hard:?} {settings:?}");
            Err(message)
        }
    }
}

/// Prints an answer; only the dynamic share may have none, and says why.
fn report(name: &str, model: &str, result: &Result<f64, String>) {
    match result {
        Ok(e) => println!("{name:<40} {model:<10} restitution {e:.5}"),
        Err(message) => {
            println!("{name:<40} {model:<10} {message}");
            let refused = message.contains("the dynamic static share has no solution");
            assert!(model == "dynamic" && refused, "{name}, {model}: {message}");
        }
    }
}

fn contacts() -> [(&'static str, Settings); 5] {
    let of = |model| Settings {
        model,
        ..Settings::default()
    };
    let dynamic = Settings {
        static_share: StaticShare::Dynamic,
        ..of(Model::Wave)
    };
    let mean = Settings {
        deflection: Deflection::Mean,
        ..of(Model::Wave)
    };
    [
        ("wave", of(Model::Wave)),
        ("dynamic", dynamic),
        ("mean", mean),
        ("growing", of(Model::Growing)),
        ("auto", of(Model::Auto)),
    ]
}

#[test]
fn velocities_from_1e_minus_6_to_1e3() {
    for exponent in -6..=3 {
        let hard = Hard {
            velocity_m_s: 10_f64.powi(exponent),
            ..STEEL_ON_STEEL
        };
        for (name, contact) in contacts() {
            let result = attempt(&hard, contact);
            report(&format!("V0 = 1e{exponent}"), name, &result);
            assert!(result.is_ok(), "{result:?}");
        }
    }
}

#[test]
fn soft_half_space_and_stiff_heavy_striker() {
    for modulus in [1e4, 1e6, 1e8] {
        let hard = Hard {
            target: (modulus, 0.45, 1500.0),
            mass_kg: 10.0,
            ..STEEL_ON_STEEL
        };
        for (name, contact) in contacts() {
            report(
                &format!("E = {modulus:e}, 10 kg"),
                name,
                &attempt(&hard, contact),
            );
        }
    }
}

#[test]
fn very_light_striker() {
    for mass_kg in [1e-4, 1e-6, 1e-8, 1e-10] {
        let hard = Hard {
            mass_kg,
            ..STEEL_ON_STEEL
        };
        for (name, contact) in contacts() {
            report(&format!("m = {mass_kg:e}"), name, &attempt(&hard, contact));
        }
    }
}

#[test]
fn disc_radius_from_a_hundredth_to_ten_tip_radii() {
    for ratio in [0.01, 0.1, 1.0, 10.0] {
        for share in [StaticShare::Full, StaticShare::Dynamic] {
            let settings = Settings {
                model: Model::Wave,
                static_share: share,
                disc_radius_m: Some(ratio * 0.005),
                ..Settings::default()
            };
            let result = attempt(&STEEL_ON_STEEL, settings);
            report(&format!("r0 = {ratio} R"), share.name(), &result);
            assert!(result.is_ok() || ratio == 0.01, "{result:?}");
        }
    }
}

#[test]
fn poisson_ratios_from_minus_a_half_to_nearly_a_half() {
    for nu in [-0.5, 0.0, 0.2, 0.263_082_06, 0.4, 0.49, 0.499, 0.4999] {
        let hard = Hard {
            target: (209e9, nu, 7830.0),
            ..STEEL_ON_STEEL
        };
        for (name, contact) in contacts() {
            let result = attempt(&hard, contact);
            report(&format!("nu = {nu}"), name, &result);
            assert!(result.is_ok(), "{result:?}");
        }
    }
}

#[test]
fn step_larger_than_the_contact() {
    for scheme in [Scheme::Implicit, Scheme::Explicit] {
        let settings = Settings {
            model: Model::Wave,
            scheme,
            step_s: Some(1.0),
            ..Settings::default()
        };
        let message = attempt(&STEEL_ON_STEEL, settings).unwrap_err();
        assert!(message.contains("step_s"), "{message}");
    }
}
