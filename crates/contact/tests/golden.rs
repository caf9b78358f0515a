//! Converged impacts of an independent program (`tests/golden/impacts.csv`), and the order of convergence.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

#[path = "support/solids.rs"]
mod solids;

use contact::CollisionUnits;
use contact::{
    Choice, Collision, Exact, FixedDisc, HalfSpace, Model, Results, Settings, Solver, StaticShare,
    Striker, Summary, march_explicit, march_implicit,
};
use halfspace::{Deflection, Medium, SurfaceResponse};
use solids::material;

struct Row {
    case: String,
    collision: Collision,
    settings: Settings,
    peak_force_n: f64,
    contact_time_s: f64,
    restitution: f64,
    peak_displacement_m: f64,
    peak_deflection_m: f64,
}

fn rows(tolerance: f64) -> Vec<Row> {
    let text = include_str!("../../../tests/golden/impacts.csv");
    text.lines()
        .skip(1)
        .map(|line| {
            // the name of the case may hold a comma: count from the end
            let columns: Vec<&str> = line.rsplit(',').collect();
            let number = |from_end: usize| columns[from_end].parse::<f64>().unwrap();
            let target = HalfSpace::new(material(number(9), number(8), number(7))).unwrap();
            let tip = material(number(11), number(10), number(7));
            let striker = Striker::new(tip, number(14), number(12)).unwrap();
            Row {
                case: line.to_owned(),
                collision: Collision::new(&target, &striker, number(15)),
                settings: Settings {
                    model: Model::Wave,
                    disc_radius_m: Some(number(13)),
                    static_share: StaticShare::named(columns[6]).unwrap(),
                    tolerance,
                    ..Settings::default()
                },
                peak_force_n: number(5),
                contact_time_s: number(4),
                restitution: number(3),
                peak_displacement_m: number(2),
                peak_deflection_m: number(1),
            }
        })
        .collect()
}

fn worst(row: &Row) -> f64 {
    let mut solver = Solver::new(&Exact);
    let (collision, settings) = (&row.collision, &row.settings);
    let (solved, _) = solver.solve_with_history(collision, settings).unwrap();
    let found = Results::new(collision, settings, &solved);
    [
        found.peak_force_n / row.peak_force_n,
        found.contact_time_s / row.contact_time_s,
        found.restitution / row.restitution,
        found.peak_displacement_m / row.peak_displacement_m,
        found.peak_deflection_m / row.peak_deflection_m,
    ]
    .into_iter()
    .map(|ratio| (ratio - 1.0).abs())
    .fold(0.0, f64::max)
}

#[test]
fn every_row_at_the_default_tolerance() {
    for row in rows(1e-4) {
        let error = worst(&row);
        println!("{} {error:.1e}", row.case);
        assert!(error < 1e-4, "{}\n{error}", row.case);
    }
}

#[test]
fn every_row_to_1e_6_at_tolerance_1e_7() {
    for row in rows(1e-7) {
        let error = worst(&row);
        println!("{} {error:.1e}", row.case);
        assert!(error < 1e-6, "{}\n{error}", row.case);
    }
}

/// The paper's case with copper at 129 GPa.
fn paper(response: &SurfaceResponse, share: StaticShare) -> (FixedDisc<'_>, CollisionUnits) {
    let e_star = 1.0 / ((1.0 - 0.34_f64.powi(2)) / 129e9 + (1.0 - 0.09) / 209e9);
    let units = CollisionUnits::new(4.0 / 3.0 * e_star * 0.004_f64.sqrt(), 0.0122, 100.0);
    let mu = 209e9 / 2.6;
    let c1 = (mu * 3.5 / 7830.0_f64).sqrt();
    let impact = FixedDisc {
        response,
        coupling: response.disc.static_compliance * units.force_n / (mu * 0.004 * units.length_m),
        wave_time: 0.004 / c1 / units.time_s,
        share,
    };
    (impact, units)
}

#[test]
fn the_explicit_scheme_reproduces_the_papers_time_step_error() {
    let response = SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Centre);
    let (impact, units) = paper(&response, StaticShare::Full);
    let (_, found) = march_explicit(&impact, 0.135e-6 / units.time_s).unwrap();
    assert!(
        (100.0 * found.restitution / 99.2 - 1.0).abs() < 3e-3,
        "{found:?}"
    );
    assert!(
        (found.peak_force * units.force_n / 162_300.0 - 1.0).abs() < 3e-3,
        "{found:?}"
    );
}

#[test]
fn the_implicit_scheme_is_of_second_order_or_better() {
    for deflection in [Deflection::Centre, Deflection::Mean] {
        let response = SurfaceResponse::new(&Medium::new(0.3).unwrap(), deflection);
        for share in [StaticShare::Full, StaticShare::Dynamic] {
            let (impact, _) = paper(&response, share);
            let run = |n: f64| Summary::new(&march_implicit(&impact, 3.0 / n).unwrap()).unwrap();
            let exact = run(3200.0);
            let errors: Vec<f64> = [25.0, 50.0, 100.0, 200.0, 400.0]
                .map(|n| {
                    let found = run(n);
                    ((found.peak_force / exact.peak_force - 1.0).abs())
                        .max((found.restitution - exact.restitution).abs())
                        .max((found.peak_displacement / exact.peak_displacement - 1.0).abs())
                })
                .to_vec();
            let order = (errors[0] / errors[4]).log2() / 4.0;
            println!("{deflection:?} {share:?}: {errors:?}, order {order:.2}");
            assert!(order > 2.0, "{errors:?}");
            for pair in errors.windows(2) {
                assert!(pair[1] < 0.35 * pair[0], "{errors:?}");
            }
            // the instant of separation falls anywhere between two samples: its errors scatter below a second order
            for n in [25.0, 50.0, 100.0, 200.0, 400.0] {
                let error = (run(n).contact_time / exact.contact_time - 1.0).abs();
                println!("contact time: {error:.1e} with {n} steps");
                assert!(error < 0.02 / (n * n), "{error:e}");
            }
        }
    }
}

#[test]
fn the_explicit_scheme_is_of_first_order() {
    let response = SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Centre);
    let (impact, _) = paper(&response, StaticShare::Full);
    let exact = Summary::new(&march_implicit(&impact, 1e-3).unwrap()).unwrap();
    let errors = [200.0, 400.0, 800.0, 1600.0].map(|n| {
        (march_explicit(&impact, 3.0 / n).unwrap().1.restitution - exact.restitution).abs()
    });
    let order = (errors[0] / errors[3]).log2() / 3.0;
    println!("explicit: {errors:?}, order {order:.2}");
    assert!((0.8..1.3).contains(&order), "{errors:?}");
}
