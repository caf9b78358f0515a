//! The equations of a piece of a contact that yields, and a guess of what solves them.

use crate::growing::arrivals::{Arrival, Departure};
use crate::growing::equations::{Independent, Values};
use crate::growing::polynomial::{LARGEST, Polynomial, dot};
use crate::growing::waves::GrowingContact;
use crate::plastic::branch::Local;
use crate::plastic::march::{March, Motion, Waves};
use crate::units::INVERSE_MASS;

/// The equations of a piece.
pub(crate) struct Problem<'m, 'a> {
    pub(crate) march: &'m March<'a>,
    pub(crate) known: Independent,
    pub(crate) given: Polynomial,
}

impl Problem<'_, '_> {
    /// What follows from values of what is sought, and the residuals; `departures` are those of a motion nearby, or empty.
    pub(crate) fn residual(
        &self,
        sought: &Values,
        departures: &mut Vec<Departure>,
    ) -> (Motion, [f64; LARGEST]) {
        let March {
            nodes,
            state,
            branch,
            ..
        } = self.march;
        let n = nodes.degree;
        let (mut given, mut given_slope) = ([0.0; LARGEST + 1], [0.0; LARGEST + 1]);
        let mut sought_slope = [0.0; LARGEST + 1];
        for (i, &s) in nodes.places.iter().enumerate() {
            (given[i], given_slope[i]) = self.given.jet(s);
        }
        for i in 1..=n {
            sought_slope[i] = dot(nodes.slope_row(i), &sought[..=n]);
        }
        let (time, radius, time_slope, radius_slope) = match self.known {
            Independent::Time => (given, *sought, given_slope, sought_slope),
            Independent::Radius => (*sought, given, sought_slope, given_slope),
        };
        let mut motion = Motion {
            time,
            radius,
            time_slope,
            radius_slope,
            velocity: [state.velocity; LARGEST + 1],
            force: [0.0; LARGEST + 1],
        };
        let lag = self.march.lag();
        let start = branch.at(state.radius);
        motion.force[0] = start.force + lag * start.stiffness.powi(2) * state.velocity;
        let mut impulse = [0.0; LARGEST];
        let mut local = [start; LARGEST];
        for j in 1..=n {
            let here = branch.at(motion.radius[j].max(0.0));
            local[j - 1] = here;
            let damped = lag * here.stiffness.powi(2) * here.depth_slope * motion.radius_slope[j];
            impulse[j - 1] = here.force * motion.time_slope[j] + damped;
            let rate = if damped == 0.0 {
                0.0
            } else {
                damped / motion.time_slope[j]
            };
            motion.force[j] = here.force + rate;
        }
        let mut residual = [0.0; LARGEST];
        for i in 1..=n {
            motion.velocity[i] -= INVERSE_MASS * dot(nodes.integral_row(i), &impulse[..n]);
            residual[i - 1] = motion.velocity[i] * motion.time_slope[i]
                - local[i - 1].depth_slope * motion.radius_slope[i];
        }
        if let Waves::Memory(contact) = self.march.waves {
            self.remember(&contact, &motion, &local, departures, &mut residual);
        }
        (motion, residual)
    }

    /// The part of the memory: phi (s_a a' - S T').
    fn remember(
        &self,
        contact: &GrowingContact<'_>,
        motion: &Motion,
        local: &[Local],
        departures: &mut Vec<Departure>,
        residual: &mut [f64; LARGEST],
    ) {
        let March {
            nodes,
            state,
            branch,
            past,
            offsets,
            offset,
            ..
        } = self.march;
        let n = nodes.degree;
        if !motion.time[..=n].iter().all(|t| t.is_finite()) {
            residual[0] = f64::NAN;
            return;
        }
        let rule = contact.waves.rule(self.march.level());
        let size = rule.delays.len();
        let delays: Vec<f64> = rule
            .delays
            .iter()
            .map(|delay| delay * contact.wave_time)
            .collect();
        let again = departures.len() == n * size;
        departures.resize(n * size, Departure::default());
        let time_of = nodes.polynomial(&motion.time[..=n]);
        let radius_of = nodes.polynomial(&motion.radius[..=n]);
        for i in 1..=n {
            let arrival = Arrival {
                time_of: &time_of,
                radius_of: &radius_of,
                from: (state.time, state.radius),
                place: nodes.places[i],
                time: motion.time[i],
            };
            let found = &mut departures[(i - 1) * size..i * size];
            arrival.departures(past, &delays, again, found);
            let here = branch.delayed(motion.radius[i].max(0.0)) + offset;
            let sum: f64 = rule
                .rates
                .iter()
                .zip(found.iter())
                .map(|(rate, left)| {
                    let (law, shift) = match self.march.stretches.get(left.piece) {
                        Some(stretch) => (&stretch.branch, offsets[left.piece]),
                        None => (branch, *offset),
                    };
                    rate * (here - law.delayed(left.radius.max(0.0)) - shift)
                })
                .sum();
            let punches = local[i - 1].punch_slope * motion.radius_slope[i];
            residual[i - 1] +=
                contact.target_share * (punches - sum / contact.wave_time * motion.time_slope[i]);
        }
    }

    /// The law without waves along what is given, as a guess; or a power law of the time left.
    pub(crate) fn guess(&self, law: Option<(f64, f64)>) -> Values {
        let March {
            nodes,
            state,
            branch,
            ..
        } = self.march;
        let mut guess = [0.0; LARGEST + 1];
        let (mut time, mut radius, mut v) = (state.time, state.radius, state.velocity);
        if self.known == Independent::Radius && self.given.jet(0.5).1 < 0.0 {
            v = v.min(0.0);
        }
        guess[0] = match self.known {
            Independent::Time => radius,
            Independent::Radius => time,
        };
        for (value, &s) in guess.iter_mut().zip(&nodes.places).skip(1) {
            let here = branch.at(radius);
            match self.known {
                Independent::Time => {
                    let step = self.given.value(s) - time;
                    let slope = |a: f64, v: f64| v / branch.at(a).depth_slope.max(1e-12);
                    let half = v - 0.5 * step * INVERSE_MASS * here.force;
                    radius += step * slope(radius + 0.5 * step * slope(radius, v), half);
                    v -= step * INVERSE_MASS * branch.at(radius).force;
                    time += step;
                    *value = radius;
                }
                Independent::Radius => {
                    let next = self.given.value(s).max(0.0);
                    let there = branch.at(next);
                    let moved = there.depth - here.depth;
                    let energy = v * v - INVERSE_MASS * moved * (here.force + there.force);
                    let after = energy.max(0.01 * v * v).sqrt().copysign(moved);
                    if moved != 0.0 {
                        time += 2.0 * moved / (v + after);
                        v = after;
                    }
                    radius = next;
                    *value = match law {
                        None => time,
                        Some((left, power)) => {
                            state.time + left * (1.0 - (next / state.radius).powf(power))
                        }
                    };
                }
            }
        }
        guess
    }
}
