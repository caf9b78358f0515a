//! Cancellation in the formulas of the kernels: potentials far away, coalescing roots, incompressible solids.

use crate::measure::Effort;
use crate::picture::Picture;
use crate::question::kernels::ALL_FIELDS;
use crate::record::{off, peaks, sizes};
use fault::AnyError;
use figure::{Axis, Interval, Layer, Style};
use halfspace::gauss::Rule;
use halfspace::{Deflection, Kernel, Medium, Profile, SurfaceResponse, kausel};
use num_complex::Complex64;
use std::f64::consts::PI;

/// Poisson's ratio where two roots of the Rayleigh cubic meet.
///
/// It is the zero of the discriminant of the Rayleigh cubic, to the last bit.
const DOUBLE_ROOT: f64 = 0.263_082_064_883_363_66;

/// A_3 and A_2 of Hertz's pressure without cancellation: a Gauss rule over the chord function.
///
/// A_n = (3/(8 pi)) int_{-1}^1 (1 - x^2) E_{n-3}(xi - i x) dx, E_0 = 1/rho, E_{-1} = zeta/rho^3; for |xi| > 1 + r.
pub(super) fn chord_potentials(xi: Complex64, r: f64) -> [Complex64; 2] {
    let rule = Rule::new(64);
    let mut sum = [Complex64::default(); 2];
    for (x, weight) in rule.on(-1.0, 1.0) {
        let i = Complex64::i();
        let zeta = xi - i * x;
        let rho = (zeta + i * r).sqrt() * (zeta - i * r).sqrt();
        let weight = weight * 0.375 / PI * (1.0 - x * x);
        sum[0] += weight / rho;
        sum[1] += weight * zeta / (rho * rho * rho);
    }
    sum
}

/// A_3 of Hertz's pressure in closed form, Re xi >= 0.
///
/// For |xi| >> 1 it is a difference of nearly equal logarithms, and the error grows as |xi|^3.
fn closed_potential(xi: Complex64, r: f64) -> Complex64 {
    let i = Complex64::i();
    // E_2 and E_3 at an end of the chord
    let end = |zeta: Complex64| {
        let rho = (zeta + i * r).sqrt() * (zeta - i * r).sqrt();
        let log = (zeta + rho).ln();
        let third = 0.75 * zeta * rho + (0.25 * r * r - 0.5 * zeta * zeta) * log;
        [zeta * log - rho, third]
    };
    let ([second, third], [second_below, third_below]) = (end(xi - i), end(xi + i));
    let difference = (third - third_below) / (2.0 * i);
    1.5 / PI * (difference - 0.5 * (second + second_below))
}

/// Relative error of A_3 in closed form at |xi| = `size` in a direction (0: real axis, pi/2: imaginary axis).
pub(super) fn closed_form_error(size: f64, direction: f64, r: f64) -> f64 {
    let xi = Complex64::from_polar(size, direction);
    let xi = Complex64::new(xi.re.max(0.0), xi.im);
    let exact = chord_potentials(xi, r)[0];
    (closed_potential(xi, r) - exact).norm() / exact.norm()
}

/// Relative error of the program's static w at a depth where it uses the multipole series.
pub(super) fn deep_static_error(medium: &Medium, r: f64, z: f64) -> Result<f64, AnyError> {
    let kernel = Kernel::new(medium, Profile::Hertz, 1e-10)?;
    let [a3, a2] = chord_potentials(z.into(), r);
    let exact = (1.0 - medium.poisson_ratio()) * a3.re + 0.5 * z * a2.re;
    Ok((kernel.static_field(r, z)?[1] / exact - 1.0).abs())
}

/// Largest difference between the closed form of W and the program's, near the double root.
pub(super) fn double_root_error(distance: f64) -> Result<f64, AnyError> {
    let medium = Medium::new(DOUBLE_ROOT + distance)?;
    let response = SurfaceResponse::new(&medium, Deflection::Centre);
    let worst = (1..40).map(|i| {
        let t = f64::from(i) * 0.025;
        (kausel::centre_step(&medium, t) - response.step(t / medium.kappa())).abs()
    });
    Ok(worst.fold(0.0, f64::max))
}

/// Largest difference between the program's surface response and the single integral, near the double root.
pub(super) fn double_root_own_error(distance: f64) -> Result<f64, AnyError> {
    let medium = Medium::new(DOUBLE_ROOT + distance)?;
    let response = SurfaceResponse::new(&medium, Deflection::Centre);
    let kernel = Kernel::new(&medium, Profile::Hertz, 1e-14)?;
    let rest = kernel.static_field(0.0, 0.0)?[1];
    (1..40).try_fold(0.0_f64, |worst, i| {
        let t = f64::from(i) * 0.025 / medium.kappa();
        let integral = 1.0 + kernel.remainder(0.0, 0.0, t)?.value[1] / rest;
        Ok(worst.max((integral - response.step(t)).abs()))
    })
}

/// Difference of the kernels at tolerances 1e-8 and 1e-13 over the largest field, at a distance from nu = 1/2.
///
/// The times are those of the shear waves, which do not change as c1 goes to infinity.
pub(super) fn incompressible_error(distance: f64) -> Result<f64, AnyError> {
    let medium = Medium::new(0.5 - distance)?;
    let coarse = Kernel::new(&medium, Profile::Hertz, 1e-8)?;
    let fine = Kernel::new(&medium, Profile::Hertz, 1e-13)?;
    let (r, z) = (0.5, 0.6);
    let rest = fine.static_field(r, z)?;
    let (mut found, mut exact, mut whole) = (Vec::new(), Vec::new(), vec![rest]);
    for shear_time in [0.3, 0.7, 1.0, 1.6, 2.5, 6.0] {
        let t = shear_time / medium.kappa();
        let value = fine.remainder(r, z, t)?.value;
        found.push(coarse.remainder(r, z, t)?.value);
        exact.push(value);
        whole.push(std::array::from_fn(|f| value[f] + rest[f]));
    }
    Ok(sizes(&off(&found, &exact, &peaks(&whole), &ALL_FIELDS))[0])
}

/// W at T = 0.7 for a ratio, from the program and from the closed form.
pub(super) fn incompressible_surface(distance: f64) -> Result<[f64; 2], AnyError> {
    let medium = Medium::new(0.5 - distance)?;
    let response = SurfaceResponse::new(&medium, Deflection::Centre);
    Ok([
        response.step(0.7 / medium.kappa()),
        kausel::centre_step(&medium, 0.7),
    ])
}

/// All three pictures.
pub(crate) fn figures(effort: Effort) -> Result<Vec<Picture>, AnyError> {
    let figures = [potentials, double_root, incompressible];
    figures.into_iter().map(|figure| figure(effort)).collect()
}

/// Adds a curve of errors; errors below 1e-17 are drawn at 1e-17.
fn add(
    figure: &mut Picture,
    name: &str,
    style: Style,
    places: &[f64],
    error: impl Fn(f64) -> Result<f64, AnyError>,
) -> Result<(), AnyError> {
    let point = |&x: &f64| Ok((x, error(x)?.max(1e-17)));
    let points: Result<_, AnyError> = places.iter().map(point).collect();
    figure.line(name, style, points?);
    Ok(())
}

fn potentials(effort: Effort) -> Result<Picture, AnyError> {
    let x = Interval::logarithmic(3.0, 1e6);
    let sizes = x.cells(effort.pick(40, 120));
    let mut figure = Picture::new(
        "potentials",
        "Potentials in closed form, without the multipole series",
        Axis::over(x, "|xi|").unit("r0"),
        Axis::logarithmic("relative error of A3").range(1e-18, 10.0),
    );
    for (name, direction) in [
        ("closed form, static (xi real)", 0.0),
        ("closed form, waves (xi imaginary)", 0.5 * PI),
        ("closed form, between", 0.25 * PI),
    ] {
        let error = |size| Ok(closed_form_error(size, direction, 0.5).min(10.0));
        add(&mut figure, name, Style::Plain, &sizes, error)?;
    }
    let medium = Medium::new(0.3)?;
    let own = "the program (static w at depth)";
    let error = |depth| deep_static_error(&medium, 0.5, depth);
    add(&mut figure, own, Style::Points, &sizes, error)?;
    let theory = "theory: machine epsilon |xi|^3 ln|xi|";
    let error = |size: f64| Ok((f64::EPSILON * size.powi(3) * size.ln()).min(10.0));
    add(&mut figure, theory, Style::HeavyDashed, &sizes, error)?;
    figure.caption = "The closed forms are differences of terms of size |xi|^2 ln|xi| with a result of size 1/|xi|: \
        their relative error grows as the third power of the distance and reaches one at about 1e5 r0. The program \
        changes to the multipole series at 7 to 10 r0 and keeps its digits."
        .to_owned();
    Ok(figure)
}

fn double_root(effort: Effort) -> Result<Picture, AnyError> {
    let x = Interval::logarithmic(1e-16, 0.1);
    let distances = x.cells(effort.pick(16, 60));
    let mut figure = Picture::new(
        "double-root",
        "Closed form of W where two roots meet",
        Axis::over(x, "distance of Poisson's ratio from 0.263082064883"),
        Axis::logarithmic("largest error of W").range(1e-17, 1e-6),
    );
    for (name, sign) in [("closed form, above", 1.0), ("closed form, below", -1.0)] {
        let error = |distance| double_root_error(sign * distance);
        add(&mut figure, name, Style::Marked, &distances, error)?;
    }
    let own = "the program, against the single integral";
    let error = double_root_own_error;
    add(&mut figure, own, Style::Points, &distances, error)?;
    let theory = "theory, at most: machine epsilon over root distance";
    let error = |distance: f64| Ok(f64::EPSILON / distance.sqrt());
    add(&mut figure, theory, Style::HeavyDashed, &x.cells(40), error)?;
    figure.caption = "The two complex roots of the Rayleigh cubic part as the square root of the distance, and the \
        closed form divides by their difference. The program's surface response has no such difference and is used \
        everywhere; the closed form only checks it."
        .to_owned();
    Ok(figure)
}

fn incompressible(effort: Effort) -> Result<Picture, AnyError> {
    let x = Interval::logarithmic(1e-9, 0.5);
    let distances = x.cells(effort.pick(12, 40));
    let mut figure = Picture::new(
        "incompressible",
        "Kernels as Poisson's ratio goes to 1/2",
        Axis::over(x, "1/2 - nu"),
        Axis::logarithmic("relative error; c2/c1").range(1e-17, 10.0),
    );
    let kernels = "kernels asked for 1e-8 at (0.5, 0.6) r0";
    let error = incompressible_error;
    add(&mut figure, kernels, Style::Marked, &distances, error)?;
    let surface = "surface response against closed form";
    let error =
        |distance| incompressible_surface(distance).map(|[own, closed]| (own - closed).abs());
    add(&mut figure, surface, Style::Marked, &distances, error)?;
    let theory = "theory: c2/c1 = sqrt(d/(1/2 + d))";
    let ratio = |d: f64| Ok((d / (0.5 + d)).sqrt());
    add(&mut figure, theory, Style::HeavyDashed, &distances, ratio)?;
    figure.add(Layer::mark(0.005, "tables end"));
    figure.caption = "c1/c2 goes to infinity as the root of 1/(1/2 - nu): a table's time axis in r0/c1 grows with \
        it, which is why tables end at nu = 0.495. The kernels and the surface response themselves keep their accuracy."
        .to_owned();
    Ok(figure)
}
