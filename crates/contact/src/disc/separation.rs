//! The end of contact on a disc of fixed radius, and the work left in a half-space whose memory is short.
//!
//! The contact ends where the displacement d, which is smooth, meets the deflection w that the surface keeps
//! from the force before.
//! There the force goes to zero with the power 3/2 and w, which is close to -c p', with its root, so a step longer
//! than the memory sees neither.
//! With s the time before the end and p(0) = 0, two integrations by parts leave an integral over the memory m only,
//!
//! ```text
//! w(end) = coupling int_0^m (1 - W) p'(s) ds = coupling int_0^m K(s) p''(s) ds,   K(s) = int_s^m (1 - W)
//! ```
//!
//! where p(s) is that of an [`Edge`] through the last samples.
//!
//! The work is
//!
//! ```text
//! work = 5/2 coupling int p' L dt,     L(t) = int_0^m (1 - W(s)) p'(t - s) ds
//! ```
//!
//! relative to the kinetic energy before, m the memory.
//! Next to the touch and to the end the integral is that of an [`Edge`].
//! Between them p' and L are those of the polynomial through five samples, L with the moments of 1 - W,
//! and the sum over the samples has the weights of Gregory for its ends.
//! The work of the march's own deflection, [`work`](crate::numeric::work::work), has an error of h^2 log h instead, with
//! a factor that depends on where in its cell the contact ends.
//!
//! Theory: `docs/theory.md` (T45, T46).

use crate::disc::edge::{Edge, RESOLVED, Relaxation};
use crate::disc::measured::first_separation;
use crate::history::{History, Separation};
use crate::numeric::linear::dot;
use crate::numeric::quadrature::LocalPolynomial;

/// Search interval for the separation; the last sample in contact is unreliable, and the one before it may be.
const EARLIEST: f64 = 2.5;
const LATEST: f64 = 5.0;

/// Improvements of a first guess at most, and the last one's size in steps; each gains more than a digit.
const MOST_ITERATIONS: usize = 4;
const LAST_IMPROVEMENT: f64 = 1e-3;

/// Overestimate of the residual deflection for steps longer than the memory, relative to the coupling and the root of the
/// memory, and its uncertainty, relative to itself.
///
/// Measured by `the_end_is_known_at_steps_longer_than_the_memory` below, on couplings of 1 to 10 and memories of 1e-4 to 1e-3
/// of the contact: it fails at 0.2 and at 0.5, and at an uncertainty of 0.25.
const UNSEEN: f64 = 1.0 / 3.0;
const UNCERTAIN: f64 = 0.5;

/// The end of the first contact, where the last samples tell it.
fn separation(
    history: &History,
    relaxation: &Relaxation<impl Fn(f64) -> f64>,
) -> Option<Separation> {
    let (step, end) = (history.step, first_separation(&history.force));
    if end < 5 || end + 1 > history.displacement.len() || relaxation.memory > RESOLVED {
        return None;
    }
    let displacement = LocalPolynomial::<5>::at(&history.displacement, end - 4);
    if displacement.value(EARLIEST) <= 0.0 || displacement.value(LATEST) >= 0.0 {
        return None;
    }
    // place of the end in steps from the sample `end - 4`; first as if the surface kept nothing
    let mut place = displacement.root(EARLIEST, LATEST);
    // two to four samples before the first free one: the newest is too close to the end to tell its shape
    let roots: [f64; 3] = std::array::from_fn(|i| history.force[end - 2 - i].cbrt());
    let at = |place: f64| Edge::new(history.elastic, roots, [place - 2.0, place - 1.0, place]);
    let unseen = relaxation.coupling
        * (relaxation.memory * step).sqrt()
        * (1.0 - relaxation.memory.sqrt()).max(0.0);
    let mut correction = 0.0;
    for _ in 0..MOST_ITERATIONS {
        let edge = at(place)?;
        let [value, slope, _] = displacement.jet(place);
        if slope >= 0.0 {
            return None;
        }
        let kept = relaxation.coupling * relaxation.kept(&edge);
        correction = UNSEEN * unseen * kept / slope;
        let next = (place - (value - kept) / slope - correction).clamp(EARLIEST, LATEST);
        let change = (next - place).abs();
        place = next;
        if change < LAST_IMPROVEMENT {
            break;
        }
    }
    let edge = at(place)?;
    Some(Separation {
        uncertainty: UNCERTAIN * correction.abs() * step,
        time: ((end - 4) as f64 + place) * step,
        impulse: edge.impulse(roots[1]) * step,
    })
}

/// First sample of the sum.
const FIRST_SAMPLE: usize = 3;

/// Gregory's weights of the first and last samples, exact for cubics, and the samples that they need.
const GREGORY: [f64; 3] = [3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0];
const NEEDED_SAMPLES: usize = 6;

/// First to fourth derivative in the middle of five samples.
const DERIVATIVES: [[f64; 5]; 4] = [
    [1.0 / 12.0, -2.0 / 3.0, 0.0, 2.0 / 3.0, -1.0 / 12.0],
    [-1.0 / 12.0, 4.0 / 3.0, -2.5, 4.0 / 3.0, -1.0 / 12.0],
    [-0.5, 1.0, 0.0, -1.0, 0.5],
    [1.0, -4.0, 6.0, -4.0, 1.0],
];

/// How many steps before the end the samples between end at least: two further are needed, the last ones are known badly.
const BEFORE_END: f64 = 2.75;

impl History {
    /// Finds the end of the first contact and, where there is no other, the work that is left in the half-space.
    pub(crate) fn separate(&mut self, relaxation: &Relaxation<impl Fn(f64) -> f64>) {
        self.separation = separation(self, relaxation);
        self.dissipated = self.work_on(relaxation);
    }

    /// Work of one contact, relative to the kinetic energy before.
    ///
    /// Nothing for several contacts, those of few steps, and where the samples at both ends are not those of an edge.
    pub(crate) fn work_on(&self, relaxation: &Relaxation<impl Fn(f64) -> f64>) -> Option<f64> {
        let (p, elastic) = (&self.force, self.elastic);
        let mut after = p.iter().skip(first_separation(p));
        if after.any(|&p| p > 0.0) {
            return None;
        }
        let steps = self.separation?.time / self.step;
        let last = (steps - BEFORE_END) as usize;
        let rest = steps - last as f64;
        let roots = |from: usize| {
            let samples = p.get(from..from + 3)?;
            Some([0, 1, 2].map(|i: usize| samples[i].cbrt()))
        };
        let (first, [r0, r1, r2]) = (roots(1)?, roots(last)?);
        let touch = Edge::new(elastic, first, [1.0, 2.0, 3.0])?;
        let leave = Edge::new(elastic, [r2, r1, r0], [rest - 2.0, rest - 1.0, rest])?;
        if last + 1 < FIRST_SAMPLE + NEEDED_SAMPLES {
            return None;
        }
        let edges = relaxation.taken(&touch, first[2], false) + relaxation.taken(&leave, r0, true);
        let delayed = delayed_weights(relaxation);
        let rate = |n: usize| {
            let samples = &p[n - 2..n + 3];
            dot(samples, &DERIVATIVES[0]) * dot(samples, &delayed)
        };
        let end =
            |(i, weight): (usize, &f64)| (1.0 - weight) * (rate(FIRST_SAMPLE + i) + rate(last - i));
        let ends: f64 = GREGORY.iter().enumerate().map(end).sum();
        let middle = (FIRST_SAMPLE..=last).map(rate).sum::<f64>() - ends;
        Some(2.5 * relaxation.coupling * (edges + middle))
    }
}

/// L in the middle of five samples: sum_k (-1)^k M_k/k! p^(k+1), M_k the moments of 1 - W.
fn delayed_weights(relaxation: &Relaxation<impl Fn(f64) -> f64>) -> [f64; 5] {
    let [m0, m1, m2, m3] = relaxation.moments;
    if relaxation.is_short() {
        return DERIVATIVES[0].map(|weight| m0 * weight);
    }
    let factors = [m0, -m1, m2 / 2.0, -m3 / 6.0];
    std::array::from_fn(|i| dot(&factors, &DERIVATIVES.map(|derivative| derivative[i])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disc::FixedDisc;
    use crate::disc::implicit::march_implicit;
    use crate::law::quasi_static::expected_contact_time;
    use crate::numeric::work::work;
    use crate::settings::StaticShare;
    use crate::summary::Summary;
    use halfspace::{Deflection, Medium, SurfaceResponse};

    /// A step resolves the memory of the half-space least of all, so its whole effect is at the end.
    #[test]
    fn the_end_is_known_at_steps_longer_than_the_memory() {
        for (nu, deflection) in [
            (0.0, Deflection::Centre),
            (0.3, Deflection::Centre),
            (0.4, Deflection::Centre),
            (0.3, Deflection::Mean),
        ] {
            let response = SurfaceResponse::new(&Medium::new(nu).unwrap(), deflection);
            for (coupling, memory) in [(1.0, 1e-3), (3.0, 4e-4), (10.0, 1e-4)] {
                let duration = expected_contact_time(coupling);
                let impact = FixedDisc {
                    response: &response,
                    coupling,
                    wave_time: memory * duration / response.disc.memory,
                    share: StaticShare::Full,
                };
                let march = |steps: f64| march_implicit(&impact, duration / steps).unwrap();
                let exact = Summary::new(&march(40.0 / memory)).unwrap().contact_time;
                for steps in [130.0, 260.0, 520.0] {
                    let found = march(steps).separation.unwrap();
                    let error = (found.time - exact).abs() / exact;
                    let uncertainty = found.uncertainty / exact;
                    println!(
                        "nu {nu}, coupling {coupling}, memory {memory}, {steps} steps: error {error:.1e}, uncertainty {uncertainty:.1e} of the contact",
                    );
                    assert!(error < uncertainty.max(2e-5 / steps));
                }
            }
        }
    }

    /// Relative errors of the work of a march and of that of its own deflection, against a march of 4,096 steps.
    fn errors(coupling: f64, memory: f64, steps: f64) -> [f64; 2] {
        let response = SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Centre);
        let duration = expected_contact_time(coupling);
        let impact = FixedDisc {
            response: &response,
            coupling,
            wave_time: memory * duration / response.disc.memory,
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
        let relaxation = Relaxation::of(&response, 1.0, 2.0 / response.disc.memory);
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
