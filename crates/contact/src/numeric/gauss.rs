//! Further rules of quadrature: Radau's, and Gauss's of a measure given by many point masses.

/// The n nodes of Radau's rule on (0, 1] that holds the right end, ascending: eigenvalues of Legendre's Jacobi matrix whose
/// last entry makes the end one of them.
pub(crate) fn radau(n: usize) -> Vec<f64> {
    let mut diagonal = vec![0.0; n];
    diagonal[n - 1] = n as f64 / (2 * n - 1) as f64;
    let beside = |k: usize| k as f64 / ((4 * k * k - 1) as f64).sqrt();
    let mut beside: Vec<f64> = (1..=n).map(beside).collect();
    eigen(&mut diagonal, &mut beside);
    diagonal.sort_by(f64::total_cmp);
    diagonal[n - 1] = 1.0;
    diagonal.iter().map(|x| 0.5 + 0.5 * x).collect()
}

/// Gauss's rule of n nodes for a sum of point masses, ascending: Stieltjes' recurrence and its Jacobi matrix.
pub(crate) fn gauss_rule(points: &[(f64, f64)], n: usize) -> Vec<(f64, f64)> {
    let total: f64 = points.iter().map(|(_, mass)| mass).sum();
    let (mut diagonal, mut beside) = (vec![], vec![]);
    let mut before = vec![0.0; points.len()];
    let mut now = vec![1.0 / total.sqrt(); points.len()];
    let mut norm = 0.0;
    for _ in 0..n {
        let parts = points.iter().zip(&now);
        let mean: f64 = parts.map(|((x, m), p)| m * x * p * p).sum();
        diagonal.push(mean);
        let mut square = 0.0;
        for (((x, mass), p), q) in points.iter().zip(&mut now).zip(&mut before) {
            let next = (x - mean) * *p - norm * *q;
            *q = *p;
            *p = next;
            square += mass * next * next;
        }
        norm = square.sqrt();
        beside.push(norm);
        now.iter_mut().for_each(|p| *p /= norm);
    }
    let first = eigen(&mut diagonal, &mut beside);
    let weights = first.iter().map(|z| total * z * z);
    let mut rule: Vec<(f64, f64)> = diagonal.into_iter().zip(weights).collect();
    rule.sort_by(|a, b| a.0.total_cmp(&b.0));
    rule
}

/// Eigenvalues (in place of the diagonal) of a symmetric tridiagonal matrix and the first components of
/// its eigenvectors, by the implicit QL iteration.
fn eigen(diagonal: &mut [f64], beside: &mut [f64]) -> Vec<f64> {
    let n = diagonal.len();
    beside[n - 1] = 0.0;
    let mut first = vec![0.0; n];
    first[0] = 1.0;
    for l in 0..n {
        for _ in 0..60 {
            let small = |i: usize| {
                beside[i].abs() <= f64::EPSILON * (diagonal[i].abs() + diagonal[i + 1].abs())
            };
            let m = (l..n - 1).find(|&i| small(i)).unwrap_or(n - 1);
            if m == l {
                break;
            }
            let half = 0.5 * (diagonal[l + 1] - diagonal[l]) / beside[l];
            let shift = half + half.hypot(1.0).copysign(half);
            let mut g = diagonal[m] - diagonal[l] + beside[l] / shift;
            let (mut sine, mut cosine, mut rest) = (1.0, 1.0, 0.0);
            for i in (l..m).rev() {
                let (f, b) = (sine * beside[i], cosine * beside[i]);
                let r = f.hypot(g);
                beside[i + 1] = r;
                (sine, cosine) = (f / r, g / r);
                g = diagonal[i + 1] - rest;
                let turn = (diagonal[i] - g) * sine + 2.0 * cosine * b;
                rest = sine * turn;
                diagonal[i + 1] = g + rest;
                g = cosine * turn - b;
                let f = first[i + 1];
                first[i + 1] = sine * first[i] + cosine * f;
                first[i] = cosine * first[i] - sine * f;
            }
            diagonal[l] -= rest;
            beside[l] = g;
            beside[m] = 0.0;
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radau_nodes_of_three() {
        // (4 -+ sqrt 6)/10 and 1
        let found = radau(3);
        let root = 6.0_f64.sqrt();
        for (x, expected) in found.iter().zip([0.4 - 0.1 * root, 0.4 + 0.1 * root, 1.0]) {
            assert!((x - expected).abs() < 1e-14, "{found:?}");
        }
    }

    #[test]
    fn all_moments_of_its_degree_are_met() {
        // dx/sqrt(x) on [0, 1] by the midpoints of its root, and a mass at the end
        let mut points: Vec<(f64, f64)> = (0..400)
            .map(|i| (((f64::from(i) + 0.5) / 400.0).powi(2), 2.0 / 400.0))
            .collect();
        points.push((1.0, 0.7));
        let moment =
            |rule: &[(f64, f64)], k: i32| -> f64 { rule.iter().map(|(x, m)| m * x.powi(k)).sum() };
        for n in [1, 2, 3, 8, 20] {
            let rule = gauss_rule(&points, n);
            assert!(rule.is_sorted_by_key(|(x, _)| *x) && rule.iter().all(|(_, m)| *m > 0.0));
            for k in 0..2 * n as i32 {
                assert!(
                    (moment(&rule, k) / moment(&points, k) - 1.0).abs() < 1e-12,
                    "{n} {k}"
                );
            }
        }
    }
}
