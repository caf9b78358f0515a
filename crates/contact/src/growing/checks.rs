//! Checks of two assumptions of the solution: waves arrive in the order in which they left, and the surface does not come
//! back to the striker.
//!
//! After the end t_e the force is zero, and the residual deflection relaxes as
//!
//! ```text
//! w'(t) = -phi sum_k (m_k/X_k) (g_1 - g_2),    T + X_k a = t at two times, T_1 < T_2 < t_e
//! ```
//!
//! with the g = int ds/a of the law, since waves of the shrinking contact are younger the later they left, but smaller.

use crate::error::MarchError;
use crate::growing::arrivals::ContactPiece;
use crate::growing::solved::SolvedContact;
use crate::waves::punch::GrowingContact;

/// Samples of a piece.
const SAMPLES_OF_PIECE: usize = 6;

/// Times after the end at which the gap is looked at.
const TIMES_OF_GAP: usize = 8;

/// Level of the rule over the waves for the gap.
const LEVEL_OF_GAP: usize = 1;

/// Depth of a second contact that cannot be distinguished from the error of the gap.
const NOISE_OF_GAP: f64 = 1e-6;

/// Part of the largest radius below which departures are not looked at: the last instants are known to
/// the accuracy only.
const SMALL_RADIUS: f64 = 1e-2;

/// The contact, if both assumptions hold.
pub(crate) fn passed(
    solved: SolvedContact,
    contact: &GrowingContact<'_>,
) -> Result<SolvedContact, MarchError> {
    if let Some(time) = folds(&solved.pieces, contact) {
        return Err(MarchError::Overtaken { time });
    }
    let velocity = -solved.summary.restitution;
    match strikes_again(&solved.pieces, contact, velocity) {
        Some(time) => Err(MarchError::StrikesAgain { time }),
        None => Ok(solved),
    }
}

/// When waves that left at different times arrive together, if they do.
///
/// At the arrival t the age of a wave over the radius that it left, (t - T)/a, has to grow with the age.
fn folds(pieces: &[ContactPiece], contact: &GrowingContact<'_>) -> Option<f64> {
    let end = pieces.last()?.end.time;
    let radius = |piece: usize| pieces[piece].end.radius;
    let top = (0..pieces.len()).max_by(|&a, &b| radius(a).total_cmp(&radius(b)))?;
    let widest = radius(top);
    let memory = contact.waves.memory * contact.wave_time;
    for piece in &pieces[top..] {
        for i in 1..=SAMPLES_OF_PIECE {
            let place = i as f64 / SAMPLES_OF_PIECE as f64;
            let [time, time_slope, _] = piece.time.jet(place);
            let [radius, radius_slope, _] = piece.radius.jet(place);
            let shrinks = radius >= SMALL_RADIUS * widest && radius_slope < 0.0;
            let age = memory.min((end - time) / radius);
            if shrinks && time_slope + age * radius_slope < 0.0 {
                return Some(time);
            }
        }
    }
    None
}

/// When the surface overtakes the striker after the end, if it does.
fn strikes_again(
    pieces: &[ContactPiece],
    contact: &GrowingContact<'_>,
    velocity: f64,
) -> Option<f64> {
    let end = pieces.last()?.end.time;
    if velocity >= 0.0 {
        return Some(end);
    }
    let sample = |piece: &ContactPiece, i: usize| {
        let place = i as f64 / SAMPLES_OF_PIECE as f64;
        let radius = piece.radius.value(place).max(0.0);
        [piece.time.value(place), radius, piece.law.delayed(radius)]
    };
    let samples: Vec<[f64; 3]> = pieces
        .iter()
        .flat_map(|piece| (1..=SAMPLES_OF_PIECE).map(move |i| sample(piece, i)))
        .collect();
    let widest = samples.iter().fold(0.0_f64, |m, &[_, a, _]| m.max(a));
    let memory = contact.waves.memory * contact.wave_time * widest;
    // the gap opens first; it closes where the surface is faster than the striker for long enough
    let (mut gap, mut before) = (0.0_f64, end);
    for i in 0..TIMES_OF_GAP {
        let t = end + memory * ((i as f64 + 0.5) / TIMES_OF_GAP as f64).powi(2);
        gap += (velocity - relaxing(&samples, contact, t)) * (t - before);
        before = t;
        if gap > NOISE_OF_GAP {
            return Some(t);
        }
    }
    None
}

/// Velocity of the surface at a time after the end.
fn relaxing(samples: &[[f64; 3]], contact: &GrowingContact<'_>, t: f64) -> f64 {
    let mut sum = 0.0;
    for (delay, rate) in contact.waves.rule(LEVEL_OF_GAP) {
        let late = |[time, radius, _]: [f64; 3]| time + delay * contact.wave_time * radius - t;
        // from the end back: waves that have not come, then those that have, then the oldest, long gone
        let mut left = samples.windows(2).rev().filter_map(|pair| {
            let (young, old) = (late(pair[1]), late(pair[0]));
            let part = young / (young - old);
            let there = pair[1][2] + part * (pair[0][2] - pair[1][2]);
            ((young < 0.0) != (old < 0.0)).then_some(there)
        });
        if let (Some(last), Some(first)) = (left.next(), left.next()) {
            sum += rate * (first - last);
        }
    }
    -contact.target_share * sum / contact.wave_time
}
