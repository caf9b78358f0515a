//! A contact that yields: the march of one that does not, along the branches, on a half-space with its memory or one that
//! answers at once, with a lag.
//!
//! The lag is that of a dashpot on the contact's area, c F_u^2 u'; with it the force is gone before the radius is.

use crate::accuracy::Accuracy;
use crate::error::MarchError;
use crate::growing::arrivals::{ContactPiece, State};
use crate::growing::checks;
use crate::growing::equations::{Independent, March, Solution};
use crate::growing::nodes::{Polynomial, SIZE};
use crate::growing::solved::SolvedContact;
use crate::law::branch::Branch;
use crate::law::yielding::Yielding;
use crate::numeric::quadrature::rising_root;
use crate::units::INVERSE_MASS;
use crate::waves::punch::GrowingContact;

/// Pieces of the flow and of the unloading at most, tried ones included.
const MOST_PIECES: usize = 300;

/// First piece of the flow over the time until the striker turns: waves from before the yield arrive with another slope.
const FIRST_OF_FLOW: f64 = 0.1;

/// Estimated time until the indentation turns at the touch, where there is no force to tell it, in collision times.
const FROM_TOUCH: f64 = 1.0;

/// Error of a piece without a memory.
pub(crate) const ERROR_WITH_DASHPOT: f64 = 1e-11;

/// Part of a base at which the radius that falls from it is mostly gone.
const LOW_RADIUS: f64 = 0.45;

/// Error of a piece with memory over the tolerance, in the order in which they are tried, and the least.
const ERROR_OF_PIECE: [f64; 3] = [0.3, 0.03, 0.003];
const FINEST_PIECE: f64 = 1e-10;

impl Yielding {
    /// The contact with the memory of the half-space, to an accuracy; nothing where waves keep it from yielding.
    ///
    /// # Errors
    /// [`MarchError`].
    pub(crate) fn remembered(
        &self,
        contact: &GrowingContact<'_>,
        asked: &Accuracy,
    ) -> Result<Option<SolvedContact>, MarchError> {
        let tried = |part: f64| {
            let march = March::new(*contact, (part * asked.tolerance).max(FINEST_PIECE));
            let found = march.follow(self)?;
            found
                .map(|solved| checks::passed(solved, contact))
                .transpose()
        };
        // a stiff striker's last instants may need finer pieces
        let [first, second, last] = ERROR_OF_PIECE;
        (tried(first).or_else(|_| tried(second))).or_else(|_| tried(last))
    }
}

impl March<'_> {
    /// Velocity, duration and the largest product of radius and velocity of a contact with a dashpot that opens along a
    /// branch from rest at radius one, and the work that it gives back without a lag.
    pub(crate) fn from_rest(branch: Branch, lag: f64) -> Option<[f64; 4]> {
        let mut march = Self::damped(lag, ERROR_WITH_DASHPOT);
        march.law.branch = branch;
        march.state = State {
            radius: 1.0,
            velocity: 0.0,
            slope: 0.0,
            ..State::TOUCH
        };
        march.unload().ok()?;
        let pull = |one: &ContactPiece, s: f64| one.radius.value(s) * -one.velocity.value(s);
        let pieces = march.pieces.iter();
        let samples = pieces.flat_map(|one| (0..=64).map(move |i| pull(one, f64::from(i) / 64.0)));
        let (pulled, stored) = (samples.fold(0.0, f64::max), branch.work(1.0));
        Some([-march.state.velocity, march.state.time, pulled, stored])
    }

    /// The whole contact; nothing where waves keep it from yielding.
    ///
    /// # Errors
    /// [`MarchError::NotFollowed`].
    pub(crate) fn follow(
        mut self,
        yielding: &Yielding,
    ) -> Result<Option<SolvedContact>, MarchError> {
        let edge = yielding.edge();
        self.load(edge)?;
        if self.state.radius < edge || self.state.slope <= 0.0 {
            return Ok(None);
        }
        let onset = self.state.time;
        self.law = self.law.followed_by(yielding.loading(), edge);
        self.flow(f64::INFINITY)?;
        let (top, turn) = (self.state.radius, self.state.time);
        let (branch, from) = yielding.unloading(top);
        self.law = self.law.followed_by(branch, top);
        self.state.radius = from;
        let crossed = self.unload()?;
        let times = [onset, turn].into_iter().chain(crossed).collect();
        Ok(Some(SolvedContact::yielded(self, yielding, top, times)))
    }

    /// Pieces from where the striker turned until the force is gone; when the branch has a root.
    fn unload(&mut self) -> Result<Option<f64>, MarchError> {
        let radius = self.state.radius;
        let (base, crossed) = match self.law.branch {
            Branch::Truncated { edge, top } => {
                // where the pressure was cut the branch has a root
                let kink = ((top - edge) * (top + edge)).max(0.0).sqrt();
                if self.open(radius, kink, f64::INFINITY)? || self.state.radius > kink {
                    return self.close().map(|()| None);
                }
                (kink, Some(self.state.time))
            }
            Branch::Line { .. }
            | Branch::Fit(_)
            | Branch::Hertzian { .. }
            | Branch::OnSpring { .. } => (radius, None),
        };
        self.open(base, 0.0, f64::INFINITY)?;
        self.close().map(|()| crossed)
    }

    /// Pieces in time until the indentation turns, no longer than `longest`.
    ///
    /// Without waves they are polynomials of the root of time, in which the radius is smooth however early it yields.
    pub(crate) fn flow(&mut self, longest: f64) -> Result<(), MarchError> {
        let (power, first) = match self.law.lag {
            Some(_) => (2, 1.0),
            None => (1, FIRST_OF_FLOW),
        };
        let root = |time: f64| if power == 2 { time.sqrt() } else { time };
        let left = |march: &Self| {
            let State { time, slope, .. } = march.state;
            let force = march.law.branch.at(march.state.radius).force;
            let until_turn = match force > 0.0 {
                true => 1.2 * slope / (INVERSE_MASS * force),
                false => FROM_TOUCH,
            };
            root(time + until_turn) - root(time)
        };
        let start = (first * left(self)).min(longest);
        let piece = |march: &Self, length: &mut f64| {
            *length = length.min(left(march)).min(longest);
            let given = Polynomial::power(root(march.state.time), *length, power);
            Some((given, march.guess(&given), false))
        };
        let turned = |_: &Self, solution: &Solution, error| {
            let slowing = |s| {
                let [_, slope, bend] = solution.piece.radius.jet(s);
                [-slope, -bend]
            };
            let turns = error <= 1.0 && solution.piece.end.slope < 0.0;
            turns.then(|| rising_root(slowing, [0.0, 1.0], 0.5, 1e-16)[1])
        };
        self.until(MOST_PIECES, Independent::Time, start, piece, turned)?;
        self.state.slope = 0.0;
        if self.law.lag.is_some() {
            self.state.velocity = 0.0;
        }
        Ok(())
    }

    /// Pieces in the root of the distance from a radius, no longer than `longest`, down to another one or until it is mostly
    /// gone; whether a dashpot's force was gone before.
    pub(crate) fn open(&mut self, base: f64, floor: f64, longest: f64) -> Result<bool, MarchError> {
        let goal = match self.law.lag {
            Some(_) => floor,
            None => floor.max(LOW_RADIUS * base),
        };
        let piece = |march: &Self, rise: &mut f64| {
            let [from, to] = [march.state.radius, goal].map(|a| (base - a).max(0.0).sqrt());
            *rise = rise.min(longest);
            let whole = *rise >= to - from;
            *rise = rise.min(to - from);
            let given = Polynomial::power(from, *rise, 2).below(base);
            Some((given, march.opening(&given), whole))
        };
        let gone = |march: &Self, solution: &Solution, error| {
            let piece = Some(&solution.piece).filter(|_| error <= 1.0);
            piece.and_then(|piece| march.released(piece))
        };
        let ends = self.until(MOST_PIECES, Independent::Radius, f64::INFINITY, piece, gone)?;
        if !ends {
            self.state.radius = goal;
        }
        Ok(ends)
    }

    /// Where in a piece the force of a dashpot's contact is gone, if it is.
    fn released(&self, piece: &ContactPiece) -> Option<f64> {
        let lag = self.law.lag?;
        // over the square of its slope, of one sign through a radius of zero
        let pull = |s: f64| {
            let here = self.law.branch.at(piece.radius.value(s));
            let square = here.stiffness * here.stiffness;
            let own = if square == 0.0 {
                0.0
            } else {
                here.force / square
            };
            -own - lag * piece.velocity.value(s)
        };
        if pull(1.0) < 0.0 {
            return None;
        }
        let values: Vec<f64> = self.nodes.places.iter().map(|&s| pull(s)).collect();
        let pull = self.nodes.polynomial(&values);
        Some(rising_root(|s| pull.jet(s), [0.0, 1.0], 0.5, 1e-16)[1])
    }

    /// Times at the nodes of a radius that falls, by the law without waves.
    fn opening(&self, radius: &Polynomial) -> [f64; SIZE] {
        let mut times = [self.state.time; SIZE];
        let (mut time, mut rate) = (self.state.time, self.state.slope);
        let mut before = self.law.branch.at(self.state.radius);
        for (value, &s) in times.iter_mut().zip(&self.nodes.places).skip(1) {
            let here = self.law.branch.at(radius.value(s));
            let risen = here.depth - before.depth;
            let square = rate * rate - INVERSE_MASS * risen * (before.force + here.force);
            let next = -square.max(0.0).sqrt();
            time += 2.0 * risen / (rate + next);
            (rate, before) = (next, here);
            *value = time;
        }
        times
    }
}
