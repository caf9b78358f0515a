//! Where the default path stands: the cheapest method for each accuracy, and the default beside it.

use crate::reasons::reason;
use crate::record::{Question, Record, distinct};

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
#[derive(Debug, Clone)]
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
    /// Cheapest of every method that is ahead of the default path by more than [`EQUAL`], by ascending cost; all
    /// that reach the accuracy where the default path does not.
    pub ahead: Vec<(&'a Record, f64)>,
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

    /// The cheapest that is ahead of the default path, in words; nothing where it is on the front.
    #[must_use]
    pub fn first_ahead(&self) -> Option<String> {
        Some(self.words(*self.ahead.first()?))
    }

    /// The cheapest that is ahead of the default path for no reason that is written down, in words.
    ///
    /// A reason excuses its own method and no other one behind it.
    #[must_use]
    pub fn unexplained(&self) -> Option<String> {
        let found = self.ahead.iter().find(|(r, _)| reason(r.method).is_none());
        Some(self.words(*found?))
    }

    fn words(&self, (record, cost): (&Record, f64)) -> String {
        let place = format!("{:.0e} in \"{}\"", self.level, self.scene);
        match self.own {
            Some((_, own)) => format!(
                "{place} ({} is {:.1} times cheaper)",
                record.method,
                own / cost
            ),
            None => format!("{place} (only {} reaches it)", record.method),
        }
    }
}

/// Of every scene with a default path at every accuracy.
#[must_use]
pub fn standings(records: &[Record], measure: Measure) -> Vec<Standing<'_>> {
    let mut found = Vec::new();
    for question in Question::ALL {
        let mine = || records.iter().filter(move |r| r.question == question);
        for scene in distinct(mine().map(|r| r.scene)) {
            let rows: Vec<&Record> = mine().filter(|r| r.scene == scene).collect();
            // a scene that only compares other ways has no default path to judge
            if rows.iter().any(|r| r.default_path) {
                let at = |level| standing(&rows, measure, level);
                found.extend(LEVELS.into_iter().filter_map(at));
            }
        }
    }
    found
}

/// Of the rows of one scene, at one accuracy; none without rows.
fn standing<'a>(rows: &[&'a Record], measure: Measure, level: f64) -> Option<Standing<'a>> {
    let first = rows.first()?;
    let mut reached: Vec<(&Record, f64)> = rows
        .iter()
        .filter(|r| !r.failed() && r.error.max <= level)
        .filter_map(|&r| Some((r, measure.of(r)?)))
        .collect();
    reached.sort_by(|a, b| a.1.total_cmp(&b.1));
    let own = reached.iter().find(|(r, _)| r.default_path).copied();
    let is_ahead = |cost: f64| own.is_none_or(|(_, own)| own > EQUAL * cost);
    let mut ahead: Vec<(&Record, f64)> = Vec::new();
    for &(record, cost) in &reached {
        let is_known = ahead.iter().any(|(r, _)| r.method == record.method);
        if is_ahead(cost) && !is_known {
            ahead.push((record, cost));
        }
    }
    Some(Standing {
        question: first.question,
        scene: first.scene,
        level,
        best: reached.first().copied(),
        own,
        ahead,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Error;
    use crate::record::Timing;

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
            (standing.first_ahead(), standing.unexplained().is_some())
        };
        // a tenth cheaper is equal
        assert_eq!(at(&[own.clone(), near], 1e-6), (None, false));
        let stranger = record("stranger", false, 50.0, 1e-7);
        let (ahead, unexplained) = at(&[own.clone(), stranger.clone()], 1e-6);
        assert!(ahead.unwrap().contains("stranger is 2.0 times cheaper") && unexplained);
        let known = record("table, linear cells", false, 50.0, 1e-7);
        let (ahead, unexplained) = at(&[own.clone(), known.clone()], 1e-6);
        assert!(ahead.is_some() && !unexplained);
        // a reason does not excuse what is hidden behind its method
        let behind = record("stranger", false, 60.0, 1e-7);
        let rows = [own.clone(), known, behind];
        let found = standings(&rows, Measure::Time);
        let standing = found.iter().find(|s| s.level == 1e-6).unwrap();
        assert!(
            standing
                .first_ahead()
                .unwrap()
                .contains("table, linear cells")
        );
        assert!(standing.unexplained().unwrap().contains("stranger"));
        // nothing of the program's own reaches it
        let exact = record("stranger", false, 1e3, 1e-9);
        let (ahead, unexplained) = at(&[own, exact], 1e-8);
        assert!(ahead.unwrap().contains("only stranger reaches it") && unexplained);
        // a scene that only compares other ways has nothing to judge
        assert!(standings(&[stranger], Measure::Time).is_empty());
    }
}
