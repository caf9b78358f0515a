//! A contact as pieces of polynomials, and where its waves left.

use super::departure::Departure;
use super::polynomial::Polynomial;
use super::roots::{LANES, Roots};

/// Time, contact radius, velocity and displacement of the striker over a stretch of the contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) time: Polynomial,
    pub(super) radius: Polynomial,
    pub(super) velocity: Polynomial,
    pub(super) displacement: Polynomial,
    /// Time and radius where it starts.
    pub(super) from: (f64, f64),
    /// Time and radius where it ends.
    pub(super) to: (f64, f64),
}

/// The piece of an arrival, after all others.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arrival<'a> {
    pub(super) time_of: &'a Polynomial,
    pub(super) radius_of: &'a Polynomial,
    /// Time and radius where the piece starts.
    pub(super) from: (f64, f64),
    /// Place in it.
    pub(super) place: f64,
    /// Time of the arrival.
    pub(super) time: f64,
}

impl Arrival<'_> {
    /// The departures of waves of some delays, in ascending order: later and later back in time.
    ///
    /// `found` holds those of a nearby contact as first guesses, where `again`.
    pub(super) fn departures(
        &self,
        pieces: &[Piece],
        delays: &[f64],
        again: bool,
        found: &mut [Departure],
    ) {
        let mut index = pieces.len();
        let mut k = 0;
        while k < delays.len() {
            let from = |index: usize| pieces.get(index).map_or(self.from, |piece| piece.from);
            // the piece of the first of those that are left, and those that it holds too
            while index > 0 && from(index).0 + delays[k] * from(index).1 > self.time {
                index -= 1;
            }
            let start = from(index);
            let held = delays[k..]
                .iter()
                .take(LANES)
                .take_while(|&delay| index == 0 || start.0 + delay * start.1 <= self.time)
                .count();
            let (time, radius, latest) = match pieces.get(index) {
                Some(piece) => (&piece.time, &piece.radius, 1.0),
                None => (self.time_of, self.radius_of, self.place),
            };
            let roots = Roots {
                time,
                radius,
                arrival: self.time,
                latest,
            };
            let (delays, found) = (&delays[k..k + held], &mut found[k..k + held]);
            roots.find(delays, index, again, found);
            k += held;
        }
    }
}
