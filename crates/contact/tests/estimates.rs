//! `relative_error_estimate` against the errors of random scenes, by family.
//!
//! `cargo test -p hertzlamb-contact --test estimates -- --nocapture`

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

#[path = "support/solids.rs"]
mod solids;

use contact::{Collision, HalfSpace, Model, Settings, Solver, StaticShare, Striker, Tabulated};
use halfspace::Deflection;
use halfspace::random::Stream;
use rayon::prelude::*;
use solids::material;

/// Scenes of each kind, as many as tell a factor of three in an estimate: `HERTZLAMB_SCENES=60` does not.
fn scenes() -> u64 {
    let asked = std::env::var("HERTZLAMB_SCENES").ok();
    asked.and_then(|n| n.parse().ok()).unwrap_or(400)
}

/// A ball on a block, the radius of a disc of 0.7 to 4 contact radii, and a tolerance of 1e-6 to 1e-3.
fn random_scene(index: u64) -> (Collision, f64, f64) {
    let mut draws = Stream::new(index * 1000 + 23);
    let (tip, density) = (draws.log(1e-4, 0.1), draws.log(1000.0, 10_000.0));
    let mass = 4.19 * tip.powi(3) * draws.log(1000.0, 20_000.0);
    let (first, second) = (draws.log(1e9, 4e11), draws.log(1e9, 4e11));
    let velocity = draws.log(1e-4, 2e-2) * (second / density).sqrt();
    let (ratio, other) = (0.48 * draws.next(), 0.05 + 0.4 * draws.next());
    let target = HalfSpace::new(material(second, ratio, density)).unwrap();
    let striker = Striker::new(material(first, other, density), mass, tip).unwrap();
    let collision = Collision::new(&target, &striker, velocity);
    let radius = collision.contact_radius_m(collision.units().force_n);
    (
        collision,
        radius * draws.log(0.7, 4.0),
        draws.log(1e-6, 1e-3),
    )
}

/// A disc, if there is one: its share and deflection.
type Disc = Option<(StaticShare, Deflection)>;

/// Error over estimate of force, contact time, restitution and displacement, the largest; and error over the tolerance.
fn compare(index: u64, model: Model, disc: Disc, responses: &Tabulated) -> Option<[f64; 2]> {
    let (collision, radius, tolerance) = random_scene(index);
    let (static_share, deflection) = disc.unwrap_or((StaticShare::Full, Deflection::Centre));
    let settings = Settings {
        model,
        static_share,
        deflection,
        tolerance,
        disc_radius_m: disc.map(|_| radius),
        ..Settings::default()
    };
    let full = match model {
        Model::Auto | Model::Growing | Model::AreaDashpot | Model::Hertz | Model::Radiation
            if disc.is_none() =>
        {
            Model::Growing
        }
        _ => Model::Wave,
    };
    let exactly = Settings {
        model: full,
        tolerance: (1e-3 * tolerance).max(1e-8),
        ..settings
    };
    // what is refused needs no reference, which a march with a memory as long as the contact may take minutes for
    let found = Solver::new(responses).solve(&collision, &settings).ok()?;
    let exact = Solver::new(responses).solve(&collision, &exactly).ok()?;
    let error = found.summary.distance(&exact.summary);
    // what the reference itself is off
    let seen = (error - exact.error).max(0.0);
    Some([seen / found.error, error / tolerance])
}

fn check(name: &str, model: Model, disc: Disc) -> usize {
    let responses = Tabulated::on_lattice();
    let mut found: Vec<[f64; 2]> = (0..scenes())
        .into_par_iter()
        .filter_map(|index| compare(index, model, disc, &responses))
        .collect();
    let count = found.len();
    let over = found.iter().filter(|f| f[0] > 1.0).count();
    let missed = found.iter().filter(|f| f[1] > 1.0).count();
    found.sort_by(|a, b| a[0].total_cmp(&b[0]));
    println!(
        "{name}: error over estimate median {:.2}, 99 % {:.2}, largest {:.2}; {over} of {count} exceed it, {missed} the tolerance",
        found[count / 2][0],
        found[count * 99 / 100][0],
        found[count - 1][0],
    );
    assert!(count as u64 > scenes() / 2);
    usize::from(100 * over > count)
}

#[test]
fn estimates_are_true_in_99_of_100_scenes() {
    let mut wrong = 0;
    // `auto` takes the march of `wave`, or a closed form
    for (model, share, deflection) in [
        (Model::Wave, StaticShare::Full, Deflection::Centre),
        (Model::Auto, StaticShare::Full, Deflection::Mean),
        (Model::Auto, StaticShare::Dynamic, Deflection::Centre),
        (Model::Wave, StaticShare::Dynamic, Deflection::Mean),
    ] {
        let name = format!("{model:?}, {share:?}, {deflection:?}");
        wrong += check(&name, model, Some((share, deflection)));
    }
    wrong += check("growing", Model::Growing, None);
    wrong += check("auto, no disc", Model::Auto, None);
    wrong += check("area dashpot", Model::AreaDashpot, None);
    wrong += check("hertz", Model::Hertz, None);
    wrong += check("radiation", Model::Radiation, None);
    assert_eq!(wrong, 0);
}
