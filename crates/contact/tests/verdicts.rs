//! What is refused does not depend on the tolerance: fixed discs of strong coupling.
//!
//! `cargo test -p hertzlamb-contact --test verdicts -- --nocapture`

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

#[path = "support/solids.rs"]
mod solids;

use contact::{
    Collision, ContactError, HalfSpace, MarchError, Model, Settings, Solver, StaticShare, Striker,
    Tabulated,
};
use halfspace::Deflection;
use halfspace::random::Stream;
use rayon::prelude::*;
use solids::material;

const SCENES: u64 = 400;
const TOLERANCES: [f64; 4] = [1e-3, 1e-4, 1e-6, 1e-8];

/// A ball on a disc of 0.05 to 3 of its contact radius.
fn random_scene(index: u64) -> (Collision, f64) {
    let mut draws = Stream::new(index * 1000 + 17);
    let (tip, density) = (draws.log(1e-4, 0.1), draws.log(1000.0, 10_000.0));
    let mass = 4.19 * tip.powi(3) * draws.log(1000.0, 20_000.0);
    let (first, second) = (draws.log(1e9, 4e11), draws.log(1e9, 4e11));
    let velocity = draws.log(1e-5, 1e-2) * (second / density).sqrt();
    let (ratio, other) = (0.49 * draws.next(), 0.05 + 0.4 * draws.next());
    let target = HalfSpace::new(material(second, ratio, density)).unwrap();
    let striker = Striker::new(material(first, other, density), mass, tip).unwrap();
    let collision = Collision::new(&target, &striker, velocity);
    let radius = collision.contact_radius_m(collision.units().force_n);
    (collision, radius * draws.log(0.05, 3.0))
}

/// What became of a scene at a tolerance.
#[derive(Debug, Clone, PartialEq)]
enum Verdict {
    Solved,
    Refused,
    /// For want of work or accuracy.
    Failed(String),
}

fn verdict(index: u64, settings: &Settings, responses: &Tabulated) -> (Verdict, f64) {
    let (collision, disc) = random_scene(index);
    let settings = Settings {
        disc_radius_m: Some(disc),
        ..*settings
    };
    let found = Solver::new(responses).solve(&collision, &settings);
    match found {
        Ok(found) => (Verdict::Solved, found.summary.restitution),
        Err(
            ContactError::March(MarchError::NoSolution { .. }) | ContactError::EnergyFed { .. },
        ) => (Verdict::Refused, 0.0),
        Err(other) => (Verdict::Failed(other.to_string()), 0.0),
    }
}

fn check(model: Model, static_share: StaticShare, deflection: Deflection) -> [usize; 2] {
    let responses = Tabulated::on_lattice();
    let all: Vec<Vec<(Verdict, f64)>> = (0..SCENES)
        .into_par_iter()
        .map(|index| {
            let at = |tolerance: f64| {
                let settings = Settings {
                    model,
                    static_share,
                    deflection,
                    tolerance,
                    ..Settings::default()
                };
                verdict(index, &settings, &responses)
            };
            TOLERANCES.map(at).to_vec()
        })
        .collect();
    let differs = |v: &&Vec<(Verdict, f64)>| v.iter().any(|one| one.0 != v[0].0);
    let refused = all.iter().filter(|v| v[0].0 == Verdict::Refused).count();
    let differ = all.iter().filter(differs).count();
    let fed = all
        .iter()
        .filter(|v| v.iter().any(|one| one.1 > 1.0))
        .count();
    println!(
        "{model:?}, {static_share:?}, {deflection:?}: {refused} of {SCENES} refused; verdicts differ in {differ}; e above 1 in {fed}"
    );
    for (index, found) in all.iter().enumerate() {
        if found.iter().any(|one| one.0 != found[0].0) {
            println!("   {index}: {found:?}");
        }
    }
    [differ + fed, refused]
}

#[test]
fn the_verdict_on_a_disc_is_the_same_at_every_tolerance() {
    for model in [Model::Wave, Model::Auto] {
        for (share, deflection) in [
            (StaticShare::Full, Deflection::Centre),
            (StaticShare::Full, Deflection::Mean),
            (StaticShare::Dynamic, Deflection::Centre),
            (StaticShare::Dynamic, Deflection::Mean),
        ] {
            let [differ, refused] = check(model, share, deflection);
            assert_eq!(differ, 0, "{model:?} {share:?} {deflection:?}");
            let passive = (share, deflection) == (StaticShare::Full, Deflection::Mean);
            assert_eq!(refused == 0, passive);
        }
    }
}
