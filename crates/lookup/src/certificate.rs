//! The error estimate of a looked-up response, from errors measured off the grid.

use crate::content::{Between, Content, FIELDS, Verification};
use crate::error::LookupError;
use crate::ratio::{self, ratio_coordinate};
use crate::table::Table;
use halfspace::{DomainError, Six};
use std::ops::Range;

/// Factor from the error measured at the centre of a mesh to the estimate for every point of it.
///
/// The Lagrange error is largest near the centre, but not exactly there, and near the disc edge and where
/// sharp fronts pass it varies within a mesh.
pub const SAFETY: f64 = 2.3;

/// Further factor on the surface and just below it, [`SURFACE_FRACTION`] of the first mesh: there the nodes are all on one side,
/// and what the depth smooths at the centre of a mesh is not smoothed.
const AT_SURFACE: f64 = 3.0;

/// Fraction of the first mesh below the surface that counts as the surface.
const SURFACE_FRACTION: f64 = 0.25;

/// Factor from the error measured in the middle between two slices, at places farther apart than the nodes.
pub const SAFETY_BETWEEN: f64 = 2.3;

/// Estimates never go below this fraction of the peak of a field: the rounding of stored values.
const STORED_ROUNDING: f64 = 6e-8;

/// Where errors were measured: a grid of places for one set of numbers.
pub(crate) struct Measured<'a> {
    content: &'a Content,
    probes: &'a Verification,
    depths: usize,
    /// From what was measured to the estimate.
    factor: f64,
}

impl<'a> Measured<'a> {
    /// What interpolation between slices at `coordinates` adds to the error, from what was measured in the middle between two
    /// of them: [`SAFETY_BETWEEN`] times that, in proportion to the node polynomial.
    pub(crate) fn between(
        content: &'a Content,
        between: &'a Between,
        coordinates: impl Iterator<Item = f64>,
        poisson_ratio: f64,
    ) -> Result<Self, DomainError> {
        let place = ratio_coordinate(poisson_ratio)?;
        let middle = ratio_coordinate(between.poisson_ratio)?;
        let polynomial: f64 = coordinates
            .map(|node| (place - node) / (middle - node))
            .product();
        Ok(Self {
            content,
            probes: &between.verification,
            depths: content.between_z.len(),
            factor: SAFETY_BETWEEN * polynomial.abs(),
        })
    }

    /// The places between slices around a point.
    pub(crate) fn around(&self, [r, z]: [f64; 2]) -> [Range<usize>; 2] {
        [
            corners(&self.content.between_r, r),
            corners(&self.content.between_z, z),
        ]
    }

    /// The estimate of a field from the largest error among the places `across` by `down`, for the pulse of index `pulse`.
    pub(crate) fn most(
        &self,
        [across, down]: &[Range<usize>; 2],
        pulse: usize,
        field: usize,
    ) -> f64 {
        let mut most = 0.0_f64;
        for i in across.clone() {
            for k in down.clone() {
                most = most.max(f64::from(self.probes.error[self.at(i, k, pulse, field)]));
            }
        }
        self.factor * most
    }

    fn peak(&self, i: usize, k: usize, pulse: usize, field: usize) -> f64 {
        f64::from(self.probes.direct[self.at(i, k, pulse, field)]).abs()
    }

    fn at(&self, i: usize, k: usize, pulse: usize, field: usize) -> usize {
        ((i * self.depths + k) * self.content.pulse_lengths.len() + pulse) * FIELDS + field
    }
}

impl Table {
    /// Estimated absolute error of each field, for a force of unit peak and length `pulse_length`.
    ///
    /// The largest of the errors measured at the centres of the mesh that holds the point and of its
    /// neighbours, times [`SAFETY`], three times that at the surface; between slices the larger of the two beside and, times
    /// [`SAFETY_BETWEEN`], what was measured in the middle between them, in proportion to the node
    /// polynomial. Interpolated in the length of the pulse; pulses longer or shorter than any measured take
    /// the value of the nearest one. Units as the fields.
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
        Ok(self.errors(poisson_ratio, r, z)?.under(pulse_length))
    }

    /// [`Self::error`] for pulses of any length.
    ///
    /// # Errors
    /// [`LookupError`] outside the table.
    pub fn errors(
        &self,
        poisson_ratio: f64,
        r: f64,
        z: f64,
    ) -> Result<PulseErrors<'_>, LookupError> {
        let lengths = &self.content().pulse_lengths;
        let mesh = self.mesh([r, z])?;
        let slices = ratio::weights(&self.served, poisson_ratio)?;
        let of = |pulse| self.measured(poisson_ratio, [r, z], mesh, &slices, pulse);
        let each = (0..lengths.len()).map(of).collect::<Result<_, _>>()?;
        Ok(PulseErrors { lengths, each })
    }

    /// The estimate for one of the pulses that were measured.
    fn measured(
        &self,
        poisson_ratio: f64,
        point: [f64; 2],
        mesh: [usize; 2],
        slices: &[(usize, f64)],
        pulse: usize,
    ) -> Result<Six, LookupError> {
        let content = self.content();
        let mut error = [1e-12_f64; FIELDS];
        let [columns, rows] = self.meshes;
        let places = [around(mesh[0], columns), around(mesh[1], rows)];
        let beside = ratio::beside(&self.served, slices, poisson_ratio);
        for &index in &beside[usize::from(beside[0] == beside[1])..] {
            let measured = Measured {
                content,
                probes: &content.slices[index].verification,
                depths: rows,
                factor: SAFETY,
            };
            for (field, value) in error.iter_mut().enumerate() {
                let most = measured.most(&places, pulse, field);
                let rounding = STORED_ROUNDING * measured.peak(mesh[0], mesh[1], pulse, field);
                *value = value.max(most).max(rounding);
            }
        }
        if slices.len() > 1 {
            let Some(between) = ratio::between(content, &self.served, poisson_ratio) else {
                // Nothing was measured here, so nothing is known.
                return Ok([f64::INFINITY; FIELDS]);
            };
            let coordinates = slices.iter().map(|&(i, _)| self.served[i].coordinate);
            let added = Measured::between(content, between, coordinates, poisson_ratio)?;
            let places = added.around(point);
            for (field, value) in error.iter_mut().enumerate() {
                *value += added.most(&places, pulse, field);
            }
        }
        if point[1] < SURFACE_FRACTION * content.z[1] {
            error = error.map(|e| AT_SURFACE * e);
        }
        Ok(error)
    }
}

/// Estimated absolute errors of the fields at a point, for forces of unit peak.
#[derive(Debug, Clone)]
pub struct PulseErrors<'a> {
    lengths: &'a [f64],
    each: Vec<Six>,
}

impl PulseErrors<'_> {
    /// Those for a pulse of some length in r0/c1, which is positive.
    pub fn under(&self, pulse_length: f64) -> Six {
        let (lower, fraction) = bracket(self.lengths, pulse_length);
        let (short, long) = (
            &self.each[lower],
            &self.each[(lower + 1).min(self.each.len() - 1)],
        );
        if fraction == 0.0 {
            return *short;
        }
        std::array::from_fn(|f| short[f].powf(1.0 - fraction) * long[f].powf(fraction))
    }

    /// Lengths of the pulses that were measured, in r0/c1, with the errors for each.
    pub fn measured(&self) -> impl Iterator<Item = (f64, Six)> {
        self.lengths.iter().copied().zip(self.each.iter().copied())
    }
}

/// A mesh and its neighbours, of `count` meshes.
fn around(index: usize, count: usize) -> Range<usize> {
    index.saturating_sub(1)..(index + 2).min(count)
}

/// The places on both sides of `x`; the nearest one beyond the first or last.
fn corners(places: &[f64], x: f64) -> Range<usize> {
    let above = places.partition_point(|&place| place < x);
    above.saturating_sub(1)..(above + 1).min(places.len())
}

/// Position of `length` among the measured lengths: index below and weight of the one above, in logarithms.
fn bracket(lengths: &[f64], length: f64) -> (usize, f64) {
    let last = lengths.len() - 1;
    if length <= lengths[0] {
        return (0, 0.0);
    }
    if length >= lengths[last] {
        return (last, 0.0);
    }
    let lower = lengths.partition_point(|&x| x <= length) - 1;
    let whole = (lengths[lower + 1] / lengths[lower]).ln();
    (lower, (length / lengths[lower]).ln() / whole)
}
