//! Pieces in the radius until it is zero.
//!
//! The end of contact is then the time at a known place.
//! In the last instants the contact is so small that its waves cross it in no time: the time left goes
//! from a^2 over the velocity to a smaller multiple of it, for a stiff striker to nearly a power one of a.

use crate::error::MarchError;
use crate::growing::arrivals::{Piece, State};
use crate::growing::equations::{Independent, March};
use crate::growing::polynomial::{Polynomial, SIZE};

/// Pieces at most, tried ones included.
const MOST: usize = 200;

/// Error of the time left when it is taken from the power law of the last piece.
const POWER_LAW: f64 = 0.2;

/// Time left, over the accuracy, that is not resolved.
const NEGLIGIBLE: f64 = 2.0;

/// The same where no shorter piece is found either.
const LOST: f64 = 30.0;

impl March<'_> {
    /// # Errors
    /// [`MarchError::NotFollowed`].
    pub(crate) fn close(&mut self) -> Result<(), MarchError> {
        if self.law.lag.is_some() {
            return Ok(());
        }
        let mut ratio = 0.3;
        // dt/da ~ a^(power - 1)
        let mut power = 2.0_f64;
        let mut again = 0;
        let (phi, wave_time) = (self.contact.target_share, self.contact.wave_time);
        let bare = (self.accuracy / (0.01 * phi * wave_time)).max(0.3 * wave_time);
        for _ in 0..MOST {
            let from = self.state.radius;
            let rate = self.law.branch.at(from).depth_slope / -self.state.slope;
            let left = rate * from / power;
            if left < NEGLIGIBLE * self.accuracy || again > 5 && left < LOST * self.accuracy {
                self.end_by_power_law(left, power);
                return Ok(());
            }
            if from < 3.0 * wave_time {
                self.level = self.level.max(self.least_level());
            }
            let last = from < bare && again == 0;
            let to = if last { 0.0 } else { ratio * from };
            let given = Polynomial::power(from.sqrt(), to.sqrt() - from.sqrt(), 2);
            let guess = self.power_law(&given, left, power);
            match self.attempt(Independent::Radius, given, guess) {
                Some((solution, error)) if error <= 1.0 => {
                    self.accept(Independent::Radius, &solution);
                    if last {
                        return Ok(());
                    }
                    again = 0;
                    let rise = self.law.branch.at(to).depth_slope / -self.state.slope / rate;
                    power = (1.0 + rise.ln() / (to / from).ln()).clamp(0.7, 2.0);
                    ratio = (1.0 - (1.0 - ratio) * self.factor(error)).clamp(0.1, 0.8);
                }
                Some(_) | None => {
                    if !last {
                        ratio = 1.0 - 0.6 * (1.0 - ratio);
                    }
                    again += 1;
                    if again > 1 && self.level < 7 {
                        self.level += 1;
                    }
                    if ratio > 0.999 {
                        break;
                    }
                }
            }
        }
        Err(self.lost())
    }

    /// Level of the rule over the waves below which the last instants have no solution: with few waves the
    /// stiff striker's contact does not open steadily.
    fn least_level(&self) -> usize {
        let phi = self.contact.target_share;
        let stiff = [phi > 0.5, phi > 0.9, self.accuracy < 1e-6];
        1 + stiff.map(usize::from).iter().sum::<usize>()
    }

    /// Times at the nodes by t = t_0 + left (1 - (a/a_0)^power).
    fn power_law(&self, radius: &Polynomial, left: f64, power: f64) -> [f64; SIZE] {
        let mut times = [0.0; SIZE];
        for (time, &s) in times.iter_mut().zip(&self.nodes.places) {
            let a = radius.value(s).max(0.0) / self.state.radius;
            *time = self.state.time + left * (1.0 - a.powf(power));
        }
        times
    }

    /// The last piece by the power law: shorter than the error.
    fn end_by_power_law(&mut self, left: f64, power: f64) {
        let start = self.state;
        let radius = Polynomial::power(start.radius.sqrt(), -start.radius.sqrt(), 2);
        let times = self.power_law(&radius, left, power);
        let places = times.map(|time| start.displacement + start.velocity * (time - start.time));
        self.errors.end += POWER_LAW * left;
        self.state = State {
            time: start.time + left,
            radius: 0.0,
            displacement: start.displacement + start.velocity * left,
            ..start
        };
        self.pieces.push(Piece {
            law: self.law,
            time: self.nodes.polynomial(&times),
            radius,
            velocity: Polynomial::constant(start.velocity),
            displacement: self.nodes.polynomial(&places),
            force: None,
            start,
            end: self.state,
        });
    }
}
