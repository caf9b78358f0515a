//! Fields close to a contact whose radius follows its load, compared with (T55) by adaptive quadrature.
//!
//! The reference shares the kernels of a punch and the force history with the program, and nothing of its sums: no discs, no
//! cells, no search for fronts. `HERTZLAMB_SCENES=33` draws as many scenes, `HERTZLAMB_TOLERANCE=1e-6` sets the tolerance.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use crate::excitation::Excitation;
use crate::impact::Impact;
use crate::kernels::KernelSource;
use contact::{HalfSpace, Material, Model, Striker};
use halfspace::random::Stream;
use halfspace::{FIELDS, Kernel, Profile, Six};
use rayon::prelude::*;
use std::env;
use std::f64::consts::PI;

/// Gauss-Kronrod rule of 7 and 15 nodes on [-1, 1]: node, weight of 15, weight of 7 (Piessens et al. 1983, QUADPACK).
const KRONROD: [[f64; 3]; 8] = [
    [0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0],
    [
        0.949_107_912_342_758_5,
        0.063_092_092_629_978_55,
        0.129_484_966_168_869_7,
    ],
    [0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0],
    [
        0.741_531_185_599_394_4,
        0.140_653_259_715_525_92,
        0.279_705_391_489_276_7,
    ],
    [0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0],
    [
        0.405_845_151_377_397_2,
        0.190_350_578_064_785_4,
        0.381_830_050_505_118_9,
    ],
    [0.207_784_955_007_898_47, 0.204_432_940_075_298_89, 0.0],
    [0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4],
];

/// Integral of six functions over some parts with its error, by bisection of the worst part.
fn adaptive(of: &dyn Fn(f64) -> Six, parts: &[f64], allowed: &Six) -> (Six, Six) {
    const MOST: usize = 2000;
    const SHORTEST: f64 = 1e-12;
    let rule = |[from, to]: [f64; 2]| {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let (mut fine, mut coarse) = (Six::default(), Six::default());
        for [x, k, g] in KRONROD {
            for side in if x == 0.0 { vec![0.0] } else { vec![-x, x] } {
                let value = of(middle + half * side);
                for f in 0..6 {
                    fine[f] += half * k * value[f];
                    coarse[f] += half * g * value[f];
                }
            }
        }
        let error: Six = std::array::from_fn(|f| (fine[f] - coarse[f]).abs());
        let over = |f: usize| error[f] / allowed[f];
        let worst = match to - from < SHORTEST {
            true => 0.0,
            false => (0..6).map(over).fold(0.0, f64::max),
        };
        (worst, [from, to], fine, error)
    };
    let mut all: Vec<_> = parts
        .windows(2)
        .map(|pair| rule([pair[0], pair[1]]))
        .collect();
    while all.len() < MOST {
        let total = |f: usize| all.iter().map(|one| one.3[f]).sum::<f64>();
        if (0..6).all(|f| total(f) <= allowed[f]) {
            break;
        }
        let worst = (all.iter().enumerate()).max_by(|a, b| a.1.0.total_cmp(&b.1.0));
        let Some((place, [from, to])) =
            worst.filter(|one| one.1.0 > 0.0).map(|(i, one)| (i, one.1))
        else {
            break;
        };
        let middle = 0.5 * (from + to);
        all[place] = rule([from, middle]);
        all.push(rule([middle, to]));
    }
    let (mut sum, mut error) = (Six::default(), Six::default());
    for one in &all {
        for f in 0..6 {
            sum[f] += one.2[f];
            error[f] += one.3[f];
        }
    }
    (sum, error)
}

/// The exact fields at a place and a time with the error of the quadrature, by (T55) over the instants' punches. Near the axis,
/// where kernels of a punch lose digits, the waves of Hertz's pressure are differenced over the square of its radius.
fn exact(excitation: &Excitation, place: [f64; 2], time: f64) -> (Six, Six) {
    /// Radii below this fraction of the distance from the largest edge are near the axis.
    const NEAR: f64 = 0.03;
    const DIFFERENCE: f64 = 3e-5;
    const QUADRATURE: f64 = 3e-8;
    let cuts = cuts(excitation, place, time);
    let units = excitation.units();
    let near_axis = place[0] < NEAR * place[1].hypot(units.disc_radius_m);
    let profile = if near_axis {
        Profile::Hertz
    } else {
        Profile::Punch
    };
    let kernel = Kernel::new(excitation.medium(), profile, 1e-12).unwrap();
    let of = |angle: f64| {
        let at = past(excitation, angle);
        let one = excitation.pressures(at)[0];
        if one.square == 0.0 {
            return Six::default();
        }
        let waves = |part: f64| -> Six {
            let over = (part * one.square).sqrt();
            let [r, z] = place.map(|x| x / (over * units.disc_radius_m));
            let since = ((time - at) / (over * units.time_s())).max(0.0);
            let value = kernel.remainder(r, z, since).unwrap().value;
            let unit = excitation.units_si(over);
            std::array::from_fn(|f| unit[f] * value[f])
        };
        let weight = 0.5 * excitation.end_s() * angle.sin();
        let now = waves(1.0);
        if !near_axis {
            return now.map(|own| weight * one.rate * own);
        }
        let [above, below] = [1.0 + DIFFERENCE, 1.0 - DIFFERENCE].map(waves);
        let grows = one.force_n * one.square_rate / (2.0 * DIFFERENCE * one.square);
        std::array::from_fn(|f| weight * (one.rate * now[f] + grows * (above[f] - below[f])))
    };
    let still = |time: f64| {
        excitation
            .static_si(place, excitation.pressures(time))
            .unwrap()
    };
    let largest = still(0.5 * excitation.end_s());
    let kinds =
        [&largest[..2], &largest[2..]].map(|own| own.iter().fold(0.0_f64, |a, b| a.max(b.abs())));
    let allowed = std::array::from_fn(|f| QUADRATURE * kinds[usize::from(f >= 2)]);
    let (waves, error) = adaptive(&of, &cuts, &allowed);
    let still = still(time);
    (std::array::from_fn(|f| still[f] + waves[f]), error)
}

/// An instant of a contact by an angle: the root of the time from its beginning and from its end is smooth in it.
fn past(excitation: &Excitation, angle: f64) -> f64 {
    excitation.end_s() * (0.5 * angle).sin().powi(2)
}

const REGIONS: [&str; 8] = [
    "axis", "under", "beneath", "beside", "surface", "near", "far", "centre",
];

/// A place of a region, over the largest radius of the contact.
fn place(region: usize, draws: &mut Stream) -> [f64; 2] {
    match region {
        0 => [0.0, draws.log(0.03, 5.0)],
        1 => [0, 1].map(|_| draws.log(0.05, 1.0)),
        2 => [draws.log(0.3, 1.0), draws.log(0.001, 0.05)],
        3 => [draws.log(1.03, 4.0), draws.log(0.001, 0.05)],
        4 => [draws.log(0.05, 10.0), 0.0],
        5 | 6 => {
            let angle = 0.5 * PI * draws.next();
            let distance = [draws.log(1.0, 10.0), draws.log(10.0, 160.0)][region - 5];
            [distance * angle.sin(), distance * angle.cos()]
        }
        _ => [draws.log(0.005, 0.3), draws.log(0.001, 0.3)],
    }
}

/// Young's modulus, Poisson's ratio and density of blocks and strikers.
const SOLIDS: [[f64; 3]; 10] = [
    [2.09e11, 0.3, 7830.0],
    [7.2e10, 0.22, 2500.0],
    [5.5e10, 0.25, 2650.0],
    [5e9, 0.35, 1190.0],
    [7.03e10, 0.345, 2700.0],
    [6.2e11, 0.22, 14900.0],
    [1.16e11, 0.3197, 4500.0],
    [3.7e11, 0.22, 3900.0],
    [4.148e7, 0.49, 1100.0],
    [3e9, -0.3, 800.0],
];

fn solid(draws: &mut Stream) -> Material {
    let [modulus, ratio, density] = SOLIDS[(draws.next() * SOLIDS.len() as f64) as usize];
    Material::elastic(modulus, ratio, density).unwrap()
}

/// A ball on a block; none where the model has no meaning.
fn scene(draws: &mut Stream, tolerance: f64) -> Option<Excitation> {
    let target = HalfSpace::new(solid(draws)).unwrap();
    let ball = Striker::ball(solid(draws), draws.log(5e-4, 2e-2)).unwrap();
    let mut impact = Impact::new(target, ball, draws.log(0.05, 50.0));
    impact.settings.model = Model::Growing;
    impact.settings.tolerance = tolerance;
    Some(impact.solve().ok()?.excitation().clone())
}

/// Samples of a grid to compare at: at random, in the first and last instants, and where fronts of these arrive.
fn instants(
    excitation: &Excitation,
    times: &[f64],
    place: [f64; 2],
    draws: &mut Stream,
) -> Vec<usize> {
    let (end, unit) = (excitation.end_s(), excitation.units().time_s());
    let fronts = excitation
        .speeds()
        .arrivals_s(place[0], place[1], 0.0)
        .map(|s| if s.is_finite() { s } else { 0.0 });
    let mut wanted: Vec<f64> = (0..3)
        .map(|_| draws.next() * times[times.len() - 1])
        .collect();
    for (k, front) in fronts.into_iter().enumerate() {
        for base in [0.0, end] {
            let beside = [0.01, 0.1, 0.5][k] * unit;
            wanted.push(base + front + beside * draws.next());
            wanted.push(base + front - 0.3 * beside * draws.next());
        }
    }
    wanted.push(draws.log(1e-3, 0.05) * end);
    wanted.push((1.0 + draws.log(1e-4, 0.03)) * end);
    let mut found: Vec<usize> = wanted
        .into_iter()
        .map(|t| times.partition_point(|&own| own < t).min(times.len() - 1))
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// Angles of [`past`] up to a time, closer toward the instants whose waves arrive then.
fn cuts(excitation: &Excitation, place: [f64; 2], time: f64) -> Vec<f64> {
    let (end, units) = (excitation.end_s(), excitation.units());
    let last = time.min(end);
    let angle = |past: f64| 2.0 * (past / end).clamp(0.0, 1.0).sqrt().asin();
    let mut cuts: Vec<f64> = (0..=24)
        .map(|i| angle(last) * f64::from(i) / 24.0)
        .collect();
    let edges = [-1.0, 0.0, 1.0].map(|side| (place[0] + side * units.disc_radius_m).abs());
    for radius in edges {
        let fronts = excitation.speeds().arrivals_s(radius, place[1], 0.0);
        for front in fronts.into_iter().chain([0.0]).filter(|s| s.is_finite()) {
            for k in -4..5 {
                let beside = units.time_s() * 2.0_f64.powi(k);
                let pasts = [-beside, 0.0, beside].map(|s| time - front + s);
                cuts.extend(
                    pasts
                        .into_iter()
                        .filter(|past| 0.0 < *past && *past < last)
                        .map(angle),
                );
            }
        }
    }
    cuts.extend(passings(excitation, place, time).map(angle));
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|b, a| *b - *a < 1e-12);
    cuts
}

/// Instants whose waves' fronts from the edge of the contact pass a place at a time, with others beside them on a scale that
/// falls to a hundred-thousandth of a/c1: near the axis a front is as narrow as the contact is small.
fn passings(excitation: &Excitation, place: [f64; 2], time: f64) -> impl Iterator<Item = f64> {
    const TRIALS: i32 = 600;
    let units = excitation.units();
    let ahead = |past: f64, side: f64, wave: usize| {
        let over = excitation.pressures(past)[0].square.sqrt();
        let radius = (place[0] + side * over * units.disc_radius_m).abs();
        time - past - excitation.speeds().arrivals_s(radius, place[1], 0.0)[wave]
    };
    let last = time.min(excitation.end_s());
    let at = |i: i32| last * (0.5 * PI * f64::from(i) / f64::from(TRIALS)).sin().powi(4);
    let mut found = Vec::new();
    for (side, wave) in [-1.0, 1.0]
        .into_iter()
        .flat_map(|side| [0, 1, 2].map(|wave| (side, wave)))
    {
        for i in 0..TRIALS {
            let [mut low, mut high] = [at(i), at(i + 1)];
            let sign = ahead(low, side, wave) > 0.0;
            if (ahead(high, side, wave) > 0.0) == sign {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                match (ahead(middle, side, wave) > 0.0) == sign {
                    true => low = middle,
                    false => high = middle,
                }
            }
            let beside = (-16..0).map(|k| units.time_s() * 2.0_f64.powi(k));
            found.push(low);
            found.extend(beside.flat_map(|s| [low - s, low + s]));
        }
    }
    found
        .into_iter()
        .filter(move |past| 0.0 < *past && *past < last)
}

/// Of one region: errors over peaks, errors over estimates where above, estimates over errors.
#[derive(Default)]
struct Found {
    errors: Vec<f64>,
    above: Vec<f64>,
    wide: Vec<f64>,
}

fn quantile(sorted: &[f64], part: f64) -> f64 {
    let place = (sorted.len().saturating_sub(1) as f64 * part) as usize;
    sorted.get(place).copied().unwrap_or(f64::NAN)
}

#[test]
#[ignore = "minutes: `scripts/check-close` runs it"]
fn fields_close_to_a_growing_contact() {
    let read = |name: &str, default: f64| env::var(name).map_or(default, |x| x.parse().unwrap());
    let tolerance = read("HERTZLAMB_TOLERANCE", 1e-4);
    let scenes = read("HERTZLAMB_SCENES", 10.0) as u64;
    let seed = read("HERTZLAMB_SEED", 1.0) as u64;
    let noise = 3e-7;
    let judged: Vec<_> = (0..scenes)
        .into_par_iter()
        .filter_map(|index| {
            let mut draws = Stream::new(seed * 1_000_003 + index);
            let excitation = scene(&mut draws, tolerance)?;
            let fields_to = (1e-1 * tolerance).clamp(1e-12, 1e-3);
            let source = KernelSource::direct(excitation.medium(), fields_to).unwrap();
            let radius = excitation.units().disc_radius_m;
            let mut of_scene = Vec::new();
            for (region, name) in REGIONS.iter().enumerate() {
                let place = place(region, &mut draws).map(|x| x * radius);
                let fields = excitation.fields_from(source.clone()).to_tolerance(tolerance);
                let history = fields.at(place[0], place[1]).unwrap();
                let samples = instants(&excitation, &history.time_s, place, &mut draws);
                let exact: Vec<(Six, Six)> = (samples.iter())
                    .map(|&n| exact(&excitation, place, history.time_s[n]))
                    .collect();
                let peaks = FIELDS.map(|field| history[field].peak().abs());
                let kinds = [&peaks[..2], &peaks[2..]].map(|own| own.iter().fold(0.0_f64, |a, b| a.max(*b)));
                for field in FIELDS {
                    let (f, trace) = (field.index(), &history[field]);
                    if peaks[f] < 1e-3 * kinds[usize::from(f >= 2)] {
                        continue;
                    }
                    let off = samples.iter().zip(&exact).map(|(&n, (x, own))| (((trace.samples[n] - x[f]).abs() - own[f]).max(0.0), n));
                    let (error, n) = off.fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a });
                    if error > trace.error + noise * peaks[f] {
                        let k = samples.iter().position(|&m| m == n).unwrap();
                        let whole = excitation.instant(place, history.time_s[n], 1e-6);
                        let whole = whole.unwrap().unwrap();
                        println!(
                            "{} r {:.4} z {:.4}, contact of {:.1} a/c1, nu {:.2}, t/T {:.4}: {field:?} off by {:.1e}, {:.1} times its estimate; the reference may be off by {:.0e}, an integral over the whole contact is by {:.0e}",
                            name, place[0] / radius, place[1] / radius,
                            excitation.end_s() / excitation.units().time_s(), excitation.medium().poisson_ratio(),
                            history.time_s[n] / excitation.end_s(), error / peaks[f], error / trace.error, exact[k].1[f] / peaks[f], (whole[f] - exact[k].0[f]).abs() / peaks[f]
                        );
                    }
                    of_scene.push((region, error / peaks[f], trace.error / peaks[f]));
                }
            }
            Some(of_scene)
        })
        .collect();
    let mut found: [Found; REGIONS.len() + 1] = Default::default();
    for (region, error, estimate) in judged.into_iter().flatten() {
        for place in [region, REGIONS.len()] {
            found[place].errors.push(error);
            found[place].wide.push(estimate / error.max(noise));
            if error > estimate + noise {
                found[place].above.push(error / estimate);
            }
        }
    }
    for (name, found) in REGIONS.into_iter().chain(["all"]).zip(&mut found) {
        for list in [&mut found.errors, &mut found.above, &mut found.wide] {
            list.sort_by(f64::total_cmp);
        }
        println!(
            "{name:8} {:5} fields, error over peak p50 {:.1e}, p90 {:.1e}, p99 {:.1e}, largest {:.1e}; above the estimate {:3}, by {:.1} at most; estimate over error p50 {:.0}",
            found.errors.len(),
            quantile(&found.errors, 0.5),
            quantile(&found.errors, 0.9),
            quantile(&found.errors, 0.99),
            quantile(&found.errors, 1.0),
            found.above.len(),
            found.above.last().copied().unwrap_or(0.0),
            quantile(&found.wide, 0.5)
        );
    }
}

/// A scene in which an audit found errors far above their estimates.
struct Audited {
    /// Young's modulus in Pa, Poisson's ratio and density of the block; modulus and ratio of the striker.
    block: [f64; 3],
    striker: [f64; 2],
    tip_m: f64,
    mass_kg: f64,
    speed: f64,
    /// Over the largest radius.
    place: [f64; 2],
    tolerance: f64,
    /// Over the duration of the contact.
    time: f64,
}

const AUDITED: [Audited; 7] = [
    Audited {
        block: [7.2e10, 0.22, 2500.0],
        striker: [7.03e10, 0.345],
        tip_m: 8.023e-4,
        mass_kg: 5.841e-6,
        speed: 17.6,
        place: [0.0141, 0.00372],
        tolerance: 1e-5,
        time: 1.0002,
    },
    Audited {
        block: [1.16e11, 0.3197, 4500.0],
        striker: [3.7e11, 0.22],
        tip_m: 4.359e-3,
        mass_kg: 1.349e-3,
        speed: 22.1,
        place: [0.0, 0.2443],
        tolerance: 1e-6,
        time: 0.0020,
    },
    Audited {
        block: [1.16e11, 0.3197, 4500.0],
        striker: [3.7e11, 0.22],
        tip_m: 4.359e-3,
        mass_kg: 1.349e-3,
        speed: 22.1,
        place: [1.326, 0.001841],
        tolerance: 1e-5,
        time: 0.0448,
    },
    Audited {
        block: [7.03e10, 0.345, 2700.0],
        striker: [2.09e11, 0.3],
        tip_m: 3.534e-3,
        mass_kg: 1.447e-3,
        speed: 23.33,
        place: [1.562, 0.002627],
        tolerance: 1e-6,
        time: 1.02,
    },
    Audited {
        block: [5.5e10, 0.25, 2650.0],
        striker: [7.2e10, 0.22],
        tip_m: 2.41e-3,
        mass_kg: 1.466e-4,
        speed: 27.97,
        place: [2.211, 0.003394],
        tolerance: 1e-6,
        time: 1.0229,
    },
    Audited {
        block: [4.148e7, 0.49, 1100.0],
        striker: [5e9, 0.35],
        tip_m: 1.125e-3,
        mass_kg: 7.031e-6,
        speed: 0.6954,
        place: [1.064, 0.004962],
        tolerance: 1e-6,
        time: 0.017,
    },
    Audited {
        block: [1.16e11, 0.3197, 4500.0],
        striker: [5e9, 0.35],
        tip_m: 8.438e-4,
        mass_kg: 2.969e-6,
        speed: 0.3361,
        place: [0.0, 0.2473],
        tolerance: 1e-6,
        time: 1.0002,
    },
];

#[test]
#[ignore = "minutes: `scripts/check-close` runs it"]
fn fields_of_an_audit() {
    for one in &AUDITED {
        let [e, nu, rho] = one.block;
        let target = HalfSpace::new(Material::elastic(e, nu, rho).unwrap()).unwrap();
        let striker = Striker {
            material: Material::given(one.striker[0], one.striker[1]),
            mass_kg: one.mass_kg,
            tip_radius_m: one.tip_m,
            length_m: None,
            shape: None,
        };
        let mut impact = Impact::new(target, striker, one.speed);
        impact.settings.model = Model::Growing;
        impact.settings.tolerance = one.tolerance;
        let excitation = impact.solve().unwrap().excitation().clone();
        let source = KernelSource::direct(
            excitation.medium(),
            (1e-1 * one.tolerance).clamp(1e-12, 1e-3),
        )
        .unwrap();
        let radius = excitation.units().disc_radius_m;
        let place = one.place.map(|x| x * radius);
        let fields = excitation.fields_from(source).to_tolerance(one.tolerance);
        let history = fields.at(place[0], place[1]).unwrap();
        let near = history
            .time_s
            .partition_point(|&t| t < one.time * excitation.end_s());
        println!(
            "{:?} contact of {:.1} a/c1, {} samples",
            one.place,
            excitation.end_s() / excitation.units().time_s(),
            history.time_s.len()
        );
        for n in (near.saturating_sub(3)..near + 3).step_by(1) {
            let time = history.time_s[n];
            if time == 0.0 {
                continue;
            }
            let exact = exact(&excitation, place, time);
            let past = excitation
                .instant(place, time, 1e-2 * one.tolerance)
                .unwrap()
                .unwrap();
            print!("  t/T {:.5}:", time / excitation.end_s());
            for field in FIELDS {
                let (f, trace) = (field.index(), &history[field]);
                let peak = trace.peak().abs();
                print!(
                    " {:.0e} ({:.0e}; {:.0e}; {:.0e})",
                    (trace.samples[n] - exact.0[f]).abs() / peak,
                    trace.error / peak,
                    (past[f] - exact.0[f]).abs() / peak,
                    exact.1[f] / peak
                );
            }
            println!();
        }
    }
}

#[test]
fn the_first_instants_of_a_fast_contact_are_resolved() {
    let [block, steel] = [8, 0].map(|i: usize| {
        let [modulus, ratio, density] = SOLIDS[i];
        Material::elastic(modulus, ratio, density).unwrap()
    });
    let ball = Striker::ball(steel, 1e-3).unwrap();
    let mut impact = Impact::new(HalfSpace::new(block).unwrap(), ball, 40.0);
    impact.settings.model = Model::Growing;
    impact.settings.tolerance = 1e-6;
    let excitation = impact.solve().unwrap().excitation().clone();
    let units = excitation.units();
    let place = [2.8, 0.006].map(|x| x * units.disc_radius_m);
    let arrivals = excitation.speeds().arrivals_s(place[0], place[1], 0.0);
    let mut largest = [0.0_f64; 2];
    for part in [0.02, 0.05, 0.1, 0.2] {
        for arrival in &arrivals[1..] {
            let time = arrival + part * units.time_s();
            let (exact, _) = exact(&excitation, place, time);
            let found = excitation.instant(place, time, 1e-6).unwrap().unwrap();
            for (kind, fields) in [0..2, 2..6].into_iter().enumerate() {
                let peak = fields.clone().map(|f| exact[f].abs()).fold(0.0, f64::max);
                for f in fields {
                    largest[kind] = largest[kind].max((found[f] - exact[f]).abs() / peak);
                }
            }
        }
    }
    println!(
        "contact of {:.1} a/c1: errors {largest:?}",
        excitation.end_s() / units.time_s()
    );
    assert!(largest.iter().all(|x| *x < 1e-5));
}
