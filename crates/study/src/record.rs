//! What is measured of one method at one setting in one scene.

/// The four questions of the chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Question {
    /// How to compute a kernel: the fields at a point and time after a unit step of force.
    Kernels,
    /// How to compute an impact: from a striker to the force history and its results.
    Force,
    /// How to compute fields under a given force history.
    Fields,
    /// How to compute the fields of a whole impact at a probe.
    Impacts,
}

impl Question {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Kernels, Self::Force, Self::Fields, Self::Impacts];

    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Kernels => "kernels",
            Self::Force => "force",
            Self::Fields => "fields",
            Self::Impacts => "impacts",
        }
    }

    /// What one value is, for cost and work.
    #[must_use]
    pub fn value(self) -> &'static str {
        match self {
            Self::Kernels => "six fields at one point and time",
            Self::Force => "one impact",
            Self::Fields => "six fields at one point over r0/c1 of time",
            Self::Impacts => "one impact with six fields at one point",
        }
    }

    /// What is counted as work.
    #[must_use]
    pub fn work(self) -> &'static str {
        match self {
            Self::Kernels => "integrand evaluations per value",
            Self::Force => "steps times cells of memory per impact",
            Self::Fields => "cells of kernels per value",
            Self::Impacts => "nothing",
        }
    }
}

/// Nanoseconds per value on one core.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Median over the runs.
    pub median_ns: f64,
    /// Half the distance between the quartiles of the runs.
    pub spread_ns: f64,
}

/// Error of a method against the converged reference, relative to the largest value of each quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Error {
    /// Largest.
    pub max: f64,
    /// Root of the mean square.
    pub rms: f64,
}

impl Error {
    /// Of a list of relative errors; anything that is not a number is infinite.
    #[must_use]
    pub fn of(errors: &[f64]) -> Self {
        let finite = |e: f64| if e.is_nan() { f64::INFINITY } else { e.abs() };
        let max = errors.iter().fold(0.0_f64, |most, &e| most.max(finite(e)));
        let squares: f64 = errors.iter().map(|&e| finite(e) * finite(e)).sum();
        Self {
            max,
            rms: (squares / errors.len().max(1) as f64).sqrt(),
        }
    }
}

/// A method has failed when its largest error is above this or is not a number.
pub const FAILED: f64 = 0.1;

/// One row of the chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Question.
    pub question: Question,
    /// Scene.
    pub scene: &'static str,
    /// Method.
    pub method: &'static str,
    /// Its setting.
    pub setting: String,
    /// Whether the program itself takes this way unless told otherwise.
    pub default_path: bool,
    /// Cost per value on one core.
    pub cost: Timing,
    /// Error against the converged reference.
    pub error: Error,
    /// Work per value, where it is counted.
    pub work: Option<f64>,
    /// Why it failed, where it says so itself.
    pub refusal: Option<String>,
}

impl Record {
    /// Whether the method gave no usable answer.
    #[must_use]
    pub fn failed(&self) -> bool {
        self.refusal.is_some() || self.error.max > FAILED || self.error.max.is_nan()
    }
}

/// Indices of the records that no other beats in both cost and error, by ascending cost.
///
/// `cost` gives the cost of a record; those without one, and failures, are left out.
pub fn pareto_front(records: &[&Record], cost: impl Fn(&Record) -> Option<f64>) -> Vec<usize> {
    let mut order: Vec<(usize, f64)> = records
        .iter()
        .enumerate()
        .filter(|(_, record)| !record.failed())
        .filter_map(|(i, record)| Some((i, cost(record)?)))
        .collect();
    order.sort_by(|a, b| {
        let errors = || records[a.0].error.max.total_cmp(&records[b.0].error.max);
        a.1.total_cmp(&b.1).then_with(errors)
    });
    let mut best = f64::INFINITY;
    order.retain(|&(i, _)| {
        let better = records[i].error.max < best;
        best = best.min(records[i].error.max);
        better
    });
    order.into_iter().map(|(i, _)| i).collect()
}

/// The different items in the order of their first appearance.
pub(crate) fn distinct<'a>(items: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut seen = Vec::new();
    for item in items {
        if !seen.contains(&item) {
            seen.push(item);
        }
    }
    seen
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(cost: f64, error: f64) -> Record {
        Record {
            question: Question::Kernels,
            scene: "",
            method: "",
            setting: String::new(),
            default_path: false,
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
    fn the_front_holds_what_nothing_beats() {
        let rows = [
            record(1.0, 1e-2),
            record(2.0, 2e-2),
            record(3.0, 1e-5),
            record(3.0, 1e-4),
            record(0.5, f64::NAN),
            record(9.0, 1e-9),
        ];
        let rows: Vec<&Record> = rows.iter().collect();
        let front = pareto_front(&rows, |r| Some(r.cost.median_ns));
        assert_eq!(front, [0, 2, 5]);
        assert!(pareto_front(&rows, |r| r.work).is_empty());
    }
}
