//! Rows: the measurement of a method at a setting in a scene.

use crate::method::ComparedMethod;
use contact::Choice;
use halfspace::Six;

contact::choice! {
    /// The four questions of the chart, with their names in files.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Question {
        /// How to compute a kernel: the fields at a point and time after a unit step of force.
        Kernels = "kernels",
        /// How to compute an impact: from a striker to the force history and its results.
        Force = "force",
        /// How to compute fields under a given force history.
        Fields = "fields",
        /// How to compute the fields of a whole impact at a probe.
        Impacts = "impacts",
    }
}

impl Question {
    /// Unit of cost and work, heading in the report, and names of the diagrams in the order of the scenes.
    pub(crate) fn words(self) -> [&'static str; 3] {
        match self {
            Self::Kernels => [
                "six fields at one point and time",
                "How to compute a kernel",
                "kernels-interior kernels-late kernels-axis kernels-surface",
            ],
            Self::Force => [
                "one impact",
                "How to compute an impact",
                "force-disc force-growing",
            ],
            Self::Fields => [
                "six fields at one point over r0/c1 of time",
                "How to compute fields",
                "fields-pulse-10 fields-interpolation-10 fields-pulse-40 fields-interpolation-40 \
                 fields-edge fields-interpolation-edge",
            ],
            Self::Impacts => [
                "one impact with six fields at one point",
                "How to compute the fields of a whole impact",
                "impacts-disc-near impacts-disc-far impacts-growing-near impacts-growing-far",
            ],
        }
    }
}

/// Largest magnitude of each field.
pub(crate) fn peaks(values: &[Six]) -> Six {
    std::array::from_fn(|f| values.iter().fold(0.0_f64, |most, v| most.max(v[f].abs())))
}

/// Errors of some of the six fields at many places, each relative to the scale of its field.
pub(crate) fn off(found: &[Six], exact: &[Six], scale: &Six, fields: &[usize]) -> Vec<f64> {
    let pairs = found.iter().zip(exact);
    let errors = pairs.flat_map(|(a, b)| fields.iter().map(|&f| (a[f] - b[f]) / scale[f]));
    errors.collect()
}

/// Maximum and root mean square of relative errors; infinite if any of them is NaN.
pub(crate) fn sizes(errors: &[f64]) -> [f64; 2] {
    let finite = |e: f64| if e.is_nan() { f64::INFINITY } else { e.abs() };
    let max = errors.iter().fold(0.0_f64, |most, &e| most.max(finite(e)));
    let squares: f64 = errors.iter().map(|&e| finite(e) * finite(e)).sum();
    [max, (squares / errors.len().max(1) as f64).sqrt()]
}

/// Error above which a method has failed, as it has if the error is NaN.
const FAILED: f64 = 0.1;

/// One row of the chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Question.
    pub question: Question,
    /// Scene.
    pub scene: &'static str,
    /// Method.
    pub method: ComparedMethod,
    /// Setting of the method.
    pub setting: String,
    /// Whether the program uses this method by default.
    pub default_path: bool,
    /// Cost in ns per value on one core, the median over the runs.
    pub cost_ns: f64,
    /// Half the interquartile range of the cost, in ns.
    pub cost_spread_ns: f64,
    /// Largest error against the converged reference, relative to the largest value of each quantity.
    pub error_max: f64,
    /// Root of the mean square of these errors.
    pub error_rms: f64,
    /// Work per value, if it is counted.
    pub work: Option<f64>,
    /// Reason for a failure, if the method reports one.
    pub refusal: Option<String>,
}

impl Record {
    /// Names of the columns of chart.csv.
    pub const COLUMNS: &str = "question scene method setting default_path cost_ns cost_spread_ns \
        error_max error_rms work failed refusal";

    /// Values of the columns.
    pub(crate) fn row(&self) -> [String; 12] {
        let number = |x: f64| format!("{x:.4e}");
        [
            self.question.name().to_owned(),
            self.scene.to_owned(),
            self.method.name().to_owned(),
            self.setting.clone(),
            self.default_path.to_string(),
            number(self.cost_ns),
            number(self.cost_spread_ns),
            number(self.error_max),
            number(self.error_rms),
            self.work.map(number).unwrap_or_default(),
            self.failed().to_string(),
            self.refusal.clone().unwrap_or_default(),
        ]
    }

    /// Whether the method returned no usable result.
    pub(crate) fn failed(&self) -> bool {
        self.refusal.is_some() || self.error_max > FAILED || self.error_max.is_nan()
    }
}

/// The records that no other record beats in both cost and error, by ascending cost.
///
/// Failures are skipped.
pub(crate) fn pareto_front<'a>(records: &[&'a Record]) -> Vec<&'a Record> {
    let mut front: Vec<&Record> = records.iter().filter(|r| !r.failed()).copied().collect();
    front.sort_by(|a, b| {
        let errors = || a.error_max.total_cmp(&b.error_max);
        a.cost_ns.total_cmp(&b.cost_ns).then_with(errors)
    });
    let mut best = f64::INFINITY;
    front.retain(|record| {
        let better = record.error_max < best;
        best = best.min(record.error_max);
        better
    });
    front
}

/// The rows of each scene, with its question and the index of the scene in the question.
pub(crate) fn by_scene(records: &[Record]) -> Vec<(Question, usize, Vec<&Record>)> {
    let mut scenes = Vec::new();
    for &question in Question::ALL {
        let mine = || records.iter().filter(move |r| r.question == question);
        let names = distinct(mine().map(|r| r.scene)).into_iter();
        scenes.extend(names.enumerate().map(|(place, name)| {
            let rows = mine().filter(|r| r.scene == name).collect();
            (question, place, rows)
        }));
    }
    scenes
}

/// The different items in the order of their first appearance.
pub(crate) fn distinct<T: PartialEq + Copy>(items: impl Iterator<Item = T>) -> Vec<T> {
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

    impl Record {
        /// A row of a question with one scene.
        pub(crate) fn of(
            method: ComparedMethod,
            default_path: bool,
            cost: f64,
            error: f64,
        ) -> Self {
            Self {
                question: Question::Fields,
                scene: "a scene",
                method,
                setting: String::new(),
                default_path,
                cost_ns: cost,
                cost_spread_ns: 0.0,
                error_max: error,
                error_rms: error,
                work: None,
                refusal: None,
            }
        }
    }

    #[test]
    fn the_front_holds_what_nothing_beats() {
        let rows = [
            (1.0, 1e-2),
            (2.0, 2e-2),
            (3.0, 1e-5),
            (3.0, 1e-4),
            (0.5, f64::NAN),
            (9.0, 1e-9),
        ];
        let rows = rows.map(|(cost, error)| Record::of(ComparedMethod::Direct, false, cost, error));
        let rows: Vec<&Record> = rows.iter().collect();
        assert_eq!(pareto_front(&rows), [rows[0], rows[2], rows[5]]);
    }
}
