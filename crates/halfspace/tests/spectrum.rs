//! Frequency responses: against an independent program, against the kernels in time, and their estimates.

use halfspace::{Attenuation, DomainError, Field, Kernel, Medium, Profile, gauss, random};
use num_complex::Complex64;
use std::f64::consts::TAU;

const W: usize = Field::DisplacementZ.index();

/// Angular frequency times r over c2, Q, and mu r G on the surface under a point force at nu = 1/4, with the quality factor at
/// the reference frequency: a direct integral over wave number by another program, good to 1e-10.
const DAMPED: [[f64; 4]; 4] = [
    [1.0, 20.0, 3.290568780107e-02, -1.133417449432e-01],
    [1.0, 100.0, 3.838442232433e-02, -1.147118626428e-01],
    [3.0, 20.0, -1.063594356415e-01, 6.746642474715e-02],
    [3.0, 100.0, -1.172091402257e-01, 6.738921343302e-02],
];

#[test]
fn damped_responses_are_those_of_another_program() {
    let medium = Medium::new(0.25).unwrap();
    let kernel = Kernel::new(&medium, Profile::Point, 1e-10).unwrap();
    for [waves, quality, re, im] in DAMPED {
        let r = 7.0;
        let frequency = waves * medium.kappa() / (TAU * r);
        let law = Attenuation::new(quality, frequency).unwrap();
        let found = kernel.spectrum(r, 0.0, frequency, Some(&law)).unwrap();
        let off = (r * found.value[W] - Complex64::new(re, im)).norm();
        assert!(off < 2e-10, "{waves} {quality}: {off}");
    }
}

/// Rayleigh wave number times r, and mu |G| c2/omega at nu = 1/4 without attenuation: the same program.
#[test]
fn elastic_responses_are_those_of_another_program() {
    let medium = Medium::new(0.25).unwrap();
    let kernel = Kernel::new(&medium, Profile::Point, 1e-10).unwrap();
    for [waves, wanted] in [
        [0.1, 1.298523],
        [0.3, 0.433_426_6],
        [1.0, 0.131_992_5],
        [3.0, 0.049_001_94],
        [6.0, 0.030_028_06],
        [10.0, 0.022_435_27],
        [20.0, 0.017_134_42],
        [30.0, 0.014_574_82],
        [60.0, 0.010_498_11],
    ] {
        let omega = waves * medium.rayleigh_speed();
        let found = kernel.spectrum(1.0, 0.0, omega / TAU, None).unwrap();
        let size = found.value[W].norm() * medium.kappa() / omega;
        assert!(
            (size / wanted - 1.0).abs() < 1e-6,
            "{waves}: {size} {wanted}"
        );
    }
}

/// G = static + i omega int R e^(-i omega t) dt, from the trace of the remainder and the first terms of its decay.
fn from_trace(
    kernel: &Kernel,
    [r, z]: [f64; 2],
    omega: f64,
) -> Result<[Complex64; 6], DomainError> {
    const END: f64 = 4e3;
    let trace = kernel.trace(r, z, END)?;
    let mut cuts: Vec<f64> = trace.breaks().collect();
    cuts.extend([0.0, END]);
    cuts.sort_by(f64::total_cmp);
    let i = Complex64::i();
    let mut found = kernel.static_field(r, z)?.map(Complex64::from);
    for pair in cuts.windows(2) {
        let panels = ((pair[1] - pair[0]) * omega / 4.0).ceil().max(1.0) as usize;
        for panel in 0..panels {
            // cos(pi s): fronts are roots
            let at = |s: f64| {
                let whole = (panel as f64 + s) / panels as f64;
                0.5 * (pair[0] + pair[1]) - 0.5 * (pair[1] - pair[0]) * (0.5 * TAU * whole).cos()
            };
            let slope = |s: f64| {
                let whole = (panel as f64 + s) / panels as f64;
                0.25 * TAU * (pair[1] - pair[0]) * (0.5 * TAU * whole).sin() / panels as f64
            };
            for (s, weight) in gauss::rule(24).on(0.0, 1.0) {
                let t = at(s);
                let factor = weight * slope(s) * i * omega * (-i * omega * t).exp();
                for (found, value) in found.iter_mut().zip(trace.at(t)) {
                    *found += factor * value;
                }
            }
        }
    }
    // the rest falls as t^-2: i omega R/(i omega) e^(-i omega T) (1 - 2/(i omega T))
    let rest = (-i * omega * END).exp() * (1.0 - 2.0 / (i * omega * END));
    for (found, value) in found.iter_mut().zip(trace.at(END)) {
        *found += rest * value;
    }
    Ok(found)
}

#[test]
fn responses_are_those_of_traces() {
    let mut worst = [0.0_f64; 6];
    for (nu, place, omega) in [
        (0.3, [0.0, 2.0], 1.0),
        (0.3, [3.0, 0.0], 0.4),
        (0.25, [3.0, 0.0], 4.0),
        (0.1, [0.4, 0.3], 2.5),
        (0.45, [1.2, 0.05], 1.5),
        (0.3, [30.0, 10.0], 1.0),
        (0.0, [0.9, 1e-3], 3.0),
    ] {
        let medium = Medium::new(nu).unwrap();
        let kernel = Kernel::new(&medium, Profile::Hertz, 1e-12).unwrap();
        let [r, z] = place;
        let found = kernel.spectrum(r, z, omega / TAU, None).unwrap().value;
        let wanted = from_trace(&kernel, place, omega).unwrap();
        let size = |of: &[Complex64]| of.iter().map(|v| v.norm()).fold(0.0, f64::max);
        for f in 0..6 {
            let kind = if f < 2 { &wanted[..2] } else { &wanted[2..] };
            let off = (found[f] - wanted[f]).norm() / size(kind);
            assert!(off < 1e-9, "{nu} {place:?} {omega} {f}: {off}");
            worst[f] = worst[f].max(off);
            println!("{nu} {place:?} {omega} {f}: {off:.1e}");
        }
    }
    println!("{worst:?}");
}

/// Far from a disc that is small compared with the waves its response is that of a point force, also where the two take other
/// paths.
#[test]
fn discs_far_away_are_points() {
    let medium = Medium::new(0.3).unwrap();
    let [disc, point] = [Profile::Hertz, Profile::Point]
        .map(|profile| Kernel::new(&medium, profile, 1e-10).unwrap());
    let mut random = random::Stream::new(7);
    for _ in 0..40 {
        let (r, z) = (random.within(1e4, 2e4), random.log(1.0, 1e5));
        let frequency = random.within(1e-6, 1e-4);
        let [own, other] = [&disc, &point].map(|k| k.spectrum(r, z, frequency, None).unwrap());
        for f in 0..2 {
            let off = (own.value[f] - other.value[f]).norm() / other.value[W].norm();
            assert!(off < 1e-6, "{r} {z} {frequency}: {off}");
        }
    }
}
