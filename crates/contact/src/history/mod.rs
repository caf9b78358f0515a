//! The history of a contact: samples of a march, or pieces, which `resample` reads at any time.

pub(crate) mod resample;

use crate::growing::solved::SolvedContact;
use crate::units::INVERSE_MASS;
use std::sync::Arc;

/// The end of the first contact, as the last samples in contact tell it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Separation {
    /// When the force is zero.
    pub(crate) time: f64,
    /// Uncertainty of `time` for steps longer than the memory.
    pub(crate) uncertainty: f64,
    /// Impulse from the third sample before the first free one until then.
    pub(crate) impulse: f64,
}

/// Samples of a march, a step apart, from the first touch until the striker has left for good, or a contact solved by pieces.
///
/// In collision units.
#[derive(Debug, Clone, Default)]
pub struct History {
    /// Time between samples.
    pub step: f64,
    /// Contact force.
    pub force: Vec<f64>,
    /// Displacement of the striker.
    pub displacement: Vec<f64>,
    /// Deflection of the half-space that enters the contact law.
    pub deflection: Vec<f64>,
    /// Error of the trapezoidal rule in the impulse at the touch.
    pub(crate) start: f64,
    /// Velocity, if the scheme computes it; empty otherwise.
    pub(crate) velocity: Vec<f64>,
    /// Compliance of the newest sample: d - w + compliance * p is smooth through the end of contact.
    pub(crate) compliance: f64,
    /// Elastic part of it, that of the surface.
    pub(crate) elastic: f64,
    /// End of the first contact, if the march computes it.
    pub(crate) separation: Option<Separation>,
    /// Work on the half-space, if the march computes it.
    pub(crate) dissipated: Option<f64>,
    /// The contact itself where it was solved by pieces; there are no samples then.
    pub pieces: Option<Arc<SolvedContact>>,
    /// Estimated error of the force at any instant, over the largest force; infinite if there is no estimate.
    pub error: f64,
}

impl History {
    /// At the touch.
    pub(crate) fn at_touch(step: f64) -> Self {
        let mut history = Self::default();
        history.restart(step);
        history
    }

    /// Removes all samples, and keeps their memory.
    pub(crate) fn restart(&mut self, step: f64) {
        let begun = |samples: &mut Vec<f64>| {
            samples.clear();
            samples.push(0.0);
            std::mem::take(samples)
        };
        *self = Self {
            step,
            force: begun(&mut self.force),
            displacement: begun(&mut self.displacement),
            deflection: begun(&mut self.deflection),
            error: f64::INFINITY,
            ..Self::default()
        };
    }

    /// Of a contact that was solved by pieces: it has no samples, [`Resampler`](crate::Resampler) reads the pieces.
    pub fn of_pieces(solved: &SolvedContact) -> Self {
        Self {
            error: solved.estimates.force,
            pieces: Some(Arc::new(solved.clone())),
            ..Self::default()
        }
    }

    #[inline]
    pub(crate) fn push(&mut self, force: f64, displacement: f64, deflection: f64) {
        self.force.push(force);
        self.displacement.push(displacement);
        self.deflection.push(deflection);
    }

    /// Mean velocity over the last step.
    pub(crate) fn last_velocity(&self) -> f64 {
        match self.displacement[..] {
            [.., before, last] => (last - before) / self.step,
            _ => 1.0,
        }
    }

    /// int_0^{t_k} p dt for a sample k that has two neighbours on both sides, error O(h^4).
    pub(crate) fn impulse_until(&self, k: usize) -> f64 {
        let sum: f64 = self.force[..k].iter().sum::<f64>() + 0.5 * self.force[k];
        self.impulse_from_sum(k, sum)
    }

    fn impulse_from_sum(&self, k: usize, sum: f64) -> f64 {
        let at = |i: usize| self.force.get(i).copied().unwrap_or(0.0);
        // h p' by central differences
        let slope = match k {
            0 => return 0.0,
            1 => 0.5 * (at(2) - at(0)),
            _ => (8.0 * (at(k + 1) - at(k - 1)) - (at(k + 2) - at(k - 2))) / 12.0,
        };
        self.step * (sum - slope / 12.0) + self.start
    }

    /// Velocity of the striker at every sample.
    pub fn velocities(&self) -> Vec<f64> {
        if !self.velocity.is_empty() {
            return self.velocity.clone();
        }
        let mut sum = 0.0;
        let mut velocity = Vec::with_capacity(self.force.len());
        for (k, &p) in self.force.iter().enumerate() {
            velocity.push(1.0 - INVERSE_MASS * self.impulse_from_sum(k, sum + 0.5 * p));
            sum += p;
        }
        velocity
    }
}
