//! Small dense systems of linear equations.

/// Scalar product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The triangular factors of a dense matrix of at most N rows, rows exchanged.
#[derive(Debug, Clone)]
pub(crate) struct Factors<const N: usize> {
    size: usize,
    matrix: [[f64; N]; N],
    rows: [usize; N],
}

impl<const N: usize> Factors<N> {
    /// Room for a matrix of `size` rows, filled by the caller.
    pub(crate) fn room(size: usize) -> Self {
        Self {
            size,
            matrix: [[0.0; N]; N],
            rows: [0; N],
        }
    }

    /// A row of the matrix, to be filled before [`Self::eliminate`].
    pub(crate) fn row(&mut self, i: usize) -> &mut [f64] {
        &mut self.matrix[i][..self.size]
    }

    /// Eliminates with row pivoting; false where the matrix is singular.
    pub(crate) fn eliminate(&mut self) -> bool {
        let n = self.size;
        let matrix = &mut self.matrix[..n];
        for k in 0..n {
            let size = |i: usize| matrix[i][k].abs();
            let pivot = (k + 1..n).fold(k, |best, i| if size(i) > size(best) { i } else { best });
            self.rows[k] = pivot;
            matrix.swap(k, pivot);
            let (upper, lower) = matrix.split_at_mut(k + 1);
            let (diagonal, top) = (upper[k][k], &upper[k][k + 1..n]);
            if diagonal == 0.0 || !diagonal.is_finite() {
                return false;
            }
            for row in lower {
                let factor = row[k] / diagonal;
                row[k] = factor;
                for (a, b) in row[k + 1..n].iter_mut().zip(top) {
                    *a -= factor * b;
                }
            }
        }
        true
    }

    /// Solves for a right side in place.
    pub(crate) fn solve(&self, right: &mut [f64]) {
        let n = self.size;
        for k in 0..n {
            right.swap(k, self.rows[k]);
        }
        for k in 0..n {
            right[k] -= dot(&self.matrix[k][..k], &right[..k]);
        }
        for k in (0..n).rev() {
            let row = &self.matrix[k];
            right[k] = (right[k] - dot(&row[k + 1..n], &right[k + 1..n])) / row[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_that_needs_its_rows_exchanged() {
        let matrix = [0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 3.0, 0.0, 1.0];
        let mut factors = Factors::<3>::room(3);
        for i in 0..3 {
            factors.row(i).copy_from_slice(&matrix[3 * i..3 * i + 3]);
        }
        assert!(factors.eliminate());
        let mut found = [7.0, 3.0, 6.0];
        factors.solve(&mut found);
        for (x, expected) in found.iter().zip([1.0, 2.0, 3.0]) {
            assert!((x - expected).abs() < 1e-14, "{found:?}");
        }
        let mut singular = Factors::<3>::room(2);
        assert!(!singular.eliminate());
    }
}
