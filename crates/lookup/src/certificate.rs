//! The error estimate of a looked-up response, from errors measured off the grid.

use crate::content::FIELDS;
use crate::error::LookupError;
use crate::stencil::locate;
use crate::table::Table;
use halfspace::Six;

/// Factor from the error measured at the centre of a mesh to the estimate for every point of it.
///
/// The Lagrange error is largest near the centre, but not exactly there, and near the disc edge and where
/// sharp fronts pass it varies within a mesh.
pub const SAFETY: f64 = 3.5;

/// Estimates never go below this share of the peak of a field: the rounding of stored values.
const ROUNDING: f64 = 6e-8;

impl Table {
    /// Estimated absolute error of each field, for a force of unit peak and length `pulse_length`.
    ///
    /// The largest of the errors measured at the centres of the mesh that holds the point and of its
    /// neighbours, times [`SAFETY`], interpolated in the length of the pulse; pulses longer or shorter than any measured take the
    /// value of the nearest one. Units as the fields.
    ///
    /// # Errors
    /// [`LookupError`] outside the table or for a length that is not positive.
    pub fn error(
        &self,
        poisson_ratio: f64,
        r: f64,
        z: f64,
        pulse_length: f64,
    ) -> Result<Six, LookupError> {
        if pulse_length.is_nan() || pulse_length <= 0.0 {
            return Err(LookupError::PulseLength {
                value: pulse_length,
            });
        }
        let content = self.content();
        let mesh = locate(&content.r, r).zip(locate(&content.z, z));
        let (i, j) = mesh.ok_or_else(|| self.outside(r, z))?;
        let (lower, share) = bracket(&content.pulse_lengths, pulse_length);
        let mut error = [0.0; FIELDS];
        for (index, weight) in self.slice_weights(poisson_ratio)? {
            let probes = &content.slices[index].verification;
            let (across, down) = (
                around(i, content.r.len() - 1),
                around(j, content.z.len() - 1),
            );
            let at = |i: usize, j: usize, pulse: usize, field: usize| {
                ((i * (content.z.len() - 1) + j) * content.pulse_lengths.len() + pulse) * FIELDS
                    + field
            };
            for (field, sum) in error.iter_mut().enumerate() {
                let measured = |pulse: usize| {
                    let mut most = 0.0_f64;
                    for k in across.clone() {
                        for l in down.clone() {
                            most = most.max(f64::from(probes.error[at(k, l, pulse, field)]));
                        }
                    }
                    let floor = ROUNDING * f64::from(probes.direct[at(i, j, pulse, field)]).abs();
                    (SAFETY * most).max(floor).max(1e-12)
                };
                let (short, long) = (
                    measured(lower),
                    measured((lower + 1).min(content.pulse_lengths.len() - 1)),
                );
                *sum += weight.abs() * short.powf(1.0 - share) * long.powf(share);
            }
        }
        Ok(error)
    }
}

/// A mesh and its neighbours, of `count` meshes.
fn around(index: usize, count: usize) -> std::ops::Range<usize> {
    index.saturating_sub(1)..(index + 2).min(count)
}

/// Position of `length` among the measured lengths: index below and share of the one above, in logarithms.
fn bracket(lengths: &[f64], length: f64) -> (usize, f64) {
    let last = lengths.len() - 1;
    if length <= lengths[0] {
        return (0, 0.0);
    }
    if length >= lengths[last] {
        return (last, 0.0);
    }
    let lower = lengths.partition_point(|&x| x <= length) - 1;
    (
        lower,
        (length / lengths[lower]).ln() / (lengths[lower + 1] / lengths[lower]).ln(),
    )
}
