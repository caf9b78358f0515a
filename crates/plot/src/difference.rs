//! Rates from samples that need not be even.

/// Weights of the first derivative at `at` of the polynomial through values at some places.
///
/// Fornberg, Mathematics of Computation 51 (1988), 699, for the first derivative.
pub(crate) fn weights(at: f64, places: &[f64]) -> Vec<f64> {
    // columns: value and first derivative
    let mut found = vec![[0.0; 2]; places.len()];
    let (mut c1, mut c4) = (1.0, places[0] - at);
    found[0][0] = 1.0;
    for i in 1..places.len() {
        let (mut c2, c5) = (1.0, c4);
        c4 = places[i] - at;
        for j in 0..i {
            let c3 = places[i] - places[j];
            c2 *= c3;
            if j == i - 1 {
                found[i][1] = c1 * (found[i - 1][0] - c5 * found[i - 1][1]) / c2;
                found[i][0] = -c1 * c5 * found[i - 1][0] / c2;
            }
            found[j][1] = (c4 * found[j][1] - found[j][0]) / c3;
            found[j][0] = c4 * found[j][0] / c3;
        }
        c1 = c2;
    }
    found.into_iter().map(|pair| pair[1]).collect()
}

/// The `count` samples nearest to the one at `index` of `samples`, as their first index and their number.
pub(crate) fn window(index: usize, count: usize, samples: usize) -> (usize, usize) {
    let count = count.min(samples);
    let start = index.saturating_sub(count / 2).min(samples - count);
    (start, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_one_degree_less_are_exact() {
        let places = [0.0, 0.7, 1.1, 2.0, 3.3];
        for at in [0.0, 1.1, 3.3] {
            let w = weights(at, &places);
            for power in 0..5_i32 {
                let sum: f64 = w.iter().zip(places).map(|(w, x)| w * x.powi(power)).sum();
                let exact = if power == 0 {
                    0.0
                } else {
                    f64::from(power) * at.powi(power - 1)
                };
                assert!(
                    (sum - exact).abs() < 1e-10 * exact.abs().max(1.0),
                    "{at} {power}: {sum}"
                );
            }
        }
        assert_eq!(weights(0.0, &[-1.0, 0.0, 1.0]), [-0.5, 0.0, 0.5]);
    }

    #[test]
    fn windows_stay_inside() {
        assert_eq!(window(0, 5, 100), (0, 5));
        assert_eq!(window(50, 5, 100), (48, 5));
        assert_eq!(window(99, 5, 100), (95, 5));
        assert_eq!(window(1, 5, 3), (0, 3));
    }
}
