//! Where the default path stands: the cheapest method for each accuracy, and the default beside it.

use crate::reasons::reason;
use crate::record::{Question, Record};
use crate::work_precision::distinct;

/// Accuracies at which the default path is to be on the Pareto front.
pub const LEVELS: [f64; 6] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// Costs within this factor count as equal: times on a busy machine scatter so.
pub const EQUAL: f64 = 1.25;

/// What a cost is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Nanoseconds.
    Time,
    /// Work count.
    Work,
}

impl Measure {
    fn of(self, record: &Record) -> Option<f64> {
        match self {
            Self::Time => Some(record.cost.median_ns),
            Self::Work => record.work,
        }
    }
}

/// The cheapest records of a scene that reach an accuracy.
#[derive(Debug, Clone, Copy)]
pub struct Standing<'a> {
    /// Question.
    pub question: Question,
    /// Scene.
    pub scene: &'a str,
    /// Accuracy.
    pub level: f64,
    /// Cheapest of all methods, with its cost.
    pub best: Option<(&'a Record, f64)>,
    /// Cheapest of the default path.
    pub own: Option<(&'a Record, f64)>,
}

impl Standing<'_> {
    /// Whether nothing is cheaper than the default path at this accuracy, up to `slack` (1: not at all).
    #[must_use]
    pub fn on_front(&self, slack: f64) -> bool {
        match (self.best, self.own) {
            (Some((_, best)), Some((_, own))) => own <= slack * best,
            (None, None) => true,
            (Some(_), None) | (None, Some(_)) => false,
        }
    }
}

impl Standing<'_> {
    /// What is ahead of the default path, in words; nothing where it is on the front.
    #[must_use]
    pub fn ahead(&self) -> Option<String> {
        if self.on_front(EQUAL) {
            return None;
        }
        let (best, cost) = self.best?;
        let place = format!("{:.0e} in \"{}\"", self.level, self.scene);
        Some(match self.own {
            Some((_, own)) => format!(
                "{place} ({} is {:.1} times cheaper)",
                best.method,
                own / cost
            ),
            None => format!("{place} (only {} reaches it)", best.method),
        })
    }

    /// Whether something is ahead of the default path for which no reason is written down.
    #[must_use]
    pub fn is_unexplained(&self) -> bool {
        let unknown = self
            .best
            .is_some_and(|(best, _)| reason(best.method).is_none());
        unknown && !self.on_front(EQUAL)
    }
}

/// Of every scene with a default path at every accuracy.
#[must_use]
pub fn standings(records: &[Record], measure: Measure) -> Vec<Standing<'_>> {
    let mut found = Vec::new();
    for question in Question::ALL {
        let scenes = distinct(
            records
                .iter()
                .filter(|r| r.question == question)
                .map(|r| r.scene),
        );
        for scene in scenes {
            // a scene that only compares other ways has no default path to judge
            let mut rows = records.iter().filter(|r| r.scene == scene);
            if !rows.any(|r| r.default_path) {
                continue;
            }
            for level in LEVELS {
                let cheapest = |default: bool| {
                    records
                        .iter()
                        .filter(|r| r.question == question && r.scene == scene)
                        .filter(|r| !r.failed() && r.error.max <= level)
                        .filter(|r| r.default_path || !default)
                        .filter_map(|r| Some((r, measure.of(r)?)))
                        .min_by(|a, b| a.1.total_cmp(&b.1))
                };
                found.push(Standing {
                    question,
                    scene,
                    level,
                    best: cheapest(false),
                    own: cheapest(true),
                });
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Timing;
    use crate::record::Error;

    fn record(method: &'static str, default_path: bool, cost: f64, error: f64) -> Record {
        Record {
            question: Question::Fields,
            scene: "a scene",
            method,
            setting: String::new(),
            default_path,
            cost: Timing {
                median_ns: cost,
                spread_ns: 0.0,
            },
            error: Error::of(&[error]),
            work: None,
            refusal: None,
        }
    }

    #[test]
    fn what_is_ahead_is_said_and_needs_a_reason() {
        let own = record("own", true, 100.0, 1e-7);
        let near = record("stranger", false, 90.0, 1e-9);
        let at = |records: &[Record], level: f64| -> (Option<String>, bool) {
            let found = standings(records, Measure::Time);
            let standing = found.iter().find(|s| s.level == level).unwrap();
            (standing.ahead(), standing.is_unexplained())
        };
        // a tenth cheaper is equal
        assert_eq!(at(&[own.clone(), near], 1e-6), (None, false));
        let stranger = record("stranger", false, 50.0, 1e-7);
        let (ahead, unexplained) = at(&[own.clone(), stranger.clone()], 1e-6);
        assert!(ahead.unwrap().contains("stranger is 2.0 times cheaper") && unexplained);
        let known = record("table, linear cells", false, 50.0, 1e-7);
        let (ahead, unexplained) = at(&[own.clone(), known], 1e-6);
        assert!(ahead.is_some() && !unexplained);
        // nothing of the program's own reaches it
        let exact = record("stranger", false, 1e3, 1e-9);
        let (ahead, unexplained) = at(&[own, exact], 1e-8);
        assert!(ahead.unwrap().contains("only stranger reaches it") && unexplained);
        // a scene that only compares other ways has nothing to judge
        assert!(standings(&[stranger], Measure::Time).is_empty());
    }
}
