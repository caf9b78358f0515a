//! Least-squares fit of the decay after the last time cell.

use lookup::chebyshev;

/// Smallest u = `time_end`/t at which the remainder is sampled: 40 times the tabulated time.
const NEAREST_TO_INFINITY: f64 = 0.025;

/// The matrix that turns samples of R at fixed u into the coefficients of [`lookup::Tail`].
///
/// It minimises the squared error of R itself, not of R/u^2, so that rounding at late times, where R is
/// small, is not amplified. The samples lie at u alone, so one matrix serves every point and slice.
#[derive(Debug, Clone)]
pub(crate) struct TailFit {
    samples: Vec<f64>,
    /// Row k gives coefficient k.
    solution: Vec<Vec<f64>>,
}

impl TailFit {
    /// A fit of `terms` coefficients to two and a half times as many samples, Chebyshev-spaced in u.
    pub(crate) fn new(terms: usize) -> Self {
        let count = terms * 5 / 2;
        let samples: Vec<f64> = (0..count)
            .map(|i| {
                let x = (std::f64::consts::PI * i as f64 / (count - 1) as f64).cos();
                NEAREST_TO_INFINITY + (1.0 - NEAREST_TO_INFINITY) * 0.5 * (1.0 + x)
            })
            .collect();
        let columns = (0..terms).map(|k| {
            let mut unit = vec![0.0; k + 1];
            unit[k] = 1.0;
            samples
                .iter()
                .map(|&u| u * u * chebyshev(&unit, u))
                .collect()
        });
        let solution = pseudo_inverse(columns.collect());
        Self { samples, solution }
    }

    /// Values of u to sample.
    pub(crate) fn samples(&self) -> &[f64] {
        &self.samples
    }

    /// The coefficients that fit `values`, one for each sample.
    pub(crate) fn coefficients<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.solution
            .iter()
            .map(move |row| row.iter().zip(values).map(|(a, b)| a * b).sum())
    }
}

/// Rows of the pseudo-inverse of the matrix with these columns, by Gram-Schmidt done twice.
fn pseudo_inverse(columns: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let terms = columns.len();
    let mut upper = vec![vec![0.0; terms]; terms];
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(terms);
    for (k, mut column) in columns.into_iter().enumerate() {
        for _ in 0..2 {
            for (j, earlier) in basis.iter().enumerate() {
                let overlap = dot(earlier, &column);
                upper[j][k] += overlap;
                for (x, y) in column.iter_mut().zip(earlier) {
                    *x -= overlap * y;
                }
            }
        }
        let norm = dot(&column, &column).sqrt();
        upper[k][k] = norm;
        basis.push(column.iter().map(|x| x / norm).collect());
    }
    // Back substitution of the triangular factor on the transposed basis.
    let mut rows = basis;
    for k in (0..terms).rev() {
        let (done, later) = rows.split_at_mut(k + 1);
        for (row, factor) in later.iter().zip(&upper[k][k + 1..]) {
            for (x, y) in done[k].iter_mut().zip(row) {
                *x -= factor * y;
            }
        }
        for x in &mut rows[k] {
            *x /= upper[k][k];
        }
    }
    rows
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decay_of_the_assumed_form_is_recovered() {
        let fit = TailFit::new(12);
        let exact = |u: f64| u * u * (0.7 + 0.2 * u) / (1.5 - u);
        let values: Vec<f64> = fit.samples().iter().map(|&u| exact(u)).collect();
        let coefficients: Vec<f64> = fit.coefficients(&values).collect();
        for i in 0..=200 {
            let u = f64::from(i) / 200.0;
            let error = u * u * chebyshev(&coefficients, u) - exact(u);
            assert!(error.abs() < 2e-6, "u = {u}: {error}");
        }
    }
}
