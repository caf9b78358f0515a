//! Segments of a trace, as many as its fronts and the tolerance need.
//!
//! Between two neighbouring fronts a < b
//!
//! ```text
//! t = a + (b - a)/2 s^2   and   t = b - (b - a)/2 s^2,     0 < s < 1
//! ```
//!
//! turn the roots at the fronts into smooth functions of s; what is left of logarithms is confined to ever smaller
//! segments by halving those whose series has not converged.

use crate::error::DomainError;
use crate::field::{Estimate, Six};
use crate::segment::{Piece, Segment};

/// Segments are halved no more once there are so many, which no place needs; what is left out is in the estimate.
const MOST: usize = 1000;

/// Segments from the `first` arrival to `end` that follow `remainder`, to `tolerance` of each field's peak.
///
/// `static_field` is minus the remainder before the first arrival.
pub(crate) fn segments(
    arrivals: &[f64],
    (first, end): (f64, f64),
    static_field: &Six,
    tolerance: f64,
    remainder: impl Fn(f64) -> Result<Estimate, DomainError>,
) -> Result<Vec<Segment>, DomainError> {
    let mut peak = static_field.map(f64::abs);
    let fit = |piece: Piece, peak: &mut Six| {
        Segment::fit(piece, |t| {
            let found = remainder(t)?;
            for (f, peak) in peak.iter_mut().enumerate() {
                *peak = peak.max((found.value[f] + static_field[f]).abs());
            }
            Ok(found)
        })
    };
    let mut stack = vec![];
    for piece in pieces(arrivals, first, end).into_iter().rev() {
        stack.push(fit(piece, &mut peak)?);
    }
    let mut done = vec![];
    while let Some(segment) = stack.pop() {
        if done.len() + stack.len() >= MOST || is_converged(&segment, tolerance, &peak) {
            done.push(segment);
        } else {
            let (early, late) = segment.piece.halves();
            stack.push(fit(late, &mut peak)?);
            stack.push(fit(early, &mut peak)?);
        }
    }
    Ok(done)
}

/// Whether a series is as good as its values, or its segment as short as rounding lets it be.
fn is_converged(segment: &Segment, tolerance: f64, peak: &Six) -> bool {
    /// Shortest segment in units of the rounding error of its time.
    const SHORTEST: f64 = 64.0;
    let length = segment.times[1] - segment.times[0];
    if length <= SHORTEST * f64::EPSILON * segment.times[1] {
        return true;
    }
    let left = segment.truncation();
    (0..6).all(|f| {
        // a short segment counts for no more than its length
        left[f] * length.min(1.0) <= (tolerance * peak[f]).max(segment.error[f])
    })
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
