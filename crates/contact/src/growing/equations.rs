//! The equations of a piece at its nodes and their derivatives, solved by collocation and Newton's method.
//!
//! Along a piece time T and radius a are functions of a place s in [0, 1]; one of them is known.
//!
//! ```text
//! (v - w' - phi S) T' = (u_a - phi s_a) a',    S = sum_k (m_k/X_k) (g - g_k),    T_k + X_k a_k = t
//! v = v_0 - (5/4) int (p T' + c p_u^2 u_a a') ds
//! ```
//!
//! w' is the velocity of a surface that moves of itself, known before. c is zero but for a half-space that answers at once, without waves, phi = 0.
//!
//! Indentation u, punches s, g = int ds/a and force p over the radius are those of a [`Law`]; Hertz's has u = s = a^2,
//! g = 2 a and p = a^3.

use crate::growing::arrivals::{ContactPiece, Departure, State, departures};
use crate::growing::nodes::{LARGEST_DEGREE, Polynomial, RadauNodes, SIZE};
use crate::growing::surface::SurfaceMotion;
use crate::law::branch::{AtRadius, Law};
use crate::numeric::linear::{Factors, dot};
use crate::units::INVERSE_MASS;
use crate::waves::punch::GrowingContact;

/// A contact on its way.
#[derive(Debug)]
pub(crate) struct March<'a> {
    pub(crate) contact: GrowingContact<'a>,
    /// Error that a piece may leave: of the force, in the end of the time.
    pub(crate) accuracy: f64,
    pub(crate) nodes: &'static RadauNodes,
    pub(crate) pieces: Vec<ContactPiece>,
    /// Where they end.
    pub(crate) state: State,
    pub(crate) law: Law,
    /// The surface, where it moves of itself.
    pub(crate) surface: Option<&'a SurfaceMotion>,
    /// Of the rule over the waves.
    pub(crate) level: usize,
    /// Largest radius.
    pub(crate) widest: f64,
    /// int p (v - u') dt.
    pub(crate) dissipated: f64,
    pub(crate) errors: Errors,
}

/// Sums of the errors that the pieces estimate of themselves.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Errors {
    /// Largest of the force at a time.
    pub(crate) force: f64,
    /// Of the momentum.
    pub(crate) momentum: f64,
    /// Of the end of contact.
    pub(crate) end: f64,
    /// Of the work done on the half-space.
    pub(crate) work: f64,
}

/// Independent variable of a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Independent {
    /// The radius is sought as a function of time.
    Time,
    /// The time is sought as a function of the radius, which falls.
    Radius,
}

/// The next piece of a contact on its way.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Equations<'a> {
    pub(crate) march: &'a March<'a>,
    pub(crate) known: Independent,
    /// The known one of time and radius.
    pub(crate) given: Polynomial,
}

/// Time, radius and the velocity and law that follow from them, at 0 and the nodes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PieceMotion {
    pub(crate) time: [f64; SIZE],
    pub(crate) radius: [f64; SIZE],
    /// Slopes with respect to the place.
    pub(crate) time_slope: [f64; SIZE],
    pub(crate) radius_slope: [f64; SIZE],
    pub(crate) velocity: [f64; SIZE],
    /// The law at the nodes.
    pub(crate) local: [AtRadius; LARGEST_DEGREE],
}

/// Residuals and the drive of the radius at the nodes, with the departures of all waves to them.
#[derive(Debug, Default)]
pub(crate) struct Residual<'a> {
    /// The rule over the waves.
    pub(crate) rule: &'a [(f64, f64)],
    pub(crate) value: [f64; LARGEST_DEGREE],
    pub(crate) drive: [f64; LARGEST_DEGREE],
    pub(crate) departures: Vec<Departure>,
    pub(crate) delays: Vec<f64>,
}

/// A piece that solves its equations at its nodes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Solution {
    pub(crate) piece: ContactPiece,
    /// Largest radius at the nodes.
    pub(crate) widest: f64,
    /// int p (v - u') dt over the piece.
    pub(crate) dissipated: f64,
    /// Size of the last term of the polynomial of the unknown.
    pub(crate) truncated: f64,
    /// Change of the unknown by the finer rule over the waves.
    pub(crate) waves: f64,
    /// Values of the unknown at 0 and the nodes.
    pub(crate) sought: [f64; SIZE],
}

/// Newton's iterations at most.
const MOST_ITERATIONS: usize = 14;

/// Iterations after which each has to halve the change.
const SETTLED: usize = 6;

/// Error of the time that the last instants may have, over the accuracy.
const SLACK: f64 = 0.3;

/// Radius that is zero but for rounding.
const CLOSED: f64 = 1e-14;

impl Equations<'_> {
    /// Polynomials of time and radius through values of the unknown.
    pub(crate) fn polynomials(&self, sought: &[f64; SIZE]) -> (Polynomial, Polynomial) {
        let sought = self.march.nodes.polynomial(sought);
        match self.known {
            Independent::Time => (self.given, sought),
            Independent::Radius => (sought, self.given),
        }
    }

    /// The motion that follows from values of the unknown.
    pub(crate) fn motion(&self, sought: &[f64; SIZE]) -> PieceMotion {
        let (nodes, law) = (self.march.nodes, &self.march.law);
        let n = nodes.degree;
        let [mut given, mut given_slope, mut sought_slope] = [[0.0; SIZE]; 3];
        for (i, &s) in nodes.places.iter().enumerate() {
            [given[i], given_slope[i], _] = self.given.jet(s);
        }
        for (i, slope) in sought_slope.iter_mut().enumerate().take(n + 1).skip(1) {
            *slope = dot(&nodes.slope[i], &sought[..=n]);
        }
        let (time, radius, time_slope, radius_slope) = match self.known {
            Independent::Time => (given, *sought, given_slope, sought_slope),
            Independent::Radius => (*sought, given, sought_slope, given_slope),
        };
        let mut impulse = [0.0; LARGEST_DEGREE];
        let mut local = [AtRadius::default(); LARGEST_DEGREE];
        for j in 1..=n {
            let here = law.branch.at(radius[j]);
            impulse[j - 1] = here.force * time_slope[j]
                + law.damping(&here) * here.depth_slope * radius_slope[j];
            local[j - 1] = here;
        }
        let mut velocity = [self.march.state.velocity; SIZE];
        for (i, v) in velocity.iter_mut().enumerate().take(n + 1).skip(1) {
            *v -= INVERSE_MASS * dot(&nodes.integral[i], &impulse[..n]);
        }
        PieceMotion {
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
        sought: &[f64; SIZE],
        motion: &PieceMotion,
        residual: &mut Residual<'_>,
    ) {
        let march = self.march;
        let n = march.nodes.degree;
        let (phi, wave_time) = (march.contact.target_share, march.contact.wave_time);
        let (time_of, radius_of) = self.polynomials(sought);
        let (rule, size) = (residual.rule, residual.rule.len());
        if residual.departures.is_empty() {
            residual.departures = vec![Departure::default(); n * size];
            residual.delays = rule.iter().map(|(delay, _)| delay * wave_time).collect();
        }
        for i in 1..=n {
            let found = &mut residual.departures[(i - 1) * size..i * size];
            departures(
                &march.pieces,
                [&time_of, &radius_of],
                &march.state,
                [march.nodes.places[i], motion.time[i]],
                &residual.delays,
                found,
            );
            let delayed = march.law.delayed(motion.radius[i]);
            let parts = rule.iter().zip(found.iter());
            let sum: f64 = parts
                .map(|((_, rate), left)| rate * (delayed - self.law_of(left).delayed(left.radius)))
                .sum();
            let moving = march
                .surface
                .map_or(0.0, |surface| surface.at(motion.time[i]));
            let drive = motion.velocity[i] - moving - phi * sum / wave_time;
            let here = &motion.local[i - 1];
            let at_once = (1.0 - phi) * here.punch_slope;
            let slope = at_once + (here.depth_slope - here.punch_slope);
            residual.value[i - 1] = drive * motion.time_slope[i] - slope * motion.radius_slope[i];
            residual.drive[i - 1] = drive;
        }
    }

    /// The law at a departure.
    fn law_of(&self, left: &Departure) -> &Law {
        let piece = left.piece.and_then(|piece| self.march.pieces.get(piece));
        piece.map_or(&self.march.law, |piece| &piece.law)
    }

    /// Derivatives of the residuals with respect to the unknown, at the departures of the residual.
    pub(crate) fn jacobian(
        &self,
        motion: &PieceMotion,
        residual: &Residual<'_>,
        matrix: &mut Factors<LARGEST_DEGREE>,
    ) {
        let (nodes, law) = (self.march.nodes, &self.march.law);
        let (n, contact) = (nodes.degree, &self.march.contact);
        let velocity = self.velocity_by_impulse(motion);
        let tension = contact.target_share / contact.wave_time;
        let rest = 1.0 - contact.target_share;
        for i in 1..=n {
            let here = &motion.local[i - 1];
            let (sums, own) = self.tension_row(residual, i, law.slope(motion.radius[i]));
            let (slopes, integral) = (&nodes.slope[i], &nodes.integral[i]);
            let line = matrix.row(i - 1);
            // what the indentation is more than the punches
            let more = here.depth_slope - here.punch_slope;
            let more_bend = here.bends[0] - here.bends[1];
            // the integral of what is a function of the radius
            let damped = INVERSE_MASS * (law.damping(here) * here.depth_slope);
            for l in 1..=n {
                let at_node = |part: f64| if l == i { part } else { 0.0 };
                let (by_velocity, by_slope) = match self.known {
                    Independent::Time => {
                        let turn = at_node(motion.radius_slope[i]);
                        let punches = here.punch_slope * slopes[l] + here.bends[1] * turn;
                        (
                            integral[l - 1] * velocity[l - 1][l - 1] - at_node(damped),
                            -rest * punches - (more * slopes[l] + more_bend * turn),
                        )
                    }
                    Independent::Radius => {
                        let parts = integral.iter().zip(&velocity);
                        let by_velocity = parts.map(|(weight, row)| weight * row[l - 1]).sum();
                        (by_velocity, residual.drive[i - 1] * slopes[l])
                    }
                };
                let by_drive: f64 = by_velocity - tension * (at_node(own) - sums[l]);
                line[l - 1] = by_drive * motion.time_slope[i] + by_slope;
            }
        }
    }

    /// Row j: derivatives of the impulse -(5/4) p T' of node j with respect to the unknown.
    fn velocity_by_impulse(&self, motion: &PieceMotion) -> [[f64; LARGEST_DEGREE]; LARGEST_DEGREE] {
        let nodes = self.march.nodes;
        let mut rows = [[0.0; LARGEST_DEGREE]; LARGEST_DEGREE];
        for (j, row) in (1..=nodes.degree).zip(&mut rows) {
            let here = &motion.local[j - 1];
            match self.known {
                Independent::Time => row[j - 1] = -here.braking * motion.time_slope[j],
                Independent::Radius => {
                    for (entry, slope) in row.iter_mut().zip(&nodes.slope[j][1..]) {
                        *entry = -INVERSE_MASS * here.force * slope;
                    }
                }
            }
        }
        rows
    }

    /// Derivatives of S times the wave time at the node i: with respect to the unknown at each node (with
    /// the sign turned) and, separately, at the node itself, where g has a slope.
    fn tension_row(&self, residual: &Residual<'_>, i: usize, slope: f64) -> ([f64; SIZE], f64) {
        let nodes = self.march.nodes;
        let [mut sums, mut basis] = [[0.0; SIZE]; 2];
        let mut own = 0.0;
        let found = residual.departures[(i - 1) * residual.rule.len()..].iter();
        for ((left, &delay), &(_, rate)) in found.zip(&residual.delays).zip(residual.rule) {
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
            if left.piece == Some(self.march.pieces.len()) {
                nodes.lagrange(left.place, &mut basis);
                for (sum, value) in sums.iter_mut().zip(&basis[..=nodes.degree]) {
                    *sum += weight * value;
                }
            }
        }
        (sums, own)
    }

    /// Solves the equations from a guess of the values sought; nothing where Newton's method does not settle
    /// or time does not go on.
    pub(crate) fn solve(&self, mut sought: [f64; SIZE]) -> Option<Solution> {
        let n = self.march.nodes.degree;
        let mut residual = self.fresh_residual(self.march.level);
        let mut matrix = Factors::room(n);
        let mut before = f64::INFINITY;
        // Newton's next change would be about the square
        let enough = (1e-2 * self.march.accuracy).sqrt().min(1e-5);
        for iteration in 1..=MOST_ITERATIONS {
            let motion = self.moves(&sought)?;
            self.residual(&sought, &motion, &mut residual);
            self.jacobian(&motion, &residual, &mut matrix);
            if !matrix.eliminate() {
                return None;
            }
            let mut change = residual.value;
            matrix.solve(&mut change[..n]);
            let factor = self.damping(&sought, &change[..n]);
            let size = changed(&mut sought, factor, &change[..n]);
            let relative = size / self.scale(&sought);
            if factor == 1.0 && relative < enough {
                return self.corrected(sought, &matrix);
            }
            if iteration > SETTLED && relative > 0.5 * before {
                return None;
            }
            before = relative;
        }
        None
    }

    /// Residuals of no motion yet, by a rule over the waves.
    fn fresh_residual(&self, level: usize) -> Residual<'_> {
        Residual {
            rule: self.march.contact.waves.rule(level),
            ..Residual::default()
        }
    }

    /// The motion, unless a matrix that is nearly singular or a law at the end of the numbers threw it out of them.
    fn moves(&self, sought: &[f64; SIZE]) -> Option<PieceMotion> {
        let motion = self.motion(sought);
        let of = [&motion.time, &motion.radius, &motion.velocity];
        let mut all = of.into_iter().flatten();
        all.all(|x| x.is_finite()).then_some(motion)
    }

    /// One more change, by the finer rule.
    fn corrected(
        &self,
        mut sought: [f64; SIZE],
        matrix: &Factors<LARGEST_DEGREE>,
    ) -> Option<Solution> {
        let motion = self.moves(&sought)?;
        let mut residual = self.fresh_residual(self.march.level + 1);
        self.residual(&sought, &motion, &mut residual);
        let change = &mut residual.value[..self.march.nodes.degree];
        matrix.solve(change);
        let waves = changed(&mut sought, 1.0, change);
        let motion = self.moves(&sought)?;
        self.goes_on(&motion)
            .then(|| self.solution(&sought, &motion, waves))
    }

    /// Size of the unknown.
    fn scale(&self, sought: &[f64; SIZE]) -> f64 {
        let n = self.march.nodes.degree;
        match self.known {
            Independent::Time => sought[..=n].iter().fold(0.0_f64, |m, x| m.max(x.abs())),
            Independent::Radius => (sought[n] - sought[0]).abs(),
        }
    }

    /// The largest part of Newton's change that keeps the radius positive or the time rising.
    fn damping(&self, sought: &[f64; SIZE], change: &[f64]) -> f64 {
        let mut factor = 1.0_f64;
        for i in 1..=change.len() {
            let (old, fall, least) = match self.known {
                Independent::Time => (sought[i], change[i - 1], 0.2),
                Independent::Radius => {
                    let before = if i == 1 { 0.0 } else { change[i - 2] };
                    (sought[i] - sought[i - 1], change[i - 1] - before, 0.1)
                }
            };
            if old > 0.0 && old - fall < least * old {
                factor = factor.min((1.0 - least) * old / fall);
            }
        }
        factor.max(0.05)
    }

    /// Whether time rises and the radius stays positive; the last instants may be shorter than their error.
    fn goes_on(&self, motion: &PieceMotion) -> bool {
        let n = self.march.nodes.degree;
        let closed = motion.radius[n] <= CLOSED;
        let slack = f64::from(closed) * SLACK * self.march.accuracy;
        let rises = motion.time[..=n].windows(2).all(|t| t[1] >= t[0] - slack);
        let positive = motion.radius[1..n].iter().all(|&a| a > 0.0);
        rises && positive && (closed || motion.time_slope[n] > 0.0)
    }

    fn solution(&self, sought: &[f64; SIZE], motion: &PieceMotion, waves: f64) -> Solution {
        let (nodes, start) = (self.march.nodes, self.march.state);
        let n = nodes.degree;
        let weights = &nodes.integral[n];
        let mut travel = [0.0; LARGEST_DEGREE];
        let mut dissipated = 0.0;
        for j in 1..=n {
            travel[j - 1] = motion.velocity[j] * motion.time_slope[j];
            let here = &motion.local[j - 1];
            let lag = travel[j - 1] - here.depth_slope * motion.radius_slope[j];
            dissipated += weights[j - 1] * here.force * lag;
        }
        let mut displacement = [start.displacement; SIZE];
        for (i, place) in displacement.iter_mut().enumerate().take(n + 1).skip(1) {
            *place += dot(&nodes.integral[i], &travel[..n]);
        }
        let (time, radius) = self.polynomials(sought);
        // the last term, or the one before continued at the rate of its fall
        let modes = nodes.modes(sought);
        let [a, b, c] = [2, 1, 0].map(|k| modes[nodes.order() - k].abs());
        let continued = if b < a { b * b / a } else { b };
        Solution {
            piece: ContactPiece {
                law: self.march.law,
                time,
                radius,
                velocity: nodes.polynomial(&motion.velocity),
                displacement: nodes.polynomial(&displacement),
                force: None,
                start,
                end: State {
                    time: motion.time[n],
                    radius: motion.radius[n],
                    velocity: motion.velocity[n],
                    displacement: displacement[n],
                    slope: motion.local[n - 1].depth_slope * motion.radius_slope[n]
                        / motion.time_slope[n],
                },
            },
            widest: motion.radius[..=n].iter().fold(0.0_f64, |m, &a| m.max(a)),
            dissipated,
            truncated: c.max(continued),
            waves,
            sought: *sought,
        }
    }
}

/// Subtracts a part of a change from the unknown beyond the start, and returns the size of the change.
fn changed(sought: &mut [f64; SIZE], factor: f64, change: &[f64]) -> f64 {
    for (value, change) in sought[1..].iter_mut().zip(change) {
        *value -= factor * change;
    }
    change.iter().fold(0.0, |size, x| size.max(x.abs()))
}
