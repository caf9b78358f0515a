//! A sampled force convolved with the cells of any number of points, term by term or by the fast Fourier transform.
//!
//! ```text
//! u_n = P_n u_static + sum_{m <= n} (P_m - P_{m-1}) Rbar_{n-m}
//! ```
//!
//! Exact for a force that is linear between samples; Rbar_j is the average of the remainder R over
//! the j-th cell. For a smooth force the cells are corrected by the first moments of R, see [`Smoothness`](lookup::Smoothness).
//! Everything is in kernel units except the force, whose unit is free.
//!
//! Theory: `docs/theory.md` (T22, T24).

use halfspace::Six;
use num_complex::Complex;
use pulp::{Arch, Simd, WithSimd};
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::cell::RefCell;
use std::sync::Arc;

/// A sampled force, ready to be convolved with the cells of any number of points.
pub struct Convolver {
    force: Vec<f64>,
    /// P_m - P_{m-1} of the samples.
    pub(crate) rises: Vec<f64>,
    /// Samples until the force has come to rest.
    live: usize,
    /// Samples at which the fields are wanted, ascending.
    wanted: Vec<usize>,
    /// Where the sum is done by it: the way that is estimated to be faster.
    pub(crate) transform: Option<Transform>,
}

/// Nanoseconds of a product of the direct sum for six fields, and of a point and stage of the twelve transforms.
///
/// Measured by the bench `fields`; only their ratio matters.
const PRODUCT_NS: f64 = 0.8;
const STAGE_NS: f64 = 3.3;

/// Nanoseconds of the direct sum for six fields at the samples wanted.
pub(crate) fn direct_ns(wanted: f64, live: f64) -> f64 {
    PRODUCT_NS * wanted * live
}

/// Nanoseconds of the transforms that take its place, of a size.
pub(crate) fn transform_ns(size: f64) -> f64 {
    STAGE_NS * size * size.log2()
}

impl Convolver {
    /// Fields are wanted at all samples.
    pub fn new(force: &[f64]) -> Self {
        Self::from_base(0.0, force, (0..force.len()).collect())
    }

    /// As [`Convolver::new`], with the summation method given.
    pub fn by(force: &[f64], method: Method) -> Self {
        let mut convolver = Self::new(force);
        let is_asked = method == Method::Transform;
        convolver.transform = is_asked.then(|| Transform::new(&convolver.rises));
        convolver
    }

    /// Fields are wanted at some samples, ascending, of a force that was `base` for long before.
    pub(crate) fn from_base(base: f64, force: &[f64], wanted: Vec<usize>) -> Self {
        let rises = rises(base, force);
        let live = rises.iter().rposition(|&d| d != 0.0).map_or(0, |i| i + 1);
        Self {
            transform: Transform::is_faster(rises.len(), live, wanted.len())
                .then(|| Transform::new(&rises)),
            force: force.to_vec(),
            rises,
            live,
            wanted,
        }
    }

    /// The six fields at the samples wanted, from the static part and the averages of the remainder over at least as many
    /// cells as the force has samples.
    pub fn fields(&self, static_part: &Six, averages: &[Six]) -> [Vec<f64>; 6] {
        let mut out = match &self.transform {
            Some(transform) => transform.convolve(averages, self.force.len(), &self.wanted),
            None => self.direct_sum(averages),
        };
        for (field, samples) in out.iter_mut().enumerate() {
            for (value, &n) in samples.iter_mut().zip(&self.wanted) {
                *value += self.force[n] * static_part[field];
            }
        }
        out
    }

    fn direct_sum(&self, averages: &[Six]) -> [Vec<f64>; 6] {
        let of = |&n: &usize| {
            let rises = self.rises[..self.live.min(n + 1)].iter().copied();
            weighted_sum(rises.zip(averages[..=n].iter().rev()))
        };
        let sums: Vec<Six> = self.wanted.iter().map(of).collect();
        std::array::from_fn(|f| sums.iter().map(|sum| sum[f]).collect())
    }
}

/// The sum of weighted cells, in vector registers; the same bits on every machine.
pub(crate) fn weighted_sum<'a>(cells: impl Iterator<Item = (f64, &'a Six)>) -> Six {
    struct Weighted<I>(I);
    impl<'a, I: Iterator<Item = (f64, &'a Six)>> WithSimd for Weighted<I> {
        type Output = Six;
        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) -> Six {
            let mut sum = [0.0; 6];
            for (weight, cell) in self.0 {
                for (sum, value) in sum.iter_mut().zip(cell) {
                    *sum += weight * value;
                }
            }
            sum
        }
    }
    Arch::new().dispatch(Weighted(cells))
}

/// How a convolution is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Sum over the increments of the force.
    Direct,
    /// Fast Fourier transform.
    Transform,
}

impl Method {
    /// Its name in reports and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Direct => "direct sum",
            Self::Transform => "fast Fourier transform",
        }
    }
}

/// P_m - P_{m-1}, with `base` before the first sample.
pub(crate) fn rises(base: f64, force: &[f64]) -> Vec<f64> {
    let before = [base].into_iter().chain(force.iter().copied());
    force
        .iter()
        .zip(before)
        .map(|(p, before)| p - before)
        .collect()
}

thread_local! {
    /// Plans of the sizes that a thread has met: making one takes as long as using it.
    static PLANNER: RefCell<RealFftPlanner<f64>> = RefCell::new(RealFftPlanner::new());
}

/// The force's increments in the frequency domain with the plans that brought them there.
pub(crate) struct Transform {
    size: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    load: Vec<Complex<f64>>,
}

impl Transform {
    pub(crate) fn new(rise: &[f64]) -> Self {
        let size = Self::size(rise.len());
        let mut transform = PLANNER.with_borrow_mut(|planner| Self {
            size,
            forward: planner.plan_fft_forward(size),
            backward: planner.plan_fft_inverse(size),
            load: Vec::new(),
        });
        transform.load = transform.spectrum(rise.iter().copied());
        transform
    }

    /// So that the end of a convolution of so many samples does not come round to its beginning.
    fn size(samples: usize) -> usize {
        (2 * samples).next_power_of_two()
    }

    /// Whether the sum over increments of which so many are not zero, for the samples wanted, would take longer.
    pub(crate) fn is_faster(samples: usize, live: usize, wanted: usize) -> bool {
        transform_ns(Self::size(samples) as f64) < direct_ns(wanted as f64, live as f64)
    }

    fn spectrum(&self, samples: impl Iterator<Item = f64>) -> Vec<Complex<f64>> {
        let mut time = self.forward.make_input_vec();
        for (slot, value) in time.iter_mut().zip(samples) {
            *slot = value;
        }
        let mut frequency = self.forward.make_output_vec();
        // The lengths are those of the plan, the only thing that can be wrong.
        let done = self.forward.process(&mut time, &mut frequency);
        debug_assert!(done.is_ok());
        frequency
    }

    pub(crate) fn convolve(
        &self,
        averages: &[Six],
        count: usize,
        wanted: &[usize],
    ) -> [Vec<f64>; 6] {
        std::array::from_fn(|field| {
            let time = self.convolve_one(averages.iter().take(count).map(|cell| cell[field]));
            wanted.iter().map(|&n| time[n]).collect()
        })
    }

    /// The same of one field, at all samples and some more; of no more cells than there are samples.
    pub(crate) fn convolve_one(&self, averages: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut product = self.spectrum(averages);
        for (a, b) in product.iter_mut().zip(&self.load) {
            *a *= b;
        }
        let mut time = self.backward.make_output_vec();
        // A spectrum that is not finite is all that can be wrong: so is the field then, which is refused as a result.
        let _ = self.backward.process(&mut product, &mut time);
        time.iter_mut().for_each(|x| *x /= self.size as f64);
        time
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transform_agrees_with_the_sum() {
        let averages: Vec<Six> = (0..300)
            .map(|j| {
                std::array::from_fn(|f| ((j * (f + 1)) as f64 * 0.01).sin() / (1.0 + j as f64))
            })
            .collect();
        let force: Vec<f64> = (0..300)
            .map(|i| (f64::from(i) * 0.02).sin().max(0.0))
            .collect();
        for wanted in [(0..300).collect::<Vec<_>>(), vec![0, 7, 150, 299]] {
            let mut convolver = Convolver::from_base(0.0, &force, wanted);
            convolver.transform = Some(Transform::new(&convolver.rises));
            let b = convolver.fields(&[1.0; 6], &averages);
            convolver.transform = None;
            let a = convolver.fields(&[1.0; 6], &averages);
            for field in 0..6 {
                for (x, y) in a[field].iter().zip(&b[field]) {
                    assert!((x - y).abs() < 1e-13);
                }
            }
        }
    }
}
