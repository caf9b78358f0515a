//! Selection and precision of the results in a file of rows: contact results, followed by the columns of probes.

use crate::error::SceneError;
use crate::quantities::{Described, Labels, QUANTITIES, labels_of};
use crate::scene::section::TomlSection;
use crate::schema::results::{ERROR_SUFFIX, beside};
use crate::schema::sweep::FIELDS as SECTION;
use impact::{ProbePeaks, Quantity};
use std::sync::Arc;
use toml::{Table, Value};

/// Results that are written; the model and the reason of a failure are always written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WrittenResults {
    /// Indices among the known ones; ascending.
    pub(crate) places: Vec<usize>,
    /// All results that could be written.
    pub(super) known: Arc<[Described]>,
    /// Precision of the numbers.
    pub precision: Precision,
}

/// Precision of written results, in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// 64 bits, as computed.
    #[default]
    Double = 64,
    /// 32 bits: rounded by a relative 6e-8 at most.
    Single = 32,
}

impl Default for WrittenResults {
    fn default() -> Self {
        Self::all(Vec::new())
    }
}

impl WrittenResults {
    /// All results, with the columns of some probes.
    pub(crate) fn all(probed: Vec<Described>) -> Self {
        let own = QUANTITIES.iter();
        let own = own.map(|own| Described::from((own.name, own.unit, own.meaning)));
        let known: Arc<[Described]> = own.chain(probed).collect();
        Self {
            places: (0..known.len()).collect(),
            known,
            precision: Precision::Double,
        }
    }

    /// Number of results per row, written or not: those of the contact, followed by those of the probes.
    pub(crate) fn width(&self) -> usize {
        self.known.len()
    }

    /// Only the results with these names.
    ///
    /// # Errors
    /// [`SceneError`] for an unknown name.
    pub fn only<S: AsRef<str>>(self, names: &[S]) -> Result<Self, SceneError> {
        let known = || self.known.iter().map(|known| known.name.as_str());
        let names = names.iter().map(AsRef::as_ref);
        if let Some(name) = names
            .clone()
            .find(|name| !known().any(|known| known == *name))
        {
            let known: Vec<&str> = known().collect();
            let key = "columns".to_owned();
            return Err(SceneError::unknown_choice(key, name, &known.join(", ")));
        }
        let wanted = |place: &usize| names.clone().any(|name| name == self.known[*place].name);
        let places = (0..self.width()).filter(wanted).collect();
        Ok(Self { places, ..self })
    }

    /// Keeps the results whose names are wanted.
    pub(crate) fn retain(&mut self, mut wanted: impl FnMut(&str) -> bool) {
        let known = &self.known;
        self.places.retain(|&place| wanted(&known[place].name));
    }

    /// The results with their indices.
    pub(crate) fn quantities(&self) -> impl Iterator<Item = (usize, &Described)> {
        self.places.iter().map(|&place| (place, &self.known[place]))
    }
}

/// Largest number of probe columns: a dimension scale lists all its datasets in an attribute of at most 64 kB.
const MOST_PROBE_COLUMNS: usize = 2000;

/// Whether the kernels of a row were looked up.
const TABLE: (&str, &str, &str) = (
    "probe_table",
    "1",
    "1 if the kernels of the fields were looked up, 0 if they were computed",
);

/// The columns of the probes of a base scene: peaks of fields, their times and errors; empty without probes.
pub(super) fn columns_of_probes(scene: &Table) -> Result<Vec<Described>, SceneError> {
    let root = TomlSection::root(scene);
    let probes = root.list("probe")?.len();
    if probes == 0 {
        return Ok(Vec::new());
    }
    let output = root.section("output")?;
    let quantities = output.map(|output| output.choices::<Quantity>("quantities"));
    let quantities = quantities.transpose()?.unwrap_or_default();
    let fields: Vec<_> = labels_of(&quantities).collect();
    let count = 1 + 3 * probes * fields.len();
    if count > MOST_PROBE_COLUMNS {
        let key = "the number of columns of the probes";
        return Err(SceneError::out_of_range(key, count as f64, "[0, 2000]"));
    }
    let mut columns = vec![TABLE.into()];
    for probe in 1..=probes {
        columns.extend(fields.iter().flat_map(|&field| of_field(probe, field)));
    }
    Ok(columns)
}

/// The columns of the probes of a stored sweep.
pub(crate) fn stored_columns(sweep: &Table) -> Result<Vec<Described>, SceneError> {
    match (sweep.get(SECTION), sweep.get("scene")) {
        (Some(_), Some(Value::Table(scene))) => columns_of_probes(scene),
        _ => Ok(Vec::new()),
    }
}

/// Peak, its time and error of a field.
fn of_field(probe: usize, field: Labels<'_>) -> [Described; 3] {
    let (name, at) = (
        format!("probe_{probe}_{}", field.0),
        format!(" at probe {probe}"),
    );
    let [_, peak, time, error] = beside(&name, field, &at);
    let name = format!("{name}{ERROR_SUFFIX}");
    [peak, time, Described { name, ..error }]
}

/// The numbers of a row, in the order of the columns.
pub(super) fn probed_numbers(found: &ProbePeaks) -> impl Iterator<Item = f64> + '_ {
    let peaks = found.peaks.iter();
    let peaks = peaks.flat_map(|one| [one.value, one.time_s, one.error]);
    std::iter::once(f64::from(u8::from(found.looked_up))).chain(peaks)
}
