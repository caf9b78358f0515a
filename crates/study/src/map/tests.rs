//! Every failure found by the chart, pinned: a right answer, or a clear error.

use super::kernels::{
    closed_form_error, deep_static_error, double_root_error, double_root_own_error,
    incompressible_error, incompressible_surface,
};
use super::marches::{
    Converged, MarchOutcome, admittance, dynamic_growth_limit, dynamic_is_solved, dynamic_limit,
    linear_growth,
};
use super::models::{Plane, SPEEDS_M_S, TOLERANCES, place_of, targets};
use crate::scenes::{paper_disc, paper_response};
use contact::law::hertz::CONTACT_TIME;
use contact::{
    FixedDisc, Memory, Model, Physics, StaticShare, Summary, march_explicit, march_implicit,
};
use halfspace::Medium;
use impact::{HalfSpace, Impact, Material, Striker};
use paper::PRINTED_PA;
use std::f64::consts::PI;

#[test]
fn the_published_restitution_is_the_explicit_schemes_step() {
    let response = paper_response().unwrap();
    let disc = paper_disc(PRINTED_PA, &response).unwrap();
    let exact = Converged::new(disc.clone()).unwrap();
    assert!((exact.summary.restitution - 0.980_44).abs() < 1e-5);
    let step = exact.summary.contact_time / 200.0;
    let (_, found) = march_explicit(&disc, step).unwrap();
    assert!(
        (found.restitution - 0.9916).abs() < 2e-3,
        "{}",
        found.restitution
    );
    let theory = exact.explicit_restitution(step);
    assert!(
        (theory - found.restitution).abs() < 2e-3,
        "{theory} {}",
        found.restitution
    );
    let (_, coarse) = march_explicit(&disc, exact.summary.contact_time / 54.0).unwrap();
    assert!(coarse.restitution > 1.0);
}

#[test]
fn first_order_theory_gives_the_slope_of_the_explicit_schemes_energy() {
    let response = paper_response().unwrap();
    let disc = paper_disc(PRINTED_PA, &response).unwrap();
    let exact = Converged::new(disc.clone()).unwrap();
    // the sampled end of contact scatters: a mean over many steps near one another
    let mean = |step: f64| -> f64 {
        let slope = |i: i32| {
            let step = step * (1.0 + 0.01 * f64::from(i));
            let (_, found) = march_explicit(&disc, step).unwrap();
            (exact.summary.loss - found.loss) / step
        };
        (-10..=10).map(slope).sum::<f64>() / 21.0
    };
    let slope = mean(1e-3);
    assert!(
        (slope / exact.gain - 1.0).abs() < 0.1,
        "{slope} against {}",
        exact.gain
    );
}

#[test]
fn the_explicit_march_blows_up_beyond_its_boundary_and_not_well_below() {
    let response = paper_response().unwrap();
    let paper = paper_disc(PRINTED_PA, &response).unwrap();
    for scale in [3.0, 10.0, 30.0] {
        let disc = FixedDisc {
            coupling: scale * paper.coupling,
            ..paper
        };
        let exact = Converged::new(disc.clone()).unwrap();
        let beyond = exact.explicit(2.0 * exact.stable_step());
        assert!(
            matches!(beyond, MarchOutcome::BlownUp | MarchOutcome::Oscillates),
            "{scale}: {beyond:?}"
        );
        let below = exact.explicit(0.5 * exact.smooth_step());
        assert!(
            matches!(
                below,
                MarchOutcome::Accurate | MarchOutcome::Lossy | MarchOutcome::GainsEnergy
            ),
            "{scale}: {below:?}"
        );
    }
}

#[test]
fn the_implicit_march_is_stable_on_the_papers_plane_and_gains_no_energy() {
    let response = paper_response().unwrap();
    let disc = paper_disc(PRINTED_PA, &response).unwrap();
    for scale in [0.1, 1.0, 3.0] {
        let disc = FixedDisc {
            coupling: scale * disc.coupling,
            ..disc
        };
        let exact = Converged::new(disc.clone()).unwrap();
        for step in [2e-3, 8e-3, 0.03, 0.08] {
            let outcome = exact.implicit(step * CONTACT_TIME);
            assert!(
                matches!(outcome, MarchOutcome::Accurate | MarchOutcome::Lossy),
                "{scale} {step}: {outcome:?}"
            );
            assert!(linear_growth(&disc, 1.5, step * CONTACT_TIME) < 1.0);
        }
    }
}

#[test]
fn on_a_very_soft_half_space_steps_near_the_memory_settle() {
    let response = paper_response().unwrap();
    let paper = paper_disc(PRINTED_PA, &response).unwrap();
    // k/Z = 50 a collision time: with the curvature of the newest cell extrapolated in full the force blew up here
    let disc = FixedDisc {
        coupling: paper.coupling * 50.0 / (1.5 * admittance(&paper)),
        ..paper
    };
    let exact = Converged::new(disc.clone()).unwrap();
    for step in [0.01, 0.02, 0.04, 0.08] {
        let step = step * CONTACT_TIME;
        assert!(linear_growth(&disc, 1.5 * exact.summary.peak_force.cbrt(), step) < 1.0);
        let outcome = exact.implicit(step);
        assert!(
            matches!(outcome, MarchOutcome::Accurate | MarchOutcome::Lossy),
            "{step}: {outcome:?}"
        );
    }
}

#[test]
fn the_dynamic_share_is_refused_where_it_has_no_solution() {
    let response = paper_response().unwrap();
    let paper = paper_disc(PRINTED_PA, &response).unwrap();
    for step in [1e-3, 0.01] {
        let limit = dynamic_limit(&paper, step * CONTACT_TIME);
        let at = |coupling: f64| {
            let disc = FixedDisc { coupling, ..paper };
            dynamic_is_solved(&disc, step * CONTACT_TIME)
        };
        assert!(
            at(0.8 * limit) && !at(1.2 * limit),
            "limit {limit} at {step}"
        );
    }
    // coarse steps hide it, up to the fold and not from where the samples grow
    for step in [0.1, 0.18] {
        let step = step * CONTACT_TIME;
        let at = |coupling: f64| {
            let disc = FixedDisc { coupling, ..paper };
            dynamic_is_solved(&disc, step)
        };
        let (grows, folds) = (
            dynamic_growth_limit(&paper, step),
            dynamic_limit(&paper, step),
        );
        assert!(grows < folds, "{grows} {folds}");
        assert!(
            at(0.9 * grows) && !at(1.1 * folds),
            "{grows} {folds} at {step}"
        );
    }
    let disc = FixedDisc {
        coupling: 2.0,
        share: StaticShare::Dynamic,
        ..paper
    };
    let message = march_implicit(&disc, 0.01).unwrap_err().to_string();
    assert!(
        message.contains("2.0000") && message.contains("static_share \"full\""),
        "{message}"
    );
}

#[test]
fn too_few_samples_are_refused_with_the_remedy() {
    let response = paper_response().unwrap();
    let disc = paper_disc(PRINTED_PA, &response).unwrap();
    let history = march_implicit(&disc, 0.5 * CONTACT_TIME).unwrap();
    let message = Summary::new(&history).unwrap_err().to_string();
    assert!(message.contains("smaller step_s"), "{message}");
}

#[test]
fn closed_potentials_lose_digits_as_the_cube_of_the_distance_and_the_program_does_not() {
    for (size, low, high) in [
        (10.0, 0.0, 1e-11),
        (1e3, 1e-9, 1e-5),
        (1e5, 1e-3, f64::INFINITY),
    ] {
        let error = closed_form_error(size, 0.5 * PI, 0.5);
        assert!((low..=high).contains(&error), "|xi| = {size}: {error:e}");
    }
    for nu in [0.0, 0.3, 0.49] {
        let medium = Medium::new(nu).unwrap();
        for depth in [3.0, 7.0, 10.0, 30.0, 1e3, 1e5, 1e6] {
            let error = deep_static_error(&medium, 0.5, depth).unwrap();
            assert!(error < 1e-12, "nu = {nu}, z = {depth}: {error:e}");
        }
    }
}

#[test]
fn the_double_root_costs_the_closed_form_digits_but_not_the_answer() {
    let mut worst = 0.0_f64;
    for distance in [1e-2, 1e-6, 1e-9, 1e-12, 1e-15, 0.0] {
        for sign in [1.0, -1.0] {
            let error = double_root_error(sign * distance).unwrap();
            let promised = (1e-13 + 1e-15 / distance.sqrt()).min(1e-7);
            assert!(error < promised, "{distance:e}: {error:e}");
            worst = worst.max(error);
            let own = double_root_own_error(sign * distance).unwrap();
            assert!(own < 2e-14, "{distance:e}: {own:e}");
        }
    }
    // the place is the double root, to the last bits
    assert!(worst > 1e-11, "{worst:e}");
}

#[test]
fn nearly_incompressible_solids_keep_their_digits() {
    let mut before: Option<f64> = None;
    for distance in [1e-1, 1e-3, 1e-5, 1e-7, 1e-9] {
        assert!(
            incompressible_error(distance).unwrap() < 3e-8,
            "{distance:e}"
        );
        let [own, closed] = incompressible_surface(distance).unwrap();
        assert!((own - closed).abs() < 1e-10, "{distance:e}: {own} {closed}");
        // the limit exists: each hundredth of the distance moves W by less
        if let Some(before) = before {
            assert!((own - before).abs() < 1.0 * (1e4 * distance).sqrt());
        }
        before = Some(own);
    }
    assert!(Medium::new(0.5).is_err());
}

#[test]
fn auto_never_takes_a_model_that_misses_the_map() {
    let plane = Plane::new(Physics::Growing, 0.3).unwrap();
    let mut cheap = 0;
    for share in [0.02, 0.1, 0.3, 0.6, 1.0] {
        for memory in [3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3] {
            let errors = plane.errors(share, memory).unwrap();
            for tolerance in TOLERANCES {
                // the march itself is known to 2e-5
                let allowed = 1.05 * tolerance + 2e-5;
                match plane.chosen(share, memory, tolerance) {
                    Memory::None => assert!(
                        errors.quasi_static <= allowed,
                        "{share} {memory} {tolerance}: {errors:?}"
                    ),
                    Memory::FirstOrder | Memory::Dashpot => assert!(
                        errors.dashpot <= allowed,
                        "{share} {memory} {tolerance}: {errors:?}"
                    ),
                    Memory::Full => {
                        // not chosen where hertz is twice as good as asked
                        assert!(
                            errors.quasi_static > 0.5 * tolerance,
                            "{share} {memory} {tolerance}: {errors:?}"
                        );
                        continue;
                    }
                }
                cheap += 1;
            }
        }
    }
    assert!(cheap > 40, "{cheap}");
}

#[test]
fn contacts_with_a_long_memory_are_refused() {
    let plane = Plane::new(Physics::Growing, 0.3).unwrap();
    let errors = plane.errors(0.78, 1.0).unwrap();
    assert!(errors.memory.is_infinite(), "{errors:?}");
    for memory in [0.01, 0.1] {
        let errors = plane.errors(1.0, memory).unwrap();
        assert!(errors.memory < 1e-4, "{memory}: {errors:?}");
    }
}

#[test]
fn auto_leaves_a_model_not_long_before_the_map_does() {
    // the last memory at which a model is taken, and twice and a half of it
    let plane = Plane::new(Physics::Growing, 0.3).unwrap();
    let mut seen = 0;
    for share in [0.03, 0.1, 0.3, 1.0] {
        for tolerance in TOLERANCES {
            for left in [Memory::None, Memory::Dashpot] {
                let memory = plane.boundary(share, tolerance, left);
                if memory * CONTACT_TIME > 0.19 {
                    // as far as the expansion is trusted at all
                    continue;
                }
                let errors = plane.errors(share, 2.5 * memory).unwrap();
                let error = match left {
                    Memory::None => errors.quasi_static,
                    Memory::FirstOrder | Memory::Dashpot | Memory::Full => errors.dashpot,
                };
                assert!(error > tolerance, "{share} {tolerance} {left:?}: {error:e}");
                seen += 1;
            }
        }
    }
    assert!(seen >= 12, "{seen}");
}

#[test]
fn auto_agrees_with_the_map_of_the_papers_disc() {
    let plane = Plane::new(Physics::Disc(StaticShare::Full), 0.3).unwrap();
    let mut cheap = [0, 0];
    for coupling in [3e-3, 0.03, 0.18, 0.8, 3.0] {
        for memory in [3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1] {
            let errors = plane.errors(coupling, memory).unwrap();
            for tolerance in TOLERANCES {
                let allowed = 1.05 * tolerance + 2e-5;
                let found = format!("{coupling} {memory} {tolerance}: {errors:?}");
                match plane.chosen(coupling, memory, tolerance) {
                    Memory::None => {
                        cheap[0] += 1;
                        assert!(errors.quasi_static <= allowed, "{found}");
                    }
                    Memory::FirstOrder | Memory::Dashpot => {
                        cheap[1] += 1;
                        assert!(errors.radiation <= allowed, "{found}");
                    }
                    Memory::Full => assert!(errors.quasi_static > 0.5 * tolerance, "{found}"),
                }
            }
        }
    }
    assert!(cheap[0] > 15 && cheap[1] > 10, "{cheap:?}");
}

#[test]
fn built_in_materials_lie_where_auto_finds_them() {
    // a scene run through `auto` takes the model that the map shows at its place
    let plane = Plane::new(Physics::Growing, 0.29).unwrap();
    let steel = || Material::named("steel").unwrap();
    let block = HalfSpace::new(steel()).unwrap();
    let ball = Striker::ball(steel(), 0.005).unwrap();
    let names: Vec<&str> = targets().collect();
    assert!(names.len() >= 40 && names.contains(&"steel"));
    for speed in SPEEDS_M_S {
        let (share, memory) = place_of("steel", speed).unwrap();
        assert!(
            (share - 0.5).abs() < 1e-9,
            "steel on steel shares evenly: {share}"
        );
        for tolerance in TOLERANCES {
            let impact = Impact::new(block.clone(), ball.clone(), speed).to_tolerance(tolerance);
            let model = impact.solve().unwrap().solved.chosen.model;
            let expected = match plane.chosen(share, memory, tolerance) {
                Memory::None => Model::Hertz,
                Memory::FirstOrder | Memory::Dashpot => Model::AreaDashpot,
                Memory::Full => Model::Growing,
            };
            assert_eq!(model, expected, "{speed} m/s at {tolerance:e}");
        }
    }
}
