//! In which multiple of its unit an axis shows its values.

use crate::axis::Unit;
use crate::interval::{Interval, Scale};
use crate::text::power_of_ten;

/// SI prefixes and their powers of ten.
const PREFIXES: [(&str, i32); 17] = [
    ("y", -24),
    ("z", -21),
    ("a", -18),
    ("f", -15),
    ("p", -12),
    ("n", -9),
    ("\u{b5}", -6),
    ("m", -3),
    ("", 0),
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
    ("P", 15),
    ("E", 18),
    ("Z", 21),
    ("Y", 24),
];

/// How values are shown: over `factor`, with a label that says so.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shown {
    pub(crate) label: String,
    pub(crate) factor: f64,
}

/// The multiple of a unit that suits the values of an interval.
///
/// A unit of the SI takes a prefix and any other one a power of ten, so that the largest value has one to three
/// digits before the point; values from 0.1 on keep the unit itself unless they are lengths, and so does a logarithmic axis.
pub(crate) fn shown(quantity: &str, unit: &Unit, interval: &Interval) -> Shown {
    let largest = interval.low.abs().max(interval.high.abs());
    let exponent = match interval.scale {
        Scale::Linear if largest > 0.0 => largest.log10().floor() as i32,
        Scale::Linear | Scale::Logarithmic => 0,
    };
    let plain = |power: String| match (quantity, unit, power.as_str()) {
        (name, Unit::One, "") => name.to_owned(),
        (name, Unit::One, power) => bracketed(name, power),
        (name, Unit::Si(unit) | Unit::Fixed(unit), "") => bracketed(name, unit),
        (name, Unit::Si(unit) | Unit::Fixed(unit), power) => {
            bracketed(name, &format!("{power} {unit}"))
        }
    };
    match unit {
        Unit::Si(unit) => {
            // tenths are read as they are, but for lengths: 120 mm
            let wanted = if exponent == -1 && unit != "m" {
                0
            } else {
                3 * exponent.div_euclid(3)
            };
            let wanted = wanted.clamp(-24, 24);
            let prefix = PREFIXES.iter().find(|(_, e)| *e == wanted);
            let (prefix, exponent) = prefix.copied().unwrap_or(("", 0));
            Shown {
                label: bracketed(quantity, &format!("{prefix}{unit}")),
                factor: 10.0_f64.powi(exponent),
            }
        }
        Unit::One | Unit::Fixed(_) if (-3..5).contains(&exponent) => Shown {
            label: plain(String::new()),
            factor: 1.0,
        },
        Unit::One | Unit::Fixed(_) => {
            let exponent = 3 * exponent.div_euclid(3);
            Shown {
                label: plain(power_of_ten(1, exponent)),
                factor: 10.0_f64.powi(exponent),
            }
        }
    }
}

fn bracketed(quantity: &str, unit: &str) -> String {
    if quantity.is_empty() {
        format!("[{unit}]")
    } else {
        format!("{quantity} [{unit}]")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_the_si_take_prefixes() {
        let si = |unit: &str, high: f64| {
            shown(
                "x",
                &Unit::Si(unit.to_owned()),
                &Interval::linear(0.0, high),
            )
        };
        assert_eq!(si("s", 4e-5).label, "x [\u{b5}s]");
        assert_eq!(si("N", 38_200.0).label, "x [kN]");
        assert_eq!(si("m/s", 0.5).label, "x [m/s]");
        assert_eq!(si("m", 0.12).label, "x [mm]");
        assert_eq!(si("Pa", 2.1e11).factor, 1e9);
        assert_eq!(si("Pa", 0.0).factor, 1.0);
        // a logarithmic axis has powers of ten already
        let long = Interval::logarithmic(1e-9, 1e-3);
        assert_eq!(shown("t", &Unit::Si("s".to_owned()), &long).label, "t [s]");
    }

    #[test]
    fn other_units_take_powers_of_ten_where_needed() {
        let fixed = Unit::Fixed("r0".to_owned());
        assert_eq!(
            shown("u", &fixed, &Interval::linear(0.0, 20.0)).label,
            "u [r0]"
        );
        let small = shown("u", &fixed, &Interval::linear(-2e-5, 1e-5));
        assert_eq!(small.label, "u [10^{\u{2212}6} r0]");
        assert_eq!(small.factor, 1e-6);
        assert_eq!(
            shown("n", &Unit::One, &Interval::linear(0.0, 2e6)).label,
            "n [10^{6}]"
        );
        assert_eq!(
            shown("n", &Unit::One, &Interval::linear(0.0, 12.0)).label,
            "n"
        );
    }
}
