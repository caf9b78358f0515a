//! Numbers as labels.

/// A sign that is as wide as a plus.
const MINUS: char = '\u{2212}';

/// A number with so many decimal places.
pub(crate) fn decimal(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    match text.strip_prefix('-') {
        // no minus zero
        Some(digits) if digits.chars().all(|c| c == '0' || c == '.') => digits.to_owned(),
        Some(digits) => format!("{MINUS}{digits}"),
        None => text,
    }
}

/// A factor times a power of ten: `10^{-6}`, `2·10^{3}`.
pub(crate) fn power_of_ten(factor: u32, exponent: i32) -> String {
    let sign = if exponent < 0 {
        MINUS.to_string()
    } else {
        String::new()
    };
    let power = format!("10^{{{sign}{}}}", exponent.abs());
    if factor == 1 {
        power
    } else {
        format!("{factor}\u{b7}{power}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_are_wide_and_zero_has_none() {
        assert_eq!(decimal(-1.25, 2), "\u{2212}1.25");
        assert_eq!(decimal(-1e-9, 1), "0.0");
        assert_eq!(decimal(3.0, 0), "3");
        assert_eq!(power_of_ten(1, -6), "10^{\u{2212}6}");
        assert_eq!(power_of_ten(5, 3), "5\u{b7}10^{3}");
    }
}
