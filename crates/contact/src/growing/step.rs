//! One piece of the contact by collocation and Newton's method.

use crate::growing::arrivals::{Piece, State};
use crate::growing::equations::{Equations, Independent, Motion, Residual};
use crate::growing::nodes::Factors;
use crate::growing::polynomial::{LARGEST, SIZE, dot};

/// A piece that solves its equations at its nodes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Solution {
    pub(crate) piece: Piece,
    /// Largest radius at the nodes.
    pub(crate) widest: f64,
    /// int p (v - u') dt over the piece.
    pub(crate) dissipated: f64,
    /// Size of the last of the polynomial's terms in what was sought.
    pub(crate) truncated: f64,
    /// Change of what was sought by the finer rule over the waves.
    pub(crate) waves: f64,
    /// What was sought, at 0 and the nodes.
    pub(crate) sought: [f64; SIZE],
}

/// Newton's iterations at most.
const ITERATIONS: usize = 14;

/// Iterations after which each has to halve the change.
const SETTLED: usize = 6;

/// Error of the time that the last instants may have, over the accuracy.
const SLACK: f64 = 0.3;

/// Radius that is zero but for rounding.
const CLOSED: f64 = 1e-14;

impl Equations<'_> {
    /// Solves the equations from a guess of the values sought; nothing where Newton's method does not settle
    /// or time does not go on.
    pub(crate) fn solve(&self, mut sought: [f64; SIZE]) -> Option<Solution> {
        let n = self.march.nodes.degree;
        let mut residual = self.to_find(self.march.level);
        let mut matrix = Factors::room(n);
        let mut before = f64::INFINITY;
        // Newton's next change would be about the square
        let enough = (1e-2 * self.march.accuracy).sqrt().min(1e-5);
        for iteration in 1..=ITERATIONS {
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

    /// Residuals to be found with a rule over the waves.
    fn to_find(&self, level: usize) -> Residual<'_> {
        Residual {
            rule: self.march.contact.waves.rule(level),
            ..Residual::default()
        }
    }

    /// The motion, unless a matrix that is nearly singular or a law at the end of the numbers threw it out of them.
    fn moves(&self, sought: &[f64; SIZE]) -> Option<Motion> {
        let motion = self.motion(sought);
        let of = [&motion.time, &motion.radius, &motion.velocity];
        let mut all = of.into_iter().flatten();
        all.all(|x| x.is_finite()).then_some(motion)
    }

    /// One more change, by the finer rule.
    fn corrected(&self, mut sought: [f64; SIZE], matrix: &Factors) -> Option<Solution> {
        let motion = self.moves(&sought)?;
        let mut residual = self.to_find(self.march.level + 1);
        self.residual(&sought, &motion, &mut residual);
        let change = &mut residual.value[..self.march.nodes.degree];
        matrix.solve(change);
        let waves = changed(&mut sought, 1.0, change);
        let motion = self.moves(&sought)?;
        self.goes_on(&motion)
            .then(|| self.solution(&sought, &motion, waves))
    }

    /// Size of what is sought.
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
    fn goes_on(&self, motion: &Motion) -> bool {
        let n = self.march.nodes.degree;
        let closed = motion.radius[n] <= CLOSED;
        let slack = if closed {
            SLACK * self.march.accuracy
        } else {
            0.0
        };
        let rises = motion.time[..=n].windows(2).all(|t| t[1] >= t[0] - slack);
        let positive = motion.radius[1..n].iter().all(|&a| a > 0.0);
        rises && positive && (closed || motion.time_slope[n] > 0.0)
    }

    fn solution(&self, sought: &[f64; SIZE], motion: &Motion, waves: f64) -> Solution {
        let (nodes, start) = (self.march.nodes, self.march.state);
        let n = nodes.degree;
        let weights = nodes.integral_row(n);
        let mut travel = [0.0; LARGEST];
        let mut dissipated = 0.0;
        for j in 1..=n {
            travel[j - 1] = motion.velocity[j] * motion.time_slope[j];
            let here = &motion.local[j - 1];
            let lag = travel[j - 1] - here.depth_slope * motion.radius_slope[j];
            dissipated += weights[j - 1] * here.force * lag;
        }
        let mut displacement = [start.displacement; SIZE];
        for (i, place) in displacement.iter_mut().enumerate().take(n + 1).skip(1) {
            *place += dot(nodes.integral_row(i), &travel[..n]);
        }
        let (time, radius) = self.polynomials(sought);
        let modes = nodes.modes(sought);
        Solution {
            piece: Piece {
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
            truncated: last_term(&modes[..=n]),
            waves,
            sought: *sought,
        }
    }
}

/// Takes a part of a change from what is sought beyond the start; the size of the change.
fn changed(sought: &mut [f64; SIZE], factor: f64, change: &[f64]) -> f64 {
    for (value, change) in sought[1..].iter_mut().zip(change) {
        *value -= factor * change;
    }
    change.iter().fold(0.0, |size, x| size.max(x.abs()))
}

/// Size of the last term of a Legendre series, or of the one before continued at the rate of its fall.
pub(crate) fn last_term(modes: &[f64]) -> f64 {
    let [a, b, c] = [3, 2, 1].map(|back| modes[modes.len() - back].abs());
    c.max(if b < a { b * b / a } else { b })
}
