//! The equations of a piece of a contact that yields, and a guess of what solves them.

use crate::growing::arrivals::{Arrival, Departure, Piece};
use crate::growing::equations::{Independent, State, Values};
use crate::growing::nodes::Nodes;
use crate::growing::polynomial::{LARGEST, Polynomial, dot};
use crate::growing::waves::GrowingContact;
use crate::plastic::branch::Branch;
use crate::plastic::branch::Local;
use crate::units::INVERSE_MASS;

/// How the half-space answers.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Waves<'a> {
    /// At once, with a lag c.
    Dashpot(f64),
    /// By its memory.
    Memory(GrowingContact<'a>),
}

/// A contact until now.
pub(crate) struct Course<'a> {
    pub(crate) waves: Waves<'a>,
    /// Level of the rule over the waves.
    pub(crate) level: usize,
    pub(crate) nodes: &'static Nodes,
    /// The pieces, the branches that they follow and the constants of their g.
    pub(crate) past: Vec<Piece>,
    pub(crate) laws: Vec<(Branch, f64)>,
    pub(crate) state: State,
    pub(crate) branch: Branch,
    pub(crate) offset: f64,
}

impl Course<'_> {
    pub(crate) fn lag(&self) -> f64 {
        match self.waves {
            Waves::Dashpot(lag) => lag,
            Waves::Memory(_) => 0.0,
        }
    }
}

/// Time, radius and what follows from them at 0 and the nodes; slopes with respect to the place.
#[derive(Clone, Copy, Default)]
pub(crate) struct Motion {
    pub(crate) time: Values,
    pub(crate) radius: Values,
    pub(crate) time_slope: Values,
    pub(crate) radius_slope: Values,
    pub(crate) velocity: Values,
    pub(crate) force: Values,
}

/// The equations of a piece.
pub(crate) struct Problem<'m, 'a> {
    pub(crate) course: &'m Course<'a>,
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
        let Course {
            nodes,
            state,
            branch,
            ..
        } = self.course;
        let n = nodes.degree;
        let (mut given, mut given_slope) = ([0.0; LARGEST + 1], [0.0; LARGEST + 1]);
        let mut sought_slope = [0.0; LARGEST + 1];
        for (i, &s) in nodes.places.iter().enumerate() {
            (given[i], given_slope[i]) = self.given.jet(s);
        }
        for (i, slope) in sought_slope.iter_mut().enumerate().take(n + 1).skip(1) {
            *slope = dot(nodes.slope_row(i), &sought[..=n]);
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
        let lag = self.course.lag();
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
        if let Waves::Memory(contact) = self.course.waves {
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
        let Course {
            nodes,
            state,
            branch,
            past,
            laws,
            offset,
            ..
        } = self.course;
        let n = nodes.degree;
        if !motion.time[..=n].iter().all(|t| t.is_finite()) {
            residual[0] = f64::NAN;
            return;
        }
        let rule = contact.waves.rule(self.course.level);
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
            let own = (*branch, *offset);
            let sum: f64 = rule
                .rates
                .iter()
                .zip(found.iter())
                .map(|(rate, left)| {
                    let (law, shift) = laws.get(left.piece).unwrap_or(&own);
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
        let Course {
            nodes,
            state,
            branch,
            ..
        } = self.course;
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
