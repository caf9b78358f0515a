//! Numbers, keys and quantities in words, for titles, axes and legends.

use contact::Choice;
use figure::{Axis, Scale};
use formats::quantities::{FIELD_QUANTITIES, FIELDS};
use formats::sweep::key_unit;
use std::path::Path;

/// A value in its unit with an SI prefix, to four digits: `5.764 µs`, `33 mg`, `0.98`.
pub(crate) fn with_unit(value: f64, unit: &str) -> String {
    let (value, unit) = match unit {
        "kg" => (1e3 * value, "g"),
        other => (value, other),
    };
    if unit.is_empty() || unit == "1" {
        return digits(value);
    }
    // a power in the unit would apply to the prefix as well
    let exponent = if value == 0.0 || !value.is_finite() || unit.contains('^') {
        0
    } else {
        // a value that rounds to 1000 gets the next prefix
        let shown: f64 = format!("{:.3e}", value.abs()).parse().unwrap_or(0.0);
        (3 * (shown.log10().floor() as i32).div_euclid(3)).clamp(-15, 12)
    };
    const PREFIXES: [&str; 10] = ["f", "p", "n", "\u{b5}", "m", "", "k", "M", "G", "T"];
    let prefix = PREFIXES[((exponent + 15) / 3) as usize];
    format!("{} {prefix}{unit}", digits(value / 10_f64.powi(exponent)))
}

/// Four digits without trailing zeros.
pub(crate) fn digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let size = value.abs().log10().floor() as i32;
    if !(-4..6).contains(&size) {
        let text = format!("{value:.3e}");
        let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
        let mantissa = trimmed(mantissa);
        return format!("{mantissa}\u{b7}10^{{{}}}", power.replace('-', "\u{2212}"));
    }
    let places = (3 - size).max(0) as usize;
    trimmed(&format!("{value:.places$}"))
}

fn trimmed(text: &str) -> String {
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    };
    text.replace('-', "\u{2212}")
}

/// Name and unit of a scene key: `striker.tip_radius_m` is "tip radius" in m.
pub(crate) fn of_key(key: &str) -> (String, &'static str) {
    let (section, key) = key.split_once('.').unwrap_or(("", key));
    let (unit, ending) = key_unit(key);
    let name = key[..key.len() - ending.len()]
        .replace("youngs_modulus", "Young's modulus")
        .replace("poisson_ratio", "Poisson's ratio")
        .replace('_', " ");
    let name = match section {
        "target" => format!("{name} of the half-space"),
        _ => name,
    };
    (name, unit)
}

/// An axis with the unit of a file; with SI prefixes if the unit allows them.
pub(crate) fn axis(name: &str, unit: &str, scale: Scale) -> Axis {
    let mut axis = Axis::linear(name);
    axis.scale = scale;
    match unit {
        "1" | "" => axis,
        "kg" => axis.si("g"),
        "kg/m^3" => axis.unit("kg/m^{3}"),
        // a power in the unit would apply to the prefix as well
        unit if unit.contains('^') => axis.unit(&unit.replace("^2", "^{2}")),
        unit => axis.si(unit),
    }
}

/// Name of a field in words, as in files but without its sign convention: `displacement_z` is "axial displacement".
pub(crate) fn of_quantity(name: &str) -> String {
    let more = FIELD_QUANTITIES.iter().map(|row| (row.0.name(), row.2));
    let mut known = FIELDS.iter().map(|row| (row.0, row.2)).chain(more);
    let meaning = match (name, known.find(|row| row.0 == name)) {
        ("displacement", _) => "magnitude of the displacement",
        ("speed", _) => "speed of the particles",
        (_, found) => found.map_or(name, |row| row.1),
    };
    meaning.split(',').take(1).collect()
}

/// Name of a quantity for the legend; components with their symbol: "axial u_{z}".
pub(crate) fn component(name: &str) -> String {
    let symbols = [
        ("displacement_", "u"),
        ("velocity_", "v"),
        ("acceleration_", "a"),
        ("stress_", "σ"),
        ("strain_", "ε"),
    ];
    let found = symbols.iter().find_map(|(kind, symbol)| {
        let words = of_quantity(name);
        let (direction, _) = words.split_once(' ')?;
        Some(format!(
            "{direction} {symbol}_{{{}}}",
            name.strip_prefix(kind)?
        ))
    });
    found.unwrap_or_else(|| of_quantity(name))
}

/// A file's name without its extension.
pub(crate) fn stem(path: &Path) -> String {
    path.file_stem()
        .map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_take_prefixes_and_keep_four_digits() {
        for (value, unit, text) in [
            (5.7641e-6, "s", "5.764 \u{b5}s"),
            (3.3e-5, "kg", "33 mg"),
            (0.0122, "kg", "12.2 g"),
            (159_053.2, "N", "159.1 kN"),
            (0.98123, "1", "0.9812"),
            (999.99, "m", "1 km"),
            (7830.0, "kg/m^3", "7830 kg/m^3"),
            (0.0, "m", "0 m"),
            (-2.5e-3, "m", "\u{2212}2.5 mm"),
            (1.25e-7, "1", "1.25\u{b7}10^{\u{2212}7}"),
        ] {
            assert_eq!(with_unit(value, unit), text);
        }
    }

    #[test]
    fn legends_have_words() {
        for (name, words) in [
            ("velocity_z", "axial v_{z}"),
            ("strain_tt", "hoop \u{3b5}_{tt}"),
            ("von_mises", "von Mises' equivalent stress"),
            ("principal_3", "smallest principal stress"),
        ] {
            assert_eq!(component(name), words);
        }
    }

    #[test]
    fn units_with_powers_have_no_prefix() {
        let of = |unit| axis("a", unit, Scale::Linear).has_prefixes;
        assert_eq!(["m/s", "m/s^2", "Pa"].map(of), [true, false, true]);
    }

    #[test]
    fn keys_say_their_unit() {
        assert_eq!(of_key("target.youngs_modulus_pa").1, "Pa");
    }
}
