//! What can be shown of a section: what a file holds, and what follows from it at the same instant.

use crate::error::PlotError;
use crate::words::{of_quantity, unit_of};
use contact::Choice;
use figure::{ColourMap, ColourScale, Limits};
use formats::stored::{ReadError, StoredQuantity, StoredSection};
use std::path::Path;

/// A quantity with the way to it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Quantity {
    /// Name, as users give it.
    pub(super) name: String,
    /// What it is, for an axis.
    pub(super) words: String,
    /// Unit without a prefix.
    pub(super) unit: String,
    recipe: Recipe,
}

/// How a quantity follows from what is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Recipe {
    Stored,
    /// Length of the vector of two.
    Length(&'static str, &'static str),
    /// From the stresses.
    Stress(impact::Quantity),
}

/// What follows from stresses without the elastic constants.
const OF_STRESSES: [impact::Quantity; 6] = [
    impact::Quantity::VonMises,
    impact::Quantity::Tresca,
    impact::Quantity::MaxShear,
    impact::Quantity::Principal1,
    impact::Quantity::Principal2,
    impact::Quantity::Principal3,
];

impl Quantity {
    /// The quantity of a name, stored or not.
    pub(super) fn named(
        name: &str,
        stored: &[StoredQuantity],
        path: &Path,
    ) -> Result<Self, PlotError> {
        let find = |name: &str| stored.iter().find(|quantity| quantity.name == name);
        let stress = OF_STRESSES.into_iter().find(|of| of.name() == name);
        let (unit, recipe) = match (find(name), stress, name) {
            (Some(found), _, _) => (found.unit.as_str(), Recipe::Stored),
            (None, Some(of), _) => ("Pa", Recipe::Stress(of)),
            (None, None, "displacement") => {
                ("m", Recipe::Length("displacement_r", "displacement_z"))
            }
            (None, None, "speed") if find("velocity_r").and(find("velocity_z")).is_some() => {
                ("m/s", Recipe::Length("velocity_r", "velocity_z"))
            }
            (None, None, _) => {
                let known = stored.iter().map(|quantity| quantity.name.as_str());
                let derived = OF_STRESSES.iter().map(|of| of.name());
                let all = known.chain(derived).chain(["displacement"]);
                return Err(PlotError::unknown(path, name, name, all));
            }
        };
        Ok(Self {
            name: name.to_owned(),
            words: of_quantity(name),
            unit: unit.to_owned(),
            recipe,
        })
    }

    /// What it is of the stresses, if that is all it is of.
    pub(super) fn stress(&self) -> Option<impact::Quantity> {
        OF_STRESSES.into_iter().find(|of| of.name() == self.name)
    }

    /// Whether it has a sign.
    pub(super) fn has_sign(&self) -> bool {
        !["von_mises", "tresca", "max_shear", "displacement", "speed"].contains(&self.name.as_str())
    }

    /// Colours that suit it, up to a size.
    pub(super) fn colours(&self, largest: f64) -> ColourScale {
        let (map, low) = match self.has_sign() {
            true => (ColourMap::Diverging, -largest),
            false => (ColourMap::Sequential, 0.0),
        };
        ColourScale::new(&self.words, unit_of(&self.unit), map)
            .limits(Limits::Between(low, largest))
    }

    /// Its values in a frame.
    pub(super) fn at(&self, section: &StoredSection, frame: usize) -> Result<Vec<f64>, ReadError> {
        let stored = |name: &str| -> Result<Vec<f64>, ReadError> {
            let values = section.frame(name, frame)?;
            Ok(values.into_iter().map(f64::from).collect())
        };
        Ok(match self.recipe {
            Recipe::Stored => stored(&self.name)?,
            Recipe::Length(a, b) => {
                let pairs = stored(a)?.into_iter().zip(stored(b)?);
                pairs.map(|(a, b)| a.hypot(b)).collect()
            }
            Recipe::Stress(of) => {
                let [rr, tt, zz, rz] =
                    ["rr", "tt", "zz", "rz"].map(|name| stored(&format!("stress_{name}")));
                let (rr, tt, zz, rz) = (rr?, tt?, zz?, rz?);
                let at = |i: usize| of.of([rr[i], tt[i], zz[i], rz[i]], [1.0, 0.0]);
                (0..rr.len()).map(at).collect()
            }
        })
    }
}
