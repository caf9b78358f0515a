//! The end of contact on a disc of fixed radius.
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
//! Theory: `docs/theory.md` (T45).

use super::dissipation::dissipated;
use super::edge::{Edge, Ends};
use super::history::{History, Separation};
use super::relaxation::{RESOLVED, Relaxation};
use crate::quadrature::Local;
use crate::response::disc::DiscResponse;
use crate::summary::first_separation;

/// Search interval for the separation; the last sample in contact is unreliable, and the one before it may be.
const FIRST: f64 = 2.5;
const LAST: f64 = 5.0;

/// Improvements of a first guess at most, and the last one's size in steps; each gains more than a digit.
const ITERATIONS: usize = 4;
const ENOUGH: f64 = 1e-3;

/// Empirical overestimate of the residual deflection for steps longer than the memory, relative to the coupling and
/// the root of the memory; uncertain by half.
const UNSEEN: f64 = 1.0 / 3.0;
const UNCERTAIN: f64 = 0.5;

/// The end of the first contact, where the last samples tell it: `end` is the first free sample.
pub(crate) fn separation(
    history: &History,
    end: usize,
    relaxation: &Relaxation<impl Fn(f64) -> f64>,
) -> Option<Separation> {
    let step = history.step;
    if end < 5 || end + 1 > history.displacement.len() || relaxation.memory > RESOLVED {
        return None;
    }
    let displacement = Local::<5>::at(&history.displacement, end - 4);
    if displacement.value(FIRST) <= 0.0 || displacement.value(LAST) >= 0.0 {
        return None;
    }
    // place of the end in steps from the sample `end - 4`; first as if the surface kept nothing
    let mut place = displacement.root(FIRST, LAST);
    // two to four samples before the first free one: the newest is too close to the end to tell its shape
    let roots: [f64; 3] = std::array::from_fn(|i| history.force[end - 2 - i].cbrt());
    let at = |place: f64| Edge::new(history.elastic, roots, [place - 2.0, place - 1.0, place]);
    let unseen = relaxation.coupling
        * (relaxation.memory * step).sqrt()
        * (1.0 - relaxation.memory.sqrt()).max(0.0);
    let mut correction = 0.0;
    for _ in 0..ITERATIONS {
        let edge = at(place)?;
        let (value, slope) = displacement.value_and_slope(place);
        if slope >= 0.0 {
            return None;
        }
        let kept = relaxation.coupling * edge.kept(relaxation);
        correction = UNSEEN * unseen * kept / slope;
        let next = (place - (value - kept) / slope - correction).clamp(FIRST, LAST);
        let change = (next - place).abs();
        place = next;
        if change < ENOUGH {
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

impl History {
    /// Finds the end of the first contact and, where there is no other, the work that is left in the half-space.
    pub(crate) fn separate(&mut self, relaxation: &Relaxation<impl Fn(f64) -> f64>) {
        let end = first_separation(&self.force);
        self.separation = separation(self, end, relaxation);
        let again = self.force.iter().skip(end).any(|&p| p > 0.0);
        let found = self.separation.filter(|_| !again);
        self.ends = found.and_then(|f| Ends::of(&self.force, self.elastic, f.time / self.step));
        self.dissipated = dissipated(self, relaxation);
    }

    /// Work of the force on another deflection of the same disc, where that on its own is known and the steps do not
    /// resolve the memory of either.
    pub(crate) fn work_on(
        &self,
        response: &impl DiscResponse,
        coupling: f64,
        wave_time: f64,
    ) -> Option<f64> {
        let relaxation = Relaxation::of(response, coupling, wave_time / self.step);
        // beyond that it knows no more than its memory
        (relaxation.memory <= RESOLVED)
            .then(|| dissipated(self, &relaxation))
            .flatten()
    }
}

#[cfg(test)]
mod tests {
    use crate::disc::FixedDisc;
    use crate::law::quasi_static::expected_contact_time;
    use crate::march::implicit::march_implicit;
    use crate::settings::StaticShare;
    use crate::summary::Summary;
    use halfspace::{Deflection, Medium, SurfaceResponse};

    /// The memory of the half-space is what a step sees least of, so its whole effect is in the end.
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
                    wave_time: memory * duration / response.memory(),
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
}
