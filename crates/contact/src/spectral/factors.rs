//! Small dense linear systems.

use super::size::LARGEST;

/// The triangular factors of a small dense matrix, rows exchanged.
#[derive(Debug, Clone)]
pub(super) struct Factors {
    size: usize,
    matrix: [f64; LARGEST * LARGEST],
    rows: [usize; LARGEST],
}

impl Factors {
    /// Room for a matrix of `size` rows, filled by the caller.
    pub(super) fn room(size: usize) -> Self {
        Self {
            size,
            matrix: [0.0; LARGEST * LARGEST],
            rows: [0; LARGEST],
        }
    }

    /// A row of the matrix, to be filled before [`Self::eliminate`].
    pub(super) fn row(&mut self, i: usize) -> &mut [f64] {
        &mut self.matrix[i * self.size..(i + 1) * self.size]
    }

    /// Eliminates with row pivoting; false where the matrix is singular.
    pub(super) fn eliminate(&mut self) -> bool {
        let n = self.size;
        let matrix = &mut self.matrix[..n * n];
        for k in 0..n {
            let size = |i: usize| matrix[i * n + k].abs();
            let pivot = (k + 1..n).fold(k, |best, i| if size(i) > size(best) { i } else { best });
            self.rows[k] = pivot;
            if pivot != k {
                for j in 0..n {
                    matrix.swap(k * n + j, pivot * n + j);
                }
            }
            let diagonal = matrix[k * n + k];
            if diagonal == 0.0 || !diagonal.is_finite() {
                return false;
            }
            let (upper, lower) = matrix.split_at_mut((k + 1) * n);
            let top = &upper[k * n + k + 1..];
            for row in lower.chunks_exact_mut(n) {
                let factor = row[k] / diagonal;
                row[k] = factor;
                for (a, b) in row[k + 1..].iter_mut().zip(top) {
                    *a -= factor * b;
                }
            }
        }
        true
    }

    /// Solves for a right side in place.
    pub(super) fn solve(&self, right: &mut [f64]) {
        let n = self.size;
        for k in 0..n {
            right.swap(k, self.rows[k]);
        }
        for k in 0..n {
            let row = &self.matrix[k * n..k * n + k];
            let known: f64 = row.iter().zip(&right[..k]).map(|(a, b)| a * b).sum();
            right[k] -= known;
        }
        for k in (0..n).rev() {
            let row = &self.matrix[k * n + k..(k + 1) * n];
            let known: f64 = row[1..]
                .iter()
                .zip(&right[k + 1..n])
                .map(|(a, b)| a * b)
                .sum();
            right[k] = (right[k] - known) / row[0];
        }
    }
}

/// The inverse of a matrix of n <= `LARGEST` + 1 rows, by Gauss and Jordan.
pub(super) fn inverse(matrix: &[f64], n: usize) -> Vec<f64> {
    let mut left = matrix.to_vec();
    let mut right: Vec<f64> = (0..n * n)
        .map(|i| if i % (n + 1) == 0 { 1.0 } else { 0.0 })
        .collect();
    for k in 0..n {
        let size = |i: usize| left[i * n + k].abs();
        let pivot = (k + 1..n).fold(k, |best, i| if size(i) > size(best) { i } else { best });
        for j in 0..n {
            left.swap(k * n + j, pivot * n + j);
            right.swap(k * n + j, pivot * n + j);
        }
        let diagonal = left[k * n + k];
        for j in 0..n {
            left[k * n + j] /= diagonal;
            right[k * n + j] /= diagonal;
        }
        for i in (0..n).filter(|&i| i != k) {
            let factor = left[i * n + k];
            for j in 0..n {
                left[i * n + j] -= factor * left[k * n + j];
                right[i * n + j] -= factor * right[k * n + j];
            }
        }
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_that_needs_its_rows_exchanged() {
        let matrix = [0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 3.0, 0.0, 1.0];
        let mut factors = Factors::room(3);
        for i in 0..3 {
            factors.row(i).copy_from_slice(&matrix[3 * i..3 * i + 3]);
        }
        assert!(factors.eliminate());
        let mut found = [7.0, 3.0, 6.0];
        factors.solve(&mut found);
        for (x, expected) in found.iter().zip([1.0, 2.0, 3.0]) {
            assert!((x - expected).abs() < 1e-14, "{found:?}");
        }
        let inverse = inverse(&matrix, 3);
        for (i, expected) in [1.0, 2.0, 3.0].iter().enumerate() {
            let row: f64 = inverse[3 * i..3 * i + 3]
                .iter()
                .zip([7.0, 3.0, 6.0])
                .map(|(a, b)| a * b)
                .sum();
            assert!((row - expected).abs() < 1e-14);
        }
        let mut singular = Factors::room(2);
        assert!(!singular.eliminate());
    }
}
