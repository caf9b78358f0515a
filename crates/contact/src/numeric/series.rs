//! Chebyshev series in one or two variables of several results at once.

use std::f64::consts::PI;

/// Most nodes along a variable.
const MOST_COEFFICIENTS: usize = 8;

/// A series in Chebyshev polynomials of two variables between -1 and 1, of the second in rows, of N results side by side
/// in vector registers.
#[derive(Debug)]
pub(crate) struct PlaneSeries<const N: usize> {
    /// Coefficients of each row that are kept.
    rows: Vec<usize>,
    coefficients: Vec<[f64; N]>,
}

/// The i-th of n Lobatto nodes; the middle of one.
fn node(i: usize, n: usize) -> f64 {
    if n == 1 {
        return 0.0;
    }
    (PI * i as f64 / (n - 1) as f64).cos()
}

/// The part of the value at the i-th of n nodes in the k-th coefficient of the polynomial through them.
fn weight(k: usize, i: usize, n: usize) -> f64 {
    if n == 1 {
        return 1.0;
    }
    let halved = |place: usize| [1.0, 0.5][usize::from(place == 0 || place == n - 1)];
    let angle = PI * (k * i % (2 * (n - 1))) as f64 / (n - 1) as f64;
    2.0 * halved(k) * halved(i) * angle.cos() / (n - 1) as f64
}

impl<const N: usize> PlaneSeries<N> {
    /// Through values at so many nodes of each variable, without the last coefficients of a row that are all below `least` of
    /// their result's mean; nothing where a value is missing.
    pub(crate) fn through(
        [across, along]: [usize; 2],
        least: f64,
        values: impl FnMut([f64; 2]) -> Option<[f64; N]>,
    ) -> Option<Self> {
        let place = |k: usize| [node(k / along, across), node(k % along, along)];
        let all = (0..across * along).map(place).map(values);
        let at_nodes = all.collect::<Option<Vec<_>>>()?;
        let coefficient = |k: usize, l: usize| {
            let mut sum = [0.0; N];
            for (place, value) in at_nodes.iter().enumerate() {
                let part = weight(k, place / along, across) * weight(l, place % along, along);
                for (sum, value) in sum.iter_mut().zip(value) {
                    *sum += part * value;
                }
            }
            sum
        };
        let mean = coefficient(0, 0);
        let counts = |found: &[f64; N]| {
            let mut lanes = found.iter().zip(&mean);
            lanes.any(|(part, mean)| part.abs() > least * mean.abs())
        };
        let (mut rows, mut coefficients) = (Vec::new(), Vec::new());
        for l in 0..along {
            let row: Vec<_> = (0..across).map(|k| coefficient(k, l)).collect();
            let kept = row.iter().rposition(counts).map_or(0, |last| last + 1);
            rows.push(kept);
            coefficients.extend(&row[..kept]);
        }
        Some(Self { rows, coefficients })
    }

    /// Its values.
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> [f64; N] {
        let mut polynomials = [1.0, x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        for k in 2..MOST_COEFFICIENTS {
            polynomials[k] = 2.0 * x * polynomials[k - 1] - polynomials[k - 2];
        }
        let mut rest = &self.coefficients[..];
        let (mut all, mut before, mut now) = ([0.0; N], y, 1.0);
        for &kept in &self.rows {
            let (row, after) = rest.split_at(kept);
            let mut sum = [0.0; N];
            for (coefficients, polynomial) in row.iter().zip(polynomials) {
                for (sum, coefficient) in sum.iter_mut().zip(coefficients) {
                    *sum += polynomial * coefficient;
                }
            }
            for (all, sum) in all.iter_mut().zip(sum) {
                *all += now * sum;
            }
            (now, before) = (2.0 * y * now - before, now);
            rest = after;
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_is_its_own_series() {
        let of = |[x, y]: [f64; 2]| -> [f64; 8] {
            std::array::from_fn(|k| {
                1.0 + k as f64 * x.powi(3) * y + (y * y - x) * y * y - 0.3 * x.powi(4)
            })
        };
        for nodes in [[5, 5], [7, 7]] {
            let series = PlaneSeries::through(nodes, 1e-15, |place| Some(of(place))).unwrap();
            for i in 0..40 {
                let place =
                    [0.754_877, 0.569_84].map(|step| 2.0 * (f64::from(i) * step).fract() - 1.0);
                for (found, exact) in series.at(place).iter().zip(of(place)) {
                    assert!((found - exact).abs() < 1e-13, "{place:?}: {found} {exact}");
                }
            }
        }
        let line = PlaneSeries::through([7, 1], 1e-15, |[x, _]| Some([x.powi(6); 8])).unwrap();
        assert!((line.at([0.3, 0.0])[7] - 0.3_f64.powi(6)).abs() < 1e-15);
        assert!(PlaneSeries::through([5, 1], 0.0, |[x, _]| (x > -0.9).then_some([x; 8])).is_none());
    }

    #[test]
    fn what_is_small_is_left_out() {
        let series = PlaneSeries::through([7, 7], 1e-6, |[x, y]| {
            Some([1.0 + 0.1 * x + 0.1 * y + 1e-8 * x.powi(5) * y.powi(5); 8])
        });
        assert_eq!(series.unwrap().rows, [2, 1, 0, 0, 0, 0, 0]);
    }
}
