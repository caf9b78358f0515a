//! The equations of a piece at its nodes and their derivatives.
//!
//! Along a piece time T and radius a are functions of a place s in [0, 1]; one of them is known.
//!
//! ```text
//! (v - phi S) T' = (u_a - phi s_a) a',    S = sum_k (m_k/X_k) (g - g_k),    T_k + X_k a_k = t
//! v = v_0 - (5/4) int (p T' + c p_u^2 u_a a') ds
//! ```
//!
//! c is zero but for a half-space that answers at once, without waves, phi = 0.
//!
//! Indentation u, punches s, g = int ds/a and force p over the radius are those of a [`Law`]; Hertz's has u = s = a^2,
//! g = 2 a and p = a^3.

use crate::growing::arrivals::{Departure, Piece, departures};
use crate::growing::nodes::{Factors, Nodes};
use crate::growing::polynomial::{LARGEST, Polynomial, SIZE, dot};
use crate::growing::waves::GrowingContact;
use crate::plastic::branch::{Law, Local};
use crate::units::INVERSE_MASS;

/// What is known where a piece starts or ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct State {
    pub(crate) time: f64,
    pub(crate) radius: f64,
    pub(crate) velocity: f64,
    pub(crate) displacement: f64,
    /// Slope of the indentation a^2.
    pub(crate) slope: f64,
}

impl State {
    /// When the striker touches.
    pub(crate) const TOUCH: Self = Self {
        time: 0.0,
        radius: 0.0,
        velocity: 1.0,
        displacement: 0.0,
        slope: 1.0,
    };
}

/// What a piece is a function of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Independent {
    /// The radius is sought as a function of time.
    Time,
    /// The time is sought as a function of the radius, which falls.
    Radius,
}

/// What the equations of a piece are made of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Equations<'a> {
    pub(crate) contact: GrowingContact<'a>,
    pub(crate) nodes: &'a Nodes,
    /// The pieces before.
    pub(crate) pieces: &'a [Piece],
    pub(crate) start: State,
    pub(crate) law: Law,
    pub(crate) known: Independent,
    /// What is known: the time or the radius.
    pub(crate) given: Polynomial,
    /// The rule over the waves that is solved with, and the next finer one that corrects.
    pub(crate) rules: [&'a [(f64, f64)]; 2],
    /// Error that is allowed.
    pub(crate) accuracy: f64,
}

/// Time, radius and what follows from them at 0 and the nodes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion {
    pub(crate) time: [f64; SIZE],
    pub(crate) radius: [f64; SIZE],
    /// Slopes with respect to the place.
    pub(crate) time_slope: [f64; SIZE],
    pub(crate) radius_slope: [f64; SIZE],
    pub(crate) velocity: [f64; SIZE],
    /// The law at the nodes.
    pub(crate) local: [Local; LARGEST],
}

/// Residuals and what drives the radius at the nodes, with the departures of all waves to them.
#[derive(Debug, Default)]
pub(crate) struct Residual {
    pub(crate) value: [f64; LARGEST],
    drive: [f64; LARGEST],
    departures: Vec<Departure>,
    delays: Vec<f64>,
}

impl Equations<'_> {
    /// Polynomials of time and radius through values of what is sought.
    pub(crate) fn polynomials(&self, sought: &[f64; SIZE]) -> (Polynomial, Polynomial) {
        let sought = self.nodes.polynomial(sought);
        match self.known {
            Independent::Time => (self.given, sought),
            Independent::Radius => (sought, self.given),
        }
    }

    /// What follows from values of what is sought.
    pub(crate) fn motion(&self, sought: &[f64; SIZE]) -> Motion {
        let n = self.nodes.degree;
        let mut given = [0.0; SIZE];
        let (mut given_slope, mut sought_slope) = ([0.0; SIZE], [0.0; SIZE]);
        for (i, &s) in self.nodes.places.iter().enumerate() {
            (given[i], given_slope[i]) = self.given.jet(s);
        }
        for (i, slope) in sought_slope.iter_mut().enumerate().take(n + 1).skip(1) {
            *slope = dot(self.nodes.slope_row(i), &sought[..=n]);
        }
        let (time, radius, time_slope, radius_slope) = match self.known {
            Independent::Time => (given, *sought, given_slope, sought_slope),
            Independent::Radius => (*sought, given, sought_slope, given_slope),
        };
        let mut impulse = [0.0; LARGEST];
        let mut local = [Local::default(); LARGEST];
        for j in 1..=n {
            let here = self.law.branch.at(radius[j]);
            impulse[j - 1] = here.force * time_slope[j]
                + self.law.damping(&here) * here.depth_slope * radius_slope[j];
            local[j - 1] = here;
        }
        let mut velocity = [self.start.velocity; SIZE];
        for (i, v) in velocity.iter_mut().enumerate().take(n + 1).skip(1) {
            *v -= INVERSE_MASS * dot(self.nodes.integral_row(i), &impulse[..n]);
        }
        Motion {
            time,
            radius,
            time_slope,
            radius_slope,
            velocity,
            local,
        }
    }

    /// Residuals; on entry they are those of a nearby motion, or of none.
    pub(crate) fn residual(
        &self,
        rule: &[(f64, f64)],
        sought: &[f64; SIZE],
        motion: &Motion,
        residual: &mut Residual,
    ) {
        let n = self.nodes.degree;
        let GrowingContact {
            target_share,
            wave_time,
            ..
        } = self.contact;
        let (time_of, radius_of) = self.polynomials(sought);
        let size = rule.len();
        let again = residual.departures.len() == n * size;
        if !again {
            residual.departures = vec![Departure::default(); n * size];
            residual.delays = rule.iter().map(|(delay, _)| delay * wave_time).collect();
        }
        for i in 1..=n {
            let found = &mut residual.departures[(i - 1) * size..i * size];
            departures(
                self.pieces,
                [&time_of, &radius_of],
                (self.start.time, self.start.radius),
                [self.nodes.places[i], motion.time[i]],
                &residual.delays,
                again,
                found,
            );
            let delayed = self.law.delayed(motion.radius[i]);
            let parts = rule.iter().zip(found.iter());
            let sum: f64 = parts
                .map(|((_, rate), left)| rate * (delayed - self.law_of(left).delayed(left.radius)))
                .sum();
            let drive = motion.velocity[i] - target_share * sum / wave_time;
            let here = &motion.local[i - 1];
            let at_once = (1.0 - target_share) * here.punch_slope;
            let slope = at_once + (here.depth_slope - here.punch_slope);
            residual.value[i - 1] = drive * motion.time_slope[i] - slope * motion.radius_slope[i];
            residual.drive[i - 1] = drive;
        }
    }

    /// The law at a departure.
    fn law_of(&self, left: &Departure) -> &Law {
        let piece = self.pieces.get(left.piece);
        piece.map_or(&self.law, |piece| &piece.law)
    }

    /// Derivatives of the residuals with respect to what is sought, at the departures of the residual.
    pub(crate) fn jacobian(
        &self,
        rule: &[(f64, f64)],
        motion: &Motion,
        residual: &Residual,
        matrix: &mut Factors,
    ) {
        let n = self.nodes.degree;
        let size = rule.len();
        let velocity = self.velocity_by_impulse(motion);
        for i in 1..=n {
            let found = &residual.departures[(i - 1) * size..i * size];
            let here = &motion.local[i - 1];
            let slope = self.law.slope(motion.radius[i]);
            let (sums, own) = self.tension_row(rule, found, &residual.delays, slope);
            let slopes = self.nodes.slope_row(i);
            let line = matrix.row(i - 1);
            let tension = self.contact.target_share / self.contact.wave_time;
            let rest = 1.0 - self.contact.target_share;
            // what the indentation is more than the punches
            let more = here.depth_slope - here.punch_slope;
            let more_bend = here.bends[0] - here.bends[1];
            let damped = INVERSE_MASS * (self.law.damping(here) * here.depth_slope);
            for l in 1..=n {
                let by_velocity: f64 = match self.known {
                    Independent::Time => {
                        // the integral of what is a function of the radius
                        let spent = if l == i { damped } else { 0.0 };
                        self.nodes.integral_row(i)[l - 1] * velocity[(l - 1) * n + l - 1] - spent
                    }
                    Independent::Radius => {
                        let integral = self.nodes.integral_row(i);
                        (0..n).map(|j| integral[j] * velocity[j * n + l - 1]).sum()
                    }
                };
                let own = if l == i { own } else { 0.0 };
                let by_drive = by_velocity - tension * (own - sums[l]);
                line[l - 1] = by_drive * motion.time_slope[i]
                    + match self.known {
                        Independent::Time => {
                            let turn = if l == i { motion.radius_slope[i] } else { 0.0 };
                            let punches = here.punch_slope * slopes[l] + here.bends[1] * turn;
                            -rest * punches - (more * slopes[l] + more_bend * turn)
                        }
                        Independent::Radius => residual.drive[i - 1] * slopes[l],
                    };
            }
        }
    }

    /// Row j: what is sought in the impulse -(5/4) p T' of node j.
    fn velocity_by_impulse(&self, motion: &Motion) -> [f64; LARGEST * LARGEST] {
        let n = self.nodes.degree;
        let mut rows = [0.0; LARGEST * LARGEST];
        for j in 1..=n {
            let row = &mut rows[(j - 1) * n..j * n];
            let here = &motion.local[j - 1];
            match self.known {
                Independent::Time => row[j - 1] = -here.braking * motion.time_slope[j],
                Independent::Radius => {
                    let slopes = &self.nodes.slope_row(j)[1..];
                    for (entry, slope) in row.iter_mut().zip(slopes) {
                        *entry = -INVERSE_MASS * here.force * slope;
                    }
                }
            }
        }
        rows
    }

    /// Derivatives of S times the wave time at a node: with respect to what is sought at each node (with
    /// the sign turned) and, beside it, at the node itself, where g has a slope.
    fn tension_row(
        &self,
        rule: &[(f64, f64)],
        found: &[Departure],
        delays: &[f64],
        slope: f64,
    ) -> ([f64; SIZE], f64) {
        let mut sums = [0.0; SIZE];
        let mut basis = [0.0; SIZE];
        let mut own = 0.0;
        for ((left, &delay), &(_, rate)) in found.iter().zip(delays).zip(rule) {
            let speed = left.time_slope + delay * left.radius_slope;
            let there = rate * self.law_of(left).slope(left.radius);
            let weight = match self.known {
                // a_k follows the polynomial at its place, which moves
                Independent::Time => {
                    own += rate * slope;
                    there * left.time_slope / speed
                }
                Independent::Radius => {
                    own -= there * left.radius_slope / speed;
                    -there * left.radius_slope / speed
                }
            };
            if left.piece == self.pieces.len() {
                self.nodes.lagrange(left.place, &mut basis);
                for (sum, value) in sums.iter_mut().zip(&basis[..=self.nodes.degree]) {
                    *sum += weight * value;
                }
            }
        }
        (sums, own)
    }
}
