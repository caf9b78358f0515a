//! chart.csv: one row a method, setting and scene. Described in data-schema/chart.md.

use crate::record::Record;
use std::path::Path;

/// Names of the columns, also those of the datasets in chart.h5.
pub const COLUMNS: [&str; 12] = [
    "question",
    "scene",
    "method",
    "setting",
    "default_path",
    "cost_ns",
    "cost_spread_ns",
    "error_max",
    "error_rms",
    "work",
    "failed",
    "refusal",
];

/// Writes the rows.
pub(crate) fn write(path: &Path, records: &[Record]) -> Result<(), String> {
    let words = |error: csv::Error| error.to_string();
    let mut writer = csv::Writer::from_path(path).map_err(words)?;
    writer.write_record(COLUMNS).map_err(words)?;
    for record in records {
        writer.write_record(row(record)).map_err(words)?;
    }
    writer.flush().map_err(|error| error.to_string())
}

fn row(record: &Record) -> [String; 12] {
    let number = |x: f64| format!("{x:.4e}");
    [
        record.question.name().to_owned(),
        record.scene.to_owned(),
        record.method.to_owned(),
        record.setting.clone(),
        record.default_path.to_string(),
        number(record.cost.median_ns),
        number(record.cost.spread_ns),
        number(record.error.max),
        number(record.error.rms),
        record.work.map(number).unwrap_or_default(),
        record.failed().to_string(),
        record.refusal.clone().unwrap_or_default(),
    ]
}
