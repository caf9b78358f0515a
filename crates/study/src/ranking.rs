//! The cheapest method for each accuracy, with the default path beside it, and why others that are ahead are not taken.

use crate::record::{Question, Record, by_scene};

/// Accuracies at which the default path is to be on the Pareto front.
pub(crate) const LEVELS: [f64; 6] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// Costs within this factor count as equal: times on a busy machine scatter so.
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
    /// Cheapest of all methods.
    pub(crate) best: Option<&'a Record>,
    /// Cheapest of the default path.
    pub(crate) own: Option<&'a Record>,
    /// Cheapest of every method that is ahead of the default path by more than [`EQUAL`], by ascending cost; all
    /// that reach the accuracy where the default path does not.
    pub(crate) ahead: Vec<&'a Record>,
}

impl Ranking<'_> {
    /// The cheapest that is ahead of the default path, in words; nothing where it is on the front.
    pub(crate) fn first_ahead(&self) -> Option<String> {
        Some(self.words(self.ahead.first()?))
    }

    /// The cheapest that is ahead of the default path for no reason that is written down, in words.
    ///
    /// A reason excuses its own method and no other one behind it.
    pub(crate) fn unexplained(&self) -> Option<String> {
        let found = self.ahead.iter().find(|r| why_not(r.method).is_none());
        Some(self.words(found?))
    }

    fn words(&self, record: &Record) -> String {
        let (level, scene, method) = (self.level, self.scene, record.method);
        let says = match self.own.map(|own| own.cost_ns / record.cost_ns) {
            Some(times) => format!("{method} is {times:.1} times cheaper"),
            None => format!("only {method} reaches it"),
        };
        format!("{level:.0e} in \"{scene}\" ({says})")
    }
}

/// Of every scene with a default path at every accuracy.
pub(crate) fn rankings(records: &[Record]) -> Vec<Ranking<'_>> {
    let mut scenes = by_scene(records);
    // a scene that only compares other ways has no default path to judge
    scenes.retain(|(.., rows)| rows.iter().any(|r| r.default_path));
    let at_levels = |(.., rows): &(_, _, Vec<_>)| LEVELS.map(|level| ranking(rows, level));
    scenes.iter().flat_map(at_levels).collect()
}

/// Of the rows of one scene, at one accuracy.
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

/// Why the program does not take a method that is cheaper than its own somewhere, in one clause, for methods that have
/// been looked at; none for others.
pub(crate) fn why_not(method: &str) -> Option<&'static str> {
    match method {
        "table, sums for this pulse only" => {
            Some("its sums know that this pulse is two exponentials, which no computed force is")
        }
        "cells alone" => Some(
            "its step is known beforehand, many times finer than that of the output; the program does not know how fine is \
             enough, and integrates the ends of the contact instead",
        ),
        "table, linear cells" => Some(
            "it reads a third of the numbers and needs a step many times finer as soon as more is asked; the program \
             takes it for forces with corners",
        ),
        "table, other nodes or points" => Some(
            "fewer nodes are enough at this place and not at the worst places of a table, for which its nodes are chosen",
        ),
        "implicit of order 2" => Some(
            "it knows the loss 1 - e^2 from the momentum alone, to the digits of the restitution and not to its own; what \
             the program's march takes longer at 1e-3 goes into the loss and the instant of separation",
        ),
        "wave implicit" => Some(
            "its number of steps is known beforehand; the program does not know how many a tolerance needs, halves the \
             step until the results stand still, and pays for the coarser marches as well",
        ),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_ahead_is_said_and_needs_a_reason() {
        let own = Record::of("own", true, 100.0, 1e-7);
        let near = Record::of("stranger", false, 90.0, 1e-9);
        let at = |records: &[Record], level: f64| -> (Option<String>, bool) {
            let found = rankings(records);
            let ranking = found.iter().find(|s| s.level == level).unwrap();
            (ranking.first_ahead(), ranking.unexplained().is_some())
        };
        // a tenth cheaper is equal
        assert_eq!(at(&[own.clone(), near], 1e-6), (None, false));
        let stranger = Record::of("stranger", false, 50.0, 1e-7);
        let (ahead, unexplained) = at(&[own.clone(), stranger.clone()], 1e-6);
        assert!(ahead.unwrap().contains("stranger is 2.0 times cheaper") && unexplained);
        let known = Record::of("table, linear cells", false, 50.0, 1e-7);
        let (ahead, unexplained) = at(&[own.clone(), known.clone()], 1e-6);
        assert!(ahead.is_some() && !unexplained);
        // a reason does not excuse what is hidden behind its method
        let behind = Record::of("stranger", false, 60.0, 1e-7);
        let rows = [own.clone(), known, behind];
        let found = rankings(&rows);
        let ranking = found.iter().find(|s| s.level == 1e-6).unwrap();
        assert!(
            ranking
                .first_ahead()
                .unwrap()
                .contains("table, linear cells")
        );
        assert!(ranking.unexplained().unwrap().contains("stranger"));
        // nothing of the program's own reaches it
        let exact = Record::of("stranger", false, 1e3, 1e-9);
        let (ahead, unexplained) = at(&[own, exact], 1e-8);
        assert!(ahead.unwrap().contains("only stranger reaches it") && unexplained);
        // a scene that only compares other ways has nothing to judge
        assert!(rankings(&[stranger]).is_empty());
    }
}
