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
const SLOPE_CELLS: usize = 5;

/// Moments beyond the last cell wanted that [`absorb`] needs.
pub const BEYOND: usize = 2;

/// Weights of five cell means for the slope and the curvature in cell 0, 1 and 2 of the five: exact for
/// polynomials of fourth degree, of which they take the Legendre components of first and second degree.
const SLOPE: [[f64; SLOPE_CELLS]; 3] = parts_of(
    [
        [-245, 462, -336, 146, -27],
        [-27, -110, 192, -66, 11],
        [11, -82, 0, 82, -11],
    ],
    120.0,
);
/// See [`SLOPE`].
const CURVATURE: [[f64; SLOPE_CELLS]; 3] = parts_of(
    [
        [81, -240, 262, -128, 25],
        [25, -44, 10, 12, -3],
        [-3, 40, -74, 40, -3],
    ],
    28.0,
);

const fn parts_of(rows: [[i32; SLOPE_CELLS]; 3], whole: f64) -> [[f64; SLOPE_CELLS]; 3] {
    let (mut parts, mut i) = ([[0.0; SLOPE_CELLS]; 3], 0);
    while i < 3 * SLOPE_CELLS {
        parts[i / SLOPE_CELLS][i % SLOPE_CELLS] =
            rows[i / SLOPE_CELLS][i % SLOPE_CELLS] as f64 / whole;
        i += 1;
    }
    parts
}

/// Adds to `cells` what the moments of [`BEYOND`] cells more than those are worth under a smooth force.
pub fn absorb(cells: &mut [Six], moments: &[Six], curvatures: &[Six]) {
    for (j, (moment, curvature)) in moments.iter().zip(curvatures).enumerate() {
        // Cell j sees the force through the five cells around it, the first of all one-sided: the force
        // after the instant of the response is not known.
        let first = j.saturating_sub(2);
        let own = j - first;
        for i in 0..SLOPE_CELLS {
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

/// The slope and half the curvature that [`absorb`] takes a force to have in the cell of its rise `cell`, which may be one
/// of the two before the first.
///
/// `own` is which of its five cells that cell is: 2, and 1 or 0 for the last two before the instant of the response.
/// In rises a cell, with s growing into the past: the rate over the cell is rise + slope s + half curvature (s^2 - 1/12).
pub fn absorbed(rises: &[f64], cell: isize, own: usize) -> [f64; 2] {
    let (mut slope, mut bend) = (0.0, 0.0);
    for i in 0..SLOPE_CELLS {
        let place = usize::try_from(cell + own as isize - i as isize).ok();
        let rise = place.and_then(|m| rises.get(m)).copied().unwrap_or(0.0);
        slope += SLOPE[own][i] * rise;
        bend += 0.5 * CURVATURE[own][i] * rise;
    }
    [slope, bend]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean of s^power over [i - 1/2, i + 1/2].
    fn mean(power: i32, i: f64) -> f64 {
        ((i + 0.5).powi(power + 1) - (i - 0.5).powi(power + 1)) / f64::from(power + 1)
    }

    #[test]
    fn what_is_absorbed_is_what_the_cells_were_given() {
        let rises = [0.3, -1.0, 0.7, 2.0, 0.1, -0.4, 0.9];
        let cells = 12;
        let curve = |seed: f64| -> Vec<Six> {
            (0..cells + BEYOND)
                .map(|j| std::array::from_fn(|f| (seed * (j * 6 + f) as f64).sin()))
                .collect()
        };
        let (moments, curvatures) = (curve(1.3), curve(0.7));
        let mut given = vec![[0.0; 6]; cells];
        absorb(&mut given, &moments, &curvatures);
        for n in 0..cells {
            let mut sums = [0.0; 2];
            for (m, rise) in rises.iter().enumerate().take(n + 1) {
                sums[0] += rise * given[n - m][4];
            }
            for j in 0..n + 3 {
                let cell = n as isize - j as isize;
                let [slope, bend] = absorbed(&rises, cell, j.min(2));
                sums[1] += slope * moments[j][4] + bend * curvatures[j][4];
            }
            assert!((sums[0] - sums[1]).abs() < 1e-12, "{n}: {sums:?}");
        }
    }

    #[test]
    fn slopes_and_curvatures_are_the_legendre_components_of_polynomials() {
        for own in 0..3 {
            for power in 0..5 {
                let sum = |weights: &[f64; SLOPE_CELLS]| -> f64 {
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
