//! Which results a file of rows has, and how exactly.

use super::probed::Described;
use crate::error::SceneError;
use crate::quantities::QUANTITIES;
use std::sync::Arc;

/// Results that are written; the model and the reason of a failure always are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fields {
    /// Places in [`QUANTITIES`] and, behind them, in the columns of the probes; ascending.
    pub(crate) places: Vec<usize>,
    /// All columns of the probes.
    pub(crate) probed: Arc<[Described]>,
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

/// A result that is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Named<'a> {
    pub(crate) name: &'a str,
    pub(crate) unit: &'static str,
    pub(crate) meaning: &'a str,
}

impl Default for Fields {
    fn default() -> Self {
        Self::all(Vec::new())
    }
}

impl Fields {
    /// All results, with the columns of some probes.
    pub(crate) fn all(probed: Vec<Described>) -> Self {
        Self {
            places: (0..QUANTITIES.len() + probed.len()).collect(),
            probed: probed.into(),
            precision: Precision::Double,
        }
    }

    /// The result at a place.
    pub(crate) fn named(&self, place: usize) -> Named<'_> {
        match QUANTITIES.get(place) {
            Some(quantity) => Named {
                name: quantity.name,
                unit: quantity.unit,
                meaning: quantity.meaning,
            },
            None => {
                let column = &self.probed[place - QUANTITIES.len()];
                Named {
                    name: &column.name,
                    unit: column.unit,
                    meaning: &column.meaning,
                }
            }
        }
    }

    /// The results of these names, without probes.
    ///
    /// # Errors
    /// [`SceneError::Missing`] for a name that is none of them.
    pub fn of_names<S: AsRef<str>>(names: &[S], precision: Precision) -> Result<Self, SceneError> {
        let all = Self {
            precision,
            ..Self::default()
        };
        all.only(names)
    }

    /// Those of these names alone.
    ///
    /// # Errors
    /// [`SceneError::Missing`] for a name that is none of them.
    pub fn only<S: AsRef<str>>(self, names: &[S]) -> Result<Self, SceneError> {
        let mut places = Vec::new();
        for name in names.iter().map(AsRef::as_ref) {
            let mut all = 0..QUANTITIES.len() + self.probed.len();
            let place = all.find(|&place| self.named(place).name == name);
            places.push(place.ok_or_else(|| {
                let known = 0..QUANTITIES.len() + self.probed.len();
                let known: Vec<&str> = known.map(|place| self.named(place).name).collect();
                SceneError::Missing {
                    key: format!("the column {name}"),
                    hint: format!("the results are {}", known.join(", ")),
                }
            })?);
        }
        places.sort_unstable();
        places.dedup();
        Ok(Self { places, ..self })
    }

    /// Keeps the results whose names are wanted.
    pub(crate) fn retain(&mut self, mut wanted: impl FnMut(&str) -> bool) {
        let mut places = std::mem::take(&mut self.places);
        places.retain(|&k| wanted(self.named(k).name));
        self.places = places;
    }

    /// The results, with their places.
    pub(crate) fn quantities(&self) -> impl Iterator<Item = (usize, Named<'_>)> {
        self.places.iter().map(|&k| (k, self.named(k)))
    }

    /// Bytes of a number.
    pub(crate) fn width(&self) -> usize {
        match self.precision {
            Precision::Double => 8,
            Precision::Single => 4,
        }
    }
}
