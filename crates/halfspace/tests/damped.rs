//! Damped traces: against frequency responses, in the limit of no attenuation, and before the first arrival.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::{Attenuation, Damping, Kernel, Medium, Profile, Six, Trace, gauss};
use num_complex::Complex64;
use std::f64::consts::TAU;

const REFERENCE: f64 = 0.03;

/// The elastic trace and the damped one.
fn traces(
    kernel: &Kernel,
    [r, z]: [f64; 2],
    quality_factor: f64,
    (end, tolerance): (f64, f64),
) -> [Trace; 2] {
    let damping = Damping::new(
        &Attenuation::new(quality_factor, REFERENCE).unwrap(),
        tolerance,
    );
    let wanted: (Six, &dyn Fn(f64) -> Six) = ([tolerance; 6], &|length| [length.min(1.0); 6]);
    let reach = damping.reach(end, REFERENCE).max(end);
    let elastic = kernel.trace_under(r, z, reach, wanted).unwrap();
    let rest = kernel.static_field(r, z).unwrap();
    let damped = elastic
        .damped(&rest, (&damping, REFERENCE), end, wanted)
        .unwrap();
    [elastic, damped]
}

/// The response to the force (1 - 2 x^2) e^(-x^2), x = (t - centre)/width, in time and by its spectrum.
#[test]
fn responses_are_those_of_spectra() {
    const TOLERANCE: f64 = 1e-10;
    for (nu, place, quality) in [
        (0.25, [3.0, 0.0], 20.0),
        (0.3, [0.5, 2.0], 100.0),
        (0.1, [6.0, 1.0], 8.0),
        (0.4, [0.3, 0.0], 50.0),
        (0.3, [4.0, 6.0], 1e3),
    ] {
        let [r, z]: [f64; 2] = place;
        let kernel = Kernel::new(&Medium::new(nu).unwrap(), Profile::Hertz, 1e-12).unwrap();
        let law = Attenuation::new(quality, REFERENCE).unwrap();
        let (width, centre) = (1.0, 6.5);
        let end = centre + 2.5 * (3.0 + r.hypot(z));
        let [_, damped] = traces(&kernel, place, quality, (end, TOLERANCE));
        let rest = kernel.static_field(r, z).unwrap();
        // the force and its slope
        let force = |t: f64| {
            let x = (t - centre) / width;
            [(1.0 - 2.0 * x * x), (4.0 * x * x - 6.0) * x / width].map(|v| v * (-x * x).exp())
        };
        let mut breaks: Vec<f64> = damped.breaks().collect();
        breaks.extend([0.0, end]);
        breaks.sort_by(f64::total_cmp);
        for t in [0.55 * end, 0.75 * end, end] {
            let mut found = rest.map(|s| s * force(t)[0]);
            for pair in breaks.windows(2).filter(|pair| pair[0] < t) {
                for (tau, weight) in gauss::rule(40).on(pair[0], pair[1].min(t)) {
                    for (found, value) in found.iter_mut().zip(damped.at(tau)) {
                        *found += weight * force(t - tau)[1] * value;
                    }
                }
            }
            // (1/pi) Re int G F e^(i omega t) d omega, F = sqrt(pi) width^3 omega^2/2 e^(-(omega width)^2/4 - i omega centre)
            let mut wanted = Six::default();
            let mut sizes = Six::default();
            for panel in 0..12 {
                let from = [
                    0.0, 0.02, 0.2, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0,
                ];
                for (omega, weight) in gauss::rule(40).on(from[panel], from[panel + 1]) {
                    let own = kernel.spectrum(r, z, omega / TAU, Some(&law)).unwrap();
                    let size = (0.5 * TAU).sqrt()
                        * 0.5
                        * width.powi(3)
                        * omega
                        * omega
                        * (-0.25 * (omega * width).powi(2)).exp();
                    let phase = Complex64::from_polar(size, omega * (t - centre));
                    for f in 0..6 {
                        wanted[f] += weight / (0.5 * TAU) * (own.value[f] * phase).re;
                        sizes[f] += weight / (0.5 * TAU) * (own.value[f] * phase).norm();
                    }
                }
            }
            let largest = |of: &[f64]| of.iter().copied().fold(0.0, f64::max);
            let kinds = [largest(&sizes[..2]), largest(&sizes[2..])];
            for f in 0..6 {
                let off = (found[f] - wanted[f]).abs() / kinds[usize::from(f >= 2)];
                println!(
                    "{nu} {place:?} {quality} {t:.1} {f}: {off:.1e} {:.1e}",
                    wanted[f]
                );
                assert!(off < 1e-9, "{nu} {place:?} {quality} {t} {f}: {off:.1e}");
            }
        }
    }
}

#[test]
fn without_attenuation_traces_are_elastic() {
    let kernel = Kernel::new(&Medium::new(0.3).unwrap(), Profile::Hertz, 1e-12).unwrap();
    for place in [[3.0, 0.0], [0.5, 2.0], [5.0, 4.0]] {
        let [elastic, damped] = traces(&kernel, place, 1e14, (20.0, 1e-11));
        let peak = |f: usize| {
            (0..400)
                .map(|i| elastic.at(0.05 * f64::from(i))[f].abs())
                .fold(0.0, f64::max)
        };
        let peaks: [f64; 6] = std::array::from_fn(peak);
        for i in 1..400 {
            let (from, to) = (0.05 * f64::from(i), 0.05 * f64::from(i + 1) - 1e-6);
            let [a, b] = [&elastic, &damped].map(|trace| trace.cell(from, to).unwrap()[0]);
            for f in 0..6 {
                let off = (a[f] - b[f]).abs();
                assert!(
                    off <= 1e-10 * peaks[f].max(1e-6),
                    "{place:?} {from} {f}: {off:.1e} of {}",
                    peaks[f]
                );
            }
        }
    }
}

#[test]
fn nothing_arrives_before_the_first_wave() {
    let kernel = Kernel::new(&Medium::new(0.3).unwrap(), Profile::Hertz, 1e-12).unwrap();
    let [_, damped] = traces(&kernel, [5.0, 4.0], 30.0, (20.0, 1e-8));
    let rest = kernel.static_field(5.0, 4.0).unwrap();
    // the first wave at sqrt(4^2 + 4^2); at these frequencies it is faster than at the reference
    for t in [0.1, 2.0, 4.0] {
        assert_eq!(damped.at(t), rest.map(|s| -s));
    }
}
