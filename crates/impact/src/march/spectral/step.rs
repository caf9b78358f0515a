//! One piece of the contact by collocation and Newton's method.

use super::nodes::{Factors, LARGEST, Nodes, Polynomial};
use super::piece::{Arrival, Departure, Piece};
use super::waves::Rule;
use crate::units::INVERSE_MASS;

/// The contact's groups.
#[derive(Debug, Clone, Copy)]
pub(super) struct Groups {
    /// phi.
    pub(super) target_share: f64,
    /// a/c1 in collision times.
    pub(super) wave_time: f64,
}

/// What is known at the end of a piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct State {
    pub(super) time: f64,
    pub(super) radius: f64,
    pub(super) velocity: f64,
    pub(super) displacement: f64,
    /// Slope of the indentation a^2.
    pub(super) slope: f64,
}

/// What a piece is a function of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Known {
    /// The radius is sought as a function of time.
    Time,
    /// The time is sought as a function of the radius, which falls.
    Radius,
}

/// Values at 0 and the nodes.
pub(super) type Values = [f64; LARGEST + 1];

/// A piece that solves its equations at its nodes.
#[derive(Debug, Clone)]
pub(super) struct Solved {
    pub(super) piece: Piece,
    pub(super) end: State,
    /// Legendre coefficients of what was sought.
    pub(super) modes: Values,
    /// Radii and slopes of the time at the nodes.
    pub(super) radius: Values,
    pub(super) time: Values,
    pub(super) time_slope: Values,
    /// int p (v - u') dt over the piece.
    pub(super) dissipated: f64,
    /// Change of what is sought that the finer rule made.
    pub(super) waves: f64,
    pub(super) iterations: usize,
}

/// The collocation problem of one piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step<'a> {
    pub(super) groups: Groups,
    pub(super) nodes: &'a Nodes,
    pub(super) rule: &'a Rule,
    /// The next finer one.
    pub(super) finer: &'a Rule,
    pub(super) pieces: &'a [Piece],
    pub(super) start: State,
    pub(super) known: Known,
    /// What is known: the time or the radius.
    pub(super) given: Polynomial,
}

/// Newton's iterations at most.
const ITERATIONS: usize = 14;

impl Step<'_> {
    /// Solves
    ///
    /// ```text
    /// (v - 2 phi S) T' = 2 (1 - phi) a a',    S = sum_k (m_k/X_k) (a - a_k),    T_k + X_k a_k = t
    /// v = v_0 - (5/4) int a^3 T' ds
    /// ```
    ///
    /// at the nodes, from a guess of the values sought there.
    pub(super) fn solve(&self, guess: &Values, accuracy: f64, slack: f64) -> Option<Solved> {
        let n = self.nodes.degree;
        let mut sought = *guess;
        let mut given = [0.0; LARGEST + 1];
        let mut given_slope = [0.0; LARGEST + 1];
        for (i, &s) in self.nodes.places.iter().enumerate() {
            (given[i], given_slope[i]) = self.given.jet(s);
        }
        let mut places = Departures::default();
        let mut jacobian = Factors::room(n);
        let mut last_change = f64::INFINITY;
        for iteration in 1..=ITERATIONS {
            let found = self.residual(self.rule, &sought, &given, &given_slope, &mut places, Some(&mut jacobian));
            let mut change = found.residual;
            if !jacobian.eliminate() {
                return None;
            }
            jacobian.solve(&mut change[..n]);
            let factor = self.damping(&sought, &change[..n]);
            let mut size = 0.0_f64;
            for i in 1..=n {
                sought[i] -= factor * change[i - 1];
                size = size.max(change[i - 1].abs());
            }
            let relative = size / self.scale(&sought);
            if !relative.is_finite() {
                return None;
            }
            // the waves' finer rule corrects once more, so that the last change is of second order
            if factor == 1.0 && relative < accuracy {
                return self.finish(&mut sought, &given, &given_slope, &jacobian, iteration, slack);
            }
            if iteration > 6 && relative > 0.5 * last_change {
                return None;
            }
            last_change = relative;
        }
        None
    }

    /// Size of what is sought.
    fn scale(&self, sought: &Values) -> f64 {
        let n = self.nodes.degree;
        match self.known {
            Known::Time => sought[..=n].iter().fold(0.0_f64, |m, x| m.max(x.abs())),
            Known::Radius => (sought[n] - sought[0]).abs(),
        }
    }

    /// The largest part of Newton's change that keeps the radius positive or the time rising.
    fn damping(&self, sought: &Values, change: &[f64]) -> f64 {
        let n = change.len();
        let mut factor = 1.0_f64;
        for i in 1..=n {
            let next = sought[i] - change[i - 1];
            match self.known {
                Known::Time => {
                    let least = 0.2 * sought[i];
                    if next < least {
                        factor = factor.min((sought[i] - least) / change[i - 1]);
                    }
                }
                Known::Radius => {
                    let before = if i == 1 { 0.0 } else { change[i - 2] };
                    let (old, fall) = (sought[i] - sought[i - 1], change[i - 1] - before);
                    if old > 0.0 && old - fall < 0.1 * old {
                        factor = factor.min(0.9 * old / fall);
                    }
                }
            }
        }
        factor.max(0.05)
    }

    fn split<'b>(&self, sought: &'b Values, given: &'b Values) -> (&'b Values, &'b Values) {
        match self.known {
            Known::Time => (given, sought),
            Known::Radius => (sought, given),
        }
    }

    /// The residual, and its derivatives with respect to what is sought where they are asked for.
    fn residual(
        &self,
        rule: &Rule,
        sought: &Values,
        given: &Values,
        given_slope: &Values,
        places: &mut Departures,
        mut jacobian: Option<&mut Factors>,
    ) -> Residual {
        let n = self.nodes.degree;
        let Groups { target_share, wave_time } = self.groups;
        let polynomial = self.nodes.polynomial(sought);
        let (time_of, radius_of) = match self.known {
            Known::Time => (&self.given, &polynomial),
            Known::Radius => (&polynomial, &self.given),
        };
        let mut found = self.motion(sought, given, given_slope);
        let (time, radius) = self.split(sought, given);
        let (time_slope, radius_slope) = (found.time_slope, found.radius_slope);
        let delays = rule.delays.len();
        let again = places.0.len() == n * delays;
        if !again {
            places.0.resize(n * delays, Departure::default());
        }
        let mut late = [0.0; 128];
        for (late, delay) in late.iter_mut().zip(&rule.delays) {
            *late = delay * wave_time;
        }
        let late = &late[..delays];
        let start = (self.start.time, self.start.radius);
        let mut basis = [0.0; LARGEST + 1];
        for i in 1..=n {
            let arrival = Arrival {
                time_of,
                radius_of,
                from: start,
                place: self.nodes.places[i],
                time: time[i],
            };
            let found_here = &mut places.0[(i - 1) * delays..i * delays];
            arrival.departures(self.pieces, late, again, found_here);
            let mut row = [0.0; LARGEST + 1];
            let mut sum = 0.0;
            let mut own = 0.0;
            for k in 0..delays {
                let delay = late[k];
                let rate = rule.rates[k] / wave_time;
                let left = &found_here[k];
                sum += rate * (radius[i] - left.radius);
                if jacobian.is_some() {
                    let speed = left.time_slope + delay * left.radius_slope;
                    let here = left.piece == self.pieces.len();
                    let (weight, local) = match self.known {
                        Known::Time => (rate * left.time_slope / speed, here),
                        Known::Radius => {
                            own += rate * left.radius_slope / speed;
                            (-rate * left.radius_slope / speed, here)
                        }
                    };
                    if local {
                        self.nodes.lagrange(left.place, &mut basis);
                        for l in 1..=n {
                            row[l] += weight * basis[l];
                        }
                    }
                }
            }
            let drive = found.velocity[i] - 2.0 * target_share * sum;
            let rest = 2.0 * (1.0 - target_share);
            found.residual[i - 1] =
                drive * time_slope[i] - rest * radius[i] * radius_slope[i];
            let Some(jacobian) = jacobian.as_deref_mut() else {
                continue;
            };
            let slopes = self.nodes.slope_row(i);
            let integral = self.nodes.integral_row(i);
            let line = jacobian.row(i - 1);
            match self.known {
                Known::Time => {
                    let total: f64 = rule.rates.iter().sum::<f64>() / wave_time;
                    for l in 1..=n {
                        let velocity = -INVERSE_MASS
                            * integral[l - 1]
                            * 3.0
                            * radius[l]
                            * radius[l]
                            * time_slope[l];
                        let mut tension = -row[l];
                        let mut elastic = radius[i] * slopes[l];
                        if l == i {
                            tension += total;
                            elastic += radius_slope[i];
                        }
                        line[l - 1] = (velocity - 2.0 * target_share * tension) * time_slope[i]
                            - rest * elastic;
                    }
                }
                Known::Radius => {
                    let mut velocity = [0.0; LARGEST + 1];
                    for j in 1..=n {
                        let weight = -INVERSE_MASS * integral[j - 1] * radius[j].powi(3);
                        for (l, slope) in self.nodes.slope_row(j).iter().enumerate() {
                            velocity[l] += weight * slope;
                        }
                    }
                    for l in 1..=n {
                        let mut tension = -row[l];
                        if l == i {
                            tension -= own;
                        }
                        line[l - 1] = (velocity[l] - 2.0 * target_share * tension) * time_slope[i]
                            + drive * slopes[l];
                    }
                }
            }
        }
        found
    }

    /// Slopes at the nodes and the velocity.
    fn motion(&self, sought: &Values, given: &Values, given_slope: &Values) -> Residual {
        let n = self.nodes.degree;
        let mut sought_slope = [0.0; LARGEST + 1];
        for i in 1..=n {
            sought_slope[i] = dot(self.nodes.slope_row(i), &sought[..=n]);
        }
        let (_, radius) = self.split(sought, given);
        let (time_slope, radius_slope) = self.split(&sought_slope, given_slope);
        let mut found = Residual {
            time_slope: *time_slope,
            radius_slope: *radius_slope,
            ..Residual::default()
        };
        let mut impulse = [0.0; LARGEST];
        for j in 1..=n {
            impulse[j - 1] = radius[j].powi(3) * time_slope[j];
        }
        for i in 1..=n {
            found.velocity[i] = self.start.velocity
                - INVERSE_MASS * dot(self.nodes.integral_row(i), &impulse[..n]);
        }
        found
    }

    fn finish(
        &self,
        sought: &mut Values,
        given: &Values,
        given_slope: &Values,
        jacobian: &Factors,
        iterations: usize,
        slack: f64,
    ) -> Option<Solved> {
        let n = self.nodes.degree;
        let mut places = Departures::default();
        let off = self.residual(self.finer, sought, given, given_slope, &mut places, None);
        let mut change = off.residual;
        jacobian.solve(&mut change[..n]);
        let mut waves = 0.0_f64;
        for i in 1..=n {
            sought[i] -= change[i - 1];
            waves = waves.max(change[i - 1].abs());
        }
        let sought = &*sought;
        let found = self.motion(sought, given, given_slope);
        let (time, radius) = self.split(sought, given);
        let (time, radius) = (*time, *radius);
        if self.known == Known::Radius {
            // the last instants may be shorter than the error
            let closed = radius[n] <= 0.0;
            let slack = if closed { slack } else { 0.0 };
            if time[..=n].windows(2).any(|t| t[1] < t[0] - slack) {
                return None;
            }
            if !closed && found.time_slope[n] <= 0.0 {
                return None;
            }
        }
        if radius[1..n].iter().any(|&a| a <= 0.0) {
            return None;
        }
        let mut velocity = found.velocity;
        velocity[0] = self.start.velocity;
        let mut displacement = [0.0; LARGEST + 1];
        displacement[0] = self.start.displacement;
        let mut travel = [0.0; LARGEST];
        let mut dissipated = 0.0;
        for j in 1..=n {
            travel[j - 1] = velocity[j] * found.time_slope[j];
            let lag = travel[j - 1] - 2.0 * radius[j] * found.radius_slope[j];
            dissipated += self.nodes.weights[j - 1] * radius[j].powi(3) * lag;
        }
        for i in 1..=n {
            displacement[i] =
                self.start.displacement + dot(self.nodes.integral_row(i), &travel[..n]);
        }
        let polynomial = self.nodes.polynomial(sought);
        let (time_of, radius_of) = match self.known {
            Known::Time => (self.given, polynomial),
            Known::Radius => (polynomial, self.given),
        };
        let mut modes = [0.0; LARGEST + 1];
        self.nodes.modes(sought, &mut modes);
        Some(Solved {
            piece: Piece {
                time: time_of,
                radius: radius_of,
                velocity: self.nodes.polynomial(&velocity),
                displacement: self.nodes.polynomial(&displacement),
                from: (self.start.time, self.start.radius),
                to: (time[n], radius[n]),
            },
            end: State {
                time: time[n],
                radius: radius[n],
                velocity: velocity[n],
                displacement: displacement[n],
                slope: 2.0 * radius[n] * found.radius_slope[n] / found.time_slope[n],
            },
            modes,
            radius,
            time,
            time_slope: found.time_slope,
            dissipated,
            waves,
            iterations,
        })
    }
}

/// The departures of each node and delay.
#[derive(Debug, Default)]
struct Departures(Vec<Departure>);

#[derive(Debug, Clone, Copy, Default)]
struct Residual {
    residual: [f64; LARGEST],
    velocity: Values,
    time_slope: Values,
    radius_slope: Values,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
