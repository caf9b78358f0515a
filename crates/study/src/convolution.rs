//! Sums of cells against the increments of a sampled force: direct, and by the fast Fourier transform.
//!
//! Restated from `impact`, which keeps its own to itself; what depends on the force alone is prepared once.

use halfspace::Six;
use num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::sync::Arc;

/// How the sum is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Way {
    /// The sum itself.
    Direct,
    /// By the fast Fourier transform.
    Transform,
}

/// A sampled force, ready for the cells of any point.
pub(crate) struct Convolution {
    force: Vec<f64>,
    rise: Vec<f64>,
    transform: Option<Transform>,
}

/// The force's increments in the frequency domain, and the plans that brought them there.
struct Transform {
    size: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    load: Vec<Complex64>,
}

impl Convolution {
    pub(crate) fn new(force: Vec<f64>, way: Way) -> Self {
        let rise = increments(&force);
        let transform = match way {
            Way::Direct => None,
            Way::Transform => Some(Transform::new(&rise)),
        };
        Self {
            force,
            rise,
            transform,
        }
    }

    /// P_n static + sum_m (P_m - P_{m-1}) cell_{n-m}.
    pub(crate) fn response(&self, rest: &Six, cells: &[Six]) -> Vec<Six> {
        let mut sums: Vec<Six> = self.force.iter().map(|p| rest.map(|s| p * s)).collect();
        match &self.transform {
            Some(transform) => transform.add(&mut sums, cells),
            None => self.add(&mut sums, cells),
        }
        sums
    }

    fn add(&self, sums: &mut [Six], cells: &[Six]) {
        let live = self.rise.iter().rposition(|&d| d != 0.0);
        let live = live.map_or(0, |i| i + 1);
        for (m, &d) in self.rise[..live].iter().enumerate() {
            for (sum, cell) in sums[m..].iter_mut().zip(cells) {
                for (s, c) in sum.iter_mut().zip(cell) {
                    *s += d * c;
                }
            }
        }
    }
}

impl Transform {
    fn new(rise: &[f64]) -> Self {
        let size = (2 * rise.len()).next_power_of_two();
        let mut planner = RealFftPlanner::<f64>::new();
        let mut transform = Self {
            size,
            forward: planner.plan_fft_forward(size),
            backward: planner.plan_fft_inverse(size),
            load: Vec::new(),
        };
        transform.load = transform.spectrum(rise.iter().copied());
        transform
    }

    fn spectrum(&self, samples: impl Iterator<Item = f64>) -> Vec<Complex64> {
        let mut time = self.forward.make_input_vec();
        for (slot, value) in time.iter_mut().zip(samples) {
            *slot = value;
        }
        let mut frequency = self.forward.make_output_vec();
        // the lengths are those of the plan, the only thing that can be wrong
        let done = self.forward.process(&mut time, &mut frequency);
        debug_assert!(done.is_ok());
        frequency
    }

    fn add(&self, sums: &mut [Six], cells: &[Six]) {
        for field in 0..6 {
            let mut product = self.spectrum(cells.iter().take(sums.len()).map(|cell| cell[field]));
            for (a, b) in product.iter_mut().zip(&self.load) {
                *a *= b;
            }
            let mut time = self.backward.make_output_vec();
            let done = self.backward.process(&mut product, &mut time);
            debug_assert!(done.is_ok());
            for (sum, t) in sums.iter_mut().zip(time) {
                sum[field] += t / self.size as f64;
            }
        }
    }
}

fn increments(force: &[f64]) -> Vec<f64> {
    let mut before = 0.0;
    force
        .iter()
        .map(|&p| {
            let rise = p - before;
            before = p;
            rise
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lookup::PulseSum;

    #[test]
    fn three_ways_to_the_same_sum() {
        let cells: Vec<Six> = (0..400)
            .map(|j| std::array::from_fn(|f| (f64::from(j) * 0.05 * (f as f64 + 1.0)).sin()))
            .collect();
        let pulse = PulseSum::new(8.0, 0.1);
        let force: Vec<f64> = (0..400).map(|n| pulse.force(n)).collect();
        let rest = [0.3; 6];
        let exact = Convolution::new(force.clone(), Way::Direct).response(&rest, &cells);
        for other in [
            Convolution::new(force, Way::Transform).response(&rest, &cells),
            pulse.response(&rest, &cells),
        ] {
            for (a, b) in exact.iter().zip(&other) {
                assert!((0..6).all(|f| (a[f] - b[f]).abs() < 1e-12));
            }
        }
    }
}
