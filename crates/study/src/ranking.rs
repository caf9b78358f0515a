//! The cheapest method for each accuracy, with the default path beside it, and why others that are ahead are not taken.

use crate::record::{Cost, Question, Record, distinct};

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
    /// Cheapest of all methods, with its cost.
    pub(crate) best: Option<(&'a Record, f64)>,
    /// Cheapest of the default path.
    pub(crate) own: Option<(&'a Record, f64)>,
    /// Cheapest of every method that is ahead of the default path by more than [`EQUAL`], by ascending cost; all
    /// that reach the accuracy where the default path does not.
    pub(crate) ahead: Vec<(&'a Record, f64)>,
}

impl Ranking<'_> {
    /// Whether nothing is cheaper than the default path at this accuracy, by more than [`EQUAL`].
    pub(crate) fn on_front(&self) -> bool {
        match (self.best, self.own) {
            (Some((_, best)), Some((_, own))) => own <= EQUAL * best,
            (None, None) => true,
            (Some(_), None) | (None, Some(_)) => false,
        }
    }

    /// The cheapest that is ahead of the default path, in words; nothing where it is on the front.
    pub(crate) fn first_ahead(&self) -> Option<String> {
        Some(self.words(*self.ahead.first()?))
    }

    /// The cheapest that is ahead of the default path for no reason that is written down, in words.
    ///
    /// A reason excuses its own method and no other one behind it.
    pub(crate) fn unexplained(&self) -> Option<String> {
        let found = self.ahead.iter().find(|(r, _)| why_not(r.method).is_none());
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
pub(crate) fn rankings(records: &[Record], cost: Cost) -> Vec<Ranking<'_>> {
    let mut found = Vec::new();
    for question in Question::ALL {
        let mine = || records.iter().filter(move |r| r.question == question);
        for scene in distinct(mine().map(|r| r.scene)) {
            let rows: Vec<&Record> = mine().filter(|r| r.scene == scene).collect();
            // a scene that only compares other ways has no default path to judge
            if rows.iter().any(|r| r.default_path) {
                let at = |level| ranking(&rows, cost, level);
                found.extend(LEVELS.into_iter().filter_map(at));
            }
        }
    }
    found
}

/// Of the rows of one scene, at one accuracy; none without rows.
fn ranking<'a>(rows: &[&'a Record], cost: Cost, level: f64) -> Option<Ranking<'a>> {
    let first = rows.first()?;
    let mut reached: Vec<(&Record, f64)> = rows
        .iter()
        .filter(|r| !r.failed() && r.error.max <= level)
        .filter_map(|&r| Some((r, cost(r)?)))
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
    Some(Ranking {
        question: first.question,
        scene: first.scene,
        level,
        best: reached.first().copied(),
        own,
        ahead,
    })
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
        "wave implicit" | "growing" => Some(
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
            let found = rankings(records, Record::time_ns);
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
        let found = rankings(&rows, Record::time_ns);
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
        assert!(rankings(&[stranger], Record::time_ns).is_empty());
    }
}
