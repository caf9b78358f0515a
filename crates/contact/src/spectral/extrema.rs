//! Where force, displacement and deflection are largest.

use super::piece::Piece;

/// A value and when it is reached.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extremum {
    pub(super) time: f64,
    pub(super) value: f64,
}

/// Parts of a piece in which an extremum is looked for.
const PARTS: usize = 4;

/// The largest of a quantity over pieces: its value at a place of a piece, and what has the sign of its slope.
pub(super) fn largest(
    pieces: &[Piece],
    value: impl Fn(&Piece, f64) -> f64,
    slope: impl Fn(&Piece, f64) -> f64,
) -> Extremum {
    let mut best = Extremum {
        time: 0.0,
        value: 0.0,
    };
    let mut candidate = |piece: &Piece, place: f64| {
        let found = value(piece, place);
        if found > best.value {
            best = Extremum {
                time: piece.time.value(place),
                value: found,
            };
        }
    };
    for piece in pieces {
        candidate(piece, 1.0);
        let mut before = slope(piece, 0.0);
        for part in 1..=PARTS {
            let end = part as f64 / PARTS as f64;
            let after = slope(piece, end);
            if before > 0.0 && after <= 0.0 {
                let start = end - 1.0 / PARTS as f64;
                candidate(piece, falling_zero(|place| slope(piece, place), start, end));
            }
            before = after;
        }
    }
    best
}

/// A zero of f between two places, positive at the first and not at the second: the false position,
/// with the value of an end that stays halved.
pub(super) fn falling_zero(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut above, mut below) = (f(low), f(high));
    let mut stays = 0_i32;
    let mut place = high;
    for _ in 0..100 {
        let next = (low * below - high * above) / (below - above);
        let middle = 0.5 * (low + high);
        let next = if next > low && next < high {
            next
        } else {
            middle
        };
        let value = f(next);
        let still = (next - place).abs() <= 1e-15 || value == 0.0;
        place = next;
        if still {
            break;
        }
        if value > 0.0 {
            (low, above) = (next, value);
            if stays == 1 {
                below *= 0.5;
            }
            stays = 1;
        } else {
            (high, below) = (next, value);
            if stays == -1 {
                above *= 0.5;
            }
            stays = -1;
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zero_is_found_to_the_last_digits() {
        let found = falling_zero(|x| 0.3 - x.powi(5), 0.0, 1.0);
        assert!((found.powi(5) - 0.3).abs() < 1e-14);
        let found = falling_zero(|x| 1e-3 - x.sqrt(), 0.0, 1.0);
        assert!((found - 1e-6).abs() < 1e-14, "{found}");
    }
}
