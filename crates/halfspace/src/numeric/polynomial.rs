//! Interpolation polynomials, and Chebyshev series from adaptive numbers of values.

use crate::field::Six;
use crate::numeric::lanes::{Lanes, dispatch};
use crate::numeric::scalar::Scalar;
use pulp::{Simd, WithSimd};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// A Chebyshev series at x in [-1, 1], by Clenshaw's recurrence.
#[inline]
pub fn chebyshev(series: &[f64], x: f64) -> f64 {
    let (mut b1, mut b2) = (0.0, 0.0);
    for &c in series[1..].iter().rev() {
        (b1, b2) = (2.0 * x * b1 - b2 + c, b1);
    }
    x * b1 - b2 + series[0]
}

/// Several Chebyshev series, with coefficients by term, at several x in vector registers; bit-identical on every
/// machine.
pub fn chebyshev_each<const F: usize, const N: usize>(
    series: &[[f64; F]],
    x: [f64; N],
) -> [[f64; N]; F] {
    dispatch(SeriesAt(series, x))
}

struct SeriesAt<'a, const F: usize, const N: usize>(&'a [[f64; F]], [f64; N]);

impl<const F: usize, const N: usize> WithSimd for SeriesAt<'_, F, N> {
    type Output = [[f64; N]; F];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self(series, x) = self;
        let mut values = [[0.0; N]; F];
        for from in (0..N).step_by(S::F64_LANES) {
            let own = from..N.min(from + S::F64_LANES);
            let x = Lanes::of(simd, simd.partial_load_f64s(&x[own.clone()]));
            let (mut term, mut next) = (x.constant(1.0), x);
            let mut sums = [x.constant(0.0); F];
            for coefficients in series {
                for (sum, coefficient) in sums.iter_mut().zip(coefficients) {
                    *sum = *sum + term * *coefficient;
                }
                (term, next) = (next, (x + x) * next - term);
            }
            for (values, sum) in values.iter_mut().zip(sums) {
                simd.partial_store_f64s(&mut values[own.clone()], sum.register);
            }
        }
        values
    }
}

/// Value at x of the polynomial that is one at the k-th of `count` places and zero at the others.
#[inline]
pub fn lagrange(place: impl Fn(usize) -> f64, count: usize, k: usize, x: f64) -> f64 {
    let (own, others) = (place(k), (0..count).filter(|&j| j != k));
    let factors = others.map(|j| (x - place(j)) / (own - place(j)));
    factors.product()
}

/// Nodes of [`leja_nodes`].
pub(crate) const LEJA_NODES: usize = 39;

/// A Leja sequence in [-1, 1]: the middle, then pairs. The first nodes of any odd number form a set, so that a series
/// can be refined without losing a value. No node is an end of the interval.
pub fn leja_nodes() -> &'static [f64; LEJA_NODES] {
    &RULE.nodes
}

/// Coefficients of a Chebyshev series from values at the first nodes of [`leja_nodes`], an odd number of them.
pub fn leja_series(values: &[Six]) -> Vec<Six> {
    let of = |weights: &Vec<f64>| {
        let mut sum = Six::default();
        for (weight, value) in weights.iter().zip(values) {
            for (s, v) in sum.iter_mut().zip(value) {
                *s += weight * v;
            }
        }
        sum
    };
    RULE.inverses[values.len()].iter().map(of).collect()
}

/// Truncation error of such a series, estimated from the last two terms and their ratio to the two before: the sum of
/// all following terms if they decrease as a geometric series or a power, times a safety factor.
pub(crate) fn leja_rest(series: &[Six]) -> Six {
    const CAUTION: f64 = 3.0;
    /// Bounds of the ratio; the lower one exceeds chance values. With the fewest terms the ratio is unknown.
    const RATIOS: [f64; 2] = [0.4, 0.9];
    const UNKNOWN: f64 = 0.5;
    let count = series.len();
    std::array::from_fn(|f| {
        let size = |part: &[Six]| part.iter().map(|term| term[f].abs()).sum::<f64>();
        let last = size(&series[count.saturating_sub(2)..]);
        let ratio = match count {
            0..5 => UNKNOWN,
            _ => last / size(&series[count - 4..count - 2]).max(f64::MIN_POSITIVE),
        };
        let ratio = ratio.clamp(RATIOS[0], RATIOS[1]);
        CAUTION * last * ratio / (1.0 - ratio)
    })
}

/// The nodes, and the matrix from values at the first nodes to coefficients, for each number of nodes.
struct LejaRule {
    nodes: [f64; LEJA_NODES],
    inverses: Vec<Vec<Vec<f64>>>,
}

static RULE: LazyLock<LejaRule> = LazyLock::new(|| {
    // after the middle and two nodes near the ends, each pair is placed where the product of distances to previous
    // nodes is largest
    let mut nodes = vec![0.0, -0.97, 0.97];
    while nodes.len() < LEJA_NODES {
        let product = |x: f64| -> f64 {
            let own = (1.0 - x * x).sqrt();
            own * nodes.iter().map(|node| (x - node).abs()).product::<f64>()
        };
        let tried = (1..1000).map(|i| (0.5 * PI * f64::from(i) / 1000.0).sin());
        let best = tried.fold(
            0.5,
            |best, x| if product(x) > product(best) { x } else { best },
        );
        nodes.extend([-best, best]);
    }
    let inverse = |terms: usize| {
        let row = |i: usize| -> Vec<f64> {
            let unit = (0..terms).map(|j| f64::from(u8::from(i == j)));
            let angle = nodes[i].acos();
            (0..terms)
                .map(|j| (j as f64 * angle).cos())
                .chain(unit)
                .collect()
        };
        let mut rows: Vec<Vec<f64>> = (0..terms).map(row).collect();
        // Gauss-Jordan elimination
        for column in 0..terms {
            let size = |i: &usize| rows[*i][column].abs();
            let pivot = (column..terms).max_by(|a, b| size(a).total_cmp(&size(b)));
            rows.swap(column, pivot.unwrap_or(column));
            let scale = rows[column][column].recip();
            let own: Vec<f64> = rows[column].iter().map(|x| scale * x).collect();
            for (i, row) in rows.iter_mut().enumerate() {
                let times = row[column];
                for (x, o) in row.iter_mut().zip(&own) {
                    *x = if i == column { *o } else { *x - times * o };
                }
            }
        }
        rows.iter().map(|row| row[terms..].to_vec()).collect()
    };
    LejaRule {
        inverses: (0..=LEJA_NODES)
            .map(|n| if n % 2 == 1 { inverse(n) } else { Vec::new() })
            .collect(),
        nodes: std::array::from_fn(|i| nodes[i]),
    }
});
