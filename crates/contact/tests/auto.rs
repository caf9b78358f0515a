//! `auto` against the full memory on a thousand random scenes of each family.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

#[path = "support/solids.rs"]
mod solids;

use contact::{
    Collision, ContactError, HalfSpace, Library, MarchError, Model, Settings, Solved, Solver,
    StaticShare, Striker, Tabulated,
};
use halfspace::random::Stream;
use rayon::prelude::*;
use solids::material;
use std::collections::BTreeMap;

const SCENES: u64 = 1000;

/// A family of models.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Family {
    Growing,
    Disc(StaticShare),
}

impl Family {
    /// The model of its full memory.
    fn full(self) -> Model {
        match self {
            Self::Growing => Model::Growing,
            Self::Disc(_) => Model::Wave,
        }
    }

    /// Distinguishes the random numbers of the families.
    fn offset(self) -> u64 {
        match self {
            Self::Growing | Self::Disc(StaticShare::Dynamic) => 7,
            Self::Disc(StaticShare::Full) => 4,
        }
    }
}

/// A collision and what is asked of it.
fn random_scene(family: Family, index: u64) -> (Collision, Settings) {
    let mut draws = Stream::new(index * 1000 + family.offset());
    let (tip, density) = (draws.log(1e-4, 0.1), draws.log(1000.0, 10_000.0));
    // around the mass of a ball of that radius
    let mass = 4.19 * tip.powi(3) * draws.log(1000.0, 20_000.0) * draws.log(0.3, 10.0);
    let (first, second) = (draws.log(1e9, 4e11), draws.log(1e9, 4e11));
    let velocity = draws.log(1e-5, 3e-3) * (second / density).sqrt();
    let (ratio, other) = (0.48 * draws.next(), 0.05 + 0.4 * draws.next());
    let tolerance = draws.log(1e-6, 1e-2);
    let mut settings = Settings {
        tolerance,
        ..Settings::default()
    };
    if draws.next() < 0.5 {
        settings.loss_tolerance = Some((tolerance * draws.log(3.0, 30.0)).clamp(1e-3, 0.1));
    }
    if let Family::Disc(share) = family {
        // around the contact's own radius, sqrt(tip * approach)
        let approach = (velocity * velocity * density / first.min(second)).powf(0.4) * tip;
        settings.disc_radius_m = Some((tip * approach).sqrt() * draws.log(0.5, 5.0));
        settings.static_share = share;
    }
    let target = HalfSpace::new(material(second, ratio, density)).unwrap();
    let striker = Striker::new(material(first, other, density), mass, tip).unwrap();
    (Collision::new(&target, &striker, velocity), settings)
}

fn collide(
    collision: &Collision,
    settings: &Settings,
    responses: &Tabulated,
) -> Result<Solved, ContactError> {
    Solver::new(responses).solve(collision, settings)
}

/// Model chosen, error over the tolerance, error of the loss over its tolerance.
fn compare(family: Family, index: u64, responses: &Tabulated) -> Option<(Model, f64, f64)> {
    let (collision, settings) = random_scene(family, index);
    let reference = Settings {
        model: family.full(),
        tolerance: (0.1 * settings.tolerance).max(1e-9),
        loss_tolerance: settings.loss_tolerance.map(|t| 0.1 * t),
        ..settings
    };
    let exact = collide(&collision, &reference, responses);
    let found = collide(&collision, &settings, responses);
    let (found, exact) = match (found, exact) {
        (Ok(found), Ok(exact)) => (found, exact),
        // the model of the disc makes no sense: whatever the rung
        (
            Err(ContactError::March(MarchError::NoSolution { .. })),
            Err(ContactError::March(MarchError::NoSolution { .. })),
        )
        | (Err(ContactError::EnergyFed { .. }), Err(ContactError::EnergyFed { .. })) => {
            return None;
        }
        (found, exact) => panic!("{family:?} {index}: {found:?} {exact:?}"),
    };
    let (a, b) = (&found.summary, &exact.summary);
    let loss = settings
        .loss_tolerance
        .map_or(0.0, |asked| a.loss_distance(b) / asked);
    Some((found.chosen.model, a.distance(b) / settings.tolerance, loss))
}

fn check(family: Family) {
    let responses = Tabulated::on_lattice();
    let mut found: Vec<_> = (0..2 * SCENES)
        .into_par_iter()
        .filter_map(|index| compare(family, index, &responses))
        .collect();
    assert!(found.len() >= SCENES as usize, "{}", found.len());
    found.truncate(SCENES as usize);
    let mut models: BTreeMap<String, usize> = BTreeMap::new();
    for (model, _, _) in &found {
        *models.entry(format!("{model:?}")).or_default() += 1;
    }
    let mut worst: Vec<f64> = found.iter().map(|(_, e, l)| e.max(*l)).collect();
    worst.sort_by(f64::total_cmp);
    let missed = worst.iter().filter(|&&e| e > 1.0).count();
    println!(
        "{family:?}: {} scenes, {models:?}; error over tolerance: median {:.2}, 99 % {:.2}, largest {:.2}; {missed} missed",
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
    assert!(models.len() >= 3, "every rung is taken: {models:?}");
    assert!(missed * 100 <= found.len(), "{missed} of {}", found.len());
}

/// A ball of one material of the library on a block of another, at 1e-4 to 5e-2 of the block's shear wave speed.
fn real_scene(index: u64) -> Collision {
    let library = Library::built_in();
    let solid = |draw: f64| {
        let with_density = || library.iter().filter(|m| m.density_kg_m3.is_some());
        let place = (draw * with_density().count() as f64) as usize;
        with_density().nth(place).unwrap().clone()
    };
    let mut draws = Stream::new(index * 7919 + 61);
    let (block, ball) = (solid(draws.next()), solid(draws.next()));
    let shear_speed = (block.shear_modulus_pa() / block.density_kg_m3.unwrap()).sqrt();
    let velocity = shear_speed * draws.log(1e-4, 5e-2);
    let target = HalfSpace::new(block).unwrap();
    let striker = Striker::ball(ball, draws.log(1e-4, 0.1)).unwrap();
    Collision::new(&target, &striker, velocity)
}

#[test]
fn most_real_impacts_need_no_memory() {
    let responses = Tabulated::default();
    for (tolerance, least) in [(1e-4, 900), (1e-6, 300)] {
        let settings = Settings {
            tolerance,
            loss_tolerance: Some(10.0 * tolerance),
            ..Settings::default()
        };
        let exactly = Settings {
            model: Model::Growing,
            tolerance: 1e-8,
            loss_tolerance: Some(1e-7),
            ..settings
        };
        let found: Vec<(Model, f64, f64)> = (0..SCENES)
            .into_par_iter()
            .map(|index| {
                let collision = real_scene(index);
                let found = collide(&collision, &settings, &responses).unwrap();
                let exact = collide(&collision, &exactly, &responses).unwrap();
                let (a, b) = (&found.summary, &exact.summary);
                (found.chosen.model, a.distance(b), a.loss_distance(b))
            })
            .collect();
        let count =
            |of: &dyn Fn(&(Model, f64, f64)) -> bool| found.iter().filter(|f| of(f)).count();
        let dashpot = count(&|f| f.0 == Model::AreaDashpot);
        let missed = count(&|f| f.1 > tolerance || f.2 > 10.0 * tolerance);
        let worst = found
            .iter()
            .fold([0.0_f64; 2], |w, f| [w[0].max(f.1), w[1].max(f.2)]);
        println!(
            "{tolerance:e}: the area dashpot serves {dashpot} of {SCENES} real impacts; {missed} outside the tolerance, worst {:.1e}, of the loss {:.1e}",
            worst[0], worst[1]
        );
        assert!(dashpot >= least && missed * 100 <= found.len());
    }
}

#[test]
fn full_share_is_within_tolerance() {
    check(Family::Disc(StaticShare::Full));
}

#[test]
fn dynamic_share_is_within_tolerance() {
    check(Family::Disc(StaticShare::Dynamic));
}

#[test]
fn growing_contact_is_within_tolerance() {
    check(Family::Growing);
}
