//! Outcomes from series against marches, on random rows of sweeps.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test file without test functions of its own crate"
)]

use contact::{
    Collision, HalfSpace, Material, Model, Outcomes, Plasticity, Settings, Solver, StaticShare,
    Striker, Tabulated,
};
use halfspace::Deflection;

/// Rows that a sweep is said to have, so that its series pay.
const ROWS: usize = 10_000_000;

/// Balls of 4 to 10 mm at 0.1 to 10 m/s on two materials, on discs of 0.5 to 2 of their contact radii where one is asked for.
fn rows(model: Model, tolerance: f64, count: u32) -> Vec<(Collision, Settings)> {
    let named = |name: &str| Material::named(name).unwrap();
    let targets = ["steel", "soda-lime-glass"].map(|name| HalfSpace::new(named(name)).unwrap());
    let row = |i: u32| {
        // equidistributed in four dimensions (Kronecker's sequence of square roots)
        let part = |root: f64| (f64::from(i) * root.sqrt()).fract();
        let between = |low: f64, high: f64, x: f64| low * (high / low).powf(x);
        let tip = between(2e-3, 5e-3, part(2.0));
        let velocity = between(0.1, 10.0, part(5.0));
        let mass = 4.19 * tip.powi(3) * between(7000.0, 8500.0, part(3.0));
        let disc = 0.6 * tip * (1.0_f64 / 3000.0).powf(0.4) * between(0.5, 2.0, part(7.0));
        let striker = Striker::new(named("copper"), mass, tip).unwrap();
        let settings = Settings {
            model,
            tolerance,
            disc_radius_m: (model == Model::Wave).then_some(disc),
            static_share: [StaticShare::Full, StaticShare::Dynamic][(i / 2 % 5 == 4) as usize],
            deflection: [Deflection::Centre, Deflection::Mean][(i / 2 % 3 == 2) as usize],
            ..Settings::default()
        };
        let collision = Collision::new(&targets[i as usize % 2], &striker, velocity);
        (collision, settings)
    };
    (0..count).map(row).collect()
}

fn series(rows: &[(Collision, Settings)], responses: &Tabulated) -> Outcomes {
    Solver::new(responses).outcomes(ROWS, rows.iter().copied())
}

#[test]
fn series_are_within_their_certificates_and_the_tolerance() {
    for (model, tolerance, most_marched) in [
        (Model::Growing, 1e-4, 0.0),
        (Model::Growing, 1e-6, 0.0),
        (Model::Wave, 1e-4, 0.1),
        (Model::Wave, 1e-6, 0.1),
    ] {
        let rows = rows(model, tolerance, 300);
        let responses = Tabulated::default();
        let outcomes = series(&rows, &responses);
        let mut solver = Solver::sharing(&responses, &outcomes);
        let mut marches = Solver::new(&responses);
        let (mut marched, mut refused, mut beyond) = (0, 0, 0);
        let mut worst = [0.0_f64; 4];
        for (collision, settings) in &rows {
            let found = solver.solve(collision, settings);
            let exactly = Settings {
                tolerance: 1e-9,
                ..*settings
            };
            let Ok(found) = found else {
                assert!(marches.solve(collision, settings).is_err());
                refused += 1;
                continue;
            };
            if found.scheme.is_some() {
                marched += 1;
                continue;
            }
            let exact = marches.solve(collision, &exactly).unwrap();
            let (a, b) = (&found.summary, &exact.summary);
            assert_eq!((a.contacts, found.step), (b.contacts, None));
            let error = a.distance(b);
            beyond += usize::from(error > found.error);
            let late = (a.peak_force_time - b.peak_force_time).abs() / b.contact_time;
            let deflection = (a.peak_deflection / b.peak_deflection - 1.0).abs();
            let work = (found.radiated / exact.radiated - 1.0).abs();
            let beside = a.loss_distance(b).max(deflection).max(work);
            for (worst, new) in worst.iter_mut().zip([error, late, beside, found.error]) {
                *worst = worst.max(new);
            }
        }
        let [results, time, rest, certificate] = worst.map(|error| format!("{error:.1e}"));
        println!(
            "{model:?} {tolerance:e}: {results} for results, {time} for the time of the peak, {rest} for the rest, certificates up to {certificate}, {beyond} beyond them, {marched} marched, {refused} refused"
        );
        assert!(f64::from(marched) <= most_marched * rows.len() as f64);
        assert!(beyond == 0 && worst[0] <= tolerance && worst[3] <= tolerance);
        // work of a growing contact by superposition is as good as its own rule
        assert!(worst[1] <= tolerance && worst[2] <= 10.0 * tolerance + 1e-4);
    }
}

/// The numbers of a row are those of its cell, whatever else was solved before it.
#[test]
fn the_order_of_rows_does_not_matter() {
    for model in [Model::Growing, Model::Wave] {
        let rows = rows(model, 1e-4, 64);
        let responses = Tabulated::default();
        let solve = |order: &mut dyn Iterator<Item = usize>| {
            let outcomes = series(&rows, &responses);
            let mut solver = Solver::sharing(&responses, &outcomes);
            let mut found: Vec<_> = order
                .map(|i| (i, solver.solve(&rows[i].0, &rows[i].1).ok()))
                .collect();
            found.sort_by_key(|(i, _)| *i);
            found
        };
        let all = solve(&mut (0..64));
        assert_eq!(all, solve(&mut (0..64).rev()));
        let halves = [solve(&mut (0..32)), solve(&mut (32..64))].concat();
        assert_eq!(all, halves);
        let from_series = |(_, found): &(usize, Option<contact::Solved>)| {
            found.as_ref().is_some_and(|one| one.scheme.is_none())
        };
        assert!(all.iter().filter(|row| from_series(row)).count() > 50);
    }
}

/// A few rows do not pay for marches at nodes, nor do rows that are all of other materials.
#[test]
fn few_rows_are_marched() {
    let rows = rows(Model::Growing, 1e-4, 20);
    let responses = Tabulated::default();
    let few = Solver::new(&responses).outcomes(rows.len(), rows.iter().copied());
    let others = rows.iter().enumerate().map(|(i, (collision, settings))| {
        let target_plane_modulus_pa = collision.target_plane_modulus_pa * (1.0 + 1e-3 * i as f64);
        let other = Collision {
            target_plane_modulus_pa,
            ..*collision
        };
        (other, *settings)
    });
    let others = Solver::new(&responses).outcomes(20 * rows.len(), others);
    for outcomes in [few, others] {
        let mut solver = Solver::sharing(&responses, &outcomes);
        for (collision, settings) in &rows {
            let found = solver.solve(collision, settings).unwrap();
            assert!(found.scheme.is_some());
            assert_eq!(
                found,
                Solver::new(&responses).solve(collision, settings).unwrap()
            );
        }
    }
}

/// A history and a step that is given are marched.
#[test]
fn what_a_series_does_not_have_is_marched() {
    let rows = rows(Model::Wave, 1e-4, 20);
    let responses = Tabulated::default();
    let outcomes = series(&rows, &responses);
    let mut solver = Solver::sharing(&responses, &outcomes);
    let (collision, settings) = &rows[0];
    assert!(solver.solve(collision, settings).unwrap().scheme.is_none());
    let (solved, history) = solver.solve_with_history(collision, settings).unwrap();
    assert!(solved.scheme.is_some() && history.force.len() > 20);
    let step_s = Some(1e-7);
    let stepped = Settings {
        step_s,
        ..*settings
    };
    assert_eq!(
        solver.solve(collision, &stepped).unwrap().step,
        Some(1e-7 / collision.units().time_s)
    );
}

/// Balls of a hardened steel on soft metals, from below the onset of yield to some thousand times its velocity.
#[test]
fn series_of_the_fit_are_within_their_certificates_and_the_tolerance() {
    let named = |name: &str| Material::named(name).unwrap();
    let targets =
        ["aluminium-6061-t6", "titanium"].map(|name| HalfSpace::new(named(name)).unwrap());
    for tolerance in [1e-4, 1e-6] {
        let row = |i: u32| {
            let part = |root: f64| (f64::from(i) * root.sqrt()).fract();
            let tip = 1e-3 * 10f64.powf(part(2.0));
            let mass = 4.19 * tip.powi(3) * 7800.0 * 2f64.powf(part(3.0));
            let striker = Striker::new(named("bearing-steel"), mass, tip).unwrap();
            let settings = Settings {
                model: Model::AreaDashpot,
                plasticity: Plasticity::JacksonGreen,
                tolerance,
                ..Settings::default()
            };
            let velocity = 1e-2 * 2e3f64.powf(part(5.0));
            let collision = Collision::new(&targets[i as usize % 2], &striker, velocity);
            (collision, settings)
        };
        let rows: Vec<_> = (0..2000).map(row).collect();
        let responses = Tabulated::default();
        let outcomes = series(&rows, &responses);
        let mut solver = Solver::sharing(&responses, &outcomes);
        let (mut from_series, mut elastic, mut refused) = (0, 0, 0);
        let (mut beyond, mut worst) = (0, 0.0_f64);
        for (collision, settings) in &rows {
            let exact = Solver::new(&responses).solve(collision, settings);
            let (Ok(found), Ok(exact)) = (solver.solve(collision, settings), exact) else {
                refused += 1;
                continue;
            };
            let (Some(flow), Some(own)) = (found.flow, exact.flow) else {
                elastic += 1;
                assert!(found == exact);
                continue;
            };
            if found == exact {
                continue;
            }
            from_series += 1;
            let error = found.summary.distance(&exact.summary);
            worst = worst.max(error);
            // the estimate is what the dashpot leaves out, and the certificate
            beyond += usize::from(error > found.error - exact.error);
            assert!(error < tolerance, "{error:e}");
            assert!((flow.radiated - own.radiated).abs() < tolerance);
            assert!((flow.plastic_work - own.plastic_work).abs() < tolerance);
            assert!((flow.flatter / own.flatter - 1.0).abs() < 10.0 * tolerance);
        }
        println!(
            "{from_series} of {} from series, {elastic} elastic, {refused} refused; off by {worst:.1e} at most, {beyond} beyond the certificate",
            rows.len()
        );
        assert!(from_series > 1200 && elastic > 20 && refused == 0);
        assert!(beyond <= from_series / 1000);
    }
}
