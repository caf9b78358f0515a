//! Euler: Fourier series with Euler summation, Abate and Whitt (1995), in the form of Abate and Whitt (2006).

use super::Framework;
use num_complex::Complex64;
use std::f64::consts::{LN_10, PI};

/// 2 `order` + 1 nodes on the line Re s t = `order` ln(10)/3; about 0.6 `order` digits for smooth functions.
#[must_use]
pub fn euler(order: usize) -> Framework {
    let m = order as f64;
    let last = 2 * order;
    let mut xi = vec![1.0; last + 1];
    xi[0] = 0.5;
    xi[last] = 0.5_f64.powi(order as i32);
    let mut binomial = 1.0;
    for k in 1..order {
        binomial *= (order + 1 - k) as f64 / k as f64;
        xi[last - k] = xi[last - k + 1] + binomial * xi[last];
    }
    let scale = 10.0_f64.powf(m / 3.0);
    let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    Framework {
        nodes: (0..=last)
            .map(|k| Complex64::new(m * LN_10 / 3.0, PI * k as f64))
            .collect(),
        weights: xi
            .iter()
            .enumerate()
            .map(|(k, xi)| (scale * sign(k) * xi).into())
            .collect(),
    }
}
