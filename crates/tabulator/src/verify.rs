//! Errors measured off the grid: exact against looked-up responses at the centre of every mesh.

use crate::blocks::Row;
use crate::error::BuildError;
use lookup::{Content, PulseSum, Series, Smoothness, Table, Verification};
use rayon::prelude::*;

/// Lengths of the verification pulses in r0/c1.
pub const PULSE_LENGTHS: [f64; 6] = [1.0, 3.0, 10.0, 25.0, 50.0, 100.0];
/// A pulse is sampled by at least this many cells where the table has them.
const SAMPLES: f64 = 500.0;

/// Measures the errors of one slice: `rows[i]` holds the exact numbers of the probes between nodes i and i + 1.
pub(crate) fn verify(
    table: &Table,
    slice: usize,
    rows: &[Row],
) -> Result<Verification, BuildError> {
    let content = table.content();
    let parts: Vec<Verification> = rows
        .par_iter()
        .enumerate()
        .map(|(i, row)| {
            let mut part = Verification::default();
            for k in 0..content.z.len() - 1 {
                let r = 0.5 * (content.r[i] + content.r[i + 1]);
                let z = 0.5 * (content.z[k] + content.z[k + 1]);
                let exact = exact(content, slice, row, k);
                for &length in &content.pulse_lengths {
                    probe(table, slice, [r, z], length, &exact, &mut part)?;
                }
            }
            Ok(part)
        })
        .collect::<Result<_, BuildError>>()?;
    let mut whole = Verification::default();
    for part in parts {
        whole.direct.extend(part.direct);
        whole.looked_up.extend(part.looked_up);
        whole.error.extend(part.error);
    }
    Ok(whole)
}

/// Errors relative to the peak over all probes, sorted, for one pulse length; probes where the field
/// stays below `least` of its largest peak over all probes are left out.
pub(crate) fn relative_errors(
    content: &Content,
    pulse: usize,
    field: usize,
    least: f64,
) -> Vec<f64> {
    let mut ratios = Vec::new();
    for slice in &content.slices {
        let probes = &slice.verification;
        let picked =
            (pulse * 6 + field..probes.direct.len()).step_by(6 * content.pulse_lengths.len());
        let largest = picked
            .clone()
            .fold(0.0_f32, |a, i| a.max(probes.direct[i].abs()));
        for i in picked {
            let peak = f64::from(probes.direct[i].abs());
            if peak > least * f64::from(largest) {
                ratios.push(f64::from(probes.error[i]) / peak);
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    ratios
}

/// The `share` quantile of sorted values; zero for none.
#[must_use]
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let last = sorted.len().saturating_sub(1) as f64;
    sorted
        .get((share * last).round() as usize)
        .copied()
        .unwrap_or(0.0)
}

/// Exact series of depth `k` of a row of probes.
fn exact(content: &Content, slice: usize, row: &Row, k: usize) -> Series {
    let slice = &content.slices[slice];
    let terms = slice.tail_terms(content.r.len() * content.z.len());
    let part = |values: &[f32], length: usize| -> Vec<f64> {
        values[k * 6 * length..(k + 1) * 6 * length]
            .iter()
            .map(|&x| f64::from(x))
            .collect()
    };
    let averages = part(&row.remainder, slice.cells);
    let moments = part(&row.moment, slice.cells);
    Series::new(
        content.cell_width,
        slice.cells,
        averages,
        moments,
        &part(&row.tail, terms),
    )
}

fn probe(
    table: &Table,
    slice: usize,
    [r, z]: [f64; 2],
    length: f64,
    exact: &Series,
    out: &mut Verification,
) -> Result<(), BuildError> {
    let content = table.content();
    let samples = length / content.cell_width;
    let coarsening = (samples / SAMPLES).log2().max(0.0) as u32;
    let width = content.cell_width * f64::from(1_u32 << coarsening);
    // Until the pulse has passed the last arrival at the farthest point, and the smooth rest is small.
    let arrived = content.slices[slice].time_end(content.cell_width) / 1.5;
    let count = ((arrived + length) / width).ceil() as usize;
    let mut looked_up = vec![[0.0; 6]; count];
    let nu = table.poisson_ratios()[slice];
    let info = table.trace_for(Smoothness::Smooth, nu, r, z, coarsening, &mut looked_up)?;
    let mut direct = vec![[0.0; 6]; count];
    exact.fill(Smoothness::Smooth, coarsening, &mut direct);
    for (a, b) in looked_up.iter_mut().zip(&direct) {
        for f in 0..6 {
            a[f] -= b[f];
        }
    }
    let pulse = PulseSum::new(length, width);
    let response = pulse.response(&info.static_part, &direct);
    let difference = pulse.response(&[0.0; 6], &looked_up);
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
    Ok(())
}
