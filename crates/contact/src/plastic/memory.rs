//! A contact that yields on a half-space with its memory: the march of one that does not, along the branches.

use crate::disc::refine::Accuracy;
use crate::error::MarchError;
use crate::growing::checks;
use crate::growing::equations::Independent;
use crate::growing::march::March;
use crate::growing::polynomial::{Polynomial, SIZE};
use crate::growing::solved::SolvedContact;
use crate::growing::waves::GrowingContact;
use crate::numeric::quadrature::rising_root;
use crate::plastic::Yielding;
use crate::plastic::branch::Branch;
use crate::units::INVERSE_MASS;

/// Pieces at most, tried ones included.
const MOST: usize = 300;

/// First piece of the flow over the time until the striker turns: waves from before the yield arrive with another slope.
const FIRST: f64 = 0.1;

/// Part of a base at which the radius that falls from it is mostly gone.
const LOW: f64 = 0.45;

/// Error of a piece with memory over the tolerance, in the order in which they are tried, and the least.
const PIECE: [f64; 3] = [0.3, 0.03, 0.003];
const FINEST: f64 = 1e-10;

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
            let mut march = March::new(*contact, (part * asked.tolerance).max(FINEST));
            let Some(turned) = march.follow(self).map_err(|time| march.lost(time))? else {
                return Ok(None);
            };
            let (pieces, velocity) = (march.pieces, march.state.velocity);
            let solved = SolvedContact::yielded(pieces, &march.errors, velocity, self, turned);
            checks::passed(solved, contact).map(Some)
        };
        // a stiff striker's last instants may need finer pieces
        let [first, second, last] = PIECE;
        (tried(first).or_else(|_| tried(second))).or_else(|_| tried(last))
    }
}

impl March<'_> {
    /// The whole contact: its radius and the times of yield and of the turning point; nothing where waves keep it from
    /// yielding.
    ///
    /// # Errors
    /// The time where no piece is short enough.
    pub(crate) fn follow(&mut self, yielding: &Yielding) -> Result<Option<[f64; 3]>, f64> {
        let edge = yielding.edge();
        self.load(edge)?;
        if self.state.radius < edge || self.state.slope <= 0.0 {
            return Ok(None);
        }
        let onset = self.state.time;
        self.law = self.law.followed_by(yielding.loading(), edge);
        self.flow()?;
        let (top, turn) = (self.state.radius, self.state.time);
        let (branch, _) = yielding.unloading(top);
        self.law = self.law.followed_by(branch, top);
        if let Branch::Truncated { edge, top } = branch {
            // where the pressure was cut the branch has a root
            let kink = ((top - edge) * (top + edge)).max(0.0).sqrt();
            self.open(top, kink)?;
            if self.state.radius <= kink {
                self.open(kink, 0.0)?;
            }
        } else {
            self.open(top, 0.0)?;
        }
        self.close()?;
        Ok(Some([top, onset, turn]))
    }

    /// Pieces in time until the indentation turns.
    fn flow(&mut self) -> Result<(), f64> {
        let left = |march: &Self| {
            let force = march.law.branch.at(march.state.radius).force;
            1.2 * march.state.slope / (INVERSE_MASS * force)
        };
        let mut length = FIRST * left(self);
        let mut turns = false;
        for _ in 0..MOST {
            let given = Polynomial::power(self.state.time, length, 1);
            let guess = self.guess(&given);
            match self.attempt(Independent::Time, given, &guess) {
                Some((solution, _)) if solution.end.slope < 0.0 && !turns => {
                    let slowing = |s| {
                        let [_, slope, bend] = solution.piece.radius.curve(s);
                        (-slope, -bend)
                    };
                    length *= rising_root(slowing, [0.0, 1.0], 0.5, 1e-16)[1];
                    turns = true;
                    continue;
                }
                Some((solution, error)) if error <= 1.0 => {
                    self.accept(Independent::Time, &solution);
                    if turns {
                        self.state.slope = 0.0;
                        return Ok(());
                    }
                    length = (length * self.factor(error)).min(left(self).max(length));
                }
                failed => length = self.shorter(length, failed.map(|(_, error)| error))?,
            }
            turns = false;
        }
        Err(self.state.time)
    }

    /// Pieces in the root of the distance from a radius, down to another one or until it is mostly gone.
    fn open(&mut self, base: f64, floor: f64) -> Result<(), f64> {
        let goal = floor.max(LOW * base);
        let mut rise = f64::INFINITY;
        for _ in 0..MOST {
            let [from, to] = [self.state.radius, goal].map(|a| (base - a).max(0.0).sqrt());
            let whole = rise >= to - from;
            rise = rise.min(to - from);
            let given = Polynomial::power(from, rise, 2).below(base);
            let guess = self.opening(&given);
            match self.attempt(Independent::Radius, given, &guess) {
                Some((solution, error)) if error <= 1.0 => {
                    self.accept(Independent::Radius, &solution);
                    if whole {
                        self.state.radius = goal;
                        return Ok(());
                    }
                    rise *= self.factor(error);
                }
                failed => rise = self.shorter(rise, failed.map(|(_, error)| error))?,
            }
        }
        Err(self.state.time)
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
