//! Numbers with units in running text.

/// A value in its unit with an SI prefix, to four digits: `5.764 µs`, `33 mg`, `0.98`.
pub(crate) fn with_unit(value: f64, unit: &str) -> String {
    let (value, unit) = match unit {
        "kg" => (1e3 * value, "g"),
        other => (value, other),
    };
    if unit.is_empty() || unit == "1" {
        return digits(value);
    }
    // a power in the unit would raise the prefix as well
    let exponent = if value == 0.0 || !value.is_finite() || unit.contains('^') {
        0
    } else {
        // what is shown as 1000 takes the next prefix
        let shown: f64 = format!("{:.3e}", value.abs()).parse().unwrap_or(0.0);
        (3 * (shown.log10().floor() as i32).div_euclid(3)).clamp(-15, 12)
    };
    const PREFIXES: [&str; 10] = ["f", "p", "n", "\u{b5}", "m", "", "k", "M", "G", "T"];
    let prefix = PREFIXES[((exponent + 15) / 3) as usize];
    format!("{} {prefix}{unit}", digits(value / 10_f64.powi(exponent)))
}

/// Four digits without zeros at the end.
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
}
