//! The work of a growing contact on the half-space by superposition of the punches that carry its load.
//!
//! The increment of load at t' leaves a deflection that is missing until its waves have crossed its punch,
//! w = -phi int V_p du. Since p is zero at both ends, the work on it is the sum over the increments of what they meet,
//!
//! ```text
//! (5/2) int p dw = (5/2) phi int du(t') int [p(t' + tau a(t') x) - p(t')] (-V_p'(x)) dx
//! ```
//!
//! -V_p' dx is the distribution of the times at which the waves pass, of mass one.
//! Force and radius alone enter: neither the velocity of the striker nor the equation that the pieces solve, so that
//! this work and the momentum are independent of each other.
//!
//! Theory: `docs/theory.md` (T47, T56).

use crate::growing::solved::SolvedContact;
use crate::numeric::quadrature::{GAUSS_4, GAUSS_8, LocalPolynomial, gauss};
use crate::numeric::work::work;
use crate::waves::punch::GrowingContact;
use std::f64::consts::PI;

/// Samples of the contact, in the angle in which it is smooth at both ends, and the rule over the waves: for
/// tolerances down to [`COARSE_TOLERANCE`] and below.
const SAMPLES_OF_CONTACT: [usize; 2] = [48, 192];
const LEVELS_OF_RULE: [usize; 2] = [1, 3];
const COARSE_TOLERANCE: f64 = 1e-5;

/// Work of a contact that was solved on the half-space, relative to the kinetic energy before, by superposition of the
/// punches that carry its load: independent of the striker's momentum.
///
/// Relative error: 1e-3 for tolerances down to 1e-5, 2e-5 below, in addition to the error of the force; for memories up
/// to the length of the contact.
pub fn work_on_half_space(
    contact: &GrowingContact<'_>,
    solved: &SolvedContact,
    tolerance: f64,
) -> f64 {
    let choice = usize::from(tolerance < COARSE_TOLERANCE);
    let (samples, rule) = (
        SAMPLES_OF_CONTACT[choice],
        contact.waves.rule(LEVELS_OF_RULE[choice]),
    );
    let points = [&GAUSS_4[..], &GAUSS_8[..]][choice];
    let duration = solved.summary.contact_time;
    let time_of = |i: usize| duration * (0.5 * PI * (i as f64 / samples as f64)).sin().powi(2);
    let radii: Vec<f64> = (0..=samples)
        .map(|i| solved.radius(time_of(i).min(duration)))
        .collect();
    // the force at a time, zero after the contact
    let force_at = |time: f64| {
        let part = time / duration;
        if part >= 1.0 {
            return 0.0;
        }
        let place = 2.0 * part.sqrt().asin() / PI * samples as f64;
        let from = (place as usize).saturating_sub(1).min(samples - 3);
        let radius = LocalPolynomial::<4>::at(&radii, from).value(place - from as f64);
        radius.max(0.0).powi(3)
    };
    let met: Vec<f64> = (0..=samples)
        .map(|i| {
            let (time, force) = (time_of(i), radii[i].powi(3));
            let crossing = contact.wave_time * radii[i];
            let reach = (duration - time) / crossing.max(f64::MIN_POSITIVE);
            let more = |x: f64| force_at(time + crossing * x) - force;
            // a wave of delay X passes at any time up to it alike; after the contact there is no force
            rule.iter()
                .map(|&(delay, rate)| {
                    let until = delay.min(reach);
                    let pressed = gauss(points, 0.0, until, more);
                    rate * (pressed - force * (delay - until))
                })
                .sum()
        })
        .collect();
    let indentation: Vec<f64> = radii.iter().map(|a| a * a).collect();
    contact.target_share * work(&met, &indentation)
}
