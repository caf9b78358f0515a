//! Least squares with non-negative unknowns: an active set on the normal equations.
//!
//! ```text
//! minimise x^T A x/2 - b^T x,   x >= 0,   A symmetric and positive definite
//! ```
//!
//! Lawson and Hanson's algorithm (Solving Least Squares Problems, 1974, chapter 23) with a Cholesky factor that is updated
//! when an unknown becomes free or is pinned at zero, so that a step costs the square of the free unknowns.
//! A start close to the solution, such as that of another regularisation, saves most of the steps.

/// A symmetric matrix with all its entries.
#[derive(Debug, Clone, PartialEq)]
pub struct Symmetric {
    rows: Vec<Vec<f64>>,
}

impl Symmetric {
    /// The matrix with these entries, of which only those with i >= j are asked for.
    pub fn from_fn(size: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let lower = (0..size).map(|i| (0..=i).map(|j| entry(i, j)).collect());
        let lower: Vec<Vec<f64>> = lower.collect();
        let row = |i: usize| (0..size).map(|j| lower[i.max(j)][i.min(j)]).collect();
        Self {
            rows: (0..size).map(row).collect(),
        }
    }

    /// Rows of the matrix.
    pub fn size(&self) -> usize {
        self.rows.len()
    }

    /// One row.
    pub fn row(&self, i: usize) -> &[f64] {
        &self.rows[i]
    }

    /// Adds a multiple of another matrix of the same size.
    pub(crate) fn add(&mut self, factor: f64, other: &Self) {
        let entries = self.rows.iter_mut().flatten();
        let pairs = entries.zip(other.rows.iter().flatten());
        pairs.for_each(|(a, b)| *a += factor * b);
    }

    /// The product with a vector.
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|row| dot(row, x)).collect()
    }
}

/// Scalar product in eight sums, which the compiler keeps in registers.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a8, a_rest), (b8, b_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let mut sums = [0.0; 8];
    for (x, y) in a8.iter().zip(b8) {
        (0..8).for_each(|i| sums[i] += x[i] * y[i]);
    }
    let rest = a_rest.iter().zip(b_rest).map(|(x, y)| x * y);
    sums.iter().sum::<f64>() + rest.sum::<f64>()
}

/// Pivot of a factor over the diagonal entry, below which a row depends on those before it.
const DEPENDENT: f64 = 1e-14;

/// Cholesky factor of the rows of a matrix that were added, in the order of their addition.
#[derive(Debug, Clone, Default)]
pub(crate) struct Factor {
    rows: Vec<Vec<f64>>,
}

impl Factor {
    /// The factor of a whole matrix; none if it is not positive definite.
    pub(crate) fn of(matrix: &Symmetric) -> Option<Self> {
        let mut factor = Self::default();
        (0..matrix.size())
            .all(|i| factor.push(&matrix.row(i)[..i], matrix.row(i)[i]))
            .then_some(factor)
    }

    /// Adds a row from its entries with the rows before and its diagonal; false, and no change, if it depends on them.
    pub(crate) fn push(&mut self, entries: &[f64], diagonal: f64) -> bool {
        let mut row = self.forward(entries);
        let rest = diagonal - dot(&row, &row);
        let independent = rest > DEPENDENT * diagonal;
        if independent {
            row.push(rest.sqrt());
            self.rows.push(row);
        }
        independent
    }

    /// Removes a row and rotates the others back to a triangle.
    fn remove(&mut self, at: usize) {
        self.rows.remove(at);
        for i in at..self.rows.len() {
            let (own, next) = (self.rows[i][i], self.rows[i][i + 1]);
            let size = own.hypot(next);
            let (cosine, sine) = (own / size, next / size);
            for row in &mut self.rows[i..] {
                let (x, y) = (row[i], row[i + 1]);
                (row[i], row[i + 1]) = (cosine * x + sine * y, cosine * y - sine * x);
            }
            self.rows[i].truncate(i + 1);
        }
    }

    /// The solution y of L y = b.
    pub(crate) fn forward(&self, right: &[f64]) -> Vec<f64> {
        let mut y: Vec<f64> = Vec::with_capacity(right.len() + 1);
        for (row, b) in self.rows.iter().zip(right) {
            let known = dot(&row[..y.len()], &y);
            y.push((b - known) / row[y.len()]);
        }
        y
    }

    /// The solution of L^T x = y.
    pub(crate) fn backward(&self, mut y: Vec<f64>) -> Vec<f64> {
        for i in (0..y.len()).rev() {
            y[i] /= self.rows[i][i];
            let (above, here) = y.split_at_mut(i);
            for (value, entry) in above.iter_mut().zip(&self.rows[i]) {
                *value -= entry * here[0];
            }
        }
        y
    }

    /// The solution of L L^T x = b.
    pub(crate) fn solve(&self, right: &[f64]) -> Vec<f64> {
        self.backward(self.forward(right))
    }

    /// The inverse of L L^T.
    pub(crate) fn inverse(&self) -> Vec<Vec<f64>> {
        let count = self.rows.len();
        let unit = |i| {
            (0..count)
                .map(|j| f64::from(u8::from(i == j)))
                .collect::<Vec<_>>()
        };
        (0..count).map(|i| self.solve(&unit(i))).collect()
    }

    /// The logarithm of the determinant of L L^T.
    pub(crate) fn log_determinant(&self) -> f64 {
        let diagonal = self.rows.iter().enumerate().map(|(i, row)| row[i].ln());
        2.0 * diagonal.sum::<f64>()
    }
}

/// A solution of [`nnls`].
#[derive(Debug, Clone)]
pub struct Solution {
    /// The unknowns, none negative.
    pub x: Vec<f64>,
    /// b - A x: zero where an unknown is free, not positive where it is pinned at zero.
    pub gradient: Vec<f64>,
    /// Free unknowns, in the order of the factor.
    pub(crate) free: Vec<usize>,
    /// Factor of their rows.
    pub(crate) factor: Factor,
}

/// Gradient below which an unknown stays pinned, over the largest term of the gradient: rounding.
const ROUNDING: f64 = 1e-13;

/// The minimum of x^T A x/2 - b^T x with x >= 0, from a start that may be empty; none if rounding prevents it.
///
/// `A` is positive definite, at least up to rounding: an unknown whose row depends on those of the free ones stays pinned.
/// Only the positive unknowns of the start matter.
///
/// Accuracy: 1e-9 of the largest unknown for conditions up to 1e6, as `tests/solver.rs` compares with
/// `scipy.optimize.nnls`.
///
/// ```
/// use inverse::{Symmetric, nnls};
/// // without the bound it would be (2, -1)
/// let matrix = Symmetric::from_fn(2, |i, j| if i == j { 2.0 } else { 1.0 });
/// let found = nnls(&matrix, &[3.0, 0.0], &[]).ok_or("no solution")?;
/// assert!((found.x[0] - 1.5).abs() < 1e-12 && found.x[1] == 0.0);
/// # Ok::<(), &str>(())
/// ```
pub fn nnls(matrix: &Symmetric, right: &[f64], start: &[f64]) -> Option<Solution> {
    let size = matrix.size();
    let (mut x, mut free, mut factor) = (vec![0.0; size], Vec::new(), Factor::default());
    for (j, &value) in start.iter().enumerate().filter(|(_, value)| **value > 0.0) {
        if freed(matrix, j, &mut free, &mut factor) {
            x[j] = value;
        }
    }
    let mut barred = vec![false; size];
    for _ in 0..10 * size + 100 {
        let wanted = factor.solve(&free.iter().map(|&j| right[j]).collect::<Vec<_>>());
        // as far as no unknown becomes negative
        let parts = free
            .iter()
            .zip(&wanted)
            .filter(|(_, wanted)| **wanted <= 0.0);
        let parts = parts.map(|(&j, wanted)| x[j] / (x[j] - wanted).max(f64::MIN_POSITIVE));
        let part = parts.fold(1.0, f64::min);
        for (&j, wanted) in free.iter().zip(&wanted) {
            x[j] = (1.0 - part) * x[j] + part * wanted;
        }
        if wanted.iter().any(|value| *value <= 0.0) {
            let largest = x.iter().fold(0.0, |a: f64, b| a.max(*b));
            for at in (0..free.len()).rev() {
                if wanted[at] <= 0.0 && x[free[at]] <= 1e-15 * largest {
                    let j = free.remove(at);
                    factor.remove(at);
                    // of one that was freed in vain, rounding alone made the gradient positive
                    (x[j], barred[j]) = (0.0, part == 0.0);
                }
            }
            continue;
        }
        let product = matrix.times(&x);
        let gradient: Vec<f64> = right.iter().zip(&product).map(|(b, a)| b - a).collect();
        let terms = right.iter().chain(&product);
        let largest = terms.fold(0.0, |a: f64, b| a.max(b.abs()));
        let pinned = (0..size).filter(|&j| x[j] == 0.0 && !barred[j] && !free.contains(&j));
        let steepest = pinned.max_by(|&i, &j| gradient[i].total_cmp(&gradient[j]));
        match steepest.filter(|&j| gradient[j] > ROUNDING * largest) {
            Some(j) => barred[j] = !freed(matrix, j, &mut free, &mut factor),
            None => {
                return Some(Solution {
                    x,
                    gradient,
                    free,
                    factor,
                });
            }
        }
    }
    None
}

/// Makes an unknown free, if its row does not depend on those of the free ones.
fn freed(matrix: &Symmetric, j: usize, free: &mut Vec<usize>, factor: &mut Factor) -> bool {
    let row = matrix.row(j);
    let entries: Vec<f64> = free.iter().map(|&i| row[i]).collect();
    let independent = factor.push(&entries, row[j]);
    if independent {
        free.push(j);
    }
    independent
}
