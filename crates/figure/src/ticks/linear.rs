//! Ticks at multiples of 1, 2 or 5 times a power of ten.

use super::{Room, Tick, Ticks};
use crate::interval::Interval;
use crate::text::decimal;

/// Steps tried, from the finest: those at a tenth of the wished distance are never wanted.
const TRIED: usize = 24;

/// The finest step whose labels fit at about the wished distance.
pub(super) fn ticks(interval: &Interval, factor: f64, room: &Room<'_>) -> Ticks {
    let (low, high) = (interval.low / factor, interval.high / factor);
    let wished = (high - low) * room.distance / room.length;
    let exponent = wished.log10().floor() as i32 - 1;
    let steps = (0..TRIED).map(|i| {
        let (digit, parts) = [(1.0, 5), (2.0, 4), (5.0, 5)][i % 3];
        (digit, exponent + (i / 3) as i32, parts)
    });
    let mut coarsest = None;
    for (digit, exponent, parts) in steps {
        let step = digit * 10.0_f64.powi(exponent);
        if step < 0.72 * wished {
            continue;
        }
        let places = usize::try_from(-exponent).unwrap_or(0);
        let major: Vec<Tick> = multiples(low, high, step)
            .map(|shown| Tick {
                value: shown * factor,
                label: decimal(shown, places),
            })
            .collect();
        if major.is_empty() {
            break;
        }
        let fits = room.fits(interval, &major);
        coarsest = Some(Ticks {
            major,
            minor: minor(low, high, step, parts)
                .map(|shown| shown * factor)
                .collect(),
        });
        if fits {
            break;
        }
    }
    // an axis too short for two labels keeps one
    let mut found = coarsest.unwrap_or(Ticks {
        major: Vec::new(),
        minor: Vec::new(),
    });
    if !room.fits(interval, &found.major) {
        found.major.truncate(1);
    }
    found
}

/// Multiples of a step from `low` to `high`, the ends included up to rounding.
fn multiples(low: f64, high: f64, step: f64) -> impl Iterator<Item = f64> {
    let first = (low / step - 1e-9).ceil();
    let count = (high / step + 1e-9).floor() - first;
    (0..=count.clamp(-1.0, 1e4) as i64).map(move |i| (first + i as f64) * step)
}

fn minor(low: f64, high: f64, step: f64, parts: u32) -> impl Iterator<Item = f64> {
    let fine = step / f64::from(parts);
    multiples(low, high, fine).filter(move |value| {
        let place = value / step;
        (place - place.round()).abs() * f64::from(parts) > 0.5
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, factor: f64, length: f64) -> Vec<String> {
        let needs = |label: &str| 6.0 * label.chars().count() as f64 + 8.0;
        let room = Room {
            length,
            distance: 70.0,
            needs: &needs,
        };
        let found = ticks(&Interval::linear(low, high), factor, &room);
        found.major.into_iter().map(|t| t.label).collect()
    }

    #[test]
    fn labels_are_round_and_have_equal_places() {
        assert_eq!(
            labels(0.0, 2.0, 1.0, 300.0),
            ["0.0", "0.5", "1.0", "1.5", "2.0"]
        );
        assert_eq!(
            labels(-3e-6, 3.1e-6, 1e-6, 300.0).first().unwrap(),
            "\u{2212}2"
        );
        assert_eq!(labels(0.98, 0.9804, 1.0, 300.0)[1], "0.9801");
        assert_eq!(labels(0.0, 1e5, 1.0, 400.0).last().unwrap(), "100000");
    }

    #[test]
    fn short_axes_have_few_labels_and_never_too_many() {
        for length in [20.0, 60.0, 200.0, 1000.0, 4000.0] {
            for (low, high) in [(0.0, 1.0), (-1e-3, 7e-3), (1e6, 1e6 + 3.0), (-2.0, 999.0)] {
                let found = labels(low, high, 1.0, length);
                assert!(
                    found.len() as f64 <= 1.0 + length / 22.0,
                    "{length}: {found:?}"
                );
                assert!(
                    length < 200.0 || found.len() >= 2,
                    "{length} {low}: {found:?}"
                );
            }
        }
    }

    #[test]
    fn minor_ticks_lie_between_the_major_ones() {
        let found: Vec<f64> = minor(0.0, 2.0, 1.0, 5).collect();
        assert_eq!(found.len(), 8);
        assert!(found.iter().all(|v| (v - v.round()).abs() > 0.1));
    }
}
