//! A number of the paper beside ours.

/// A number of the paper beside ours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Where the paper has it: an equation, a figure, a table, a page of text.
    pub place: &'static str,
    /// What it is.
    pub what: &'static str,
    /// Its unit; empty for a number without one.
    pub unit: &'static str,
    /// As printed.
    pub paper: f64,
    /// As computed here.
    pub here: f64,
    /// Digits after the point that are told.
    pub digits: usize,
    /// Why they differ; empty where they do not, beyond the printed digits.
    pub why: &'static str,
}

impl Row {
    /// The printed number and ours.
    pub(crate) fn new(place: &'static str, what: &'static str, [paper, here]: [f64; 2]) -> Self {
        Self {
            place,
            what,
            unit: "",
            paper,
            here,
            digits: 2,
            why: "",
        }
    }

    /// With a unit, and digits after the point.
    pub(crate) fn unit(self, unit: &'static str, digits: usize) -> Self {
        Self {
            unit,
            digits,
            ..self
        }
    }

    /// With the reason of the difference.
    pub(crate) fn why(self, why: &'static str) -> Self {
        Self { why, ..self }
    }

    /// Ours over the paper's, less one.
    #[must_use]
    pub fn difference(&self) -> f64 {
        self.here / self.paper - 1.0
    }

    /// The two numbers and their difference as text, without unit.
    #[must_use]
    pub fn told(&self) -> [String; 3] {
        let digits = self.digits;
        [
            format!("{:.digits$}", self.paper),
            format!("{:.digits$}", self.here),
            format!("{:+.2} %", 100.0 * self.difference()),
        ]
    }
}
