//! Chebyshev's series from values at a Leja sequence of nodes in [-1, 1], taken in pairs: each set holds the one before, so
//! that a function is read at as many as its series needs and no value is lost.

use crate::field::Six;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Nodes at most.
pub const MOST: usize = 39;

/// The nodes in their order, an odd number of which are a set; none is an end.
pub fn nodes() -> &'static [f64; MOST] {
    &RULE.nodes
}

/// Coefficients of Chebyshev's polynomials from values at the first nodes, an odd number of them.
pub fn series(values: &[Six]) -> Vec<Six> {
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

/// The nodes, and what makes coefficients of values at the first of them, for each number.
struct Rule {
    nodes: [f64; MOST],
    inverses: Vec<Vec<Vec<f64>>>,
}

static RULE: LazyLock<Rule> = LazyLock::new(|| {
    // after the middle and two near the ends, each pair where the product of distances to those before is largest
    let mut nodes = vec![0.0, -0.97, 0.97];
    while nodes.len() < MOST {
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
        // Gauss and Jordan
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
    Rule {
        inverses: (0..=MOST)
            .map(|n| if n % 2 == 1 { inverse(n) } else { Vec::new() })
            .collect(),
        nodes: std::array::from_fn(|i| nodes[i]),
    }
});
