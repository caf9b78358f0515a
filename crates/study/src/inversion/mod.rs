//! Numerical inversion of the Laplace transform, one method a file.
//!
//! Two families: methods of the Abate-Whitt framework evaluate the transform anew for every time, at
//! nodes beta/t, and series methods share their samples among all times of a window.
//!
//! ```text
//! f(t) ~ (1/t) sum_k Re[ weight_k F(beta_k/t) ]                              Abate and Whitt (2006)
//! f(t) ~ (e^{a t}/T) Re[ F(a)/2 + sum_k F(a + i k pi/T) e^{i k pi t/T} ]     Dubner and Abate (1968)
//! ```

mod cme;
mod crump;
mod de_hoog;
mod durbin;
mod euler;
mod stehfest;
mod stehfest_extended;
mod talbot;

pub use cme::cme;
pub use crump::crump;
pub use de_hoog::DeHoog;
pub use durbin::durbin;
pub use euler::euler;
pub use stehfest::stehfest;
pub use stehfest_extended::{ExtendedWeights, MOST_TERMS, stehfest_extended};
pub use talbot::talbot;

use num_complex::Complex64;

/// Nodes and weights of a method that takes the transform anew for every time.
#[derive(Debug, Clone, PartialEq)]
pub struct Framework {
    /// beta_k, Im >= 0.
    pub nodes: Vec<Complex64>,
    /// Their weights.
    pub weights: Vec<Complex64>,
}

impl Framework {
    /// f(t), t > 0, of a transform with any number of components.
    pub fn invert<const N: usize>(
        &self,
        t: f64,
        mut transform: impl FnMut(Complex64) -> [Complex64; N],
    ) -> [f64; N] {
        let mut sum = [0.0; N];
        for (&node, &weight) in self.nodes.iter().zip(&self.weights) {
            let values = transform(node / t);
            for (total, value) in sum.iter_mut().zip(values) {
                *total += (weight * value).re;
            }
        }
        sum.map(|v| v / t)
    }

    /// Smallest real and largest imaginary part of the nodes.
    #[must_use]
    pub fn extent(&self) -> (f64, f64) {
        self.nodes.iter().fold((f64::INFINITY, 0.0), |(re, im), n| {
            (re.min(n.re), im.max(n.im.abs()))
        })
    }
}

/// Where a series method samples the transform: a + i k pi/T.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Half the period T of the series; times up to it are inverted.
    pub half_period: f64,
    /// Distance a of the path from the imaginary axis.
    pub damping: f64,
    /// Number of samples.
    pub samples: usize,
}

impl Window {
    /// Times up to `longest` with an aliasing error of `aliasing`: a = -ln(aliasing)/(2 T), T = 1.25 `longest`.
    #[must_use]
    pub fn new(longest: f64, aliasing: f64, samples: usize) -> Self {
        let half_period = 1.25 * longest;
        Self {
            half_period,
            damping: -aliasing.ln() / (2.0 * half_period),
            samples,
        }
    }

    /// The node of sample k.
    #[must_use]
    pub fn node(&self, k: usize) -> Complex64 {
        let step = std::f64::consts::PI / self.half_period;
        Complex64::new(self.damping, step * k as f64)
    }
}

#[cfg(test)]
mod tests;
