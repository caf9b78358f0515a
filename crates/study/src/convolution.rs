//! Sums of cells against the increments of a sampled force: direct, and by the fast Fourier transform.

use halfspace::Six;
use realfft::RealFftPlanner;

/// P_n static + sum_m (P_m - P_{m-1}) cell_{n-m} by the sum itself.
pub(crate) fn direct(rest: &Six, cells: &[Six], force: &[f64]) -> Vec<Six> {
    let rise = increments(force);
    let live = rise.iter().rposition(|&d| d != 0.0).map_or(0, |i| i + 1);
    let mut sums: Vec<Six> = force.iter().map(|p| rest.map(|s| p * s)).collect();
    for (m, &d) in rise[..live].iter().enumerate() {
        for (sum, cell) in sums[m..].iter_mut().zip(cells) {
            for (s, c) in sum.iter_mut().zip(cell) {
                *s += d * c;
            }
        }
    }
    sums
}

/// The same by the fast Fourier transform.
pub(crate) fn transformed(rest: &Six, cells: &[Six], force: &[f64]) -> Vec<Six> {
    let count = force.len();
    let size = (2 * count).next_power_of_two();
    let mut planner = RealFftPlanner::<f64>::new();
    let (forward, backward) = (
        planner.plan_fft_forward(size),
        planner.plan_fft_inverse(size),
    );
    let spectrum = |samples: &mut dyn Iterator<Item = f64>| {
        let mut time = forward.make_input_vec();
        for (slot, value) in time.iter_mut().zip(samples) {
            *slot = value;
        }
        let mut frequency = forward.make_output_vec();
        // the lengths are those of the plan, the only thing that can be wrong
        let done = forward.process(&mut time, &mut frequency);
        debug_assert!(done.is_ok());
        frequency
    };
    let load = spectrum(&mut increments(force).into_iter());
    let mut out: Vec<Six> = force.iter().map(|p| rest.map(|s| p * s)).collect();
    for field in 0..6 {
        let mut product = spectrum(&mut cells.iter().take(count).map(|cell| cell[field]));
        for (a, b) in product.iter_mut().zip(&load) {
            *a *= b;
        }
        let mut time = backward.make_output_vec();
        let done = backward.process(&mut product, &mut time);
        debug_assert!(done.is_ok());
        for (value, t) in out.iter_mut().zip(time) {
            value[field] += t / size as f64;
        }
    }
    out
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
        let exact = direct(&rest, &cells, &force);
        for other in [
            transformed(&rest, &cells, &force),
            pulse.response(&rest, &cells),
        ] {
            for (a, b) in exact.iter().zip(&other) {
                assert!((0..6).all(|f| (a[f] - b[f]).abs() < 1e-12));
            }
        }
    }
}
