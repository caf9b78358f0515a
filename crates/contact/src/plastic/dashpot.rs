//! A contact that yields on a half-space that answers at once, with a lag: ordinary equations along an arc q.
//!
//! ```text
//! da = v dq,    dt = u_a dq,    v' = -(5/4) (F + c F_u^2 v) u_a
//! ```
//!
//! At the touch, where the striker turns and where the force is gone these are smooth, and so is their solution.
//! Inside the radius of a cut pressure the branch has a root; there the angle with a = kink cos(angle) stands for the
//! radius.

use crate::growing::arrivals::Piece;
use crate::growing::march::Errors;
use crate::growing::nodes::Nodes;
use crate::growing::polynomial::{LARGEST, SIZE, dot};
use crate::growing::solved::SolvedContact;
use crate::growing::step::last_term;
use crate::numeric::quadrature::rising_root;
use crate::plastic::Yielding;
use crate::plastic::branch::{Branch, Law, Local};
use crate::units::INVERSE_MASS;

/// Degree of the pieces, and the error that each may leave.
const DEGREE: usize = 12;
const ACCURACY: f64 = 1e-11;

/// Iterations of Picard at most, and the change that ends them.
const ITERATIONS: usize = 40;
const SETTLED: f64 = 1e-14;

/// Pieces at most, tried ones included.
const MOST: usize = 300;

/// A contact on its way.
pub(crate) struct Dashpot {
    lag: f64,
    branch: Branch,
    /// Radius inside which an angle stands for it; none before.
    kink: Option<f64>,
    /// The radius or the angle.
    place: f64,
    pub(crate) velocity: f64,
    pub(crate) time: f64,
    /// Length of the next piece.
    length: f64,
    pub(crate) pieces: Vec<Piece>,
}

/// Radius, velocity and law at the nodes of a piece, and the length of time over that of the arc.
#[derive(Clone, Copy)]
struct Motion {
    place: [f64; SIZE],
    velocity: [f64; SIZE],
    radius: [f64; SIZE],
    pace: [f64; SIZE],
    local: [Local; SIZE],
}

impl Yielding {
    /// The contact with a dashpot; nothing where that keeps it from yielding.
    ///
    /// # Errors
    /// The time where no piece is short enough.
    pub(crate) fn damped(&self, lag: f64) -> Result<Option<SolvedContact>, f64> {
        let mut march = Dashpot::new(lag, Branch::HERTZ, 0.0, 1.0);
        let turned = march.follow(self)?;
        let Dashpot {
            pieces, velocity, ..
        } = march;
        let errors = Errors::default();
        Ok(turned.map(|turned| SolvedContact::yielded(pieces, &errors, velocity, self, turned)))
    }
}

impl Dashpot {
    /// On a branch at a radius, with a velocity.
    pub(crate) fn new(lag: f64, branch: Branch, radius: f64, velocity: f64) -> Self {
        Self {
            lag,
            branch,
            kink: None,
            place: radius,
            velocity,
            time: 0.0,
            length: 0.3,
            pieces: Vec::with_capacity(16),
        }
    }

    /// The whole contact: its radius and the times of yield and of the turning point; nothing where waves keep it from
    /// yielding.
    ///
    /// # Errors
    /// The time where no piece is short enough.
    pub(crate) fn follow(&mut self, yielding: &Yielding) -> Result<Option<[f64; 3]>, f64> {
        let edge = yielding.edge();
        if self.until(|radius, v, _| [edge - radius, v])? == 1 {
            return Ok(None);
        }
        let onset = self.time;
        (self.place, self.branch) = (edge, yielding.loading());
        self.until(|_, v, _| [v; 2])?;
        let (top, turn) = (self.place, self.time);
        self.velocity = 0.0;
        (self.branch, self.place) = yielding.unloading(top);
        self.open()?;
        Ok(Some([top, onset, turn]))
    }

    /// Velocity, duration and the largest product of radius and velocity of a contact that opens from rest at radius one.
    pub(crate) fn from_rest(branch: Branch, lag: f64) -> Option<[f64; 3]> {
        let mut march = Self::new(lag, branch, 1.0, 0.0);
        march.open().ok()?;
        let pull = |one: &Piece, s: f64| one.radius.value(s) * -one.velocity.value(s);
        let pieces = march.pieces.iter();
        let samples = pieces.flat_map(|one| (0..=64).map(move |i| pull(one, f64::from(i) / 64.0)));
        let pulled = samples.fold(0.0, f64::max);
        Some([-march.velocity, march.time, pulled])
    }

    /// Until the force is gone, from where the striker turned.
    ///
    /// # Errors
    /// The time where no piece is short enough.
    pub(crate) fn open(&mut self) -> Result<(), f64> {
        let lag = self.lag;
        // the force over the square of its slope, of one sign through a radius of zero
        let left = |velocity: f64, local: &Local| {
            let square = local.stiffness * local.stiffness;
            let own = if square == 0.0 {
                0.0
            } else {
                local.force / square
            };
            own + lag * velocity
        };
        if let Branch::Truncated { edge, top } = self.branch {
            let kink = ((top - edge) * (top + edge)).max(0.0).sqrt();
            if self.until(|radius, v, local| [radius - kink, left(v, local)])? == 1 {
                return Ok(());
            }
            (self.kink, self.place) = (Some(kink), 0.0);
        }
        self.until(|_, v, local| [left(v, local); 2]).map(|_| ())
    }

    /// Pieces until one of two things, of radius, velocity and law, falls through zero: which.
    fn until(&mut self, events: impl Fn(f64, f64, &Local) -> [f64; 2]) -> Result<usize, f64> {
        let nodes = Nodes::of(DEGREE);
        for _ in 0..MOST {
            let Some((motion, error)) = self.attempt(nodes, self.length) else {
                self.length *= 0.5;
                if self.length < 1e-9 {
                    break;
                }
                continue;
            };
            if error > ACCURACY {
                self.length *= 0.6;
                continue;
            }
            let values: [[f64; 2]; DEGREE + 1] = std::array::from_fn(|i| {
                events(motion.radius[i], motion.velocity[i], &motion.local[i])
            });
            let place_of = |which: usize| {
                let after = (1..=DEGREE).find(|&i| values[i][which] <= 0.0)?;
                let passed = nodes.polynomial(&values.map(|value| -value[which]));
                let place = nodes.places[after];
                Some(rising_root(|s| passed.jet(s), [0.0, place], 0.5 * place, 1e-16)[1])
            };
            let places = [0, 1].map(|which| place_of(which).unwrap_or(f64::INFINITY));
            let first = usize::from(places[1] < places[0]);
            if let Some((motion, _)) = Some(places[first])
                .filter(|part| part.is_finite())
                .and_then(|part| self.attempt(nodes, part * self.length))
            {
                self.accept(nodes, &motion);
                return Ok(first);
            }
            self.accept(nodes, &motion);
            self.length *= (0.3 * ACCURACY / error.max(1e-16))
                .powf(1.0 / DEGREE as f64)
                .clamp(0.5, 2.0);
        }
        Err(self.time)
    }

    /// A piece of some length by Picard's iteration, and the last term of its velocity and place.
    fn attempt(&self, nodes: &Nodes, length: f64) -> Option<(Motion, f64)> {
        let n = nodes.degree;
        let mut motion = Motion {
            place: [self.place; SIZE],
            velocity: [self.velocity; SIZE],
            radius: [0.0; SIZE],
            pace: [0.0; SIZE],
            local: [Local::default(); SIZE],
        };
        let along = if self.kink.is_some() { -1.0 } else { 1.0 };
        for (place, s) in motion.place.iter_mut().zip(&nodes.places) {
            *place += along * length * self.velocity * s;
        }
        for _ in 0..ITERATIONS {
            let mut slowing = [0.0; LARGEST];
            for i in 0..=n {
                let radius_slope = match self.kink {
                    Some(kink) => {
                        motion.radius[i] = kink * motion.place[i].cos();
                        -kink * motion.place[i].sin()
                    }
                    None => {
                        motion.radius[i] = motion.place[i];
                        1.0
                    }
                };
                let here = self.branch.at(motion.radius[i]);
                motion.pace[i] = length * along * radius_slope * here.depth_slope;
                motion.local[i] = here;
                if i > 0 {
                    let force = here.force + self.lag * here.stiffness.powi(2) * motion.velocity[i];
                    slowing[i - 1] = INVERSE_MASS * force * motion.pace[i];
                }
            }
            let mut change = 0.0_f64;
            for i in 1..=n {
                let next = self.velocity - dot(nodes.integral_row(i), &slowing[..n]);
                change = change.max((next - motion.velocity[i]).abs());
                motion.velocity[i] = next;
            }
            for i in 1..=n {
                let travelled = dot(nodes.integral_row(i), &motion.velocity[1..=n]);
                let next = self.place + along * length * travelled;
                change = change.max((next - motion.place[i]).abs());
                motion.place[i] = next;
            }
            if !change.is_finite() {
                return None;
            }
            if change < SETTLED {
                let mut error = 0.0_f64;
                for values in [&motion.velocity, &motion.place] {
                    let mut modes = [0.0; SIZE];
                    nodes.modes(&values[..=n], &mut modes);
                    error = error.max(last_term(&modes[..=n]));
                }
                return Some((motion, error));
            }
        }
        None
    }

    fn accept(&mut self, nodes: &Nodes, motion: &Motion) {
        let n = nodes.degree;
        let (mut time, mut force, mut depth) = ([self.time; SIZE], [0.0; SIZE], [0.0; SIZE]);
        for i in 0..=n {
            let here = &motion.local[i];
            force[i] = here.force + self.lag * here.stiffness.powi(2) * motion.velocity[i];
            depth[i] = here.depth;
            if i > 0 {
                time[i] += dot(nodes.integral_row(i), &motion.pace[1..=n]);
            }
        }
        self.pieces.push(Piece {
            law: Law::HERTZ.followed_by(self.branch, motion.radius[0]),
            time: nodes.polynomial(&time[..=n]),
            radius: nodes.polynomial(&motion.radius[..=n]),
            velocity: nodes.polynomial(&motion.velocity[..=n]),
            displacement: nodes.polynomial(&depth[..=n]),
            force: Some(nodes.polynomial(&force[..=n])),
            lag: Some(self.lag),
            from: (self.time, motion.radius[0]),
            to: (time[n], motion.radius[n]),
        });
        (self.time, self.place, self.velocity) = (time[n], motion.place[n], motion.velocity[n]);
    }
}
