//! The columns that probes bring to a sweep: peaks of fields, their instants and errors.

use super::schema::FIELDS as SECTION;
use crate::error::SceneError;
use crate::quantities::{FIELDS, described};
use crate::results::schema::{ERROR_SUFFIX, PEAK_SUFFIXES};
use crate::section::Section;
use impact::{ProbePeaks, Quantity};
use toml::{Table, Value};

/// A column of results.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Described {
    /// Its name in files.
    pub(crate) name: String,
    /// Its unit.
    pub(crate) unit: &'static str,
    /// What it is.
    pub(crate) meaning: String,
}

/// Columns of the probes at most: a dimension scale names every dataset that it belongs to in 64 kB.
const MOST: usize = 2000;

/// Whether the kernels of a row were looked up.
const TABLE: [&str; 3] = [
    "probe_table",
    "1",
    "1 where the kernels of the fields were looked up, 0 where they were computed",
];

/// The columns of the probes of a base scene; none without probes.
pub(crate) fn probed(scene: &Table) -> Result<Vec<Described>, SceneError> {
    let root = Section::root(scene);
    let probes = root.list("probe")?.len();
    if probes == 0 {
        return Ok(Vec::new());
    }
    let quantities: Vec<Quantity> = match root.section("output")? {
        Some(output) => output.choices("quantities")?,
        None => Vec::new(),
    };
    let fields = || {
        FIELDS
            .into_iter()
            .chain(quantities.iter().map(|&q| described(q)))
    };
    let count = 1 + 3 * probes * fields().count();
    if count > MOST {
        return Err(SceneError::OutOfRange {
            key: "the number of columns of the probes".to_owned(),
            value: count as f64,
            range: "[0, 2000]",
        });
    }
    let [name, unit, meaning] = TABLE;
    let mut columns = vec![Described {
        name: name.to_owned(),
        unit,
        meaning: meaning.to_owned(),
    }];
    for probe in 1..=probes {
        columns.extend(fields().flat_map(|field| of_field(probe, field)));
    }
    Ok(columns)
}

/// The columns of the probes of a stored sweep.
pub(crate) fn stored_columns(sweep: &Table) -> Result<Vec<Described>, SceneError> {
    match (sweep.get(SECTION), sweep.get("scene")) {
        (Some(_), Some(Value::Table(scene))) => probed(scene),
        _ => Ok(Vec::new()),
    }
}

/// Peak, instant and error of a field.
fn of_field(probe: usize, (name, unit, meaning): (&str, &'static str, &str)) -> [Described; 3] {
    let [peak, time] = PEAK_SUFFIXES;
    [
        (peak, unit, "largest in magnitude over time"),
        (time, "s", "when it is largest in magnitude"),
        (ERROR_SUFFIX, unit, "estimated absolute error"),
    ]
    .map(|(suffix, unit, what)| Described {
        name: format!("probe_{probe}_{name}{suffix}"),
        unit,
        meaning: format!("{what} at probe {probe}: {meaning}"),
    })
}

/// The numbers of a row, in the order of the columns.
pub(super) fn numbers(found: &ProbePeaks) -> impl Iterator<Item = f64> + '_ {
    let peaks = found.peaks.iter();
    let peaks = peaks.flat_map(|peak| [peak.value, peak.time_s, peak.error]);
    std::iter::once(f64::from(u8::from(found.looked_up))).chain(peaks)
}
