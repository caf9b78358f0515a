//! Division of a trace into segments, by its fronts and the tolerance.
//!
//! Fronts are ends of segments. A segment whose series has not converged with the largest number of nodes is halved,
//! which confines logarithmic singularities to ever smaller segments. A segment that is short compared with the rise
//! time of the force has little weight and few nodes.

use crate::domain::DomainError;
use crate::field::{Estimate, Six};
use crate::trace::Signal;
use crate::trace::segment::{Course, MappedInterval, Segment};

/// Segments of a signal from its first arrival to `end`, such that the responses to a force that changes by at most `rise` of
/// its peak within a time have errors below `tolerance` of their peaks.
pub(crate) fn segments(
    signal: &Signal,
    end: f64,
    (tolerance, rise): (Six, &dyn Fn(f64) -> Six),
    value: impl Fn(f64) -> Result<Estimate, DomainError>,
) -> Result<Vec<Segment>, DomainError> {
    let counts = |segment: &Segment| rise(segment.times[1] - segment.times[0]);
    let mut peak = signal.size.map(f64::abs);
    let mut stack = vec![];
    for piece in pieces(&signal.fronts, signal.passing, [signal.first, end])
        .into_iter()
        .rev()
    {
        let segment = Segment::fit(piece, &value)?;
        let part = counts(&segment);
        for (f, peak) in peak.iter_mut().enumerate() {
            // for a force that begins like this, less than the segment's part of it
            let since = segment.middle()[f] - signal.before[f];
            *peak = peak.max(part[f].powf(1.5) * since.abs());
        }
        stack.push(segment);
    }
    /// Ratio to the fields of the same kind below which a field is not resolved separately: tractions vanish just below
    /// the surface.
    const SMALLEST_FIELD: f64 = 1e-6;
    let largest = |kind: &[f64]| kind.iter().copied().fold(0.0, f64::max);
    let kinds = [largest(&peak[..2]), largest(&peak[2..])];
    for (f, peak) in peak.iter_mut().enumerate() {
        *peak = peak.max(SMALLEST_FIELD * kinds[usize::from(f >= 2)]);
    }
    let mut done = vec![];
    while let Some(mut segment) = stack.pop() {
        let part = counts(&segment);
        let allowed = std::array::from_fn(|f| tolerance[f] * peak[f] / part[f]);
        let full = done.len() + stack.len() >= signal.most_segments;
        loop {
            if full || is_converged(&segment, &allowed) {
                done.push(segment);
                break;
            }
            if !segment.refine(&value)? {
                for half in segment.piece.parts(2).rev() {
                    stack.push(Segment::fit(half, &value)?);
                }
                break;
            }
        }
    }
    Ok(done)
}

/// Whether the error of a series is allowed or limited by its values, or the segment cannot be shortened further.
fn is_converged(segment: &Segment, allowed: &Six) -> bool {
    /// Shortest segment in units of the rounding error of its time.
    const SHORTEST: f64 = 64.0;
    let length = segment.times[1] - segment.times[0];
    length <= SHORTEST * f64::EPSILON * segment.times[1]
        || (0..6).all(|f| segment.truncation[f] <= allowed[f].max(segment.error[f]))
}

/// The intervals between fronts and after the last front, in the order of time; a wave without a front may be `passing`
/// at a time and for a duration.
///
/// Between fronts that are very far apart few nodes would miss the variation of R within a disc's width of a front, so
/// that such an interval is divided in two.
fn pieces(
    arrivals: &[f64],
    passing: Option<[f64; 2]>,
    [first, end]: [f64; 2],
) -> Vec<MappedInterval> {
    /// Largest distance in radii between fronts that are not very far apart.
    const MOST_RADII_APART: f64 = 500.0;
    /// Largest logarithm of the ratio of times that one polynomial covers.
    const LONG: f64 = 3.5;
    /// Relative distance below which two fronts count as one.
    const SAME_FRONT: f64 = 1e-13;
    let mut fronts = vec![first];
    for &arrival in arrivals {
        let last = fronts[fronts.len() - 1];
        if arrival - last > SAME_FRONT * arrival {
            fronts.push(arrival);
        }
    }
    let mut courses = vec![];
    for pair in fronts.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        if to - from < MOST_RADII_APART {
            courses.push((from, Course::Between([from, to])));
        } else {
            let middle = 0.5 * (from + to);
            courses.push((from, Course::beside(from, middle)));
            courses.push((middle, Course::beside(to, middle)));
        }
    }
    let last = fronts[fronts.len() - 1];
    match passing {
        Some(wave) if wave[0] > last => {
            let middle = 0.5 * (last + wave[0]);
            courses.push((last, Course::beside(last, middle)));
            courses.push((middle, Course::around(wave, [middle, end.max(middle)])));
        }
        Some(_) | None => courses.push((last, Course::beside(last, end.max(last)))),
    }
    let begun = courses.into_iter().filter(|(from, _)| *from < end);
    let parts = |(_, course): (f64, Course)| {
        let count = (course.length() / LONG).ceil().max(1.0);
        MappedInterval::new(course, end).parts(count as u32)
    };
    begun.flat_map(parts).collect()
}
