//! Errors between the nodes: exact responses compared with looked-up ones at the centre of every mesh.

use crate::block::{PointKind, Row};
use crate::error::BuildError;
use crate::known::Known;
use crate::rows::TableWork;
use halfspace::{Medium, Profile, Six};
use lookup::{PulseSum, Series, Smoothness, Table, Verification};
use rayon::prelude::*;

/// Smallest number of cells that sample a pulse, if the cells of the table are narrow enough.
const CELLS_OF_PULSE: f64 = 250.0;

/// Measures errors at one Poisson ratio at the places of a kind; a row contains the exact numbers at a radius and all
/// depths.
pub(super) fn verify<'a>(
    table: &Table,
    work: &TableWork<'a>,
    kind: PointKind,
    poisson_ratio: f64,
    rows: &[Row],
) -> Result<Verification, BuildError> {
    let (_, [r, z]) = &work.points[kind as usize];
    let width = table.cell_width(poisson_ratio)?;
    // until the pulse has passed the last arrival at the farthest point, and the smooth remainder is small
    let arrived = table.content().slices[0].cells as f64 * width / 1.5;
    let medium = Medium::new(poisson_ratio)?;
    let parts: Vec<Verification> = rows
        .par_iter()
        .zip(r)
        .map(|(row, &r)| {
            let mut part = Verification::default();
            for (k, &depth) in z.iter().enumerate() {
                let probe_of = |known: &'a Known| known.probe(kind, poisson_ratio, [r, depth]);
                if let Some((measured, entries)) = work.known.and_then(probe_of) {
                    part.extend(measured, entries);
                    continue;
                }
                let exact = exact(width, row, k, z.len());
                let found = table.series(poisson_ratio, r, depth)?;
                let rest = medium.static_field(Profile::Hertz, r, depth)?;
                let coarsening =
                    |length: f64| (length / width / CELLS_OF_PULSE).log2().max(0.0) as u32;
                let lengths = &table.content().pulse_lengths;
                for lengths in lengths.chunk_by(|&a, &b| coarsening(a) == coarsening(b)) {
                    let pulses = (coarsening(lengths[0]), lengths, arrived);
                    probe([&exact, &found], &rest, pulses, &mut part);
                }
            }
            Ok(part)
        })
        .collect::<Result<_, BuildError>>()?;
    let mut whole = Verification::default();
    for part in parts {
        whole.extend(&part, 0..part.error.len());
    }
    Ok(whole)
}

/// Exact series at the depth with index `k` of a row of probes at `depths` depths.
fn exact(width: f64, row: &Row, k: usize, depths: usize) -> Series {
    let numbers = row.each_ref().map(|values| -> Vec<Six> {
        let length = values.len() / (6 * depths);
        let values = &values[k * 6 * length..(k + 1) * 6 * length];
        let six = |i| std::array::from_fn(|f| f64::from(values[f * length + i]));
        (0..length).map(six).collect()
    });
    Series::new(width, numbers[0].len(), numbers)
}

/// Errors for pulses whose cells are 2^`coarsening` cells of the table.
fn probe(
    [exact, found]: [&Series; 2],
    rest: &Six,
    (coarsening, lengths, arrived): (u32, &[f64], f64),
    out: &mut Verification,
) {
    let width = exact.width() * f64::from(1_u32 << coarsening);
    let count = |length: f64| ((arrived + length) / width).ceil() as usize;
    let most = lengths.iter().copied().map(count).max().unwrap_or(0);
    let (mut looked_up, mut direct) = (vec![[0.0; 6]; most], vec![[0.0; 6]; most]);
    found.fill(Smoothness::Smooth, coarsening, &mut looked_up);
    exact.fill(Smoothness::Smooth, coarsening, &mut direct);
    for (a, b) in looked_up.iter_mut().zip(&direct) {
        for f in 0..6 {
            a[f] -= b[f];
        }
    }
    for &length in lengths {
        let (pulse, count) = (PulseSum::new(length, width), count(length));
        let response = pulse.response(rest, &direct[..count]);
        let difference = pulse.response(&[0.0; 6], &looked_up[..count]);
        for f in 0..6 {
            let peak = (0..count)
                .max_by(|&a, &b| response[a][f].abs().total_cmp(&response[b][f].abs()))
                .unwrap_or(0);
            let error = difference
                .iter()
                .fold(0.0_f64, |most, six| most.max(six[f].abs()));
            out.direct.push(response[peak][f] as f32);
            out.looked_up
                .push((response[peak][f] + difference[peak][f]) as f32);
            out.error.push(error as f32);
        }
    }
}
