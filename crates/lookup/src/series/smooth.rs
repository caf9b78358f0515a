//! Cells for a smooth force: averages corrected with the first and second moments of R in each cell.
//!
//! Within a cell the rate of a smooth force is a mean, a slope and a curvature, which follow to fourth order from its
//! means over five cells. The convolution with R needs the average, first and second moment of R, and is exact even if
//! a front crosses the cell. Sorted by the samples of the force, it is the usual sum with corrected cells.
//!
//! Theory: `docs/theory.md` (T24).

use halfspace::Six;

/// Number of cells that determine a slope and a curvature.
const SLOPE_CELLS: usize = 5;

/// Number of moments after the last wanted cell that [`absorb`] needs.
pub const BEYOND: usize = 2;

/// Weights of five cell means for the slope in cell 0, 1 and 2 of the five: the Legendre component of first degree,
/// exact for polynomials of fourth degree.
const SLOPE: [[f64; SLOPE_CELLS]; 3] = parts_of(
    [
        [-245, 462, -336, 146, -27],
        [-27, -110, 192, -66, 11],
        [11, -82, 0, 82, -11],
    ],
    120.0,
);
/// Weights for the curvature, the Legendre component of second degree, see [`SLOPE`].
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

/// Adds the correction for a smooth force to `cells`, from the moments of these and of the next [`BEYOND`] cells.
pub fn absorb(cells: &mut [Six], moments: &[Six], curvatures: &[Six]) {
    for (j, (moment, curvature)) in moments.iter().zip(curvatures).enumerate() {
        // cell j uses the force in the five cells around it; the first cells use one-sided ones, since the force after
        // the time of the response is not known
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

/// The slope and half the curvature of the force that [`absorb`] assumes in the cell with index `cell`, which may be
/// one of the two before the first.
///
/// `own` is the position of the cell among its five cells: 2, or 1 or 0 for the last two before the time of the
/// response.
/// Both are in rises per cell, and s grows into the past: the rate over the cell is rise + slope s + half curvature
/// (s^2 - 1/12).
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
