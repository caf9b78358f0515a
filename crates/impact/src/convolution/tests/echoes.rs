//! Echoes of a plate by few discs beside those by many.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use crate::convolution::discs::Discs;
use crate::convolution::tests::contact;
use crate::convolution::{Convolution, Trace};
use crate::grid::{Grid, Wanted};
use crate::kernels::KernelSource;
use crate::quantity::Quantity;
use crate::sampled::projection::largest;
use contact::{Echoes, HalfSpace, Material};
use halfspace::random::Stream;

/// Over the durations of contacts, thicknesses and places: how far the echoes by the discs that the plan chooses are from those by
/// 15 discs down to a hundredth of the radius, over the largest of their kind, and how this compares with the estimates.
#[test]
fn echoes_by_few_discs_are_within_their_estimates() {
    let mut random = Stream::new(5);
    let many = Discs::between(0.01, 15);
    let (mut errors, mut ratios, mut above) = ([vec![], vec![], vec![]], vec![], 0);
    let mut count = 0;
    for _ in 0..24 {
        let ratio = 0.1 + 0.35 * random.next();
        let duration = 10_f64.powf(1.3 + 1.7 * random.next());
        let thickness = duration * 10_f64.powf(random.next() - 0.7);
        let tolerance = [1e-2, 1e-3, 1e-4][(3.0 * random.next()) as usize];
        let excitation = contact(ratio, duration);
        let density = 2.0 * (1.0 - ratio) / (1.0 - 2.0 * ratio);
        let material = Material::elastic(2.0 * (1.0 + ratio), ratio, density).unwrap();
        let mut block = HalfSpace::new(material).unwrap();
        (block.thickness_m, block.echoes) = (Some(thickness), Some(Echoes::Legs(3)));
        let source = KernelSource::direct(excitation.medium(), 0.1 * tolerance).unwrap();
        let wanted = Wanted {
            tolerance,
            step_s: None,
            duration_s: Some(4.0 * thickness),
            frames: None,
            farthest_m: None,
            plate_s: None,
            low_pass_hz: None,
        };
        let grid = Grid::new(&wanted, &excitation, Some(&source)).unwrap();
        let all: Vec<usize> = (0..grid.count()).collect();
        let asked = (&[Quantity::VelocityZ][..], Some(&block));
        let convolution = || Convolution::new(&source, &grid, &all, asked, &|| {}).unwrap();
        let z = [0.0, thickness, thickness * random.next()][(3.0 * random.next()) as usize];
        let place = [1.5 * thickness * random.next(), z];
        let own = |convolution: &Convolution<'_>| -> Vec<[Trace; 6]> {
            let echoes = convolution.echoes.as_ref().unwrap();
            let (set, kernels) = convolution.echo_kernels(echoes, place).unwrap();
            let forcings = convolution.forcings.iter();
            forcings
                .map(|forcing| convolution.of_echoes(forcing, set, &kernels).unwrap())
                .collect()
        };
        let few = own(&convolution());
        let mut exact = convolution();
        exact.sets.replace(&many);
        let exact = own(&exact);
        for (kind, (forcing, fields)) in [(0, 0..2), (0, 2..6), (1, 0..2)].into_iter().enumerate() {
            let of = |all: &[[Trace; 6]]| all[forcing][fields.clone()].to_vec();
            let [few, exact] = [of(&few), of(&exact)];
            let peak = exact
                .iter()
                .map(|own| largest(&own.samples))
                .fold(0.0, f64::max);
            for (few, exact) in few.iter().zip(&exact) {
                let off = few.samples.iter().zip(&exact.samples);
                let off = off.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                errors[kind].push(off / peak / tolerance);
                ratios.push(few.error / off);
                count += 1;
                if off > few.error {
                    above += 1;
                    println!(
                        "kind {kind} of {tolerance:e}, duration {duration:.0}, H {thickness:.0}, {place:.0?}: {:.1e} estimated {:.1e}",
                        off / peak,
                        few.error / peak
                    );
                }
            }
        }
    }
    report(&mut errors, &mut ratios);
    println!("{above} of {count} above their estimate");
    assert!(20 * above <= count);
}

/// Prints the errors over the tolerances by kind, and how wide the estimates are.
fn report(errors: &mut [Vec<f64>; 3], ratios: &mut [f64]) {
    ratios.sort_by(f64::total_cmp);
    for (kind, errors) in ["displacements", "stresses", "velocities"]
        .iter()
        .zip(errors)
    {
        errors.sort_by(f64::total_cmp);
        println!(
            "{kind}: error over tolerance {:.1e} in the median, {:.1e} at most",
            errors[errors.len() / 2],
            errors[errors.len() - 1]
        );
    }
    println!(
        "estimate over error {:.0} in the median",
        ratios[ratios.len() / 2]
    );
}
