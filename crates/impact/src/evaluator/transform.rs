//! Convolution by the fast Fourier transform.

use halfspace::Six;
use num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::cell::RefCell;
use std::sync::Arc;

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
    pub(crate) fn new(rise: &[f64], size: usize) -> Self {
        let mut transform = PLANNER.with_borrow_mut(|planner| Self {
            size,
            forward: planner.plan_fft_forward(size),
            backward: planner.plan_fft_inverse(size),
            load: Vec::new(),
        });
        transform.load = transform.spectrum(rise.iter().copied());
        transform
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
            let mut product = self.spectrum(averages.iter().take(count).map(|cell| cell[field]));
            for (a, b) in product.iter_mut().zip(&self.load) {
                *a *= b;
            }
            let mut time = self.backward.make_output_vec();
            // A spectrum that is not finite is all that can be wrong: so is the field then, which is refused as a result.
            let _ = self.backward.process(&mut product, &mut time);
            wanted.iter().map(|&n| time[n] / self.size as f64).collect()
        })
    }
}
