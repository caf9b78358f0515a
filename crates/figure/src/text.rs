//! Text whose size is known before it is drawn: lines with superscripts and subscripts, numbers, sizes.
//!
//! Labels may contain superscripts and subscripts: `10^{-6}`, `r_{0}/c_{1}`. All other characters are literal.

use crate::font;

/// Height of a line of text relative to the size of its letters.
pub(crate) const LINE: f64 = 1.25;

/// A part of a line with the same size and height.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TextRun {
    pub(crate) text: String,
    /// Size relative to the line.
    pub(crate) size: f64,
    /// Vertical shift relative to the size of the line; negative for subscripts.
    pub(crate) rise: f64,
}

impl TextRun {
    /// Width relative to the size of the line.
    pub(crate) fn width(&self) -> f64 {
        self.size * font::width(&self.text)
    }
}

const RAISED_SIZE: f64 = 0.72;
const RAISED: f64 = 0.38;
const LOWERED: f64 = -0.16;

/// The parts of a line: `^{...}` is a superscript and `_{...}` a subscript; an unclosed brace is literal.
pub(crate) fn runs(markup: &str) -> Vec<TextRun> {
    let mut runs: Vec<TextRun> = Vec::new();
    let mut push = |text: &str, size: f64, rise: f64| {
        if !text.is_empty() {
            runs.push(TextRun {
                text: text.to_owned(),
                size,
                rise,
            });
        }
    };
    let mut rest = markup;
    let mut from = 0;
    while let Some(at) = rest[from..].find(['^', '_']).map(|i| from + i) {
        let part = rest[at + 1..]
            .strip_prefix('{')
            .and_then(|inner| inner.split_once('}'));
        let Some((inner, after)) = part else {
            from = at + 1;
            continue;
        };
        push(&rest[..at], 1.0, 0.0);
        let is_raised = rest[at..].starts_with('^');
        push(inner, RAISED_SIZE, if is_raised { RAISED } else { LOWERED });
        (rest, from) = (after, 0);
    }
    push(rest, 1.0, 0.0);
    runs
}

/// Width of a line in pixels at a size.
pub(crate) fn width(markup: &str, size: f64) -> f64 {
    size * runs(markup).iter().map(TextRun::width).sum::<f64>()
}

/// Words of a text; a number is joined with the next word, which may be its unit.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut is_number = false;
    for word in text.split_whitespace() {
        match words.last_mut().filter(|_| is_number) {
            Some(number) => *number += &format!(" {word}"),
            None => words.push(word.to_owned()),
        }
        is_number = word.replace(MINUS, "-").parse::<f64>().is_ok();
    }
    words
}

/// Lines of at most `width` pixels at a size, broken between words, but not between a number and its unit. A single
/// word that is too wide is broken between letters, unless it has superscripts or subscripts.
pub(crate) fn wrap(text: &str, size: f64, width: f64) -> Vec<String> {
    let fits = |line: &str| self::width(line, size) <= width;
    let mut lines = Vec::new();
    let mut line = String::new();
    let all = words(text);
    // a number and a unit that are too wide together are two words
    let parts = |word: &String| match fits(word) {
        true => vec![word.clone()],
        false => word.split_whitespace().map(str::to_owned).collect(),
    };
    for word in all.iter().flat_map(parts) {
        let word = word.as_str();
        let longer = format!("{line} {word}").trim_start().to_owned();
        if fits(&longer) {
            line = longer;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        if fits(word) || word.contains('{') {
            word.clone_into(&mut line);
            continue;
        }
        for letter in word.chars() {
            line.push(letter);
            if !fits(&line) && line.chars().count() > 1 {
                line.pop();
                lines.push(std::mem::replace(&mut line, letter.to_string()));
            }
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// A minus sign that is as wide as a plus sign.
const MINUS: &str = "\u{2212}";

/// A number with a given number of decimal places.
pub(crate) fn decimal(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    match text.strip_prefix('-') {
        // no negative zero
        Some(digits) if digits.chars().all(|c| c == '0' || c == '.') => digits.to_owned(),
        Some(digits) => format!("{MINUS}{digits}"),
        None => text,
    }
}

/// A factor times a power of ten: `10^{-6}`, `2·10^{3}`.
pub(crate) fn power_of_ten(factor: u32, exponent: i32) -> String {
    let sign = if exponent < 0 { MINUS } else { "" };
    let power = format!("10^{{{sign}{}}}", exponent.abs());
    match factor {
        1 => power,
        factor => format!("{factor}\u{b7}{power}"),
    }
}

/// Sizes of all texts, derived from the size at the ticks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Typeface {
    pub(crate) tick: f64,
    pub(crate) label: f64,
    pub(crate) legend: f64,
    pub(crate) mark: f64,
    pub(crate) subtitle: f64,
    pub(crate) title: f64,
}

impl Typeface {
    pub(crate) fn new(tick: f64) -> Self {
        Self {
            tick,
            label: 1.15 * tick,
            legend: 1.04 * tick,
            mark: 0.95 * tick,
            subtitle: 1.1 * tick,
            title: 1.4 * tick,
        }
    }

    /// Height of `count` lines of a size.
    pub(crate) fn lines(size: f64, count: usize) -> f64 {
        LINE * size * count as f64
    }

    /// Length of a tick with a label.
    pub(crate) fn tick_length(&self) -> f64 {
        0.42 * self.tick
    }

    /// A small distance.
    pub(crate) fn gap(&self) -> f64 {
        0.5 * self.tick
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(markup: &str) -> Vec<String> {
        runs(markup).into_iter().map(|run| run.text).collect()
    }

    #[test]
    fn parts_are_raised_and_lowered() {
        let parts = runs("time [r_{0}/c_{1}]");
        assert_eq!(
            texts("time [r_{0}/c_{1}]"),
            ["time [r", "0", "/c", "1", "]"]
        );
        assert!(parts[1].rise < 0.0 && parts[2].rise == 0.0);
        assert!(runs("10^{-6}")[1].rise > 0.0);
    }

    #[test]
    fn everything_else_stands_for_itself() {
        for text in ["|xi|^3 ln|xi|", "a_b", "open ^{", "", "^", "x^{2"] {
            assert_eq!(texts(text).concat(), text);
        }
        assert_eq!(texts("a^2 b^{3}"), ["a^2 b", "3"]);
    }

    #[test]
    fn long_names_are_broken_between_words() {
        let name = "wave implicit, step halved to tolerance, and then some more";
        let lines = wrap(name, 12.0, 150.0);
        assert!(lines.len() > 2);
        assert!(lines.iter().all(|l| width(l, 12.0) <= 150.0));
        assert_eq!(lines.join(" "), name);
        assert!(wrap("  ", 12.0, 50.0).is_empty());
    }

    #[test]
    fn a_number_keeps_its_unit() {
        let text = "a ball of 2.5 mm strikes steel at \u{2212}1.4 m/s";
        for pixels in 60..300 {
            for line in wrap(text, 12.0, f64::from(pixels)) {
                assert!(!line.ends_with("1.4") && !line.ends_with("2.5"), "{line}");
            }
        }
        assert_eq!(wrap("12 km", 12.0, 20.0), ["12", "km"]);
    }

    #[test]
    fn a_word_that_is_too_long_is_broken_too() {
        let lines = wrap("incompressibility of it", 12.0, 40.0);
        assert!(lines.iter().all(|l| width(l, 12.0) <= 40.0));
        assert!(lines.len() >= 3);
        assert_eq!(lines.concat().replace(' ', ""), "incompressibilityofit");
        assert_eq!(wrap("x^{22}", 12.0, 1.0), ["x^{22}"]);
    }

    #[test]
    fn signs_are_wide_and_zero_has_none() {
        assert_eq!(decimal(-1.25, 2), "\u{2212}1.25");
        assert_eq!(decimal(-1e-9, 1), "0.0");
        assert_eq!(decimal(3.0, 0), "3");
        assert_eq!(power_of_ten(1, -6), "10^{\u{2212}6}");
        assert_eq!(power_of_ten(5, 3), "5\u{b7}10^{3}");
    }
}
