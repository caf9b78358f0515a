//! Plates: fields against an inversion of the whole plate and in their limits, and contacts whose echo returns.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{Echoes, HalfSpace, Material, Model, Plasticity, Settings, Striker};
use halfspace::Field;
use impact::{
    ForceRecord, Impact, KernelChoice, Load, Outcome, Probe, Quantity, Scene, Strike, simulate,
};
use std::f64::consts::PI;

const W: usize = Field::DisplacementZ.index();
/// Radius of the disc in m.
const DISC_M: f64 = 1e-3;

fn block(poisson_ratio: f64, thickness_m: f64, echoes: Option<Echoes>) -> HalfSpace {
    let material = Material::elastic(70e9, poisson_ratio, 2500.0).unwrap();
    let mut block = HalfSpace::new(material).unwrap();
    (block.thickness_m, block.echoes) = (Some(thickness_m), echoes);
    block
}

fn scene(target: HalfSpace, load: Load, places_m: &[[f64; 2]], duration_s: Option<f64>) -> Scene {
    let place = |&[r_m, z_m]: &[f64; 2]| Probe { r_m, z_m };
    Scene {
        target,
        load,
        settings: Settings {
            tolerance: 1e-5,
            ..Settings::default()
        },
        quantities: vec![Quantity::VelocityZ],
        peaks: false,
        duration_s,
        low_pass_hz: None,
        probes: places_m.iter().map(place).collect(),
        section: None,
        sensors: Vec::new(),
    }
}

/// A force sin^4(pi t/T) of 1 kN on a disc.
fn pulse(duration_s: f64) -> Load {
    let time_s: Vec<f64> = (0..=1000)
        .map(|i| duration_s * f64::from(i) / 1000.0)
        .collect();
    let force_n = time_s
        .iter()
        .map(|t| 1000.0 * (PI * t / duration_s).sin().powi(4));
    let force_n: Vec<f64> = force_n.collect();
    Load::Record(ForceRecord::new(time_s, force_n).unwrap())
}

fn run(mut scene: Scene) -> Outcome {
    if matches!(scene.load, Load::Record(_)) {
        scene.settings.disc_radius_m = Some(DISC_M);
    }
    simulate(&scene, &KernelChoice::Direct).unwrap()
}

/// A sample at a time, on a line between two.
fn at(outcome: &Outcome, quantity: usize, probe: usize, time_s: f64) -> f64 {
    let (times_s, values) = (
        &outcome.series.time_s,
        &outcome.probes.as_ref().unwrap().values,
    );
    let samples = &values[quantity][probe];
    let i = times_s.partition_point(|t| *t < time_s).max(1);
    let part = (time_s - times_s[i - 1]) / (times_s[i] - times_s[i - 1]);
    samples[i - 1] + part * (samples[i] - samples[i - 1])
}

/// w under such a force by Laplace-Hankel inversion of the whole plate, with a 4 by 4 system for each wave number: Poisson's ratio,
/// H, r, legs, T, t, and w in P/(mu r0), lengths in radii. An odd number of legs is the lower face.
const WHOLE: [(f64, f64, f64, usize, f64, f64, f64); 12] = [
    (0.25, 4.0, 0.0, 5, 8.0, 9.0, 7.5026346e-02),
    (0.25, 4.0, 0.0, 5, 8.0, 13.5, 1.1181633e-02),
    (0.25, 4.0, 0.0, 5, 8.0, 20.0, 4.2377676e-02),
    (0.25, 4.0, 0.0, 5, 8.0, 26.0, 3.8618539e-02),
    (0.25, 4.0, 3.0, 6, 8.0, 9.0, 2.5892777e-02),
    (0.25, 4.0, 3.0, 6, 8.0, 13.5, 2.4629052e-02),
    (0.25, 4.0, 3.0, 6, 8.0, 20.0, 2.5902630e-02),
    (0.25, 4.0, 3.0, 6, 8.0, 26.0, 2.6210270e-02),
    (0.3, 3.0, 2.0, 7, 6.0, 9.0, 4.2161703e-02),
    (0.3, 3.0, 2.0, 7, 6.0, 13.5, 3.3482046e-02),
    (0.3, 3.0, 2.0, 7, 6.0, 20.0, 3.7995610e-02),
    (0.3, 3.0, 2.0, 7, 6.0, 26.0, 3.9403683e-02),
];

#[test]
fn fields_are_those_of_the_whole_plate() {
    for (ratio, thickness, r, legs, duration, t, whole) in WHOLE {
        let target = block(ratio, thickness * DISC_M, Some(Echoes::Legs(legs)));
        let unit_s = DISC_M / target.longitudinal_speed_m_s();
        let shear_modulus = 70e9 / (2.0 * (1.0 + ratio));
        let z = if legs % 2 == 1 { thickness } else { 0.0 };
        let places_m = [[r, z].map(|x| x * DISC_M)];
        let load = pulse(duration * unit_s);
        let outcome = run(scene(target, load, &places_m, Some(26.1 * unit_s)));
        let found = at(&outcome, W, 0, t * unit_s) * shear_modulus * DISC_M / 1000.0;
        let estimate = outcome.probes.as_ref().unwrap().errors[W][0];
        let estimate = estimate * shear_modulus * DISC_M / 1000.0;
        // the inversion interpolates the fronts, which are sharp on the axis
        let off = (found - whole).abs();
        assert!(
            off < 2e-6 && estimate < 2e-5,
            "{t}: {found} against {whole}, {estimate:.1e}"
        );
    }
}

/// Velocities are the slopes of the displacements, on a face and inside, after echoes of all kinds.
#[test]
fn velocities_of_a_plate_are_slopes() {
    let target = block(
        0.3,
        3.0 * DISC_M,
        Some(Echoes::Until(30e-6 * DISC_M / 1e-2)),
    );
    let unit_s = DISC_M / target.longitudinal_speed_m_s();
    let places_m = [[0.0, 3.0], [2.0, 0.0], [1.5, 1.2]].map(|place| place.map(|x| x * DISC_M));
    let outcome = run(scene(target, pulse(6.0 * unit_s), &places_m, None));
    let step_s = outcome.series.time_s[1];
    let fields = outcome.probes.as_ref().unwrap();
    for probe in 0..3 {
        let (w, v) = (&fields.values[W][probe], &fields.values[6][probe]);
        let most = v.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        for n in 1..w.len() - 1 {
            let slope = (w[n + 1] - w[n - 1]) / (2.0 * step_s);
            let off = (slope - v[n]).abs();
            assert!(
                off < 0.02 * most,
                "probe {probe}, sample {n}: {slope} {}",
                v[n]
            );
        }
    }
}

/// Before the first echo the fields are those of the half-space, to the last bit.
#[test]
fn a_thick_plate_is_a_half_space() {
    let places_m = [[0.0, 0.01], [0.02, 0.0], [0.004, 0.003]];
    let load = || {
        Load::Strike(Strike {
            striker: Striker::ball(Material::named("bearing-steel").unwrap(), 0.002).unwrap(),
            velocity_m_s: 1.0,
        })
    };
    let of = |echoes| {
        run(scene(
            block(0.25, 1.0, echoes),
            load(),
            &places_m,
            Some(1e-4),
        ))
    };
    let [plate, alone] = [Some(Echoes::Legs(3)), None].map(of);
    let [plate, alone] = [plate, alone].map(|outcome| outcome.probes.unwrap().values);
    assert_eq!(plate, alone);
}

/// The waves have names and arrive where they are seen, and fields are valid until the first that is left out.
#[test]
fn echoes_have_names() {
    let target = block(0.25, 0.02, Some(Echoes::Legs(2)));
    let speed = target.longitudinal_speed_m_s();
    let load = pulse(2e-6);
    let outcome = run(scene(
        target,
        load,
        &[[0.0, 0.0], [0.03, 0.02], [0.0, 0.015]],
        None,
    ));
    let fields = outcome.probes.unwrap();
    let of = |name: &str, probe: usize| {
        let place = fields.echoes.names.iter().position(|own| own == name);
        fields.echoes.time_s[probe][place.unwrap()]
    };
    assert!((of("PP", 0) * speed / 0.04 - 1.0).abs() < 1e-9);
    // up from the lower face
    assert!((of("PP", 2) * speed / 0.025 - 1.0).abs() < 1e-9);
    assert!((of("SP", 2) * speed / (0.02 * 3_f64.sqrt() + 0.005) - 1.0).abs() < 1e-9);
    assert!(of("PP", 1).is_infinite());
    let paths_m = [0.08, f64::hypot(0.029, 0.06), 0.065];
    for (valid_s, path_m) in fields.valid_until_s.iter().zip(paths_m) {
        assert!((valid_s * speed / path_m - 1.0).abs() < 1e-9, "{valid_s}");
    }
}

fn steel_ball(thickness_m: f64, echoes: Option<Echoes>) -> Impact {
    let steel = || Material::named("steel").unwrap();
    let mut target = HalfSpace::new(steel()).unwrap();
    (target.thickness_m, target.echoes) = (Some(thickness_m), echoes);
    let striker = Striker::ball(steel(), 0.01).unwrap();
    Impact::new(target, striker, 0.2)
}

/// An echo changes the force after its return only, and takes the more energy the thinner the plate; there it is that of the
/// half-space's waves and of bending waves by Zener's formula (The intrinsic inelasticity of large plates, Physical Review 59, 669, 1941):
///
/// ```text
/// e = exp(-1.719 l),   l = pi^(3/5)/sqrt(3) (R/H)^2 (v/c)^(1/5) (rho1/rho2)^(3/5) (E1'/(E1' + E2'))^(2/5),   c^2 = E1'/rho1
/// ```
///
/// for a ball of radius R, with E' = E/(1 - nu^2).
#[test]
fn the_echo_that_returns_changes_the_force() {
    let alone = steel_ball(0.05, None).solve().unwrap();
    let mut losses = vec![alone.loss];
    for thickness_m in [0.1, 0.06, 0.04] {
        let run = steel_ball(thickness_m, Some(Echoes::Legs(1)))
            .solve()
            .unwrap();
        assert_eq!(run.solved.chosen.model, Model::Growing);
        let speed = run.excitation().speeds().p;
        let back_s = 2.0 * thickness_m / speed;
        for part in [0.3, 0.9, 0.999] {
            let time_s = part * back_s;
            let [own, other] = [&run, &alone].map(|run| run.excitation().force_n(time_s));
            assert!(
                (own / other - 1.0).abs() < 3e-4,
                "{thickness_m} {part}: {own} {other}"
            );
        }
        assert!((run.radiated_energy_j / run.initial_energy_j / run.loss - 1.0).abs() < 1e-6);
        losses.push(run.loss);
    }
    assert!(losses.is_sorted(), "{losses:?}");
    let (material, velocity_m_s) = (Material::named("steel").unwrap(), 0.2);
    let modulus = material.plane_modulus_pa();
    let speed = (modulus / material.density_kg_m3.unwrap()).sqrt();
    let bending = PI.powf(0.6) / 3_f64.sqrt()
        * (0.01_f64 / 0.04).powi(2)
        * (velocity_m_s / speed).powf(0.2)
        * 0.5_f64.powf(0.4);
    let zener = 1.0 - (-2.0 * 1.719 * bending).exp();
    println!(
        "loss {:.4e}, of bending waves {zener:.4e}, on a half-space {:.4e}",
        losses[3], alone.loss
    );
    assert!(
        (losses[3] / (zener + alone.loss) - 1.0).abs() < 0.07,
        "{losses:?} {zener}"
    );
}

/// The estimate of a contact counts the error of its echo.
#[test]
fn estimates_count_the_echo() {
    let of = |thickness_m: f64, tolerance: f64| {
        let impact = steel_ball(thickness_m, Some(Echoes::Legs(1)));
        impact.to_tolerance(tolerance).solve().unwrap()
    };
    for thickness_m in [0.1, 0.05] {
        let exact = of(thickness_m, 1e-6);
        for tolerance in [1e-3, 1e-4, 1e-5] {
            let run = of(thickness_m, tolerance);
            let off = [
                run.peak_force_n / exact.peak_force_n,
                run.contact_time_s / exact.contact_time_s,
                run.restitution / exact.restitution,
            ];
            let off = off
                .map(|own| (own - 1.0).abs())
                .into_iter()
                .fold(0.0, f64::max);
            let estimate = run.relative_error_estimate + exact.relative_error_estimate;
            assert!(
                off < estimate && estimate < tolerance,
                "{thickness_m} {tolerance:e}: {off:.1e}, {estimate:.1e}"
            );
        }
    }
}

#[test]
fn contacts_that_do_not_know_the_echo_are_rejected() {
    let with = |change: fn(&mut Impact), thickness_m: f64| {
        let mut impact = steel_ball(thickness_m, Some(Echoes::Legs(2)));
        change(&mut impact);
        impact.solve().map(drop).unwrap_err().to_string()
    };
    let hertz = with(|impact| impact.settings.model = Model::Hertz, 0.05);
    assert!(hertz.contains("model \"hertz\" does not know"), "{hertz}");
    let disc = with(|impact| impact.settings.disc_radius_m = Some(1e-3), 0.05);
    assert!(disc.contains("on a disc of fixed radius"), "{disc}");
    let yields = with(
        |impact| {
            impact.settings.plasticity = Plasticity::Thornton;
            impact.velocity_m_s = 10.0;
        },
        0.05,
    );
    assert!(yields.contains("yields"), "{yields}");
    let thin = with(|_| {}, 0.01);
    assert!(thin.contains("bending"), "{thin}");
    // a thick plate has no echo in time
    let mut thick = steel_ball(1.0, Some(Echoes::Legs(2)));
    thick.settings.model = Model::Hertz;
    thick.solve().unwrap();
}

#[test]
fn echoes_end_where_no_digit_is_left() {
    let target = block(0.3, 0.01, Some(Echoes::Legs(4)));
    let scene = scene(target, pulse(2e-6), &[[0.0, 0.0]], Some(1e-3));
    let settings = Settings {
        disc_radius_m: Some(DISC_M),
        ..scene.settings
    };
    let scene = Scene { settings, ..scene };
    let error = simulate(&scene, &KernelChoice::Direct)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("16 transits") && error.contains("Rayleigh-Lamb"),
        "{error}"
    );
}
