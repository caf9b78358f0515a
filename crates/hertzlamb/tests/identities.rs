//! Identities of every impact: momentum, energy, scaling, limits.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::law::radiation::{self, radiation};
use contact::{
    Accuracy, GrowingContact, HalfSpace, Material, Model, PunchWaves, Settings, StaticShare,
    Striker, solve_growing,
};
use halfspace::{Deflection, Medium, SurfaceResponse};
use hertzlamb::{contact, halfspace, impact};
use impact::Impact;
use proptest::prelude::{ProptestConfig, proptest};
use proptest::test_runner::FileFailurePersistence;

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

const NU: f64 = 0.27;

/// A striker at 20 times the velocity unit on a block; lengths by `length`, moduli by `modulus`, densities by `density`.
fn strike(scale: &Scale, settings: Settings) -> Impact {
    let Scale {
        length,
        density,
        modulus,
    } = *scale;
    let material = |youngs_modulus_pa: f64, poisson_ratio: f64| {
        let scaled = youngs_modulus_pa * modulus;
        Material::elastic(scaled, poisson_ratio, 2700.0 * density).unwrap()
    };
    let striker = Striker::new(
        material(110e9, 0.31),
        0.01 * density * length.powi(3),
        0.005 * length,
    );
    Impact {
        half_space: HalfSpace::new(material(70e9, NU)).unwrap(),
        striker: striker.unwrap(),
        velocity_m_s: 20.0 * (modulus / density).sqrt(),
        settings,
    }
}

fn model(model: Model) -> Settings {
    Settings {
        model,
        ..Settings::default()
    }
}

fn on_disc(deflection: Deflection, static_share: StaticShare, tolerance: f64) -> Settings {
    Settings {
        disc_radius_m: Some(0.002),
        deflection,
        static_share,
        tolerance,
        ..model(Model::Wave)
    }
}

#[test]
fn the_ledger_balances_with_the_mean_deflection() {
    for share in [StaticShare::Full, StaticShare::Dynamic] {
        for tolerance in [1e-5, 1e-7] {
            let settings = on_disc(Deflection::Mean, share, tolerance);
            let found = strike(&ONE, settings).solve().unwrap().results;
            println!(
                "{share:?} {tolerance:e}: radiated {:.6} residual {:.1e}",
                found.radiated_energy_j / found.initial_energy_j,
                found.energy_residual
            );
            let limit = if tolerance == 1e-5 { 1e-4 } else { 1e-5 };
            assert!(found.energy_residual.abs() < limit, "{found:?}");
        }
    }
}

#[test]
fn the_centre_deflection_has_a_known_defect() {
    let settings = on_disc(Deflection::Centre, StaticShare::Full, 1e-6);
    let found = strike(&ONE, settings).solve().unwrap().results;
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
    for name in [Model::Wave, Model::Growing, Model::Hertz, Model::Radiation] {
        let run = strike(&ONE, model(name)).solve().unwrap();
        let found = run.results;
        let (steps, step_s) = (1000, 1.1e-3 * found.contact_time_s);
        let force = |i: usize| run.excitation().force_n(i as f64 * step_s);
        let impulse = (1..steps).map(force).sum::<f64>() * step_s;
        let momentum = 0.01 * (20.0 + found.rebound_velocity_m_s);
        // two routes: the force, and for small losses the work that the restitution is taken from
        assert!(
            (found.impulse_n_s / momentum - 1.0).abs() < 1e-4,
            "{name:?}: {} {momentum}",
            found.impulse_n_s
        );
        assert!(
            (impulse / momentum - 1.0).abs() < 2e-3,
            "{name:?}: {impulse} {momentum}"
        );
        assert!((0..=steps).all(|i| force(i) >= 0.0));
    }
}

#[test]
fn growing_tends_to_the_radiation_law() {
    let medium = Medium::new(0.3).unwrap();
    let response = SurfaceResponse::new(&medium, Deflection::Centre);
    let waves = PunchWaves::new(&medium);
    let mut before = f64::INFINITY;
    for wave_time in [3e-2, 1e-2, 3e-3, 1e-3] {
        // equal materials: half of the compliance is the half-space's
        let impact = GrowingContact {
            waves: &waves,
            target_share: 0.5,
            wave_time,
        };
        let found = solve_growing(&impact, &Accuracy::of_contact(1e-8, None))
            .unwrap()
            .summary;
        let law = radiation(0.5 * wave_time * response.disc.relaxation_time);
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
    let steel = Material::elastic(2.08e11, 0.3, 7800.0).unwrap();
    let ball = Striker::new(steel.clone(), 0.004_084, 0.005).unwrap();
    let mut ball_drop = Impact::new(HalfSpace::new(steel).unwrap(), ball, 0.7);
    ball_drop.settings = model(Model::Radiation);
    let mu: f64 = 2.08e11 / 2.6;
    let e_star = 2.08e11 / (2.0 * 0.91);
    let k = 4.0 / 3.0 * e_star * 0.005_f64.sqrt();
    let law = 3.805_839_78 * 0.137_227_07 / (mu * (mu / 7800.0).sqrt())
        * k.powf(1.2)
        * 0.004_084_f64.powf(-0.2)
        * 0.7_f64.powf(0.6);
    let found = ball_drop.solve().unwrap().results;
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
    let chosen = |loss_tolerance| {
        let mut slow = strike(&ONE, model(Model::Auto)).to_tolerance(1e-2);
        slow.velocity_m_s = 1e-4;
        slow.settings.loss_tolerance = loss_tolerance;
        slow.solve().unwrap().solved.chosen.model
    };
    assert_eq!(chosen(None), Model::Hertz);
    assert_ne!(chosen(Some(1e-1)), Model::Hertz);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))), ..ProptestConfig::default() })]
    #[test]
    fn results_scale_with_the_units(a in -3.0_f64..3.0, b in -2.0_f64..2.0, c in -3.0_f64..3.0) {
        let scale = Scale { length: 10_f64.powf(a), density: 10_f64.powf(b), modulus: 10_f64.powf(c) };
        for name in [Model::Wave, Model::Growing] {
            let run = |scale: &Scale| strike(scale, model(name)).solve().unwrap().results;
            let (one, other) = (run(&ONE), run(&scale));
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
