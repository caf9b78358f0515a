//! Velocities and accelerations against differences of a much finer output, and identities.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{HalfSpace, Material, Model, Plasticity, Settings, Striker};
use impact::{ForceRecord, KernelChoice, Load, Outcome, Probe, Quantity, Scene, Strike, simulate};

const PLACES: [[f64; 2]; 4] = [[0.0, 0.002], [0.003, 0.004], [0.004, 0.0], [6e-5, 1.2e-4]];

fn scene(load: Load, disc_radius_m: Option<f64>, tolerance: f64) -> Scene {
    Scene {
        target: HalfSpace::new(Material::named("soda-lime-glass").unwrap()).unwrap(),
        load,
        settings: Settings {
            tolerance,
            disc_radius_m,
            ..Settings::default()
        },
        probes: PLACES.map(|[r_m, z_m]| Probe { r_m, z_m }).to_vec(),
        section: None,
        sensors: Vec::new(),
        quantities: vec![
            Quantity::VelocityR,
            Quantity::VelocityZ,
            Quantity::AccelerationR,
            Quantity::AccelerationZ,
        ],
        peaks: false,
        duration_s: Some(1.2e-5),
        low_pass_hz: None,
    }
}

fn ball() -> Load {
    Load::Strike(Strike {
        striker: Striker::ball(Material::named("bearing-steel").unwrap(), 0.001).unwrap(),
        velocity_m_s: 1.0,
    })
}

/// sin^2 over 6 us, in 600 lines.
fn record() -> Load {
    let time_s: Vec<f64> = (0..=600).map(|i| 1e-8 * f64::from(i)).collect();
    let force = |t: f64| 20.0 * (std::f64::consts::PI * t / 6e-6).sin().powi(2);
    let force_n = time_s.iter().map(|&t| force(t)).collect();
    Load::Record(ForceRecord::new(time_s, force_n).unwrap())
}

fn run(scene: &Scene) -> Outcome {
    simulate(scene, &KernelChoice::Direct).unwrap()
}

/// Six-point differences of the displacement of a finer output at the times of a coarser one, of the first order, and
/// those of the second averaged over a step of it.
fn differenced(
    fine: &Outcome,
    every: usize,
    [probe, component]: [usize; 2],
    [time_s, step_s]: [f64; 2],
) -> [f64; 2] {
    let thin = |x: &[f64]| -> Vec<f64> { x.iter().step_by(every).copied().collect() };
    let t = thin(&fine.series.time_s);
    let u = thin(&fine.probes.as_ref().unwrap().values[component][probe]);
    let h = t[1] - t[0];
    let rate = |at_s: f64| {
        // the slope of a quintic through six samples around
        let place = at_s / h;
        let from = (place.floor() as isize - 2).clamp(0, t.len() as isize - 6) as usize;
        let x = place - from as f64;
        let mut slope = 0.0;
        for j in 0..6 {
            let mut sum = 0.0;
            for k in (0..6).filter(|&k| k != j) {
                let others = (0..6).filter(|&m| m != j && m != k);
                let product: f64 = others
                    .map(|m| (x - m as f64) / (j as f64 - m as f64))
                    .product();
                sum += product / (j as f64 - k as f64);
            }
            slope += u[from + j] * sum;
        }
        slope / h
    };
    if fine.results().is_none() {
        // a record's are means over a step
        let at = |at_s: f64| {
            let place = at_s / h;
            let from = (place.floor() as isize - 1).clamp(0, t.len() as isize - 4) as usize;
            let x = place - from as f64;
            (0..4)
                .map(|j| {
                    let others = (0..4).filter(|&m| m != j);
                    let product: f64 = others
                        .map(|m| (x - m as f64) / (j as f64 - m as f64))
                        .product();
                    u[from + j] * product
                })
                .sum::<f64>()
        };
        let [a, b, c, d, e] =
            [-1.0, -0.5, 0.0, 0.5, 1.0].map(|x| at((time_s + x * step_s).max(0.0)));
        return [(d - b) / step_s, (e - 2.0 * c + a) / (step_s * step_s)];
    }
    let (after, before) = (
        rate(time_s + 0.5 * step_s),
        rate((time_s - 0.5 * step_s).max(0.0)),
    );
    [rate(time_s), (after - before) / step_s]
}

fn peak(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// The largest error over its estimate at the places, and the largest estimate over the peak.
///
/// The reference counts with its own errors: those of the displacements over a step of it, and three times the change
/// when it has every other sample, which shows what differences miss at fronts.
fn worst(load: &Load, disc: Option<f64>, tolerance: f64, quantities: &[Quantity]) -> [f64; 2] {
    let asked = Scene {
        quantities: quantities.to_vec(),
        ..scene(load.clone(), disc, tolerance)
    };
    worst_of(&asked, 1.0)
}

/// The same of a scene, with a part of the errors of the reference's displacements: that of the force is not seen in them.
fn worst_of(asked: &Scene, part: f64) -> [f64; 2] {
    let disc = asked.settings.disc_radius_m;
    // the end of a growing contact is felt over less than a sixteenth of a step
    let finer_by = if disc.is_none() { 64.0 } else { 16.0 };
    let coarse = run(asked);
    let times_s = &coarse.series.time_s;
    let step_s = times_s[1] - times_s[0];
    let mut finer = asked.clone();
    finer.settings.tolerance = 1e-6;
    finer.quantities.clear();
    finer.settings.step_s = Some(step_s / finer_by);
    let fine = run(&finer);
    let last_s = fine.series.time_s[fine.series.time_s.len() - 1] - 4.0 * step_s;
    let mut found = [0.0_f64; 2];
    let probes = coarse.probes.as_ref().unwrap();
    let found_rates = probes.values.iter().zip(&probes.errors).skip(6);
    for (quantity, (own, errors)) in probes.quantities.iter().zip(found_rates) {
        let (component, order) = match quantity {
            Quantity::VelocityR => (0, 0),
            Quantity::VelocityZ => (1, 0),
            Quantity::AccelerationR => (0, 1),
            _ => (1, 1),
        };
        for probe in 0..asked.probes.len() {
            let of_finer = fine.probes.as_ref().unwrap().errors[component][probe]
                / (step_s / finer_by)
                * part
                * if order == 0 { 1.0 } else { 1.0 / step_s };
            let most = peak(&own[probe]);
            if most == 0.0 {
                continue;
            }
            let mut off = 0.0;
            let inside = times_s.iter().enumerate().skip(1);
            for (i, &time_s) in inside.take_while(|(_, t)| **t < last_s) {
                let of = |every| differenced(&fine, every, [probe, component], [time_s, step_s]);
                let (wanted, thinned) = (of(1)[order], of(2)[order]);
                let sure = 3.0 * (wanted - thinned).abs() + of_finer;
                let error = (own[probe][i] - wanted).abs() - sure;
                if error > errors[probe] {
                    println!(
                        "{:?} at probe {probe}, {time_s:.4e} s, disc {disc:?}: {:.4e} for {wanted:.4e}, estimated {:.1e}",
                        quantity, own[probe][i], errors[probe]
                    );
                }
                off = error.max(off);
            }
            found[0] = found[0].max(off / errors[probe]);
            found[1] = found[1].max(errors[probe] / most);
        }
    }
    found
}

const VELOCITIES: [Quantity; 2] = [Quantity::VelocityR, Quantity::VelocityZ];
const ACCELERATIONS: [Quantity; 2] = [Quantity::AccelerationR, Quantity::AccelerationZ];

#[test]
fn velocities_are_within_their_estimates_of_a_finer_output() {
    for (load, disc, most) in [
        (ball(), None, 0.02),
        (ball(), Some(1e-4), 0.02),
        (record(), Some(2e-4), 0.05),
    ] {
        let [over, estimate] = worst(&load, disc, 1e-3, &VELOCITIES);
        assert!(over < 1.0 && estimate < most, "{over} {estimate}");
    }
}

/// Velocities under a steel ball on aluminium, which it makes flow where there is a law for that.
fn of_aluminium(
    (model, plasticity): (Model, Plasticity),
    tolerance: f64,
    places: &[[f64; 2]],
) -> Scene {
    let load = Load::Strike(Strike {
        striker: Striker::ball(Material::named("bearing-steel").unwrap(), 0.005).unwrap(),
        velocity_m_s: 1.57,
    });
    let mut asked = scene(load, None, tolerance);
    asked.target = HalfSpace::new(Material::named("aluminium-6061-t6").unwrap()).unwrap();
    (asked.settings.model, asked.settings.plasticity) = (model, plasticity);
    asked.quantities = VELOCITIES.to_vec();
    let probe = |&[r_m, z_m]: &[f64; 2]| Probe { r_m, z_m };
    asked.probes = places.iter().map(probe).collect();
    asked
}

/// The rate of a dashpot's force jumps where it begins and ends, that of one that yields where it does and where it turns.
#[test]
fn velocities_are_within_their_estimates_where_the_rate_of_the_force_jumps() {
    for plasticity in [Plasticity::None, Plasticity::Thornton] {
        let places = [[0.003, 0.003], [9e-4, 0.0], [0.0, 6e-4], [2e-3, 0.0]];
        let mut asked = of_aluminium((Model::AreaDashpot, plasticity), 1e-4, &places);
        asked.duration_s = Some(2.7e-5);
        let [over, estimate] = worst_of(&asked, 0.02);
        assert!(
            over < 1.0 && estimate < 0.01,
            "{plasticity:?} {over} {estimate}"
        );
    }
}

/// What is left of a cut pressure begins to open with a root of time.
#[test]
fn velocities_are_within_their_estimates_where_a_cut_pressure_opens() {
    let of = (Model::Growing, Plasticity::Recovery);
    let mut asked = of_aluminium(of, 1e-3, &[[0.003, 0.003]]);
    asked.duration_s = None;
    let [over, estimate] = worst_of(&asked, 0.02);
    assert!(over < 2.0 && estimate < 0.02, "{over} {estimate}");
    // far away many discs have forces with edges there: the velocity's integral is the displacement, but for spikes at fronts
    let mut asked = of_aluminium(of, 1e-5, &[[0.02, 0.0]]);
    asked.duration_s = None;
    let outcome = run(&asked);
    let (time_s, fields) = (outcome.series.time_s, outcome.probes.unwrap());
    for component in 0..2 {
        let [u, v] = [component, component + 6].map(|i| &fields.values[i][0]);
        let (mut from_v, mut off) = (0.0, 0.0_f64);
        for i in 1..time_s.len() {
            from_v += 0.5 * (time_s[i] - time_s[i - 1]) * (v[i] + v[i - 1]);
            off = off.max((from_v - u[i]).abs());
        }
        assert!(off < 1e-2 * peak(u), "{component}: {}", off / peak(u));
    }
}

#[test]
fn accelerations_are_within_their_estimates_of_a_finer_output() {
    for (load, disc, most) in [
        (ball(), None, 0.2),
        (ball(), Some(1e-4), 0.2),
        (record(), Some(2e-4), 0.5),
    ] {
        let [over, estimate] = worst(&load, disc, 1e-3, &ACCELERATIONS);
        assert!(over < 1.0 && estimate < most, "{over} {estimate}");
    }
}

/// Integrals of the velocity are displacements, and those of the acceleration, a mean over a step, velocities between
/// samples: each is a convolution of its own.
#[test]
fn rates_integrate_to_what_they_are_rates_of() {
    for (load, disc) in [(ball(), None), (ball(), Some(1e-4)), (record(), Some(2e-4))] {
        let mut scene = scene(load, disc, 1e-4);
        scene.settings.step_s = Some(3e-9);
        let outcome = run(&scene);
        let (time_s, fields) = (outcome.series.time_s, outcome.probes.unwrap());
        for component in 0..2 {
            for probe in 0..PLACES.len() {
                let u = &fields.values[component][probe];
                let [v, a] = [6, 8].map(|rate| &fields.values[component + rate][probe]);
                let (mut from_v, mut from_a) = (0.0, 0.0);
                let (mut off_v, mut off_a) = (0.0_f64, Vec::new());
                for i in 1..time_s.len() {
                    let step_s = time_s[i] - time_s[i - 1];
                    from_v += 0.5 * step_s * (v[i] + v[i - 1]);
                    off_v = off_v.max((from_v - u[i]).abs());
                    off_a.push((from_a - 0.5 * (v[i] + v[i - 1])).abs());
                    from_a += step_s * a[i];
                }
                // between two samples beside a front the velocity is not their mean
                off_a.sort_by(f64::total_cmp);
                let off_a = off_a[off_a.len() * 9 / 10];
                // nothing moves across on the axis
                let over = |off: f64, most: f64| if most > 0.0 { off / most } else { off };
                let off = [over(off_v, peak(u)), over(off_a, peak(v))];
                println!(
                    "disc {disc:?}, component {component}, probe {probe}: {:.1e}, {:.1e}",
                    off[0], off[1]
                );
                assert!(
                    off[0] <= 1e-3 && off[1] <= 2e-3,
                    "{disc:?} {component} {probe}: {off:?}"
                );
            }
        }
    }
}
