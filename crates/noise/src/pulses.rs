//! Spectra of contact forces, for many impacts from few solved ones.
//!
//! The force of an impact is its impulse times a pulse of unit area, whose time is divided by the contact time. The shape of this
//! pulse depends on the law, on radiation and on flow, which all show in the time of its peak over the contact time: a few solved
//! contacts, equidistant in it, serve all impacts, linearly between two of them. Other solved contacts measure the error.

use crate::spacing::cubic;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// An impact as a sweep computes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blow {
    /// Integral of the force in N s.
    pub impulse_n_s: f64,
    /// Duration in s.
    pub contact_time_s: f64,
    /// Time of the largest force over the duration.
    pub peak_at: f64,
    /// Energy radiated as waves in J.
    pub radiated_energy_j: f64,
    /// Radius of contact in m at the largest force.
    pub contact_radius_m: f64,
}

/// Contacts that are solved as nodes, at most.
const NODES: usize = 33;

/// Contacts drawn from all, in addition to those between the nodes, which measure the error.
const DRAWN_CHECKS: usize = 16;

/// Frequencies times contact time: cubic interpolation between their steps is within 2e-6, and at the end, beyond which a force has
/// no power, its power is below 1e-9 of that at low frequencies (`a_pulse_has_hertz_spectrum`).
const STEP: f64 = 1.0 / 32.0;
const END: f64 = 32.0;

/// Nodes of the midpoint rule over a pulse; half as many change no digit that counts (`a_pulse_has_hertz_spectrum`).
const INTEGRATED: usize = 1024;

/// The spectrum of one pulse of unit area, at multiples of a step from the first negative one on, with time from half of the
/// contact.
#[derive(Debug, Clone)]
pub struct Pulse(Vec<Complex64>);

impl Pulse {
    /// Of the force as a function of time over the contact time, until it is zero for good.
    pub fn new(force: impl Fn(f64) -> f64, end: f64) -> Self {
        let mut samples = Vec::with_capacity(INTEGRATED);
        let mut area = 0.0;
        for i in 0..INTEGRATED {
            // a cosine's steps: the force begins and ends like a power 3/2
            let angle = PI * (i as f64 + 0.5) / INTEGRATED as f64;
            let time = 0.5 * end * (1.0 - angle.cos());
            let weighted = angle.sin() * force(time);
            area += weighted;
            samples.push((time - 0.5, weighted));
        }
        let count = (END / STEP) as usize + 4;
        let mut values = vec![Complex64::default(); count];
        for (time, weighted) in samples {
            let step = Complex64::from_polar(1.0, -TAU * STEP * time);
            let mut term = weighted / area * step.conj();
            for value in &mut values {
                *value += term;
                term *= step;
            }
        }
        Self(values)
    }

    /// At a frequency times contact time.
    fn at(&self, place: f64) -> Complex64 {
        let place = place / STEP;
        if place.is_nan() || place >= END / STEP {
            return Complex64::default();
        }
        let first = place as usize;
        let weights = cubic(place - first as f64);
        let terms = self.0[first..].iter().zip(weights);
        terms.map(|(value, weight)| value * weight).sum()
    }
}

/// The spectra of all impacts.
#[derive(Debug)]
pub struct Pulses {
    nodes: Vec<Pulse>,
    /// Node below each impact, and the weight of the node above it.
    places: Vec<(u32, f32)>,
    /// Impacts that were solved to measure the error.
    checks: Vec<(usize, Pulse)>,
}

impl Pulses {
    /// Of at least one impact; `solve` returns the pulse of the impact with a number.
    ///
    /// # Errors
    /// Those of `solve`.
    pub fn new<E>(
        blows: &[Blow],
        mut solve: impl FnMut(usize) -> Result<Pulse, E>,
    ) -> Result<Self, E> {
        let mut order: Vec<usize> = (0..blows.len()).collect();
        order.sort_by(|&a, &b| {
            blows[a]
                .peak_at
                .total_cmp(&blows[b].peak_at)
                .then(a.cmp(&b))
        });
        let peak = |place: usize| blows[order[place]].peak_at;
        let (low, high) = (peak(0), peak(order.len() - 1));
        let nearest = |part: f64| {
            let wanted = low + part * (high - low);
            let after = order.partition_point(|&i| blows[i].peak_at < wanted);
            let sides = [after.saturating_sub(1), after.min(order.len() - 1)];
            let off = |place: usize| (peak(place) - wanted).abs();
            if off(sides[0]) < off(sides[1]) {
                sides[0]
            } else {
                sides[1]
            }
        };
        let part = |i: usize, of: usize| (i as f64) / of.max(1) as f64;
        let mut chosen: Vec<usize> = (0..NODES).map(|i| nearest(part(i, NODES - 1))).collect();
        chosen.dedup_by_key(|&mut place| peak(place));
        let between = (0..chosen.len().saturating_sub(1))
            .map(|i| nearest(part(2 * i + 1, 2 * (chosen.len() - 1))));
        let drawn = (0..DRAWN_CHECKS.min(order.len()))
            .map(|i| i * order.len() / DRAWN_CHECKS.min(order.len()));
        let mut checked: Vec<usize> = between.chain(drawn).map(|place| order[place]).collect();
        checked.sort_unstable();
        checked.dedup();
        checked.retain(|&i| chosen.iter().all(|&place| order[place] != i));
        let peaks: Vec<f64> = chosen.iter().map(|&place| peak(place)).collect();
        let place_of = |blow: &Blow| {
            let above = peaks.partition_point(|&at| at < blow.peak_at);
            let node = above.clamp(1, peaks.len().max(2) - 1) - 1;
            let width = peaks.get(node + 1).map_or(1.0, |next| next - peaks[node]);
            (node as u32, ((blow.peak_at - peaks[node]) / width) as f32)
        };
        Ok(Self {
            places: blows.iter().map(place_of).collect(),
            nodes: chosen
                .iter()
                .map(|&place| solve(order[place]))
                .collect::<Result<_, E>>()?,
            checks: checked
                .into_iter()
                .map(|i| Ok((i, solve(i)?)))
                .collect::<Result<_, E>>()?,
        })
    }

    /// The pulse of a node.
    pub fn pulse(&self, node: usize) -> &Pulse {
        &self.nodes[node]
    }

    /// Number of contacts that were solved.
    pub fn solved(&self) -> usize {
        self.nodes.len() + self.checks.len()
    }

    /// The force spectrum of impact `i` in N s, with time from half of its contact.
    pub(crate) fn force(&self, i: usize, blow: &Blow, frequency_hz: f64) -> Complex64 {
        let (node, part) = self.places[i];
        let (node, part, place) = (
            node as usize,
            f64::from(part),
            frequency_hz * blow.contact_time_s,
        );
        let below = self.nodes[node].at(place);
        let found = match self.nodes.get(node + 1) {
            Some(above) => below + part * (above.at(place) - below),
            None => below,
        };
        blow.impulse_n_s * found
    }

    /// Relative error of the power of the forces at a frequency, from the solved contacts that are no nodes.
    pub(crate) fn error(&self, blows: &[Blow], frequency_hz: f64) -> f64 {
        let (mut off, mut all) = (0.0, f64::MIN_POSITIVE);
        for (i, pulse) in &self.checks {
            let blow = &blows[*i];
            let true_one = blow.impulse_n_s * pulse.at(frequency_hz * blow.contact_time_s);
            let power = true_one.norm_sqr();
            off += (power - self.force(*i, blow, frequency_hz).norm_sqr()).abs();
            all += power;
        }
        off / all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Direct integrals of sin^(3/2)(pi t) cos(2 pi y (t - 1/2)) by Gauss's rule; decay as y^(-5/2).
    #[test]
    fn a_pulse_has_hertz_spectrum() {
        // nearly Hertz's force: its indentation is a sine
        let pulse = Pulse::new(|t| (PI * t).sin().max(0.0).powf(1.5), 1.0);
        let direct = |y: f64| {
            let of = |t: f64, y: f64| (PI * t).sin().powf(1.5) * (TAU * y * (t - 0.5)).cos();
            let sum = |y: f64| -> f64 {
                let panels = (0..400).flat_map(|i| {
                    let end = |i: usize| 0.5 * (1.0 - (PI * i as f64 / 400.0).cos());
                    halfspace::gauss::rule(12).on(end(i), end(i + 1))
                });
                panels.map(|(t, weight)| weight * of(t, y)).sum()
            };
            sum(y) / sum(0.0)
        };
        for y in [0.0, 0.013, 0.5, 0.67, 1.9, 7.77, 21.3] {
            let (found, known) = (pulse.at(y), direct(y));
            assert!((found - known).norm() < 5e-6, "{y}: {found} {known}");
        }
        assert!(pulse.at(0.999 * END).norm_sqr() < 1e-9);
        assert_eq!(pulse.at(END), Complex64::default());
    }
}
