//! Segments of a trace, as many as its fronts and the tolerance need.
//!
//! Between two neighbouring fronts a < b
//!
//! ```text
//! t = a + (b - a)/2 s^2   and   t = b - (b - a)/2 s^2,     0 < s < 1
//! ```
//!
//! turn the roots at the fronts into smooth functions of s; what is left of logarithms is confined to ever smaller
//! segments by halving those whose series has not converged. A segment that is short beside the time in which the force
//! rises counts for little, and has few nodes.

use crate::error::DomainError;
use crate::field::{Estimate, Six};
use crate::trace::segment::{Piece, Segment};

/// Segments are halved no more once there are so many, which no place needs; what is left out is in the estimate.
const MOST: usize = 200;

/// Segments from the `first` arrival to `end` that follow `remainder`, so that responses to a force that changes by no more
/// than `rise` of its peak within a time hold `tolerance` of their peaks.
///
/// `static_field` is minus the remainder before the first arrival.
pub(crate) fn segments(
    arrivals: &[f64],
    (first, end): (f64, f64),
    static_field: &Six,
    (tolerance, rise): (f64, &dyn Fn(f64) -> f64),
    remainder: impl Fn(f64) -> Result<Estimate, DomainError>,
) -> Result<Vec<Segment>, DomainError> {
    let counts = |segment: &Segment| rise(segment.times[1] - segment.times[0]);
    let mut peak = static_field.map(f64::abs);
    let mut stack = vec![];
    for piece in pieces(arrivals, first, end).into_iter().rev() {
        let segment = Segment::fit(piece, &remainder)?;
        let part = counts(&segment);
        for (f, peak) in peak.iter_mut().enumerate() {
            // of a force that begins so, less than the segment's part of it
            *peak = peak.max(part.powf(1.5) * (segment.middle()[f] + static_field[f]).abs());
        }
        stack.push(segment);
    }
    /// Fields that are smaller beside their kind are not resolved on their own: just below the surface tractions vanish.
    const SMALL: f64 = 1e-6;
    let largest = |kind: &[f64]| kind.iter().copied().fold(0.0, f64::max);
    let kinds = [largest(&peak[..2]), largest(&peak[2..])];
    for (f, peak) in peak.iter_mut().enumerate() {
        *peak = peak.max(SMALL * kinds[usize::from(f >= 2)]);
    }
    let mut done = vec![];
    while let Some(mut segment) = stack.pop() {
        let part = counts(&segment);
        let allowed = peak.map(|peak| tolerance * peak / part);
        let full = done.len() + stack.len() >= MOST;
        loop {
            if full || is_converged(&segment, &allowed) {
                done.push(segment);
                break;
            }
            if !segment.refine(&remainder)? {
                let (early, late) = segment.piece.halves();
                stack.push(Segment::fit(late, &remainder)?);
                stack.push(Segment::fit(early, &remainder)?);
                break;
            }
        }
    }
    Ok(done)
}

/// Whether a series is within what is allowed or as good as its values, or its segment as short as rounding lets it be.
fn is_converged(segment: &Segment, allowed: &Six) -> bool {
    /// Shortest segment in units of the rounding error of its time.
    const SHORTEST: f64 = 64.0;
    let length = segment.times[1] - segment.times[0];
    length <= SHORTEST * f64::EPSILON * segment.times[1]
        || (0..6).all(|f| segment.truncation[f] <= allowed[f].max(segment.error[f]))
}

/// The intervals between fronts, halved, in the order of time.
fn pieces(arrivals: &[f64], first: f64, end: f64) -> Vec<Piece> {
    /// Fronts this close to each other are one.
    const SAME: f64 = 1e-13;
    let mut fronts = vec![first];
    for &arrival in arrivals {
        let last = fronts[fronts.len() - 1];
        if arrival - last > SAME * arrival {
            fronts.push(arrival);
        }
    }
    let mut pieces = vec![];
    for (i, &from) in fronts.iter().enumerate() {
        if from >= end {
            break;
        }
        match fronts.get(i + 1) {
            None => pieces.push(Piece {
                anchor: from,
                scale: end - from,
                s: [0.0, 1.0],
            }),
            Some(&to) => {
                let half = 0.5 * (to - from);
                let until = |reach: f64| (reach / half).clamp(0.0, 1.0).sqrt();
                pieces.push(Piece {
                    anchor: from,
                    scale: half,
                    s: [0.0, until(end - from)],
                });
                if end > from + half {
                    pieces.push(Piece {
                        anchor: to,
                        scale: -half,
                        s: [until(to - end), 1.0],
                    });
                }
            }
        }
    }
    pieces
}
