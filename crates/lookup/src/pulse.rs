//! Response to a smooth pulse, the reference for every error in a table.

use halfspace::Six;
use std::f64::consts::{PI, TAU};

/// Response to the pulse P(t) = sin^4(pi t/T) on [0, T] of unit peak, taken as linear between samples one cell apart.
///
/// ```text
/// u_n = P_n u_static + sum_m (P_m - P_{m-1}) Rbar_{n-m},   P_m - P_{m-1} = Re sum_{k=1,2} A_k e^{2 pi i k m/M}
/// ```
///
/// With exponentials the sum becomes a running sum, so that a response costs a few operations per sample, independent
/// of the length of the pulse.
#[derive(Debug, Clone)]
pub struct PulseSum {
    cells: usize,
    turn: [[f64; 2]; 2],
    amplitude: [[f64; 2]; 2],
}

impl PulseSum {
    /// The pulse of length `length`, rounded to whole cells of `width` (at least two).
    pub fn new(length: f64, width: f64) -> Self {
        let cells = ((length / width).round() as usize).max(2);
        let angles = [1.0, 2.0].map(|k| TAU * k / cells as f64);
        let turn = angles.map(|angle| [angle.cos(), angle.sin()]);
        let amplitude = |factor: f64, [cos, sin]: [f64; 2]| [factor * (1.0 - cos), factor * sin];
        Self {
            cells,
            turn,
            amplitude: [amplitude(-0.5, turn[0]), amplitude(0.125, turn[1])],
        }
    }

    /// P at the end of cell `n - 1`.
    pub fn force(&self, n: usize) -> f64 {
        if n >= self.cells {
            return 0.0;
        }
        let angle = PI * n as f64 / self.cells as f64;
        angle.sin().powi(4)
    }

    /// Responses at the times 0, 1, 2, ... in cell widths, one for each entry of `cells`.
    ///
    /// For `static_part` zero and the difference of two traces as `cells`, the result is the difference of their
    /// responses.
    pub fn response(&self, static_part: &Six, cells: &[Six]) -> Vec<Six> {
        let mut sums = [[[0.0; 2]; 6]; 2];
        let mut out = Vec::with_capacity(cells.len());
        for n in 0..cells.len() {
            let force = self.force(n);
            let mut value = static_part.map(|s| force * s);
            if n > 0 {
                let entering = cells[n - 1];
                let leaving = (n - 1).checked_sub(self.cells);
                let leaving = leaving.map_or([0.0; 6], |cell| cells[cell]);
                for (k, field) in sums.iter_mut().enumerate() {
                    let [c, s] = self.turn[k];
                    let [a, b] = self.amplitude[k];
                    for (f, sum) in field.iter_mut().enumerate() {
                        // a cell leaves with a phase of M + 1 turns, equal to one turn
                        let re = sum[0] + entering[f] - leaving[f];
                        let im = sum[1];
                        *sum = [c * re - s * im, s * re + c * im];
                        value[f] += a * sum[0] - b * sum[1];
                    }
                }
            }
            out.push(value);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_running_sum_equals_the_plain_convolution() {
        let cells: Vec<Six> = (0..300)
            .map(|j| std::array::from_fn(|f| (-(j as f64) / (30.0 + f as f64)).exp()))
            .collect();
        let pulse = PulseSum::new(4.0, 0.1);
        let response = pulse.response(&[0.5; 6], &cells);
        for n in [0, 1, 20, 40, 41, 42, 100, 299] {
            for f in 0..6 {
                let plain: f64 = (1..=n.min(pulse.cells))
                    .map(|m| (pulse.force(m) - pulse.force(m - 1)) * cells[n - m][f])
                    .sum();
                let exact = 0.5 * pulse.force(n) + plain;
                assert!(
                    (response[n][f] - exact).abs() < 1e-13,
                    "n = {n}: {} against {exact}",
                    response[n][f]
                );
            }
        }
    }
}
