//! Ticks at powers of ten, and at multiples of them where there are few.

use super::{Room, Tick, Ticks, linear};
use crate::interval::Interval;
use crate::text::{decimal, power_of_ten};

/// Ticks of a logarithmic axis.
pub(super) fn ticks(interval: &Interval, factor: f64, room: &Room<'_>) -> Ticks {
    let (low, high) = (interval.low / factor, interval.high / factor);
    let decades = (high / low).log10();
    if decades < 0.5 {
        // hardly bent: equal differences
        return linear::ticks(interval, factor, room);
    }
    let first = (low.log10() - 1e-9).floor() as i32;
    let last = (high.log10() + 1e-9).ceil() as i32;
    let inside = |value: f64| interval.contains(value * factor);
    // plain numbers where all are short
    let plain = low > 0.9e-3 && high < 1.1e4;
    let tick = |digit: u32, exponent: i32| Tick {
        value: f64::from(digit) * ten(exponent) * factor,
        label: if plain {
            let places = usize::try_from(-exponent).unwrap_or(0);
            decimal(f64::from(digit) * ten(exponent), places)
        } else {
            power_of_ten(digit, exponent)
        },
    };
    let at = |digits: &[u32], stride: i32| -> Vec<Tick> {
        (first..=last)
            .filter(|exponent| exponent.rem_euclid(stride) == 0)
            .flat_map(|exponent| digits.iter().map(move |&d| (d, exponent)))
            .map(|(digit, exponent)| tick(digit, exponent))
            .filter(|t| inside(t.value / factor))
            .collect()
    };
    let dense: &[&[u32]] = &[&[1, 2, 3, 5], &[1, 2, 5], &[1, 3]];
    let dense = dense.iter().filter(|_| decades < 2.5);
    let candidates = dense
        .map(|digits| (*digits, 1))
        .chain((1..=last - first + 1).map(|stride| (&[1_u32][..], stride)));
    let mut found = None;
    for (digits, stride) in candidates {
        let major = at(digits, stride);
        if major.is_empty() {
            continue;
        }
        let fits = room.fits(interval, &major);
        found = Some((major, stride));
        if fits {
            break;
        }
    }
    let (mut major, stride) = found.unwrap_or((Vec::new(), 1));
    if !room.fits(interval, &major) {
        major.truncate(1);
    }
    let labelled = |value: f64| major.iter().any(|t| (t.value / value - 1.0).abs() < 1e-6);
    // multiples where a decade is long enough, the decades themselves where labels skip some
    let fine = room.length / decades >= 40.0 && stride == 1;
    let digits = if fine { 1..=9 } else { 1..=1 };
    let minor = (first..=last)
        .flat_map(|exponent| digits.clone().map(move |d| f64::from(d) * ten(exponent)))
        .filter(|&value| inside(value) && !labelled(value * factor))
        .map(|value| value * factor)
        .collect();
    Ticks { major, minor }
}

/// A power of ten to the last bit.
fn ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(low: f64, high: f64, length: f64) -> Ticks {
        let needs = |label: &str| 6.0 * label.chars().count() as f64 + 8.0;
        let room = Room {
            length,
            distance: 70.0,
            needs: &needs,
        };
        ticks(&Interval::logarithmic(low, high), 1.0, &room)
    }

    #[test]
    fn ticks_are_round_inside_and_two_at_least() {
        for (low, high) in [
            (1e-16, 10.0),
            (1.0, 100.0),
            (3.0, 1e6),
            (0.4, 30.0),
            (1e-3, 0.2),
            (30.0, 45.0),
            (1e-150, 1e150),
        ] {
            let interval = Interval::logarithmic(low, high);
            let found = found(low, high, 500.0);
            assert!(
                (2..=12).contains(&found.major.len()),
                "{low} {high}: {found:?}"
            );
            let all = found.major.iter().map(|t| &t.value).chain(&found.minor);
            assert!(all.clone().all(|&v| interval.contains(v)));
        }
    }

    #[test]
    fn plain_numbers_where_all_are_short() {
        let labels: Vec<String> = found(0.01, 100.0, 500.0)
            .major
            .into_iter()
            .map(|t| t.label)
            .collect();
        assert_eq!(labels, ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(found(1e-9, 1.0, 900.0).major[0].label, "10^{\u{2212}9}");
    }

    #[test]
    fn multiples_are_minor_ticks() {
        let ticks = found(1e-3, 1e3, 400.0);
        assert_eq!(ticks.major.len(), 7);
        assert_eq!(ticks.minor.len(), 48);
        // too narrow for them: at least the decades without label
        let narrow = found(1e-16, 1e4, 200.0);
        assert_eq!(narrow.major.len() + narrow.minor.len(), 21);
    }
}
