//! Cells for a smooth force: averages corrected with the first and second moments of R in each cell.
//!
//! Within a cell the rate of a smooth force is a mean, a slope and a curvature, which follow from its means
//! over five cells to fourth order. Against them R counts with its average, first and second moment,
//! exactly, also where a front crosses the cell. Collected by the samples of the force, this is the same
//! sum with other cells.
//!
//! Theory: `docs/theory.md` (T24).

use halfspace::Six;

/// Cells that a slope and a curvature are taken from.
const REACH: usize = 5;

/// Moments beyond the last cell wanted that the correction needs.
pub(crate) const BEYOND: usize = 2;

/// Weights of five cell means for the slope and the curvature in cell 0, 1 and 2 of the five: exact for
/// polynomials of fourth degree, of which they take the Legendre components of first and second degree.
const SLOPE: [[f64; REACH]; 3] = [
    [
        -49.0 / 24.0,
        77.0 / 20.0,
        -14.0 / 5.0,
        73.0 / 60.0,
        -9.0 / 40.0,
    ],
    [
        -9.0 / 40.0,
        -11.0 / 12.0,
        8.0 / 5.0,
        -11.0 / 20.0,
        11.0 / 120.0,
    ],
    [11.0 / 120.0, -41.0 / 60.0, 0.0, 41.0 / 60.0, -11.0 / 120.0],
];
/// See [`SLOPE`].
const CURVATURE: [[f64; REACH]; 3] = [
    [
        81.0 / 28.0,
        -60.0 / 7.0,
        131.0 / 14.0,
        -32.0 / 7.0,
        25.0 / 28.0,
    ],
    [25.0 / 28.0, -11.0 / 7.0, 5.0 / 14.0, 3.0 / 7.0, -3.0 / 28.0],
    [
        -3.0 / 28.0,
        10.0 / 7.0,
        -37.0 / 14.0,
        10.0 / 7.0,
        -3.0 / 28.0,
    ],
];

/// Adds to `cells` what the moments of [`BEYOND`] cells more than those are worth.
pub(crate) fn correct(cells: &mut [Six], moments: &[Six], curvatures: &[Six]) {
    for (j, (moment, curvature)) in moments.iter().zip(curvatures).enumerate() {
        // Cell j sees the force through the five cells around it, the first of all one-sided: the force
        // after the instant of the response is not known.
        let first = j.saturating_sub(2);
        let own = j - first;
        for i in 0..REACH {
            let Some(cell) = cells.get_mut(first + i) else {
                break;
            };
            let (slope, bend) = (SLOPE[own][i], 0.5 * CURVATURE[own][i]);
            for f in 0..6 {
                cell[f] += slope * moment[f] + bend * curvature[f];
            }
        }
    }
}

/// The third-order correction of averages that have first moments alone; `moments` has one more entry than `cells`.
///
/// ```text
/// cell_j = Rbar_j - (M_{j+1} - M_{j-1})/2,   cell_0 = Rbar_0 - M_0 - M_1/2,   cell_1 = Rbar_1 + M_0 - M_2/2
/// ```
pub fn correct_for_curvature(cells: &mut [Six], moments: &[Six]) {
    for f in 0..6 {
        for (j, cell) in cells.iter_mut().enumerate() {
            let before = if j == 0 {
                2.0 * moments[0][f]
            } else {
                moments[j - 1][f]
            };
            let sign = if j == 0 { -1.0 } else { 1.0 };
            cell[f] -= 0.5 * (moments[j + 1][f] - sign * before);
            if j == 1 {
                cell[f] += 0.5 * moments[0][f];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean of s^power over [i - 1/2, i + 1/2].
    fn mean(power: i32, i: f64) -> f64 {
        ((i + 0.5).powi(power + 1) - (i - 0.5).powi(power + 1)) / f64::from(power + 1)
    }

    #[test]
    fn slopes_and_curvatures_are_the_legendre_components_of_polynomials() {
        for own in 0..3 {
            for power in 0..5 {
                let sum = |weights: &[f64; REACH]| -> f64 {
                    weights
                        .iter()
                        .enumerate()
                        .map(|(i, w)| w * mean(power, i as f64 - own as f64))
                        .sum()
                };
                // 12 int s^n s ds and 360 int s^n (s^2 - 1/12)/2 ds over the cell
                let slope = [0.0, 1.0, 0.0, 0.15, 0.0][power as usize];
                let bend = [0.0, 0.0, 2.0, 0.0, 3.0 / 7.0][power as usize];
                assert!((sum(&SLOPE[own]) - slope).abs() < 1e-12, "{own} {power}");
                assert!((sum(&CURVATURE[own]) - bend).abs() < 1e-12, "{own} {power}");
            }
        }
    }
}
