//! Records that jump, compared with the step responses of the half-space summed directly, and with ever steeper rises.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::{Deflection, Kernel, Medium, Profile, Six, SurfaceResponse};
use impact::{
    ForceRecord, HalfSpace, KernelChoice, Load, Material, Outcome, Probe, Quantity, Scene,
    Settings, simulate,
};

const RADIUS_M: f64 = 0.003;

/// Begins with a force, falls at once in the middle, and ends with a force.
const ROWS: [(f64, f64); 5] = [
    (1.3e-6, 70.0),
    (7.7e-6, 160.0),
    (7.7e-6, 45.0),
    (1.21e-5, 45.0),
    (1.6e-5, 30.0),
];

fn record(rows: &[(f64, f64)]) -> ForceRecord {
    let (time_s, force_n) = rows.iter().copied().unzip();
    ForceRecord::new(time_s, force_n).unwrap()
}

fn scene(record: ForceRecord, places: &[[f64; 2]], tolerance: f64) -> Scene {
    let probes = places.iter().map(|&[r_m, z_m]| Probe { r_m, z_m });
    Scene {
        target: HalfSpace::new(Material::named("steel").unwrap()).unwrap(),
        load: Load::Record(record),
        settings: Settings {
            disc_radius_m: Some(RADIUS_M),
            tolerance,
            ..Settings::default()
        },
        probes: probes.collect(),
        section: None,
        sensors: Vec::new(),
        quantities: Vec::new(),
        peaks: false,
        duration_s: None,
        low_pass_hz: None,
    }
}

fn run(scene: &Scene) -> Outcome {
    simulate(scene, &KernelChoice::Direct).unwrap()
}

/// Under the load, on its axis, and beside it: where fronts jump, and where they do not.
const PLACES: [[f64; 2]; 4] = [
    [0.0, 0.004],
    [0.0011, 0.0007],
    [0.004, 0.0031],
    [0.011, 0.0],
];

/// The steps and slopes of a force that is given by rows, each with its response of a kernel.
struct Reference {
    kernel: Kernel,
    /// Of lengths in m, times in s, displacements in m/N and stresses in Pa/N.
    units: [f64; 3],
}

impl Reference {
    fn new() -> Self {
        let steel = HalfSpace::new(Material::named("steel").unwrap()).unwrap();
        let mu = steel.material().shear_modulus_pa();
        let unit_s = RADIUS_M / steel.longitudinal_speed_m_s();
        Self {
            kernel: Kernel::new(&Medium::new(0.3).unwrap(), Profile::Hertz, 1e-11).unwrap(),
            units: [unit_s, 1.0 / (mu * RADIUS_M), 1.0 / (RADIUS_M * RADIUS_M)],
        }
    }

    /// The six fields in SI units at a time under a force that is zero before its rows and after them.
    fn at(&self, [r_m, z_m]: [f64; 2], rows: &[(f64, f64)], time_s: f64) -> Six {
        let [unit_s, displacement, stress] = self.units;
        let (r, z) = (r_m / RADIUS_M, z_m / RADIUS_M);
        let fixed = self.kernel.static_field(r, z).unwrap();
        let since = |at_s: f64| (time_s - at_s) / unit_s;
        let mut sum = Six::default();
        let mut step = |at_s: f64, rise_n: f64| {
            if since(at_s) >= 0.0 {
                let rest = self.kernel.remainder(r, z, since(at_s)).unwrap().value;
                sum = std::array::from_fn(|f| sum[f] + rise_n * (fixed[f] + rest[f]));
            }
        };
        step(rows[0].0, rows[0].1);
        let last = rows[rows.len() - 1];
        step(last.0, -last.1);
        for pair in rows.windows(2) {
            let [(t0, p0), (t1, p1)] = [pair[0], pair[1]];
            if t0 == t1 {
                step(t0, p1 - p0);
            }
        }
        for pair in rows.windows(2) {
            let [(t0, p0), (t1, p1)] = [pair[0], pair[1]];
            let [late, early] = [since(t1).max(0.0), since(t0).max(0.0)];
            if t0 == t1 || early == 0.0 {
                continue;
            }
            let slope = (p1 - p0) / ((t1 - t0) / unit_s);
            let of = |t: f64| self.kernel.step_integral(r, z, t).unwrap().value;
            let (until, from) = (of(early), of(late));
            sum = std::array::from_fn(|f| {
                sum[f] + slope * (fixed[f] * (early - late) + until[f] - from[f])
            });
        }
        std::array::from_fn(|f| sum[f] * if f < 2 { displacement } else { stress })
    }
}

fn peak(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Largest difference of some samples from the reference over the field's peak, and over its estimate.
fn compared(found: &Outcome, rows: &[(f64, f64)], every: usize) -> [f64; 2] {
    let (reference, probes) = (Reference::new(), found.probes.as_ref().unwrap());
    let mut worst = [0.0_f64; 2];
    for (probe, &place_m) in PLACES.iter().enumerate() {
        for (i, &time_s) in found.series.time_s.iter().enumerate().step_by(every) {
            let exact = reference.at(place_m, rows, time_s);
            for (field, exact) in exact.into_iter().enumerate() {
                let own = &probes.values[field][probe];
                let (size, off) = (peak(own), (own[i] - exact).abs());
                if size > 0.0 {
                    worst[0] = worst[0].max(off / size);
                    worst[1] = worst[1].max(off / probes.errors[field][probe]);
                }
            }
        }
    }
    worst
}

#[test]
fn fields_under_jumps_are_those_of_steps_within_their_estimates() {
    for tolerance in [1e-2, 1e-4, 1e-6] {
        let found = run(&scene(record(&ROWS), &PLACES, tolerance));
        let [off, over] = compared(&found, &ROWS, 17);
        let steps = found.series.time_s.len();
        println!(
            "{tolerance}: {steps} samples, off by {off:.1e} of the peaks, {over:.1e} of the estimates"
        );
        assert!(over < 1.0 && off < tolerance);
    }
}

/// An ever steeper rise is a jump, and the fields differ as little as both forces do.
#[test]
fn fields_under_jumps_are_the_limit_of_those_under_rises() {
    let jumps = [
        (0.0, 0.0),
        (2e-6, 0.0),
        (2e-6, 80.0),
        (9e-6, 25.0),
        (9e-6, 0.0),
        (1e-5, 0.0),
    ];
    let of = |rise_s: f64| {
        let rises = jumps.map(|(t, p)| {
            (
                if p > 0.0 && t < 5e-6 || p == 0.0 && t == 9e-6 {
                    t + rise_s
                } else {
                    t
                },
                p,
            )
        });
        let mut asked = scene(record(&rises), &PLACES, 1e-4);
        (asked.duration_s, asked.settings.step_s) = (Some(2.2e-5), Some(1e-8));
        run(&asked)
    };
    let exact = of(0.0);
    let mut before = f64::INFINITY;
    for rise_s in [1e-7, 1e-8, 1e-9] {
        let (found, known) = (of(rise_s), exact.probes.as_ref().unwrap());
        let probes = found.probes.unwrap();
        let mut worst = 0.0_f64;
        // displacements are continuous
        for (field, probe) in [(1, 0), (1, 1), (0, 2), (1, 2), (1, 3)] {
            let (a, b) = (&known.values[field][probe], &probes.values[field][probe]);
            let gap = a
                .iter()
                .zip(b)
                .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            worst = worst.max(gap / peak(a));
        }
        println!("rise over {rise_s} s: {worst:.1e} of the peak");
        assert!(worst < 0.3 * before, "{worst} after {before}");
        before = worst;
    }
    assert!(before < 2e-3);
}

/// Samples that fall on a jump, and on the front of its P wave, which jumps below the load, are those after it.
#[test]
fn samples_at_a_jump_and_at_its_fronts_are_those_after() {
    let speed = HalfSpace::new(Material::named("steel").unwrap())
        .unwrap()
        .longitudinal_speed_m_s();
    for (at_s, z_m) in [(0.0, 7e-4), (3.1e-6, 9e-4), (3.3e-5, 1.1e-3)] {
        let travel_s = z_m / speed;
        let record = record(&[
            (0.0, 0.0),
            (at_s + 1e-9, 0.0),
            (at_s + 1e-9, 50.0),
            (at_s + 2e-5, 50.0),
        ]);
        let mut asked = scene(record, &[[0.0, z_m]], 1e-4);
        // a grid with a sample at the front
        asked.settings.step_s = Some(1e-8);
        let found = run(&asked);
        let step_s = found.step_s();
        let times_s = &found.series.time_s;
        let stress = &found.probes.as_ref().unwrap().values[4][0];
        // the first sample with a stress is the first at or after the front, with all of its jump
        let front_s = at_s + 1e-9 + travel_s;
        let first = stress.iter().position(|&x| x != 0.0).unwrap();
        assert!(times_s[first] > front_s - 1e-15 * front_s && times_s[first] < front_s + step_s);
        let under = 1.5 * 50.0 / (std::f64::consts::PI * RADIUS_M * RADIUS_M);
        assert!(
            (stress[first] / -under - 1.0).abs() < 0.05,
            "{} {under}",
            stress[first]
        );
        // moved so that the front is at a sample: by rounding alone it may be before or after
        let moved_s = times_s[first] - travel_s;
        let exactly = self::record(&[
            (0.0, 0.0),
            (moved_s, 0.0),
            (moved_s, 50.0),
            (moved_s + 2e-5, 50.0),
        ]);
        let mut again = scene(exactly, &[[0.0, z_m]], 1e-4);
        again.settings.step_s = Some(1e-8);
        let found = run(&again);
        let i = found
            .series
            .time_s
            .partition_point(|&t| t < times_s[first] - 0.5 * step_s);
        let stress = &found.probes.as_ref().unwrap().values[4][0];
        assert!(
            stress[i - 1] == 0.0 && (stress[i] / -under - 1.0).abs() < 0.01,
            "{} {}",
            stress[i],
            under
        );
        let jump = found
            .series
            .time_s
            .iter()
            .position(|&t| t >= moved_s * (1.0 - 1e-15))
            .unwrap();
        assert_eq!(
            (found.series.force_n[jump], found.series.force_n[jump - 1]),
            (50.0, 0.0)
        );
    }
}

/// Means over a step of the output, of the exact displacements half a step before and after.
#[test]
fn velocities_under_jumps_are_means_over_a_step() {
    let mut asked = scene(record(&ROWS), &PLACES, 1e-4);
    asked.quantities = vec![Quantity::VelocityZ, Quantity::AccelerationZ];
    let found = run(&asked);
    assert!(
        found
            .warnings
            .iter()
            .any(|told| told.contains("jumps by up to 115 N: velocities"))
    );
    let (reference, probes, step_s) = (
        Reference::new(),
        found.probes.as_ref().unwrap(),
        found.step_s(),
    );
    let mut most = [0.0_f64; 2];
    for (probe, &place_m) in PLACES.iter().enumerate() {
        for (i, &time_s) in found.series.time_s.iter().enumerate().step_by(37) {
            let at = |steps: f64| reference.at(place_m, &ROWS, time_s + steps * step_s)[1];
            let exact = [
                (at(0.5) - at(-0.5)) / step_s,
                (at(1.0) - 2.0 * at(0.0) + at(-1.0)) / (step_s * step_s),
            ];
            for k in 0..2 {
                let (own, error) = (&probes.values[6 + k][probe], probes.errors[6 + k][probe]);
                let off = (own[i] - exact[k]).abs();
                assert!(
                    off < error,
                    "{k} at {time_s}: {} {}, {error}",
                    own[i],
                    exact[k]
                );
                most[k] = most[k].max(off / peak(own));
            }
        }
    }
    println!(
        "velocities off by {:.1e} of their peaks, accelerations by {:.1e}",
        most[0], most[1]
    );
    assert!(most[0] < 1e-4 && most[1] < 1e-2);
}

/// The work of a force that is constant after a jump is that force times the deflection, which is the step response.
#[test]
fn the_work_of_a_jump_is_the_force_times_the_deflection() {
    let mut asked = scene(record(&[(2.37e-6, 60.0), (9e-5, 60.0)]), &[], 1e-4);
    (asked.duration_s, asked.settings.deflection) = (Some(2e-5), Deflection::Mean);
    let found = run(&asked);
    let steel = HalfSpace::new(Material::named("steel").unwrap()).unwrap();
    let response = SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Mean);
    let unit_s = RADIUS_M / steel.longitudinal_speed_m_s();
    let still_m =
        60.0 * response.disc.static_compliance / (steel.material().shear_modulus_pa() * RADIUS_M);
    let energy = found.series.energy.unwrap();
    let work_j = energy.work_j.unwrap();
    for (i, &time_s) in found.series.time_s.iter().enumerate() {
        let exact_m = still_m * response.step((time_s - 2.37e-6) / unit_s);
        assert!(
            (found.series.deflection_m[i] - exact_m).abs() < 1e-9 * still_m,
            "{time_s}"
        );
        assert!(
            (work_j[i] - 60.0 * exact_m).abs() < 1e-4 * 60.0 * still_m,
            "{time_s} {} {}",
            work_j[i],
            60.0 * exact_m
        );
    }
}
