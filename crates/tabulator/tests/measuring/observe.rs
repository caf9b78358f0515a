//! Whether the error estimate of a table is true: random places and pulses against the exact kernels.

use super::uniform;
use lookup::{PulseSum, Series, Smoothness, Table};
use rayon::prelude::*;
use tabulator::{BuildError, Grid};

/// Error and estimate at one place for one pulse, field by field, in the units of the field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Observation {
    /// Poisson's ratio.
    pub(crate) poisson_ratio: f64,
    /// Radius in r0.
    pub(crate) r: f64,
    /// Depth in r0.
    pub(crate) z: f64,
    /// Length of the pulse in r0/c1.
    pub(crate) pulse_length: f64,
    /// Largest magnitude in time of the exact response to a pulse of unit peak.
    pub(crate) peak: [f64; 6],
    /// Largest difference in time between looked-up and exact response.
    pub(crate) error: [f64; 6],
    /// Estimate of [`Table::error`].
    pub(crate) estimate: [f64; 6],
}

/// Observes `places` random places of `table`, each with `pulses` random pulses of 1 to 100 r0/c1.
///
/// Poisson's ratio is uniform over the table's range, r and z over theirs, the pulse length in its logarithm.
/// The same `seed` gives the same places.
///
/// # Errors
/// [`BuildError`] when the table's settings cannot be read or the exact kernels fail.
pub(crate) fn observe(
    table: &Table,
    places: usize,
    pulses: usize,
    seed: u64,
) -> Result<Vec<Observation>, BuildError> {
    let lengths = |draws: &dyn Fn(u64) -> f64| -> Vec<f64> {
        (0..pulses as u64)
            .map(|k| 100.0_f64.powf(draws(k)))
            .collect()
    };
    at(table, places, 3 + pulses as u64, seed, &lengths)
}

/// [`observe`] with pulses of given lengths in r0/c1.
///
/// # Errors
/// As [`observe`].
pub(crate) fn observe_lengths(
    table: &Table,
    places: usize,
    lengths: &[f64],
    seed: u64,
) -> Result<Vec<Observation>, BuildError> {
    at(table, places, 3, seed, &|_| lengths.to_vec())
}

/// A list of pulse lengths from a source of random numbers.
type Lengths<'a> = &'a (dyn Fn(&dyn Fn(u64) -> f64) -> Vec<f64> + Sync);

fn at(
    table: &Table,
    places: usize,
    stride: u64,
    seed: u64,
    lengths: Lengths<'_>,
) -> Result<Vec<Observation>, BuildError> {
    let grid = Grid::parse(&table.content().origin.grid)?;
    let ratios = table.poisson_ratios();
    let (low, high) = (ratios[0], ratios[ratios.len() - 1]);
    let found: Vec<Vec<Observation>> = (0..places as u64)
        .into_par_iter()
        .map(|i| {
            let draw = |k: u64| uniform(seed, i * stride + k);
            let nu = low + (high - low) * draw(0);
            let (r, z) = (
                draw(1) * table.content().r_max,
                draw(2) * table.content().z_max,
            );
            let exact = exact(table, &grid, nu, r, z)?;
            lengths(&|k| draw(3 + k))
                .into_iter()
                .map(|length| compare(table, &exact, [nu, r, z], length))
                .collect()
        })
        .collect::<Result<_, BuildError>>()?;
    Ok(found.into_iter().flatten().collect())
}

fn exact(table: &Table, grid: &Grid, nu: f64, r: f64, z: f64) -> Result<Series, BuildError> {
    let point = grid.point(nu)?.compute(r, z)?;
    Ok(Series::new(table.cell_width(nu)?, grid.cells()?, point))
}

fn compare(
    table: &Table,
    exact: &Series,
    [nu, r, z]: [f64; 3],
    pulse_length: f64,
) -> Result<Observation, BuildError> {
    let width = table.cell_width(nu)?;
    let count = table.content().slices[0].cells * 2 / 3 + (pulse_length / width) as usize + 1;
    let (mut direct, mut found) = (vec![[0.0; 6]; count], vec![[0.0; 6]; count]);
    exact.fill(Smoothness::Smooth, 0, &mut direct);
    let info = table.trace(Smoothness::Smooth, nu, r, z, 0, &mut found)?;
    for (a, b) in found.iter_mut().zip(&direct) {
        for f in 0..6 {
            a[f] -= b[f];
        }
    }
    let pulse = PulseSum::new(pulse_length, width);
    let most = |responses: &[[f64; 6]]| {
        responses.iter().fold([0.0_f64; 6], |most, six| {
            std::array::from_fn(|f| most[f].max(six[f].abs()))
        })
    };
    Ok(Observation {
        poisson_ratio: nu,
        r,
        z,
        pulse_length,
        peak: most(&pulse.response(&info.static_part, &direct)),
        error: most(&pulse.response(&[0.0; 6], &found)),
        estimate: table.error(nu, r, z, pulse_length)?,
    })
}
