//! Where each inversion fails, and where it is at its best: w on the axis, settings as in the pictures.

use crate::inversion::ExtendedWeights;
use crate::question::inversions::Inversion;
use crate::question::kernels::{KernelScene, POISSON_RATIO};
use halfspace::Medium;

/// Largest error within 3 % of the last front, and from four times its time on.
fn errors(scene: &KernelScene, values: &[halfspace::Six]) -> [f64; 2] {
    let front = scene.arrivals.last().copied().unwrap();
    let mut worst = [0.0_f64; 2];
    for (t, error) in scene.times.iter().zip(scene.errors_over_time(values)) {
        if (t / front - 1.0).abs() < 0.03 {
            worst[0] = worst[0].max(error);
        } else if *t > 4.0 * front {
            worst[1] = worst[1].max(error);
        }
    }
    worst
}

#[test]
fn every_inversion_fails_at_the_front_and_recovers_as_far_as_it_can() {
    let medium = Medium::new(POISSON_RATIO).unwrap();
    let scene = KernelScene::axis(&medium, 24, &[-0.02, -0.01, 0.0, 0.01, 0.02]).unwrap();
    let mut found = Vec::new();
    for method in Inversion::best() {
        let run = method.prepare();
        let (values, _) = run.run(&medium, scene.place, method.digits(), &scene.times);
        found.push((method.name(), errors(&scene, &values)));
    }
    let mut few = scene.clone();
    few.thin(3);
    let (values, _) = few.extended(&medium, &ExtendedWeights::new(26));
    found.push(("Gaver-Stehfest, 31 digits", errors(&few, &values)));
    // at the front at least, and long after at most
    for (name, [front, late]) in found {
        let [least, most] = match name {
            "fixed Talbot" => [1e-3, 1e-11],
            "Gaver-Stehfest" => [1e-2, 1e-3],
            "Euler" | "Crump" => [1e-4, 1e-6],
            "Durbin" => [1e-4, 2e-3],
            "de Hoog" => [1e-5, 1e-10],
            // CME, and Gaver-Stehfest with 31 digits
            _ => [1e-3, 1e-4],
        };
        assert!(front > least && late < most, "{name}: {front:e}, {late:e}");
    }
}
