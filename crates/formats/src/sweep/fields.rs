//! Which results a file of rows has, and how exactly.

use crate::error::SceneError;
use crate::quantities::{QUANTITIES, Quantity};

/// Results that are written; the model and the reason of a failure always are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fields {
    /// Places in [`QUANTITIES`], ascending.
    pub(crate) places: Vec<usize>,
    /// How exactly.
    pub precision: Precision,
}

/// How exactly results are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// 64 bits, as they are computed.
    #[default]
    Double,
    /// 32 bits: rounded by up to 6e-8 of themselves.
    Single,
}

impl Default for Fields {
    fn default() -> Self {
        Self {
            places: (0..QUANTITIES.len()).collect(),
            precision: Precision::Double,
        }
    }
}

impl Fields {
    /// The results of these names.
    ///
    /// # Errors
    /// [`SceneError::Missing`] for a name that is none of them.
    pub fn of_names<S: AsRef<str>>(names: &[S], precision: Precision) -> Result<Self, SceneError> {
        let mut places = Vec::new();
        for name in names.iter().map(AsRef::as_ref) {
            let place = QUANTITIES.iter().position(|quantity| quantity.name == name);
            places.push(place.ok_or_else(|| {
                let known: Vec<&str> = QUANTITIES.iter().map(|q| q.name).collect();
                SceneError::Missing {
                    key: format!("the column {name}"),
                    hint: format!("the results are {}", known.join(", ")),
                }
            })?);
        }
        places.sort_unstable();
        places.dedup();
        Ok(Self { places, precision })
    }

    /// Keeps the results whose names are wanted.
    pub(crate) fn retain(&mut self, mut wanted: impl FnMut(&str) -> bool) {
        self.places.retain(|&k| wanted(QUANTITIES[k].name));
    }

    /// The results, with their places in [`QUANTITIES`].
    pub(crate) fn quantities(&self) -> impl Iterator<Item = (usize, &'static Quantity)> {
        self.places.iter().map(|&k| (k, &QUANTITIES[k]))
    }

    /// Bytes of a number.
    pub(crate) fn width(&self) -> usize {
        match self.precision {
            Precision::Double => 8,
            Precision::Single => 4,
        }
    }
}
