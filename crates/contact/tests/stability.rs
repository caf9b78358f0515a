//! The implicit march at steps around the memory, where extrapolated curvature would let the force alternate.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::law::quasi_static::expected_contact_time;
use contact::{FixedDisc, StaticShare, Summary, march_implicit};
use halfspace::{Deflection, Medium, SurfaceResponse};

/// Cells of memory in a step, most of them where the compliance of an alternating force is smallest.
const CELLS: [f64; 14] = [
    0.05, 0.3, 0.5, 0.7, 0.9, 1.0, 1.1, 1.3, 1.6, 2.0, 2.5, 3.0, 5.0, 9.0,
];

/// Largest relative difference of the peak force and difference of restitution from eight times finer marches.
fn worst(deflection: Deflection, ratios: &[f64], couplings: &[f64]) -> (f64, f64) {
    let mut worst = (0.0_f64, 0.0_f64);
    for &ratio in ratios {
        let response = SurfaceResponse::new(&Medium::new(ratio).unwrap(), deflection);
        for &coupling in couplings {
            for cells in CELLS {
                let step = expected_contact_time(coupling) / 100.0;
                let impact = FixedDisc {
                    response: &response,
                    coupling,
                    wave_time: cells * step / response.disc.memory,
                    share: StaticShare::Full,
                };
                let run =
                    |step: f64| Summary::new(&march_implicit(&impact, step).unwrap()).unwrap();
                let (coarse, fine) = (run(step), run(step / 8.0));
                let place = format!("nu = {ratio}, coupling {coupling}, {cells} cells");
                assert_eq!((coarse.contacts, fine.contacts), (1, 1), "{place}");
                worst.0 = worst
                    .0
                    .max((coarse.peak_force / fine.peak_force - 1.0).abs());
                worst.1 = worst.1.max((coarse.restitution - fine.restitution).abs());
            }
        }
    }
    println!(
        "{deflection:?}: peak force {:.1e}, restitution {:.1e}",
        worst.0, worst.1
    );
    worst
}

/// The mean deflection does the work of the pressure: it cannot feed energy back at any coupling.
#[test]
fn the_mean_deflection_is_stable_at_any_step() {
    let (force, restitution) = worst(
        Deflection::Mean,
        &[-0.5, 0.0, 0.3, 0.45],
        &[0.1, 1.0, 3.0, 10.0, 30.0],
    );
    assert!(
        force < 1e-3 && restitution < 3e-4,
        "{force:e} {restitution:e}"
    );
}

/// The deflection of the centre does not: beyond these couplings the model itself lets the force oscillate.
#[test]
fn the_deflection_of_the_centre_is_stable_at_moderate_coupling() {
    let (force, restitution) = worst(
        Deflection::Centre,
        &[0.0, 0.3, 0.45],
        &[0.1, 0.3, 1.0, 2.0, 3.0],
    );
    assert!(
        force < 1e-3 && restitution < 3e-4,
        "{force:e} {restitution:e}"
    );
}
