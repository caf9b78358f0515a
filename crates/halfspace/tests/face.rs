//! The mean over a face against an independent integral over wave number, and against means of points.

use halfspace::{Face, Field, Kernel, Medium, Profile, Six, Trace, gauss};
use std::f64::consts::PI;

const W: usize = Field::DisplacementZ.index();

/// Response at a time to a pulse sin^1.5 of some length by a trace of the remainder: the integral over its rate, whose roots at both
/// ends the substitution s = length (1 - cos(a))/2 takes away, between the breaks of the trace.
fn under_pulse(trace: &Trace, rest: f64, (length, t): (f64, f64)) -> f64 {
    let force = |s: f64| (PI * s / length).sin().max(0.0).powf(1.5);
    let rate = |s: f64| {
        let angle = PI * s / length;
        1.5 * PI / length * angle.sin().max(0.0).sqrt() * angle.cos()
    };
    let angle_of = |s: f64| (1.0 - 2.0 * s / length).clamp(-1.0, 1.0).acos();
    let mut ends: Vec<f64> = trace.breaks().map(|b| t - b).collect();
    ends.extend([0.0, length, t]);
    ends.retain(|s| (0.0..=length.min(t)).contains(s));
    ends.sort_by(f64::total_cmp);
    let mut sum = if t < length { force(t) * rest } else { 0.0 };
    for pair in ends.windows(2).filter(|pair| pair[1] > pair[0]) {
        let [from, to] = [pair[0], pair[1]].map(angle_of);
        for (part, weight) in gauss::rule(32).on(0.0, PI) {
            // roots of the trace next to a front
            let angle = 0.5 * (from + to) - 0.5 * (to - from) * part.cos();
            let s = 0.5 * length * (1.0 - angle.cos());
            let jacobian = 0.25 * length * angle.sin() * (to - from) * part.sin();
            sum += weight * jacobian * rate(s) * trace.at(t - s)[W];
        }
    }
    sum
}

/// Traces of w alone, for a pulse of some length in r0/c1.
fn wanted(tolerance: f64, length: f64) -> (Six, impl Fn(f64) -> Six) {
    let mut all = [f64::INFINITY; 6];
    all[W] = tolerance;
    (all, move |gap: f64| [(PI * gap / length).min(1.0); 6])
}

/// `tests/reference/face.py`: means by the closed form of a point force at a Poisson's ratio of 1/4, units r, c2 and P/(mu r).
/// A Hertz disc of 1e-6 r is the point to 1e-9; estimates of the kernels of a point force are wide, so that its trace is less accurate.
#[test]
fn means_are_those_of_a_closed_form() {
    let rows = include_str!("../../../tests/golden/face.csv").lines();
    let rows = rows
        .skip(1)
        .map(|row| row.split(',').map(|x| x.parse().unwrap()));
    let rows: Vec<Vec<f64>> = rows.map(Iterator::collect).collect();
    let medium = Medium::new(0.25).unwrap();
    for (profile, r, allowed) in [(Profile::Hertz, 1e6, 1e-8), (Profile::Point, 1.0, 1e-6)] {
        let kernel = Kernel::new(&medium, profile, 1e-10).unwrap();
        for case in rows.chunk_by(|one, other| one[..2] == other[..2]) {
            let to_c1 = r / medium.kappa();
            let (radius, length) = (r * case[0][0], to_c1 * case[0][1]);
            let face = Face::new(r, radius).unwrap();
            let end = case.last().unwrap()[2] * to_c1 * 1.01;
            let (tolerance, rise) = wanted(1e-9, length);
            let trace = kernel
                .mean_trace_under(&face, 0.0, end, (tolerance, &rise))
                .unwrap();
            let rest = kernel.static_mean(&face, 0.0).unwrap()[W];
            let peak = case.iter().map(|row| row[3].abs()).fold(0.0, f64::max);
            let of = |row: &Vec<f64>| r * under_pulse(&trace, rest, (length, row[2] * to_c1));
            let differences = case.iter().map(|row| (of(row) - row[3]).abs() / peak);
            let most = differences.fold(0.0, f64::max);
            let [face, pulse] = [case[0][0], case[0][1]];
            println!("{profile:?}, face {face} r, pulse {pulse} r/c2: {most:.1e}");
            assert!(most < allowed, "{profile:?} {:?}: {most:e}", &case[0][..2]);
        }
    }
}

/// Few circles, each a point, against the trace of the mean: all fields, places beside the load, under it and below the surface.
#[test]
fn circles_and_traces_agree() {
    let kernel = Kernel::new(&Medium::new(0.3).unwrap(), Profile::Hertz, 1e-9).unwrap();
    for (r, z, radius) in [
        (8.0, 0.0, 2.0),
        (8.0, 3.0, 2.0),
        (2.0, 4.0, 1.9),
        (0.0, 5.0, 3.0),
        (1.5, 2.5, 3.0),
    ] {
        let face = Face::new(r, radius).unwrap();
        let end = 40.0;
        let rise = |gap: f64| [(PI * gap / 6.0).min(1.0); 6];
        let mean = kernel
            .mean_trace_under(&face, z, end, ([1e-7; 6], &rise))
            .unwrap();
        let arcs = face.arcs(24);
        let weight: f64 = arcs.iter().map(|arc| arc.even).sum();
        assert!((weight - 1.0).abs() < 1e-6, "{weight}");
        let trace = |arc: &halfspace::Arc| {
            kernel
                .trace_under(arc.r, z, end, ([1e-7; 6], &rise))
                .unwrap()
        };
        let traces: Vec<Trace> = arcs.iter().map(trace).collect();
        // averages over times longer than fronts need to cross a gap between circles
        let mut peak = [0.0_f64; 6];
        let mut most = [0.0_f64; 6];
        for i in 0..20 {
            let (from, to) = (2.0 * f64::from(i), 2.0 * f64::from(i + 1));
            let [found, ..] = mean.cell(from, to).unwrap();
            let mut sum = Six::default();
            for (arc, trace) in arcs.iter().zip(&traces) {
                arc.add(&trace.cell(from, to).unwrap()[0], &mut sum);
            }
            for f in 0..6 {
                peak[f] = peak[f].max(found[f].abs());
                most[f] = most[f].max((found[f] - sum[f]).abs());
            }
        }
        let relative: Vec<f64> = (0..6).map(|f| most[f] / peak[f].max(1e-9)).collect();
        println!("r {r}, z {z}, face {radius}: {relative:?}");
        for f in 0..6 {
            assert!(relative[f] < 2e-3, "{r} {z} {radius}: {relative:?}");
        }
    }
}

/// A face of no size is its centre, and a face over a point force on the surface has no mean.
#[test]
fn small_faces_are_points_and_impossible_ones_are_rejected() {
    let kernel = Kernel::new(&Medium::new(0.2).unwrap(), Profile::Hertz, 1e-10).unwrap();
    let face = Face::new(5.0, 1e-4).unwrap();
    let (mean, own) = (
        kernel.static_mean(&face, 2.0).unwrap(),
        kernel.static_field(5.0, 2.0).unwrap(),
    );
    for f in 0..6 {
        assert!(
            (mean[f] - own[f]).abs() < 1e-8 * own[f].abs(),
            "{mean:?} {own:?}"
        );
    }
    let point = Kernel::new(kernel.medium(), Profile::Point, 1e-8).unwrap();
    let over = Face::new(1.0, 1.5).unwrap();
    assert!(point.static_mean(&over, 0.0).is_err());
    assert!(Face::new(1.0, 0.0).is_err() && Face::new(f64::NAN, 1.0).is_err());
}
