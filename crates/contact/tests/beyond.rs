//! Contacts beyond the range of their law, and work that would not end: a sentence or a warning in time.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{
    Collision, ContactError, Exact, FixedDisc, HalfSpace, MarchError, Material, Measure, Model,
    Plasticity, Results, Settings, Solver, StaticShare, Striker, Unknown, infer, march_implicit,
    warnings,
};
use halfspace::{Deflection, Medium, SurfaceResponse};
use std::time::{Duration, Instant};

/// A hard ball of 5 mm on a block without waves of a yield strength over its effective modulus of 1e11 Pa, at 1 m/s.
fn fitted(strain: f64, nu: f64) -> (HalfSpace, Striker, Settings) {
    let mut soft = Material::elastic(1e11 * (1.0 - nu * nu), nu, 2700.0).unwrap();
    soft.yield_strength_pa = Some(strain * 1e11);
    let hard = Material::elastic(1e30, 0.0, 7800.0).unwrap();
    let settings = Settings {
        model: Model::Hertz,
        plasticity: Plasticity::JacksonGreen,
        ..Settings::default()
    };
    let ball = Striker::ball(hard, 0.005).unwrap();
    (HalfSpace::new(soft).unwrap(), ball, settings)
}

fn solved(collision: &Collision, settings: &Settings) -> Result<Results, ContactError> {
    let solved = Solver::new(&Exact).solve(collision, settings)?;
    Results::new(collision, settings, &solved).checked()
}

/// The authors' formula for the restitution over V/V_c up to 1000 (Jackson, Green and Marghitu 2010).
fn of_the_authors(v: f64, strain: f64) -> f64 {
    1.0 - 0.1 * 60_f64.ln() - 0.11 * (v / 60.0).ln() * (v - 60.0).powf(2.36 * strain)
}

#[test]
fn the_fit_is_warned_of_where_it_leaves_its_authors_restitution() {
    for strain in [3e-4, 1e-3, 3e-3, 0.01] {
        let (block, ball, settings) = fitted(strain, 0.31);
        let at = |v: f64| {
            let once = Collision::new(&block, &ball, 1.0);
            let leaves = 1.0 / once.yielding(&settings).unwrap().unwrap().velocity_ratio();
            let velocity = v * leaves / 1.9_f64.powf(1.25);
            let collision = Collision::new(&block, &ball, velocity);
            let solved = Solver::new(&Exact).solve(&collision, &settings).unwrap();
            let results = Results::new(&collision, &settings, &solved);
            let told = warnings(
                &block,
                &ball,
                &collision,
                &settings,
                &solved.chosen,
                &results,
            );
            let warned = told.iter().any(|one| one.contains("is valid"));
            let off = results.restitution / of_the_authors(v, strain) - 1.0;
            (off, results.plastic.velocity_over_trusted.unwrap(), warned)
        };
        for v in [80.0, 200.0, 350.0, 499.0] {
            let (off, over, warned) = at(v);
            assert!(off.abs() < 0.025, "{strain} at {v}: {off}");
            assert!(
                (over - v / 500.0).abs() < 1e-9 && !warned,
                "{over} {warned}"
            );
        }
        let (_, over, warned) = at(501.0);
        assert!(over > 1.0 && warned);
        let (off, ..) = at(2000.0);
        assert!(off.abs() > 0.1, "{strain}: {off}");
    }
}

#[test]
fn the_onset_of_the_fit_is_where_it_differs_from_elasticity() {
    let (block, ball, settings) = fitted(2e-3, 0.27);
    let velocity = solved(&Collision::new(&block, &ball, 1.0), &settings).unwrap();
    let onset = velocity.plastic.yield_velocity_m_s.unwrap();
    let restitution = |part: f64| {
        let found = solved(&Collision::new(&block, &ball, part * onset), &settings).unwrap();
        (
            found.restitution,
            found.plastic.velocity_over_yield.unwrap(),
        )
    };
    let (below, under) = restitution(0.999);
    let (above, over) = restitution(1.1);
    assert!(below == 1.0 && under < 1.0, "{below} {under}");
    assert!(above < 0.999 && over > 1.0, "{above} {over}");
}

#[test]
fn a_dent_as_deep_as_the_indentation_is_refused_whatever_the_strength() {
    let begun = Instant::now();
    for strength in [1e5, 1e2, 1.0, 1e-9, 1e-30, 1e-120, 1e-300] {
        let (block, ball, settings) = fitted(strength * 1e-11, 0.3);
        for velocity in [0.07, 3.0, 40.0] {
            let found = solved(&Collision::new(&block, &ball, velocity), &settings);
            let error = found.unwrap_err().to_string();
            let says = error.contains("thornton") || error.contains("check their units");
            assert!(says, "{strength} at {velocity}: {error}");
        }
    }
    assert!(begun.elapsed() < Duration::from_secs(20));
}

/// Steel on titanium with a pressure of Thornton's law.
fn titanium(velocity: f64, pressure: f64) -> (Collision, Settings) {
    let block = HalfSpace::new(Material::named("titanium").unwrap()).unwrap();
    let ball = Striker::ball(Material::named("bearing-steel").unwrap(), 0.0021).unwrap();
    let settings = Settings {
        plasticity: Plasticity::Thornton,
        yield_pressure_pa: Some(pressure),
        model: Model::AreaDashpot,
        ..Settings::default()
    };
    (Collision::new(&block, &ball, velocity), settings)
}

#[test]
fn every_rebound_is_inferred_that_an_impact_gives() {
    for pressure in [3e8, 2e7, 4e6] {
        let (collision, settings) = titanium(1.7, pressure);
        let found = solved(&collision, &settings).unwrap();
        let over = found.plastic.velocity_over_yield.unwrap();
        let given = [found.restitution, 0.0];
        let back = infer(
            &collision,
            &Settings {
                yield_pressure_pa: None,
                ..settings
            },
            Unknown::YieldPressure,
            Measure::Restitution,
            given,
        );
        let back = back.unwrap_or_else(|error| panic!("{over:e} times yield: {error}"));
        assert!((back.value / pressure - 1.0).abs() < 1e-6, "{}", back.value);
        assert!(!back.elastic && back.band.iter().all(Option::is_some));
    }
}

#[test]
fn an_elastic_rebound_has_a_least_pressure_and_no_largest() {
    let truth = 4e9;
    let (collision, settings) = titanium(0.11, truth);
    let elastic = solved(&collision, &settings).unwrap();
    assert!(elastic.plastic.velocity_over_yield.unwrap() < 1.0);
    // as measured, rounded up and down, and with an error
    let e = elastic.restitution;
    for given in [[e, 0.0], [e + 4e-7, 0.0], [e - 4e-7, 0.0], [e - 1e-4, 5e-4]] {
        let (unknown, measure) = (Unknown::YieldPressure, Measure::Restitution);
        let found = infer(&collision, &settings, unknown, measure, given).unwrap();
        let [low, high] = found.band;
        assert!(found.elastic && high.is_none(), "{given:?}: {found:?}");
        assert!(low.unwrap() < truth && low.unwrap() <= found.value);
    }
    // one that has yielded has both ends
    let (collision, settings) = titanium(3.0, 9e8);
    let given = [solved(&collision, &settings).unwrap().restitution, 1e-3];
    let (unknown, measure) = (Unknown::YieldPressure, Measure::Restitution);
    let found = infer(&collision, &settings, unknown, measure, given).unwrap();
    assert!(!found.elastic && found.band.iter().all(Option::is_some));
}

#[test]
fn a_step_too_fine_is_refused_before_the_march() {
    let response = SurfaceResponse::new(&Medium::new(0.33).unwrap(), Deflection::Centre);
    let disc = FixedDisc {
        response: &response,
        coupling: 0.4,
        wave_time: 5e-3,
        share: StaticShare::Full,
    };
    let begun = Instant::now();
    let found = march_implicit(&disc, 3e-6);
    assert!(
        matches!(found, Err(MarchError::TooLong { .. })),
        "{found:?}"
    );
    assert!(begun.elapsed() < Duration::from_secs(1));
    assert!(march_implicit(&disc, 2e-3).is_ok());
}
