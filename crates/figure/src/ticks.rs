//! Ticks: round values with labels that fit next to one another, in a suitable multiple of the unit.

use crate::axis::{Axis, Interval, Scale};
use crate::text::{decimal, power_of_ten};

/// Ticks of an axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Ticks {
    /// Ticks with labels, as markup.
    pub(crate) major: Vec<(f64, String)>,
    /// Minor ticks between them.
    pub(crate) minor: Vec<f64>,
}

/// Ticks over an interval whose labels are values divided by `factor`.
pub(crate) fn ticks(interval: &Interval, factor: f64, room: &Room<'_>) -> Ticks {
    let (low, high) = (interval.low / factor, interval.high / factor);
    let decades = (high / low).log10();
    match interval.scale {
        Scale::Logarithmic if decades >= 0.5 => logarithmic(interval, factor, decades, room),
        // on a nearly linear logarithmic axis equal differences are suitable
        Scale::Linear | Scale::Logarithmic => linear(interval, factor, room),
    }
}

/// Space for ticks.
pub(crate) struct Room<'a> {
    /// Length of the axis in pixels.
    pub(crate) length: f64,
    /// Desired distance of two labels in pixels.
    pub(crate) distance: f64,
    /// Length of a label along the axis in pixels, with a gap.
    pub(crate) needs: &'a dyn Fn(&str) -> f64,
}

impl Room<'_> {
    /// The first candidate whose labels fit; if none fits, the coarsest one with a single label.
    fn first_that_fits(
        &self,
        interval: &Interval,
        candidates: impl Iterator<Item = Ticks>,
    ) -> Ticks {
        let fits = |ticks: &Ticks| {
            ticks.major.windows(2).all(|pair| {
                let distance = interval.fraction(pair[1].0) - interval.fraction(pair[0].0);
                let needed = 0.5 * ((self.needs)(&pair[0].1) + (self.needs)(&pair[1].1));
                distance.abs() * self.length >= needed
            })
        };
        let mut coarsest = Ticks::default();
        for candidate in candidates {
            if fits(&candidate) {
                return candidate;
            }
            coarsest = candidate;
        }
        coarsest.major.truncate(1);
        coarsest
    }
}

/// Ticks at multiples of 1, 2 or 5 times a power of ten: the finest that fit, at about the desired distance.
fn linear(interval: &Interval, factor: f64, room: &Room<'_>) -> Ticks {
    /// Number of tried steps, from a tenth of the desired distance on, which is never needed.
    const TRIED: usize = 24;
    let (low, high) = (interval.low / factor, interval.high / factor);
    let wished = (high - low) * room.distance / room.length;
    let exponent = wished.log10().floor() as i32 - 1;
    let steps = (0..TRIED).map(|i| {
        let (digit, parts) = [(1.0, 5), (2.0, 4), (5.0, 5)][i % 3];
        let exponent = exponent + (i / 3) as i32;
        (exponent, digit * 10.0_f64.powi(exponent), parts)
    });
    let candidates = steps
        .filter(|(_, step, _)| *step >= 0.72 * wished)
        .map(|(exponent, step, parts)| {
            let places = usize::try_from(-exponent).unwrap_or(0);
            let tick = |shown| (shown * factor, decimal(shown, places));
            let minor = minor(low, high, step, parts);
            Ticks {
                major: multiples(low, high, step).map(tick).collect(),
                minor: minor.map(|shown| shown * factor).collect(),
            }
        })
        .take_while(|ticks| !ticks.major.is_empty());
    room.first_that_fits(interval, candidates)
}

/// Multiples of a step from `low` to `high`, including the ends up to rounding.
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

/// Ticks at powers of ten, and at multiples of them if there are few.
fn logarithmic(interval: &Interval, factor: f64, decades: f64, room: &Room<'_>) -> Ticks {
    let (low, high) = (interval.low / factor, interval.high / factor);
    let first = (low.log10() - 1e-9).floor() as i32;
    let last = (high.log10() + 1e-9).ceil() as i32;
    let inside = |value: f64| interval.contains(value * factor);
    let plain = is_plain(low, high);
    let tick = |digit: u32, exponent: i32| {
        let shown = f64::from(digit) * ten(exponent);
        let label = match plain {
            true => decimal(shown, usize::try_from(-exponent).unwrap_or(0)),
            false => power_of_ten(digit, exponent),
        };
        (shown * factor, label)
    };
    let at = |(digits, stride): (&[u32], i32)| {
        let major: Vec<_> = (first..=last)
            .filter(|exponent| exponent.rem_euclid(stride) == 0)
            .flat_map(|exponent| digits.iter().map(move |&digit| tick(digit, exponent)))
            .filter(|t| inside(t.0 / factor))
            .collect();
        let labelled = |value: f64| major.iter().any(|t| (t.0 / value - 1.0).abs() < 1e-6);
        // multiples if a decade is long enough, the decades themselves if labels skip some
        let fine = room.length / decades >= 40.0 && stride == 1;
        let digits = if fine { 1..=9 } else { 1..=1 };
        let minor = (first..=last)
            .flat_map(|exponent| digits.clone().map(move |d| f64::from(d) * ten(exponent)))
            .filter(|&value| inside(value) && !labelled(value * factor))
            .map(|value| value * factor)
            .collect();
        Ticks { major, minor }
    };
    let dense: &[&[u32]] = &[&[1, 2, 3, 5], &[1, 2, 5], &[1, 3]];
    let dense = dense.iter().filter(|_| decades < 2.5);
    let candidates = dense
        .map(|digits| (*digits, 1))
        .chain((1..=last - first + 1).map(|stride| (&[1_u32][..], stride)))
        .map(at)
        .filter(|ticks| !ticks.major.is_empty());
    room.first_that_fits(interval, candidates)
}

/// Whether numbers on a logarithmic axis are written without powers of ten: all of them are short.
fn is_plain(low: f64, high: f64) -> bool {
    low > 0.9e-3 && high < 1.1e4
}

/// An exactly rounded power of ten.
fn ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

/// SI prefixes from 1e-24 to 1e24 in steps of a thousand.
const PREFIXES: [&str; 17] = [
    "y", "z", "a", "f", "p", "n", "\u{b5}", "m", "", "k", "M", "G", "T", "P", "E", "Z", "Y",
];

/// Label and factor of the multiple of a unit that suits the values of an interval: shown numbers are values divided by
/// the factor.
///
/// An SI unit gets a prefix and any other unit a power of ten, so that the largest value has one to three digits before
/// the point. Values from 0.1 to 1 keep the unit itself, lengths excepted. A logarithmic axis keeps it unless a prefix
/// makes all numbers short.
pub(crate) fn shown(axis: &Axis, interval: &Interval) -> (String, f64) {
    let largest = interval.low.abs().max(interval.high.abs());
    let exponent = match interval.scale {
        Scale::Linear if largest > 0.0 => largest.log10().floor() as i32,
        Scale::Logarithmic if axis.has_prefixes => short_numbers(interval).unwrap_or(0),
        Scale::Linear | Scale::Logarithmic => 0,
    };
    let thousands = 3 * exponent.div_euclid(3);
    let unit = axis.unit.as_str();
    let (exponent, unit) = match axis.has_prefixes {
        // values from 0.1 to 1 are readable without a prefix, lengths excepted: 120 mm
        true if exponent == -1 && unit != "m" && interval.scale == Scale::Linear => {
            (0, unit.to_owned())
        }
        true => {
            let exponent = thousands.clamp(-24, 24);
            let prefix = PREFIXES[((exponent + 24) / 3) as usize];
            (exponent, format!("{prefix}{unit}"))
        }
        false if (-3..5).contains(&exponent) => (0, unit.to_owned()),
        false => {
            let unit = format!("{} {unit}", power_of_ten(1, thousands));
            (thousands, unit.trim().to_owned())
        }
    };
    let label = match unit.as_str() {
        "" => axis.quantity.clone(),
        unit => format!("{} [{unit}]", axis.quantity)
            .trim_start()
            .to_owned(),
    };
    (label, 10.0_f64.powi(exponent))
}

/// The power of ten, zero or that of a prefix, by which all numbers of a logarithmic axis become short; none if it has
/// too many decades.
fn short_numbers(interval: &Interval) -> Option<i32> {
    let first = 3 * (interval.low.log10().floor() as i32).div_euclid(3);
    let mut powers = [0].into_iter().chain((0..3).map(|i| first + 3 * i));
    powers.find(|&power| is_plain(interval.low / ten(power), interval.high / ten(power)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(interval: &Interval, factor: f64, length: f64) -> Ticks {
        let needs = |label: &str| 6.0 * label.chars().count() as f64 + 8.0;
        let room = Room {
            length,
            distance: 70.0,
            needs: &needs,
        };
        ticks(interval, factor, &room)
    }

    fn labels(low: f64, high: f64, factor: f64, length: f64) -> Vec<String> {
        let found = found(&Interval::linear(low, high), factor, length);
        found.major.into_iter().map(|t| t.1).collect()
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
            let found = found(&interval, 1.0, 500.0);
            assert!(
                (2..=12).contains(&found.major.len()),
                "{low} {high}: {found:?}"
            );
            let all = found.major.iter().map(|t| &t.0).chain(&found.minor);
            assert!(all.clone().all(|&v| interval.contains(v)));
        }
    }

    #[test]
    fn plain_numbers_where_all_are_short() {
        let labels: Vec<String> = found(&Interval::logarithmic(0.01, 100.0), 1.0, 500.0)
            .major
            .into_iter()
            .map(|t| t.1)
            .collect();
        assert_eq!(labels, ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(
            found(&Interval::logarithmic(1e-9, 1.0), 1.0, 900.0).major[0].1,
            "10^{\u{2212}9}"
        );
    }

    #[test]
    fn multiples_are_minor_ticks() {
        let ticks = found(&Interval::logarithmic(1e-3, 1e3), 1.0, 400.0);
        assert_eq!(ticks.major.len(), 7);
        assert_eq!(ticks.minor.len(), 48);
        // too narrow for labels: at least the decades without labels
        let narrow = found(&Interval::logarithmic(1e-16, 1e4), 1.0, 200.0);
        assert_eq!(narrow.major.len() + narrow.minor.len(), 21);
    }

    #[test]
    fn units_of_the_si_take_prefixes() {
        let si = |unit: &str, high: f64| {
            shown(&Axis::linear("x").si(unit), &Interval::linear(0.0, high))
        };
        assert_eq!(si("s", 4e-5).0, "x [\u{b5}s]");
        assert_eq!(si("N", 38_200.0).0, "x [kN]");
        assert_eq!(si("m/s", 0.5).0, "x [m/s]");
        assert_eq!(si("m", 0.12).0, "x [mm]");
        assert_eq!(si("Pa", 2.1e11).1, 1e9);
        assert_eq!(si("Pa", 0.0).1, 1.0);
        // also a logarithmic axis, unless its many decades require powers of ten
        for (low, high, label) in [
            (5e-6, 8e-5, "t [\u{b5}s]"),
            (2e-7, 4e-6, "t [ns]"),
            (2e-7, 4e-5, "t [\u{b5}s]"),
            (0.05, 20.0, "t [s]"),
            (1e-11, 1e-3, "t [s]"),
        ] {
            let interval = Interval::logarithmic(low, high);
            assert_eq!(shown(&Axis::linear("t").si("s"), &interval).0, label);
        }
    }

    #[test]
    fn other_units_take_powers_of_ten_where_needed() {
        let fixed = Axis::linear("u").unit("r0");
        assert_eq!(shown(&fixed, &Interval::linear(0.0, 20.0)).0, "u [r0]");
        let small = shown(&fixed, &Interval::linear(-2e-5, 1e-5));
        assert_eq!(small.0, "u [10^{\u{2212}6} r0]");
        assert_eq!(small.1, 1e-6);
        let number = Axis::linear("n");
        assert_eq!(shown(&number, &Interval::linear(0.0, 2e6)).0, "n [10^{6}]");
        assert_eq!(shown(&number, &Interval::linear(0.0, 12.0)).0, "n");
    }
}
