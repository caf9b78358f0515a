//! `auto` against the full memory on a thousand random scenes of each family.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use impact::scene::{Load, Model};
use impact::sweep::{Collided, Collider, Ratios, Responses};
use impact::{ImpactError, Scene};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;

const SCENES: u64 = 1000;

/// Numbers in [0, 1) that depend on the scene and the place of use only (splitmix64).
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn log(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }
}

/// A scene, the model of its full memory, and the tolerances asked for.
fn random_scene(family: &str, index: u64) -> (Scene, Model) {
    let mut draws = Draws(index * 1000 + family.len() as u64);
    let (tip, density) = (draws.log(1e-4, 0.1), draws.log(1000.0, 10_000.0));
    // around the mass of a ball of that radius
    let mass = 4.19 * tip.powi(3) * draws.log(1000.0, 20_000.0) * draws.log(0.3, 10.0);
    let (first, second) = (draws.log(1e9, 4e11), draws.log(1e9, 4e11));
    let velocity = draws.log(1e-5, 3e-3) * (second / density).sqrt();
    let (ratio, other) = (0.48 * draws.next(), 0.05 + 0.4 * draws.next());
    let tolerance = match family {
        "growing" => draws.log(1e-4, 1e-2),
        _ => draws.log(1e-6, 1e-2),
    };
    let mut contact = format!("tolerance = {tolerance:e}\n");
    if draws.next() < 0.5 {
        let loss = (tolerance * draws.log(3.0, 30.0)).clamp(1e-3, 0.1);
        contact += &format!("loss_tolerance = {loss:e}\n");
    }
    if family != "growing" {
        // around the contact's own radius, sqrt(tip * approach)
        let approach = (velocity * velocity * density / first.min(second)).powf(0.4) * tip;
        let disc = (tip * approach).sqrt() * draws.log(0.5, 5.0);
        contact += &format!("disc_radius_m = {disc:e}\nstatic_share = \"{family}\"\n");
    }
    let text = format!(
        "[target]\nyoungs_modulus_pa = {second:e}\npoisson_ratio = {ratio}\ndensity_kg_m3 = {density}\n\
         [striker]\nyoungs_modulus_pa = {first:e}\npoisson_ratio = {other}\nmass_kg = {mass:e}\n\
         tip_radius_m = {tip:e}\nvelocity_m_s = {velocity:e}\n[contact]\n{contact}"
    );
    let scene = Scene::from_toml(&text, Path::new(".")).unwrap();
    let full = match family {
        "growing" => Model::Growing,
        _ => Model::Wave,
    };
    (scene, full)
}

fn collide(scene: &Scene, responses: &Responses) -> Result<Collided, ImpactError> {
    let Load::Strike(striker) = &scene.load else {
        panic!("the scenes above have strikers")
    };
    Collider::new(responses).collide(scene, striker)
}

/// Model chosen, error over the tolerance, error of the loss over its tolerance.
fn compare(family: &str, index: u64, responses: &Responses) -> Option<(Model, f64, f64)> {
    let (scene, full) = random_scene(family, index);
    let mut reference = scene.clone();
    reference.contact.model = full;
    reference.contact.tolerance = (0.1 * scene.contact.tolerance).max(1e-9);
    reference.contact.loss_tolerance = scene.contact.loss_tolerance.map(|t| 0.1 * t);
    // the dynamic share has no solution for soft targets: neither has its full memory
    let exact = collide(&reference, responses).ok()?;
    let Ok(found) = collide(&scene, responses) else {
        return Some((full, f64::INFINITY, 0.0));
    };
    let (a, b) = (&found.summary, &exact.summary);
    let loss = scene
        .contact
        .loss_tolerance
        .map_or(0.0, |asked| a.loss_distance(b) / asked);
    Some((found.model, a.distance(b) / scene.contact.tolerance, loss))
}

fn check(family: &str) {
    let responses = Responses::new(Ratios::Many);
    let found: Vec<_> = (0..SCENES)
        .into_par_iter()
        .filter_map(|index| compare(family, index, &responses))
        .collect();
    let mut models: BTreeMap<String, usize> = BTreeMap::new();
    for (model, _, _) in &found {
        *models.entry(format!("{model:?}")).or_default() += 1;
    }
    let mut worst: Vec<f64> = found.iter().map(|(_, e, l)| e.max(*l)).collect();
    worst.sort_by(f64::total_cmp);
    let missed = worst.iter().filter(|&&e| e > 1.0).count();
    println!(
        "{family}: {} scenes, {models:?}; error over tolerance: median {:.2}, 99 % {:.2}, largest {:.2}; {missed} missed",
        found.len(),
        worst[worst.len() / 2],
        worst[worst.len() * 99 / 100],
        worst[worst.len() - 1]
    );
    for rung in &found {
        if rung.1.max(rung.2) > 1.0 {
            println!("   missed: {rung:?}");
        }
    }
    assert!(found.len() as u64 > SCENES * 7 / 10, "{}", found.len());
    assert!(models.len() >= 3, "every rung is taken: {models:?}");
    assert!(missed * 100 <= found.len(), "{missed} of {}", found.len());
}

#[test]
fn full_share_is_within_tolerance() {
    check("full");
}

#[test]
fn dynamic_share_is_within_tolerance() {
    check("dynamic");
}

#[test]
fn growing_contact_is_within_tolerance() {
    check("growing");
}
