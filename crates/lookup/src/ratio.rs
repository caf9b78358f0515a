//! Interpolation across Poisson's ratio.

use crate::content::{Between, Content, Role};
use crate::error::LookupError;
use crate::series::stencil::{Stencil, locate};
use halfspace::{DomainError, Medium};
use std::sync::LazyLock;

/// Number of slices that take part.
const SLICES_USED: usize = 8;
/// Largest difference of two ratios that count as the same slice.
const SAME_RATIO: f64 = 1e-12;
/// Poisson's ratio at which the time cells have the width stated in a table.
const REFERENCE: f64 = 0.3;

/// Width of a time cell of a slice over that at nu = 0.3: c_R(0.3)/c_R(nu).
///
/// At a fixed place the Rayleigh wave then arrives in the same cell for every ratio, and the shear wave nearly so:
/// fronts do not move between slices, and interpolation between them is accurate.
///
/// # Errors
/// [`DomainError`] for a ratio outside (-1, 0.5).
pub fn cell_scale(poisson_ratio: f64) -> Result<f64, DomainError> {
    scale(&Medium::new(poisson_ratio)?)
}

/// [`cell_scale`] for a half-space.
pub(crate) fn scale(medium: &Medium) -> Result<f64, DomainError> {
    static MEDIUM: LazyLock<Result<Medium, DomainError>> = LazyLock::new(|| Medium::new(REFERENCE));
    Ok(MEDIUM.as_ref().map_err(Clone::clone)?.rayleigh_speed() / medium.rayleigh_speed())
}

/// Coordinate of the interpolation between slices: nu/5 - c_R/c1, ascending in nu.
///
/// 99th percentile of the error over the peak in time, measured midway between 9 slices over nu = 0 .. 0.45, for pulses
/// of 40 r0/c1 at ten places to 5.5 r0 (`tabulator`, example `ratios`): 5e-5 with this coordinate; 4e-4 with c1/c_R +
/// nu; 2e-4 with nu; 2e-3 if the cells of all slices have the same width in r0/c1.
///
/// # Errors
/// [`DomainError`] for a ratio outside (-1, 0.5).
pub fn ratio_coordinate(poisson_ratio: f64) -> Result<f64, DomainError> {
    Ok(0.2 * poisson_ratio - Medium::new(poisson_ratio)?.rayleigh_speed())
}

/// Poisson's ratio and role of a slice.
#[derive(Debug, Clone)]
pub(crate) struct Served {
    pub(crate) ratio: f64,
    pub(crate) medium: Medium,
    pub(crate) role: Role,
    /// [`ratio_coordinate`] of the ratio.
    pub(crate) coordinate: f64,
}

impl Served {
    pub(crate) fn new(ratio: f64, role: Role) -> Result<Self, DomainError> {
        Ok(Self {
            ratio,
            medium: Medium::new(ratio)?,
            role,
            coordinate: ratio_coordinate(ratio)?,
        })
    }
}

/// Indices of the slices for a Poisson ratio with their weights: a single slice if the ratio is tabulated, otherwise
/// the slices of a Lagrange interpolation.
///
/// # Errors
/// [`LookupError::Outside`] outside the range of the interpolated slices, and for NaN.
pub(crate) fn weights(
    slices: &[Served],
    poisson_ratio: f64,
) -> Result<Vec<(usize, f64)>, LookupError> {
    let same = |slice: &Served| (slice.ratio - poisson_ratio).abs() < SAME_RATIO;
    if let Some(index) = slices.iter().position(same) {
        return Ok(vec![(index, 1.0)]);
    }
    let grid: Vec<usize> = (0..slices.len())
        .filter(|&i| slices[i].role == Role::Grid)
        .collect();
    let end = |index: Option<&usize>| index.map_or(f64::NAN, |&i| slices[i].ratio);
    let [min, max] = [grid.first(), grid.last()].map(end);
    let coordinates: Vec<f64> = grid.iter().map(|&i| slices[i].coordinate).collect();
    if !(poisson_ratio > min && poisson_ratio < max) {
        let range = [min, max];
        return Err(LookupError::outside("poisson_ratio", poisson_ratio, range));
    }
    // rounding of the coordinate must not move the point outside
    let place =
        ratio_coordinate(poisson_ratio)?.clamp(coordinates[0], coordinates[coordinates.len() - 1]);
    let interval = locate(&coordinates, place).unwrap_or(0);
    let stencil = Stencil::one_sided(&coordinates, interval, place, SLICES_USED);
    let nodes = stencil.nodes().iter().map(|&node| grid[node]);
    Ok(nodes.zip(stencil.even().iter().copied()).collect())
}

/// The nearest slices below and above a ratio, of those that have weights for it; twice the same if the ratio is
/// tabulated.
pub(crate) fn beside(
    slices: &[Served],
    weights: &[(usize, f64)],
    poisson_ratio: f64,
) -> [usize; 2] {
    let above = weights.partition_point(|&(index, _)| slices[index].ratio <= poisson_ratio);
    let index = |place: usize| weights[place.min(weights.len() - 1)].0;
    [index(above.saturating_sub(1)), index(above)]
}

/// Errors measured between the two slices around a ratio.
pub(crate) fn between<'a>(
    content: &'a Content,
    slices: &[Served],
    poisson_ratio: f64,
) -> Option<&'a Between> {
    // the neighbouring interpolated slices: below or equal, and above
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for slice in slices.iter().filter(|slice| slice.role == Role::Grid) {
        if slice.ratio <= poisson_ratio {
            low = low.max(slice.ratio);
        } else {
            high = high.min(slice.ratio);
        }
    }
    let inside = |between: &&Between| between.poisson_ratio > low && between.poisson_ratio < high;
    content.between.iter().find(inside)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_coordinate_ascends_over_all_ratios() {
        let places: Vec<f64> = (0..1000)
            .map(|i| ratio_coordinate(-0.999 + 1.498 * f64::from(i) / 999.0).unwrap())
            .collect();
        assert!(places.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn the_reference_has_the_stated_width() {
        assert_eq!(cell_scale(REFERENCE).unwrap(), 1.0);
        assert!(cell_scale(0.45).unwrap() > 1.5);
    }
}
