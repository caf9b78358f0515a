//! Legendre polynomials and Gauss's rules of any number of nodes.

use std::f64::consts::PI;

/// P_(n-1), P_n and the slope of P_n at x in (-1, 1).
pub(super) fn legendre(n: usize, x: f64) -> (f64, f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 1..=n {
        let k = k as f64;
        (before, value) = (
            value,
            ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k,
        );
    }
    let slope = n as f64 * (before - x * value) / ((1.0 - x) * (1.0 + x));
    (before, value, slope)
}

/// Nodes and weights of the Gauss-Legendre rule of n nodes on [0, 1], ascending.
pub(super) fn gauss(n: usize) -> Vec<(f64, f64)> {
    let mut rule = vec![(0.0, 0.0); n];
    for (i, entry) in rule.iter_mut().enumerate() {
        let mut x = -(PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        for _ in 0..20 {
            let (_, value, slope) = legendre(n, x);
            x -= value / slope;
            if (value / slope).abs() < 1e-16 {
                break;
            }
        }
        let slope = legendre(n, x).2;
        *entry = (
            0.5 * (1.0 + x),
            1.0 / ((1.0 - x) * (1.0 + x) * slope * slope),
        );
    }
    rule
}

/// The n nodes of Radau's rule on (0, 1] that holds the right end, ascending.
///
/// They are the zeros of P_(n-1) - P_n, one of which is the end.
pub(super) fn radau(n: usize) -> Vec<f64> {
    // (P_(n-1) - P_n)/(1 - x) = (P'_(n-1) + P'_n)/n changes sign between neighbours of a fine cosine grid
    let function = |x: f64| {
        let (before, value, _) = legendre(n, x);
        (before - value) / (1.0 - x)
    };
    let cells = 40 * n;
    let place = |i: usize| -((i as f64 + 0.5) * PI / cells as f64).cos();
    let mut nodes = vec![];
    for i in 0..cells - 1 {
        let (mut low, mut high) = (place(i), place(i + 1));
        let sign = function(low) > 0.0;
        if sign == (function(high) > 0.0) {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (function(middle) > 0.0) == sign {
                low = middle;
            } else {
                high = middle;
            }
        }
        nodes.push(0.25 * (low + high) + 0.5);
    }
    nodes.push(1.0);
    debug_assert_eq!(nodes.len(), n);
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_integrates_its_degree() {
        for n in [1, 2, 5, 12, 20] {
            for k in 0..2 * n {
                let sum: f64 = gauss(n).iter().map(|&(x, w)| w * x.powi(k as i32)).sum();
                assert!((sum * (k as f64 + 1.0) - 1.0).abs() < 1e-13, "{n} {k}");
            }
        }
    }

    #[test]
    fn radau_nodes_of_three() {
        // (4 -+ sqrt 6)/10 and 1
        let found = radau(3);
        let root = 6.0_f64.sqrt();
        for (x, expected) in found.iter().zip([0.4 - 0.1 * root, 0.4 + 0.1 * root, 1.0]) {
            assert!((x - expected).abs() < 1e-14, "{found:?}");
        }
    }
}
