//! Error estimate of a looked-up response, from errors measured between the nodes of the grid.

use crate::content::{Between, Content, FIELDS, Verification};
use crate::error::LookupError;
use crate::ratio::{self, ratio_coordinate};
use crate::table::Table;
use halfspace::{DomainError, Six};
use std::ops::Range;

/// Factor from the error measured at the centre of a mesh to the estimate for all its points.
///
/// The error of Lagrange interpolation is largest near the centre, but not exactly there; near the edge of the disc and
/// at sharp fronts it varies within a mesh.
pub const SAFETY: f64 = 2.3;

/// Additional factor at the surface and in the upper [`SURFACE_FRACTION`] of the first mesh: all nodes lie on one side
/// there, and the fields are less smooth than at the depth of the centre of the mesh.
const AT_SURFACE: f64 = 3.0;

/// Fraction of the first mesh below the surface that counts as the surface.
const SURFACE_FRACTION: f64 = 0.25;

/// Factor from the error measured midway between two slices to the estimate; these probes are farther apart than the
/// nodes.
pub const SAFETY_BETWEEN: f64 = 2.3;

/// Smallest estimate as a fraction of the peak of a field: the rounding of stored values.
const STORED_ROUNDING: f64 = 6e-8;

/// Grid of places where the errors of one slice, or between two slices, were measured.
pub(crate) struct Measured<'a> {
    content: &'a Content,
    probes: &'a Verification,
    depths: usize,
    /// Factor from the measured error to the estimate.
    factor: f64,
}

impl<'a> Measured<'a> {
    /// Error of the interpolation between slices at `coordinates`: [`SAFETY_BETWEEN`] times the error measured midway
    /// between two of them, in proportion to the node polynomial.
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

    /// Index ranges in r and z of the measured places around a point.
    pub(crate) fn around(&self, [r, z]: [f64; 2]) -> [Range<usize>; 2] {
        [
            corners(&self.content.between_r, r),
            corners(&self.content.between_z, z),
        ]
    }

    /// Estimate for a field and the pulse with index `pulse`, from the largest error among the places `across` and
    /// `down`.
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
    /// On a slice: the largest error measured at the centres of the point's mesh and of its neighbours, times
    /// [`SAFETY`], and
    /// three times as much at the surface. Between slices: the larger estimate of the two neighbouring slices, or
    /// [`SAFETY_BETWEEN`]
    /// times the error measured midway between them, in proportion to the node polynomial, if that is larger.
    ///
    /// The estimate is interpolated in the length of the pulse; for pulses longer or shorter than all measured ones it
    /// is that of the nearest. Units are those of the fields.
    ///
    /// # Errors
    /// [`LookupError`] outside the table, or for a length that is not positive.
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

    /// [`Self::error`] as a function of the length of the pulse.
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

    /// Estimate for one of the measured pulses.
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
                // nothing was measured here: the error is unknown
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
    /// Errors for a pulse of a positive length in r0/c1.
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

    /// Lengths of the measured pulses in r0/c1, with the errors for each.
    pub fn measured(&self) -> impl Iterator<Item = (f64, Six)> {
        self.lengths.iter().copied().zip(self.each.iter().copied())
    }
}

/// Index range of a mesh and its neighbours, of `count` meshes.
fn around(index: usize, count: usize) -> Range<usize> {
    index.saturating_sub(1)..(index + 2).min(count)
}

/// Index range of the places on both sides of `x`; the nearest place if `x` is before the first or after the last.
fn corners(places: &[f64], x: f64) -> Range<usize> {
    let above = places.partition_point(|&place| place < x);
    above.saturating_sub(1)..(above + 1).min(places.len())
}

/// Position of `length` among the measured lengths: index of the length below, and logarithmic weight of the one above.
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
