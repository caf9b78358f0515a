//! The cheapest method for each accuracy, compared with the default path.

use crate::record::{Question, Record, by_scene};
use contact::Choice;

/// Accuracies at which the default path should be on the Pareto front.
pub(crate) const LEVELS: [f64; 6] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// Ratio of costs below which they count as equal; times on a busy machine scatter by as much.
pub(crate) const EQUAL: f64 = 1.25;

/// The cheapest records of a scene that reach an accuracy.
#[derive(Debug, Clone)]
pub(crate) struct Ranking<'a> {
    /// Question.
    pub(crate) question: Question,
    /// Scene.
    pub(crate) scene: &'a str,
    /// Accuracy.
    pub(crate) level: f64,
    /// Cheapest record of all methods.
    pub(crate) best: Option<&'a Record>,
    /// Cheapest record of the default path.
    pub(crate) own: Option<&'a Record>,
    /// Cheapest record of each method that is ahead of the default path by more than [`EQUAL`], by ascending cost; of
    /// all methods that reach the accuracy if the default path does not.
    pub(crate) ahead: Vec<&'a Record>,
}

impl Ranking<'_> {
    /// Description of the cheapest method that is ahead of the default path; none if the default path is on the front.
    pub(crate) fn first_ahead(&self) -> Option<String> {
        Some(self.words(self.ahead.first()?))
    }

    /// Description of the cheapest method that is ahead of the default path without a recorded reason.
    ///
    /// A reason applies to its own method only, not to more expensive ones.
    pub(crate) fn unexplained(&self) -> Option<String> {
        let found = self.ahead.iter().find(|r| r.method.why_not().is_none());
        Some(self.words(found?))
    }

    fn words(&self, record: &Record) -> String {
        let (level, scene, method) = (self.level, self.scene, record.method.name());
        let says = match self.own.map(|own| own.cost_ns / record.cost_ns) {
            Some(times) => format!("{method} is {times:.1} times cheaper"),
            None => format!("only {method} reaches it"),
        };
        format!("{level:.0e} in \"{scene}\" ({says})")
    }
}

/// Rankings of every scene with a default path, at every accuracy.
pub(crate) fn rankings(records: &[Record]) -> Vec<Ranking<'_>> {
    let mut scenes = by_scene(records);
    // a scene that compares other methods only has no default path
    scenes.retain(|(.., rows)| rows.iter().any(|r| r.default_path));
    let at_levels = |(.., rows): &(_, _, Vec<_>)| LEVELS.map(|level| ranking(rows, level));
    scenes.iter().flat_map(at_levels).collect()
}

/// Ranking of the rows of a scene at an accuracy.
fn ranking<'a>(rows: &[&'a Record], level: f64) -> Ranking<'a> {
    let reaches = |r: &&&Record| !r.failed() && r.error_max <= level && r.cost_ns.is_finite();
    let mut reached: Vec<&Record> = rows.iter().filter(reaches).copied().collect();
    reached.sort_by(|a, b| a.cost_ns.total_cmp(&b.cost_ns));
    let own = reached.iter().find(|r| r.default_path).copied();
    let mut ahead: Vec<&Record> = Vec::new();
    for &record in &reached {
        let is_known = ahead.iter().any(|r| r.method == record.method);
        if own.is_none_or(|own| own.cost_ns > EQUAL * record.cost_ns) && !is_known {
            ahead.push(record);
        }
    }
    Ranking {
        question: rows[0].question,
        scene: rows[0].scene,
        level,
        best: reached.first().copied(),
        own,
        ahead,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::ComparedMethod;

    #[test]
    fn what_is_ahead_is_said_and_needs_a_reason() {
        let own = Record::of(ComparedMethod::TableTransform, true, 100.0, 1e-7);
        let near = Record::of(ComparedMethod::Durbin, false, 90.0, 1e-9);
        let at = |records: &[Record], level: f64| -> (Option<String>, bool) {
            let found = rankings(records);
            let ranking = found.iter().find(|s| s.level == level).unwrap();
            (ranking.first_ahead(), ranking.unexplained().is_some())
        };
        // a difference of 10 % counts as equal
        assert_eq!(at(&[own.clone(), near], 1e-6), (None, false));
        let stranger = Record::of(ComparedMethod::Durbin, false, 50.0, 1e-7);
        let (ahead, unexplained) = at(&[own.clone(), stranger.clone()], 1e-6);
        assert!(ahead.unwrap().contains("Durbin is 2.0 times cheaper") && unexplained);
        let known = Record::of(ComparedMethod::TableLinear, false, 50.0, 1e-7);
        let (ahead, unexplained) = at(&[own.clone(), known.clone()], 1e-6);
        assert!(ahead.is_some() && !unexplained);
        // a reason does not apply to a more expensive method
        let behind = Record::of(ComparedMethod::Durbin, false, 60.0, 1e-7);
        let rows = [own.clone(), known, behind];
        let found = rankings(&rows);
        let ranking = found.iter().find(|s| s.level == 1e-6).unwrap();
        assert!(
            ranking
                .first_ahead()
                .unwrap()
                .contains("table, linear cells")
        );
        assert!(ranking.unexplained().unwrap().contains("Durbin"));
        // none of the program's methods reaches the accuracy
        let exact = Record::of(ComparedMethod::Durbin, false, 1e3, 1e-9);
        let (ahead, unexplained) = at(&[own, exact], 1e-8);
        assert!(ahead.unwrap().contains("only Durbin reaches it") && unexplained);
        // a scene that compares other methods only has no ranking
        assert!(rankings(&[stranger]).is_empty());
    }
}
