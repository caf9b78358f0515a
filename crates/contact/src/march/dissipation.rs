//! The work that an impact leaves in a half-space whose memory is short.
//!
//! ```text
//! work = 5/2 coupling int p' L dt,     L(t) = int_0^m (1 - W(s)) p'(t - s) ds
//! ```
//!
//! relative to the kinetic energy before, m the memory.
//! Next to the touch and to the end the integral is that of an [`Edge`].
//! Between them p' and L are those of the polynomial through five samples, L with the moments of 1 - W,
//! and the sum over the samples has the weights of Gregory for its ends.
//! The work of the march's own deflection, [`work`](crate::work::work), has an error of h^2 log h instead, with
//! a factor that depends on where in its cell the contact ends.
//!
//! Theory: `docs/theory.md` (T46).

use super::history::History;
use super::relaxation::Relaxation;

/// First sample of the sum.
const FIRST: usize = 3;

/// Gregory's weights of the first and last samples, exact for cubics, and the samples that they need.
const GREGORY: [f64; 3] = [3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0];
const NEEDED: usize = 6;

/// First to fourth derivative in the middle of five samples.
const DERIVATIVES: [[f64; 5]; 4] = [
    [1.0 / 12.0, -2.0 / 3.0, 0.0, 2.0 / 3.0, -1.0 / 12.0],
    [-1.0 / 12.0, 4.0 / 3.0, -2.5, 4.0 / 3.0, -1.0 / 12.0],
    [-0.5, 1.0, 0.0, -1.0, 0.5],
    [1.0, -4.0, 6.0, -4.0, 1.0],
];

/// Work of one contact, relative to the kinetic energy before, where its [`Ends`] are known.
pub(crate) fn dissipated(
    history: &History,
    relaxation: &Relaxation<impl Fn(f64) -> f64>,
) -> Option<f64> {
    let ends = history.ends?;
    let (p, last) = (&history.force, ends.last);
    if last + 1 < FIRST + NEEDED {
        return None;
    }
    let edges = ends.touch.taken_at_touch(relaxation, ends.until[0])
        + ends.leave.taken_at_end(relaxation, ends.until[1]);
    let delayed = delayed_weights(relaxation);
    let rate = |n: usize| {
        let samples = &p[n - 2..n + 3];
        let sum =
            |weights: &[f64; 5]| -> f64 { samples.iter().zip(weights).map(|(p, w)| p * w).sum() };
        sum(&DERIVATIVES[0]) * sum(&delayed)
    };
    let middle: f64 = (FIRST..=last).map(rate).sum::<f64>()
        - GREGORY
            .iter()
            .enumerate()
            .map(|(i, weight)| (1.0 - weight) * (rate(FIRST + i) + rate(last - i)))
            .sum::<f64>();
    Some(2.5 * relaxation.coupling * (edges + middle))
}

/// L in the middle of five samples: sum_k (-1)^k M_k/k! p^(k+1), M_k the moments of 1 - W.
fn delayed_weights(relaxation: &Relaxation<impl Fn(f64) -> f64>) -> [f64; 5] {
    let [m0, m1, m2, m3] = relaxation.moments;
    if relaxation.is_short() {
        return DERIVATIVES[0].map(|weight| m0 * weight);
    }
    let factors = [m0, -m1, m2 / 2.0, -m3 / 6.0];
    std::array::from_fn(|i| {
        factors
            .iter()
            .zip(&DERIVATIVES)
            .map(|(factor, derivative)| factor * derivative[i])
            .sum()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disc::FixedDisc;
    use crate::law::quasi_static::expected_contact_time;
    use crate::march::implicit::march_implicit;
    use crate::settings::StaticShare;
    use crate::work::work;
    use halfspace::{Deflection, Medium, SurfaceResponse};

    /// Relative errors of the work of a march and of that of its own deflection, against a march of 4,096 steps.
    fn errors(coupling: f64, memory: f64, steps: f64) -> [f64; 2] {
        let response = SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Centre);
        let duration = expected_contact_time(coupling);
        let impact = FixedDisc {
            response: &response,
            coupling,
            wave_time: memory * duration / response.memory(),
            share: StaticShare::Full,
        };
        let fine = march_implicit(&impact, duration / 4096.0).unwrap();
        let exact = work(&fine.force, &fine.deflection);
        let coarse = march_implicit(&impact, duration / steps).unwrap();
        [
            coarse.dissipated.unwrap() / exact - 1.0,
            work(&coarse.force, &coarse.deflection) / exact - 1.0,
        ]
    }

    #[test]
    fn the_loss_does_not_hang_on_where_in_its_cell_the_contact_ends() {
        // strongly coupled surfaces with a longer memory have a layer at the touch that no edge describes
        let longest = [(0.1, 5), (1.0, 5), (5.0, 3)];
        for (coupling, cases) in longest {
            for memory in [1e-4, 1e-3, 5e-3, 2e-2, 5e-2].into_iter().take(cases) {
                let found: Vec<[f64; 2]> = (0..8)
                    .map(|i| errors(coupling, memory, 26.0 + 0.125 * f64::from(i)))
                    .collect();
                let largest = |k: usize| found.iter().fold(0.0, |a: f64, e| a.max(e[k].abs()));
                println!(
                    "coupling {coupling}, memory {memory} of the contact: {:.1e}, of the march's own deflection {:.1e}",
                    largest(0),
                    largest(1)
                );
                assert!(largest(0) < 2e-3, "{coupling} {memory}: {found:?}");
                assert!(
                    2.0 * largest(0) < largest(1),
                    "{coupling} {memory}: {found:?}"
                );
            }
        }
    }

    #[test]
    fn the_weights_of_the_lag_are_exact_for_its_moments() {
        let response = SurfaceResponse::new(&Medium::new(0.25).unwrap(), Deflection::Mean);
        let relaxation = Relaxation::of(&response, 1.0, 2.0 / response.memory());
        let weights = delayed_weights(&relaxation);
        // p = (2 + s)^k at s = -2 .. 2: L(0) = sum_j (-1)^j p^(j+1)(0) M_j/j!
        let [m0, m1, m2, m3] = relaxation.moments;
        let exact = [
            0.0,
            m0,
            4.0 * m0 - 2.0 * m1,
            12.0 * m0 - 12.0 * m1 + 3.0 * m2,
        ];
        let quartic = 32.0 * m0 - 48.0 * m1 + 24.0 * m2 - 4.0 * m3;
        for (k, exact) in exact.into_iter().chain([quartic]).enumerate() {
            let found: f64 = (0..5).map(|i| weights[i] * (i as f64).powi(k as i32)).sum();
            assert!(
                (found - exact).abs() < 1e-12 * quartic.abs(),
                "{k}: {found} {exact}"
            );
        }
    }
}
