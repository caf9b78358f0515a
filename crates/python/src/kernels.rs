//! Exact kernels at many places and times, in reduced units.

use crate::errors::{check_memory, one_of, plain, raise};
use crate::values::{Array, fields, numbers, vector};
use crate::work::{Threads, Ticker, run, run_short};
use halfspace::{
    Arrivals, Attenuation, Deflection, DomainError, Estimate, Kernel, Medium, Profile, Six,
    Spectrum, SurfaceResponse, kausel,
};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use tabulator::Progress;

/// The medium of a Poisson's ratio, or a `DomainError`.
fn medium_of(nu: f64) -> PyResult<Medium> {
    Medium::new(nu).map_err(raise)
}

const PROFILES: [(&str, Profile); 3] = [
    ("hertz", Profile::Hertz),
    ("punch", Profile::Punch),
    ("point", Profile::Point),
];

const DEFLECTIONS: [(&str, Deflection); 2] =
    [("centre", Deflection::Centre), ("mean", Deflection::Mean)];

/// A function of time: of a kernel at (r, z, t), and of the surface at t.
type Order = (
    fn(&Kernel, [f64; 3]) -> Result<Estimate, DomainError>,
    fn(&SurfaceResponse, f64) -> f64,
);

const ORDERS: [(&str, Order); 4] = [
    ("step", (step, SurfaceResponse::step)),
    (
        "remainder",
        (
            |kernel, [r, z, t]| kernel.remainder(r, z, t),
            |surface, t| surface.step(t) - 1.0,
        ),
    ),
    (
        "impulse",
        (
            |kernel, [r, z, t]| kernel.impulse(r, z, t),
            SurfaceResponse::impulse,
        ),
    ),
    (
        "step_integral",
        (
            |kernel, [r, z, t]| kernel.step_integral(r, z, t),
            SurfaceResponse::step_integral,
        ),
    ),
];

/// The step response, static field plus remainder, with the error of the remainder.
fn step(kernel: &Kernel, [r, z, t]: [f64; 3]) -> Result<Estimate, DomainError> {
    let rest = kernel.static_field(r, z)?;
    let mut found = kernel.remainder(r, z, t)?;
    found.value = std::array::from_fn(|f| rest[f] + found.value[f]);
    Ok(found)
}

/// Values and errors of a kernel, both (place, 6), at the places (r, z, t); the three arrays have equal lengths.
#[pyfunction]
#[pyo3(signature = (order, nu, r, z, t, profile, tolerance, threads=None, progress=None))]
pub(crate) fn kernel<'py>(
    py: Python<'py>,
    order: &str,
    nu: f64,
    r: PyReadonlyArray1<'py, f64>,
    z: PyReadonlyArray1<'py, f64>,
    t: PyReadonlyArray1<'py, f64>,
    profile: &str,
    tolerance: f64,
    threads: Option<Threads>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Array<'py>, Array<'py>)> {
    let (at, _) = one_of("order", order, &ORDERS)?;
    let profile = one_of("profile", profile, &PROFILES)?;
    let kernel = Kernel::new(&medium_of(nu)?, profile, tolerance).map_err(raise)?;
    let rows = r.len()?;
    if z.len()? != rows || t.len()? != rows {
        return Err(plain("SceneError", "r, z and t differ in their lengths"));
    }
    // the places, the estimates, and the two returned arrays
    check_memory(rows, "places", 3 * 8 + size_of::<Estimate>() + 2 * 6 * 8)?;
    let (r, z, t) = (numbers(&r), numbers(&z), numbers(&t));
    let one = move |ticker: &Ticker, i: usize| {
        ticker.advance(1);
        at(&kernel, [r[i], z[i], t[i]])
    };
    let found: Result<Vec<Estimate>, DomainError> = if rows < 8 {
        run_short(py, || {
            let ticker = Ticker::default();
            (0..rows).map(|i| one(&ticker, i)).collect()
        })?
    } else {
        run(py, threads, progress, move |ticker| {
            ticker.total("places", rows as u64);
            (0..rows).into_par_iter().map(|i| one(ticker, i)).collect()
        })?
    };
    let found = found.map_err(raise)?;
    let (values, limits) = found.iter().map(|e| (e.value, e.error)).unzip();
    Ok((fields(py, values)?, fields(py, limits)?))
}

/// Real and imaginary parts of frequency responses and errors, all (place, 6), at the places and frequencies (r, z, f), which have
/// equal lengths.
///
/// Without a reference frequency each frequency is its own.
#[pyfunction]
#[pyo3(signature = (nu, r, z, f, profile, attenuation=None, threads=None, progress=None))]
pub(crate) fn spectrum<'py>(
    py: Python<'py>,
    nu: f64,
    r: PyReadonlyArray1<'py, f64>,
    z: PyReadonlyArray1<'py, f64>,
    f: PyReadonlyArray1<'py, f64>,
    profile: &str,
    attenuation: Option<(f64, Option<f64>)>,
    threads: Option<Threads>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Array<'py>, Array<'py>, Array<'py>)> {
    let profile = one_of("profile", profile, &PROFILES)?;
    // the tolerance has no effect
    let kernel = Kernel::new(&medium_of(nu)?, profile, 1e-6).map_err(raise)?;
    let rows = r.len()?;
    if z.len()? != rows || f.len()? != rows {
        return Err(plain("SceneError", "r, z and f differ in their lengths"));
    }
    check_memory(rows, "places", 3 * 8 + size_of::<Spectrum>() + 3 * 6 * 8)?;
    let (r, z, f) = (numbers(&r), numbers(&z), numbers(&f));
    let one = move |i: usize| {
        let law = attenuation
            .map(|(quality, reference)| Attenuation::new(quality, reference.unwrap_or(f[i])));
        kernel.spectrum(r[i], z[i], f[i], law.transpose()?.as_ref())
    };
    let found: Result<Vec<Spectrum>, DomainError> = run(py, threads, progress, move |ticker| {
        ticker.total("frequencies", rows as u64);
        let each = (0..rows).into_par_iter().map(|i| {
            ticker.advance(1);
            one(i)
        });
        each.collect()
    })?;
    let found = found.map_err(raise)?;
    Ok((
        fields(
            py,
            found.iter().map(|own| own.value.map(|v| v.re)).collect(),
        )?,
        fields(
            py,
            found.iter().map(|own| own.value.map(|v| v.im)).collect(),
        )?,
        fields(py, found.iter().map(|own| own.error).collect())?,
    ))
}

/// The static fields (place, 6) at the places (r, z).
#[pyfunction]
pub(crate) fn static_field<'py>(
    py: Python<'py>,
    nu: f64,
    r: PyReadonlyArray1<'py, f64>,
    z: PyReadonlyArray1<'py, f64>,
    profile: &str,
) -> PyResult<Array<'py>> {
    // a closed form: the tolerance has no effect
    let profile = one_of("profile", profile, &PROFILES)?;
    let kernel = Kernel::new(&medium_of(nu)?, profile, 1e-6).map_err(raise)?;
    let rows = r.len()?;
    check_memory(rows, "places", 2 * 8 + 2 * 6 * 8)?;
    let (r, z) = (numbers(&r), numbers(&z));
    let at = |(&r, &z): (&f64, &f64)| kernel.static_field(r, z);
    let found: Result<Vec<Six>, DomainError> =
        run_short(py, || r.iter().zip(&z).map(at).collect())?;
    fields(py, found.map_err(raise)?)
}

/// The deflection of the loaded surface over its static value, or its time integral or derivative.
#[pyfunction]
pub(crate) fn surface<'py>(
    py: Python<'py>,
    order: &str,
    nu: f64,
    t: PyReadonlyArray1<'py, f64>,
    deflection: &str,
) -> PyResult<Array<'py>> {
    let (_, at) = one_of("order", order, &ORDERS)?;
    let deflection = one_of("deflection", deflection, &DEFLECTIONS)?;
    let response = SurfaceResponse::new(&medium_of(nu)?, deflection);
    check_memory(t.len()?, "times", 2 * 8)?;
    let t = numbers(&t);
    let found = run_short(py, || t.iter().map(|&t| at(&response, t)).collect())?;
    vector(py, found)
}

/// The closed form of Kausel (2012) for the surface centre; times in r0/c2.
#[pyfunction]
pub(crate) fn surface_centre<'py>(
    py: Python<'py>,
    nu: f64,
    t: PyReadonlyArray1<'py, f64>,
) -> PyResult<Array<'py>> {
    check_memory(t.len()?, "times", 2 * 8)?;
    let (medium, t) = (medium_of(nu)?, numbers(&t));
    let at = |&t: &f64| kausel::centre_step(&medium, t);
    let found = run_short(py, || t.iter().map(at).collect())?;
    vector(py, found)
}

/// The reduced wave speeds, compliances and memories of a Poisson's ratio.
#[pyfunction]
pub(crate) fn medium(py: Python<'_>, nu: f64) -> PyResult<Bound<'_, PyDict>> {
    let medium = medium_of(nu)?;
    let found = PyDict::new(py);
    found.set_item("nu", medium.poisson_ratio())?;
    found.set_item("shear_speed", medium.kappa())?;
    found.set_item("rayleigh_speed", medium.rayleigh_speed())?;
    found.set_item("lambda_over_mu", medium.lambda_over_mu())?;
    for (name, deflection) in DEFLECTIONS {
        let disc = SurfaceResponse::new(&medium, deflection).disc;
        found.set_item(format!("{name}_compliance"), disc.static_compliance)?;
        found.set_item(format!("{name}_memory"), disc.memory)?;
        found.set_item(format!("{name}_relaxation_time"), disc.relaxation_time)?;
    }
    Ok(found)
}

/// Arrival times at a place by wave; None for a wave that does not reach it.
#[pyfunction]
pub(crate) fn arrivals<'py>(
    py: Python<'py>,
    nu: f64,
    r: f64,
    z: f64,
    profile: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let medium = medium_of(nu)?;
    let profile = one_of("profile", profile, &PROFILES)?;
    let found = Arrivals::new(&medium, profile, r, z).map_err(raise)?;
    let waves = PyDict::new(py);
    waves.set_item("above", found.above)?;
    waves.set_item("p", found.p)?;
    waves.set_item("s", found.s)?;
    waves.set_item("head", found.head)?;
    waves.set_item("rayleigh", found.rayleigh)?;
    waves.set_item("first", found.first())?;
    waves.set_item("last", found.last())?;
    Ok(waves)
}
