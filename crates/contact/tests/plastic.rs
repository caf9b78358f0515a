//! Contacts that yield against closed forms, independent references, and the elastic contact that they continue.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{
    Collision, Exact, HalfSpace, Material, Measure, Model, Plasticity, Results, Settings, Solved,
    Solver, Strength, Striker, Tabulated, Unknown, infer,
};
use halfspace::{Deflection, Medium, SurfaceResponse};
use std::f64::consts::PI;

const RESULTS: &str = include_str!("../../../tests/reference/plastic/results.csv");
const HISTORIES: &str = include_str!("../../../tests/reference/plastic/histories.csv");
const JACKSON_GREEN: &str = include_str!("../../../tests/reference/plastic/jackson_green.csv");

/// A collision of a reference row, by its groups.
struct Row<'r> {
    fields: Vec<&'r str>,
}

impl Row<'_> {
    fn number(&self, back: usize) -> f64 {
        self.fields[self.fields.len() - back].parse().unwrap()
    }

    fn collision(&self) -> (Collision, f64) {
        let [tip_radius_m, mass_kg, pressure, velocity_m_s, at_yield] =
            [23, 22, 21, 20, 19].map(|i| self.number(i));
        let [phi, tau, nu] = [17, 16, 14].map(|i| self.number(i));
        // V_y = (pi/(2 E*))^2 sqrt(8 pi R^3/(15 m)) p_y^2.5
        let shape = (8.0 * PI * tip_radius_m.powi(3) / (15.0 * mass_kg)).sqrt();
        let effective_modulus_pa = 0.5 * PI * (shape * pressure.powf(2.5) / at_yield).sqrt();
        let plane = effective_modulus_pa / phi;
        let mut collision = Collision {
            mass_kg,
            velocity_m_s,
            tip_radius_m,
            effective_modulus_pa,
            target_plane_modulus_pa: plane,
            target_shear_modulus_pa: 0.5 * plane * (1.0 - nu),
            target_longitudinal_speed_m_s: 1.0,
            target_poisson_ratio: nu,
            strengths: [Strength::default(); 2],
        };
        collision.target_longitudinal_speed_m_s = collision.contact_wave_time() / tau;
        (collision, pressure)
    }
}

fn solved(collision: &Collision, settings: &Settings) -> (Solved, Results) {
    let mut solver = Solver::new(&Exact);
    let found = solver.solve(collision, settings).unwrap();
    let results = Results::new(collision, settings, &found);
    (found, results)
}

fn near(what: &str, found: f64, expected: f64, allowed: f64) {
    assert!(
        (found - expected).abs() <= allowed,
        "{what}: {found:.12e}, {expected:.12e}, off by {:.1e}",
        found - expected
    );
}

#[test]
fn rows_of_the_reference() {
    for line in RESULTS.lines().skip(1) {
        let row = Row {
            fields: line.split(',').collect(),
        };
        let (collision, settings) = referenced(line, [1e-4, 1e-7]);
        let allowed = match settings.model {
            Model::Hertz => 1e-8,
            Model::AreaDashpot => 1e-7,
            _ => 1e-6,
        };
        let (_, r) = solved(&collision, &settings);
        let of = |what: &str| format!("{what} of {line}");
        near(&of("restitution"), r.restitution, row.number(11), allowed);
        for (what, found, back) in [
            ("peak force", r.peak_force_n, 10),
            ("contact time", r.contact_time_s, 9),
            ("indentation", r.plastic.peak_indentation_m.unwrap(), 6),
            ("displacement", r.peak_displacement_m, 7),
            ("indentation", r.plastic.peak_indentation_m.unwrap(), 6),
        ] {
            near(&of(what), found / row.number(back), 1.0, allowed.max(3e-9));
        }
        let (deepest, left) = (row.number(6), r.plastic.residual_indentation_m.unwrap());
        near(
            &of("residual"),
            left / deepest,
            row.number(5) / deepest,
            allowed,
        );
        let work = r.plastic.plastic_work_j.unwrap() / r.initial_energy_j;
        let radiated = r.radiated_energy_j / r.initial_energy_j;
        near(
            &of("energy"),
            work + radiated,
            row.number(4) + row.number(3),
            2.0 * allowed,
        );
        // the reference counts what is stored where the dashpot's force ends as work of the law
        let flatter = r.plastic.dent_radius_m.unwrap() / collision.tip_radius_m;
        let kept = (2.25 * row.number(15) * r.restitution).powi(5) * flatter.powi(3);
        near(
            &of("radiated"),
            radiated,
            row.number(3),
            2.0 * kept + 1e-5 * row.number(3).max(1e-2),
        );
        near(&of("ledger"), r.energy_residual, 0.0, 1e-6);
    }
}

/// A collision of the reference with the settings of its row.
fn referenced(line: &str, tolerance: [f64; 2]) -> (Collision, Settings) {
    let row = Row {
        fields: line.split(',').collect(),
    };
    let (collision, pressure) = row.collision();
    let [waves, unloading] = [13, 12].map(|i| row.fields[row.fields.len() - i]);
    let (model, tolerance) = match waves {
        "none" => (Model::Hertz, tolerance[0]),
        "dashpot" => (Model::AreaDashpot, tolerance[0]),
        _ => (Model::Growing, tolerance[1]),
    };
    let plasticity = if unloading == "thornton" {
        Plasticity::Thornton
    } else {
        Plasticity::Recovery
    };
    let settings = Settings {
        model,
        tolerance,
        plasticity,
        yield_pressure_pa: Some(pressure),
        ..Settings::default()
    };
    (collision, settings)
}

#[test]
fn histories_of_the_reference() {
    let mut before = String::new();
    let mut contact = None;
    for line in HISTORIES.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let case = fields[..3].join(",");
        if case != before {
            let named = |row: &&str| {
                let of: Vec<&str> = row.split(',').collect();
                of[0] == fields[0] && of[of.len() - 13..of.len() - 11] == fields[1..3]
            };
            let row = RESULTS.lines().find(named).unwrap();
            let (collision, settings) = referenced(row, [1e-4, 1e-6]);
            let (_, history) = Solver::new(&Exact)
                .solve_with_history(&collision, &settings)
                .unwrap();
            contact = Some((history.pieces.as_ref().unwrap().clone(), collision.units()));
            before = case;
        }
        let (found, units) = contact.as_ref().unwrap();
        let [time, force, displacement, velocity] =
            [3, 4, 5, 6].map(|i| fields[i].parse::<f64>().unwrap());
        let now = found.state(time / units.time_s);
        near(
            &format!("force of {line}"),
            now.force,
            force / units.force_n,
            1e-5,
        );
        near(
            &format!("displacement of {line}"),
            now.displacement,
            displacement / units.length_m,
            1e-5,
        );
        near(
            &format!("velocity of {line}"),
            now.velocity,
            velocity / units.velocity_m_s(),
            1e-5,
        );
    }
}

/// Steel on aluminium, by V/V_y.
fn at(ratio: f64) -> (Collision, Settings) {
    let block = HalfSpace::new(Material::named("aluminium-6061-t6").unwrap()).unwrap();
    let ball = Striker::ball(Material::named("bearing-steel").unwrap(), 0.005).unwrap();
    let settings = Settings {
        plasticity: Plasticity::Thornton,
        yield_pressure_pa: Some(8e8),
        ..Settings::default()
    };
    let once = Collision::new(&block, &ball, 1.0);
    let velocity = ratio / once.yielding(&settings).unwrap().unwrap().velocity_ratio();
    (Collision::new(&block, &ball, velocity), settings)
}

#[test]
fn thornton_without_waves_is_his_closed_form() {
    for ratio in [1.0001_f64, 1.01, 1.3, 2.0, 7.0, 40.0, 300.0, 1e3] {
        let (mut collision, settings) = at(ratio);
        // no wave is outrun by a block as stiff
        collision.target_longitudinal_speed_m_s *= 1e6;
        let settings = Settings {
            model: Model::Hertz,
            ..settings
        };
        let (_, r) = solved(&collision, &settings);
        let s = r.plastic.velocity_over_yield.unwrap();
        let root = 1.2 - 0.2 / (s * s);
        let closed = (1.2 * 3f64.sqrt()).sqrt()
            * (1.0 - 1.0 / (6.0 * s * s)).sqrt()
            * (1.0 / s / (1.0 / s + 2.0 * root.sqrt())).powf(0.25);
        near("restitution", r.restitution, closed, 1e-9);
        near(
            "peak force",
            r.peak_force_n,
            s.powf(-1.2) * s * root.sqrt() * collision.units().force_n,
            1e-9 * r.peak_force_n,
        );
    }
}

#[test]
fn the_quick_way_is_the_march() {
    for (plasticity, allowed) in [
        (Plasticity::Thornton, 1e-9),
        (Plasticity::Recovery, 1e-9),
        (Plasticity::JacksonGreen, 1e-8),
    ] {
        let mut worst = [0.0_f64; 6];
        for ratio in [
            1.0 + 1e-5,
            1.003,
            1.05,
            1.2,
            1.9,
            3.0,
            5.0,
            13.0,
            30.0,
            77.0,
            200.0,
            900.0,
        ] {
            let (collision, settings) = at(ratio);
            let settings = Settings {
                model: Model::AreaDashpot,
                plasticity,
                yield_pressure_pa: settings
                    .yield_pressure_pa
                    .filter(|_| plasticity != Plasticity::JacksonGreen),
                ..settings
            };
            let (found, _) = solved(&collision, &settings);
            let Some(flow) = found.flow else { continue };
            let quick = found.summary;
            let (_, history) = Solver::new(&Exact)
                .solve_with_history(&collision, &settings)
                .unwrap();
            let contact = history.pieces.as_ref().unwrap();
            let (march, slow) = (contact.summary, contact.flow.unwrap());
            let off = [
                quick.restitution / march.restitution,
                quick.peak_force / march.peak_force,
                quick.contact_time / march.contact_time,
                quick.peak_displacement / march.peak_displacement,
                1.0 + flow.plastic_work - slow.plastic_work,
                1.0 + flow.radiated - slow.radiated,
            ];
            println!(
                "{plasticity:?} {ratio} {:?}",
                off.map(|x| format!("{:.1e}", x - 1.0))
            );
            for (worst, off) in worst.iter_mut().zip(off) {
                *worst = worst.max((off - 1.0).abs());
            }
            near(
                "deflection",
                quick.peak_deflection / march.peak_deflection,
                1.0,
                1e-3,
            );
            near(
                "time of the peak",
                quick.peak_force_time / march.peak_force_time,
                1.0,
                1e-6,
            );
        }
        println!("{plasticity:?}: {worst:?}");
        assert!(
            worst.iter().all(|off| *off < allowed),
            "{plasticity:?}: {worst:?}"
        );
    }
}

#[test]
fn below_yield_it_is_the_elastic_contact_to_the_last_bit() {
    let (collision, settings) = at(0.99);
    let elastic = Settings {
        plasticity: Plasticity::None,
        yield_pressure_pa: None,
        ..settings
    };
    for model in [
        Model::Auto,
        Model::Hertz,
        Model::AreaDashpot,
        Model::Growing,
    ] {
        let [one, other] =
            [settings, elastic].map(|s| solved(&collision, &Settings { model, ..s }).1);
        let mut bare = one;
        bare.plastic = other.plastic;
        assert_eq!(bare, other);
    }
    let (fast, settings) = at(100.0);
    let hard = Settings {
        yield_pressure_pa: Some(1e15),
        ..settings
    };
    let [mut one, other] = [hard, elastic].map(|s| solved(&fast, &s).1);
    one.plastic = other.plastic;
    assert_eq!(one, other);
}

#[test]
fn restitution_does_not_depend_on_the_radius() {
    let e = |radius: f64| {
        let (collision, settings) = at(20.0);
        let larger = Collision {
            tip_radius_m: radius * collision.tip_radius_m,
            mass_kg: radius.powi(3) * collision.mass_kg,
            ..collision
        };
        solved(&larger, &settings).1.restitution
    };
    near("restitution", e(7.0), e(1.0), 1e-12);
}

#[test]
fn the_ledger_closes_at_every_instant_and_plastic_work_never_falls() {
    for plasticity in [Plasticity::Thornton, Plasticity::Recovery] {
        for model in [Model::AreaDashpot, Model::Growing] {
            let (collision, settings) = at(15.0);
            let settings = Settings {
                plasticity,
                model,
                tolerance: 1e-9,
                ..settings
            };
            let (_, history) = Solver::new(&Exact)
                .solve_with_history(&collision, &settings)
                .unwrap();
            let contact = history.pieces.as_ref().unwrap();
            let mut before = 0.0;
            for i in 0..=500 {
                let time = contact.summary.contact_time * 0.999 * f64::from(i) / 500.0;
                let now = contact.state(time);
                let [stored, flowed, radiated] = contact.energies(time).unwrap();
                let sum = now.velocity * now.velocity + stored + flowed + radiated;
                near(&format!("energy at {time}"), sum, 1.0, 1e-9);
                assert!(flowed >= before - 1e-12, "{flowed} after {before}");
                before = flowed;
                // each term counts
                let largest =
                    [stored, flowed, radiated].map(|term| (sum - 0.01 * term - 1.0).abs());
                if i == 250 {
                    assert!(largest.iter().all(|off| *off > 1e-6), "{largest:?}");
                }
            }
        }
    }
}

#[test]
fn rows_of_jackson_and_green() {
    for line in JACKSON_GREEN.lines().skip(1) {
        let v: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        let [strain, nu, ratio, lag, e, time, deepest, force] = std::array::from_fn(|i| v[i]);
        let given = |youngs_modulus_pa: f64, poisson_ratio: f64, yield_strength_pa: Option<f64>| {
            let mut made = Material::named("steel").unwrap();
            (made.youngs_modulus_pa, made.poisson_ratio) = (youngs_modulus_pa, poisson_ratio);
            made.yield_strength_pa = yield_strength_pa;
            made
        };
        let modulus = 1e11;
        let soft = given(modulus * (1.0 - nu * nu), nu, Some(strain * modulus));
        let ball = Striker::ball(given(1e30, 0.0, None), 0.01).unwrap();
        let block = HalfSpace::new(soft).unwrap();
        let mut settings = Settings {
            model: if lag > 0.0 {
                Model::AreaDashpot
            } else {
                Model::Hertz
            },
            plasticity: Plasticity::JacksonGreen,
            ..Settings::default()
        };
        let once = Collision::new(&block, &ball, 1.0);
        // the law leaves Hertz's at 1.9 times the indentation at which the material yields under the surface
        let leaves = 1.0 / once.yielding(&settings).unwrap().unwrap().velocity_ratio();
        let critical = leaves / 1.9_f64.powf(1.25);
        let mut collision = Collision::new(&block, &ball, ratio * critical);
        let units = Collision::new(&block, &ball, critical).units();
        // the lag in units of the critical velocity goes with V^0.6
        let response = SurfaceResponse::new(&Medium::new(nu).unwrap(), Deflection::Centre);
        let wanted = if lag > 0.0 { lag } else { 1e-6 } * ratio.powf(0.6);
        collision.target_longitudinal_speed_m_s *=
            collision.lag(collision.contact_wave_time(), &response) / wanted;
        settings.tolerance = 1e-6;
        let (_, r) = solved(&collision, &settings);
        let allowed = 1e-6;
        near(&format!("restitution of {line}"), r.restitution, e, allowed);
        near(
            "contact time",
            r.contact_time_s / units.time_s,
            time,
            allowed * time,
        );
        near(
            "indentation",
            r.peak_displacement_m / units.length_m,
            deepest,
            allowed * deepest,
        );
        near(
            "residual",
            r.plastic.residual_indentation_m.unwrap() / units.length_m,
            v.get(8).copied().unwrap_or(0.0),
            2e-6 * deepest,
        );
        assert!(r.peak_force_n / units.force_n >= force * (1.0 - 1e-6));
    }
}

#[test]
fn a_rebound_gives_back_its_yield_pressure_and_its_velocity() {
    let block = HalfSpace::new(Material::named("aluminium-6061-t6").unwrap()).unwrap();
    for i in 0..12 {
        // equidistributed in three dimensions
        let part = |root: f64| (f64::from(i + 1) * root).fract();
        let ball = Striker::ball(
            Material::named("bearing-steel").unwrap(),
            1e-3 + 0.01 * part(2f64.sqrt()),
        )
        .unwrap();
        let (velocity, pressure) = (
            0.3 * 30f64.powf(part(3f64.sqrt())),
            4e8 * 3f64.powf(part(5f64.sqrt())),
        );
        let settings = Settings {
            plasticity: [Plasticity::Thornton, Plasticity::Recovery][i as usize % 2],
            yield_pressure_pa: Some(pressure),
            model: Model::AreaDashpot,
            ..Settings::default()
        };
        let (_, r) = solved(&Collision::new(&block, &ball, velocity), &settings);
        for (measure, value) in [
            (Measure::Restitution, r.restitution),
            (Measure::PeakForce, r.peak_force_n),
        ] {
            for (unknown, true_value) in [
                (Unknown::YieldPressure, pressure),
                (Unknown::Velocity, velocity),
            ] {
                let known = if unknown == Unknown::Velocity {
                    1.0
                } else {
                    velocity
                };
                let collision = Collision::new(&block, &ball, known);
                let measured = [value, 0.01 * value];
                let found = infer(&collision, &settings, unknown, measure, measured).unwrap();
                near(
                    &format!("{unknown:?} from {measure:?}"),
                    found.value / true_value,
                    1.0,
                    1e-6,
                );
                let [low, high] = found.band;
                assert!(
                    low.is_none_or(|low| low < found.value)
                        && high.is_none_or(|high| high > found.value)
                );
            }
        }
    }
}

#[test]
fn every_law_is_followed_at_every_velocity() {
    let (_, settings) = at(1.0);
    let block = HalfSpace::new(Material::named("aluminium-6061-t6").unwrap()).unwrap();
    let ball = Striker::ball(Material::named("bearing-steel").unwrap(), 0.01).unwrap();
    let responses = Tabulated::default();
    let mut solver = Solver::new(&responses);
    for plasticity in [
        Plasticity::Thornton,
        Plasticity::Recovery,
        Plasticity::JacksonGreen,
    ] {
        let settings = Settings {
            plasticity,
            yield_pressure_pa: None,
            ..settings
        };
        for i in 0..300 {
            let velocity = 0.02 * 1000f64.powf(f64::from(i % 60) / 59.0 + f64::from(i / 60) * 1e-3);
            let found = solver.solve(&Collision::new(&block, &ball, velocity), &settings);
            assert!(found.is_ok(), "{plasticity:?} at {velocity}: {found:?}");
        }
    }
}

#[test]
fn a_yielding_contact_that_the_surface_meets_again_is_refused() {
    // a ball of a thousandth of its mass at a quarter of the speed of Rayleigh waves
    let block = HalfSpace::new(Material::named("pmma").unwrap()).unwrap();
    let mut ball = Striker::ball(Material::named("iron").unwrap(), 0.005).unwrap();
    ball.mass_kg *= 1e-3;
    let rayleigh = Medium::new(0.35).unwrap().rayleigh_speed() * block.longitudinal_speed_m_s();
    let collision = Collision::new(&block, &ball, 0.283 * rayleigh);
    let solve = |model| {
        let settings = Settings {
            plasticity: Plasticity::Recovery,
            model,
            ..Settings::default()
        };
        Solver::new(&Exact).solve(&collision, &settings)
    };
    let refused = solve(Model::Growing).unwrap_err().to_string();
    assert!(refused.contains("meets the striker again"), "{refused}");
    // the dashpot has one contact, and no results that count
    let found = solve(Model::Auto).unwrap();
    assert!(found.chosen.model == Model::AreaDashpot && found.error > 0.5);
}

/// Errors of `auto` over their estimates on random pairs of metals, from the onset of yield to some hundred times its
/// velocity; and what the dashpot leaves out over c^2, from which `auto` chooses.
#[test]
fn estimates_of_contacts_that_yield_hold() {
    let metals = [
        "steel",
        "aluminium-6061-t6",
        "copper",
        "brass-70-30",
        "titanium",
    ];
    let (mut over, mut left_out) = (Vec::new(), Vec::new());
    for i in 0..80_u32 {
        let part = |root: f64| (f64::from(i + 1) * root).fract();
        let named = |i: u32| Material::named(metals[i as usize % metals.len()]).unwrap();
        let block = HalfSpace::new(named(i)).unwrap();
        let mut ball = Striker::ball(named(i / 5 + 2), 0.005).unwrap();
        ball.mass_kg *= 0.5 * 6f64.powf(part(2f64.sqrt()));
        let settings = Settings {
            plasticity: [Plasticity::Thornton, Plasticity::Recovery][i as usize % 2],
            yield_pressure_pa: Some(3e8 * 10f64.powf(part(3f64.sqrt()))),
            tolerance: 1e-6 * 1e3f64.powf(part(5f64.sqrt())),
            ..Settings::default()
        };
        let slow = Collision::new(&block, &ball, 1.0);
        let onset = 1.0 / slow.yielding(&settings).unwrap().unwrap().velocity_ratio();
        let velocity = (onset * 1.05 * 300f64.powf(part(7f64.sqrt()))).min(40.0);
        let collision = Collision::new(&block, &ball, velocity);
        let with = |model, tolerance| {
            let settings = Settings {
                model,
                tolerance,
                ..settings
            };
            Solver::new(&Exact).solve(&collision, &settings)
        };
        // stiff strikers' last instants cannot all be followed so closely
        let Some(exact) = with(Model::Growing, 1e-7)
            .ok()
            .filter(|one| one.flow.is_some())
        else {
            continue;
        };
        let found = with(Model::Auto, settings.tolerance).unwrap();
        let error = found.summary.distance(&exact.summary);
        over.push((error - exact.error).max(0.0) / found.error);
        let damped = with(Model::AreaDashpot, settings.tolerance).unwrap();
        let lag = damped.chosen.regime.lag;
        left_out.push(damped.summary.distance(&exact.summary) / (lag * lag));
    }
    over.sort_by(f64::total_cmp);
    left_out.sort_by(f64::total_cmp);
    let (count, last) = (over.len(), over.len() - 1);
    println!(
        "auto: error over estimate median {:.2}, largest {:.2}, of {count}; dashpot: error over c^2 median {:.2}, largest {:.2}",
        over[count / 2],
        over[last],
        left_out[count / 2],
        left_out[last]
    );
    assert!(count > 60 && over[last] < 1.0, "{over:?}");
    // the coefficient of `auto`
    assert!(left_out[last] < 10.0, "{left_out:?}");
}
