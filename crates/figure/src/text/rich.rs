//! A line of text with raised and lowered parts.

use super::font;

/// A part of a line, at one size and height.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Run {
    pub(crate) text: String,
    /// Size over that of the line.
    pub(crate) size: f64,
    /// How far it is raised over the line's size; lowered where negative.
    pub(crate) rise: f64,
}

impl Run {
    /// Width over the size of the line.
    fn width(&self) -> f64 {
        self.size * font::width(&self.text)
    }
}

/// A line of text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Rich(pub(crate) Vec<Run>);

const SMALL: f64 = 0.72;
const RAISED: f64 = 0.38;
const LOWERED: f64 = -0.16;

impl Rich {
    /// Reads `^{...}` as raised and `_{...}` as lowered; a brace that is not closed stands for itself.
    pub(crate) fn new(markup: &str) -> Self {
        let mut runs: Vec<Run> = Vec::new();
        let mut push = |text: &str, size: f64, rise: f64| {
            if !text.is_empty() {
                runs.push(Run {
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
            let rise = if rest[at..].starts_with('^') {
                RAISED
            } else {
                LOWERED
            };
            push(inner, SMALL, rise);
            (rest, from) = (after, 0);
        }
        push(rest, 1.0, 0.0);
        Self(runs)
    }

    /// Width in pixels at a size.
    pub(crate) fn width(&self, size: f64) -> f64 {
        size * self.0.iter().map(Run::width).sum::<f64>()
    }

    /// Top above the line and bottom below it over the size, for the letters of the font.
    pub(crate) fn extent(&self) -> (f64, f64) {
        let runs = self.0.iter();
        runs.fold((0.0, 0.0), |(top, bottom): (f64, f64), run| {
            (
                top.max(run.rise + run.size * font::ASCENT),
                bottom.max(run.size * font::DESCENT - run.rise),
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(markup: &str) -> Vec<String> {
        Rich::new(markup)
            .0
            .into_iter()
            .map(|run| run.text)
            .collect()
    }

    #[test]
    fn parts_are_raised_and_lowered() {
        let rich = Rich::new("time [r_{0}/c_{1}]");
        assert_eq!(
            texts("time [r_{0}/c_{1}]"),
            ["time [r", "0", "/c", "1", "]"]
        );
        assert!(rich.0[1].rise < 0.0 && rich.0[2].rise == 0.0);
        assert!(Rich::new("10^{-6}").0[1].rise > 0.0);
        assert!(Rich::new("10^{-6}").extent().0 > Rich::new("10").extent().0);
    }

    #[test]
    fn everything_else_stands_for_itself() {
        for text in ["|xi|^3 ln|xi|", "a_b", "open ^{", "", "^", "x^{2"] {
            assert_eq!(texts(text).concat(), text);
        }
        assert_eq!(texts("a^2 b^{3}"), ["a^2 b", "3"]);
    }
}
