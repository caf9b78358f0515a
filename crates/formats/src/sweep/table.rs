//! The columns of a file of rows, whatever its format.

use super::axis::Values;
use super::columns::What;
use super::file::{results, unit};
use super::schema::part;
use super::spec::Spec;

/// A column of such a file.
#[derive(Debug, Clone)]
pub(super) struct RowColumn<'a> {
    pub(super) name: String,
    pub(super) unit: &'static str,
    pub(super) meaning: String,
    pub(super) what: What,
    /// Values of a key.
    pub(super) values: Option<&'a Values>,
}

/// The number of the row, the keys that vary, the results, the model and the reason of a failure.
pub(super) fn row_columns(spec: &Spec) -> Vec<RowColumn<'_>> {
    let fixed = |(name, unit, meaning): (&str, &'static str, &str), what| RowColumn {
        name: name.to_owned(),
        unit,
        meaning: meaning.to_owned(),
        what,
        values: None,
    };
    let mut found = vec![fixed(part::ROW, What::Row)];
    let mut stride = spec.rows();
    for (axis, along) in spec.axes.iter().enumerate() {
        stride /= along.len;
        for (column, key) in along.columns.iter().enumerate() {
            let what = What::Key {
                stride,
                axis,
                column,
            };
            found.push(RowColumn {
                meaning: format!("scene key {}", key.name()),
                name: key.name(),
                unit: unit(&key.key),
                what,
                values: Some(&key.values),
            });
        }
    }
    found.extend(results(&spec.fields).map(|(described, what)| fixed(described, what)));
    found
}
