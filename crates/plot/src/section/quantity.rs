//! What can be shown of a field: what a file holds, and what follows from it.

use crate::error::PlotError;
use crate::series::{weights, window};
use crate::words::of_quantity;
use figure::{ColourMap, ColourScale, Limits, Unit};
use formats::stored::{ReadError, StoredQuantity};
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
    /// It is stored.
    Stored,
    /// Rate of change of a stored one, by differences.
    Rate(&'static str),
    /// Length of the vector of two.
    Length(&'static str, &'static str),
    /// Length of the velocity, by differences.
    Speed,
    /// From the stresses.
    Stress(impact::Quantity),
}

/// Names, units and recipes of what follows from displacements and stresses.
const DERIVED: [(&str, &str, Recipe); 6] = [
    ("velocity_r", "m/s", Recipe::Rate("displacement_r")),
    ("velocity_z", "m/s", Recipe::Rate("displacement_z")),
    ("speed", "m/s", Recipe::Speed),
    (
        "displacement",
        "m",
        Recipe::Length("displacement_r", "displacement_z"),
    ),
    (
        "von_mises",
        "Pa",
        Recipe::Stress(impact::Quantity::VonMises),
    ),
    (
        "max_shear",
        "Pa",
        Recipe::Stress(impact::Quantity::MaxShear),
    ),
];

/// Samples that a rate is taken from.
pub(super) const SAMPLES: usize = 5;

/// A field at several instants: what an instant holds of a stored quantity.
pub(super) trait Instants {
    /// Times in s, ascending.
    fn time_s(&self) -> &[f64];

    /// A stored quantity at an instant.
    fn at(&mut self, quantity: &str, instant: usize) -> Result<Vec<f64>, ReadError>;
}

impl Quantity {
    /// The quantity of a name, stored or not.
    pub(super) fn named(
        name: &str,
        stored: &[StoredQuantity],
        path: &Path,
    ) -> Result<Self, PlotError> {
        let find = |name: &str| stored.iter().find(|quantity| quantity.name == name);
        let derived = DERIVED.iter().find(|row| row.0 == name);
        let (unit, recipe) = match (find(name), derived) {
            (Some(found), _) => (found.unit.as_str(), Recipe::Stored),
            (None, Some((_, unit, Recipe::Speed)))
                if find("velocity_r").is_some() && find("velocity_z").is_some() =>
            {
                (*unit, Recipe::Length("velocity_r", "velocity_z"))
            }
            (None, Some((_, unit, recipe))) => (*unit, *recipe),
            (None, None) => {
                let known = stored.iter().map(|quantity| quantity.name.as_str());
                let all = known.chain(DERIVED.iter().map(|row| row.0));
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

    /// Whether it is taken by differences in time.
    pub(super) fn is_rate(&self) -> bool {
        matches!(self.recipe, Recipe::Rate(_) | Recipe::Speed)
    }

    /// Whether it has a sign.
    fn has_sign(&self) -> bool {
        match self.recipe {
            Recipe::Stored => !["von_mises", "tresca", "max_shear"].contains(&self.name.as_str()),
            Recipe::Rate(_) => true,
            Recipe::Length(..) | Recipe::Speed | Recipe::Stress(_) => false,
        }
    }

    /// Colours that suit it, up to a size.
    pub(super) fn colours(&self, largest: f64) -> ColourScale {
        let (map, low) = match self.has_sign() {
            true => (ColourMap::Diverging, -largest),
            false => (ColourMap::Sequential, 0.0),
        };
        ColourScale::new(&self.words, Unit::Si(self.unit.clone()), map)
            .limits(Limits::Between(low, largest))
    }

    /// Its values at an instant, rates from so many samples in time: fewer say how much the distance of the samples
    /// matters.
    pub(super) fn at(
        &self,
        field: &mut dyn Instants,
        instant: usize,
        samples: usize,
    ) -> Result<Vec<f64>, ReadError> {
        let length = |a: Vec<f64>, b: Vec<f64>| -> Vec<f64> {
            a.into_iter().zip(b).map(|(a, b)| a.hypot(b)).collect()
        };
        Ok(match self.recipe {
            Recipe::Stored => field.at(&self.name, instant)?,
            Recipe::Rate(of) => rate(field, of, instant, samples)?,
            Recipe::Length(a, b) => length(field.at(a, instant)?, field.at(b, instant)?),
            Recipe::Speed => length(
                rate(field, "displacement_r", instant, samples)?,
                rate(field, "displacement_z", instant, samples)?,
            ),
            Recipe::Stress(of) => {
                let [rr, tt, zz, rz] = ["rr", "tt", "zz", "rz"]
                    .map(|component| field.at(&format!("stress_{component}"), instant));
                let (rr, tt, zz, rz) = (rr?, tt?, zz?, rz?);
                // of these two the elastic constants do not matter
                let at = |i: usize| of.of([rr[i], tt[i], zz[i], rz[i]], [1.0, 0.0]);
                (0..rr.len()).map(at).collect()
            }
        })
    }
}

/// Rate of change of a stored quantity.
fn rate(
    field: &mut dyn Instants,
    of: &str,
    instant: usize,
    samples: usize,
) -> Result<Vec<f64>, ReadError> {
    let (start, count) = window(instant, samples, field.time_s().len());
    let places = field.time_s()[start..start + count].to_vec();
    let weights = weights(places[instant - start], &places);
    let mut sum: Vec<f64> = Vec::new();
    for (i, weight) in weights.into_iter().enumerate() {
        let values = field.at(of, start + i)?;
        sum.resize(values.len(), 0.0);
        for (sum, value) in sum.iter_mut().zip(values) {
            *sum += weight * value;
        }
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A field that is a polynomial of the time.
    struct Cubic(Vec<f64>);

    impl Instants for Cubic {
        fn time_s(&self) -> &[f64] {
            &self.0
        }

        fn at(&mut self, _: &str, instant: usize) -> Result<Vec<f64>, ReadError> {
            let t = self.0[instant];
            Ok(vec![1.0 - t + t.powi(3), 4.0 * t])
        }
    }

    #[test]
    fn velocities_are_rates_of_displacements() {
        let mut field = Cubic(vec![0.0, 0.1, 0.2, 0.32, 0.4, 0.5]);
        let velocity = Quantity::named("velocity_z", &[], Path::new("a.h5"))
            .unwrap_or_else(|e| unreachable!("{e}"));
        for instant in 0..6 {
            let t = field.0[instant];
            let found = velocity
                .at(&mut field, instant, SAMPLES)
                .unwrap_or_default();
            assert!(
                (found[0] - (3.0 * t * t - 1.0)).abs() < 1e-12 && (found[1] - 4.0).abs() < 1e-12
            );
        }
        assert!(velocity.is_rate() && velocity.has_sign());
        let unknown = Quantity::named("velocity_x", &[], Path::new("a.h5"));
        assert!(unknown.is_err_and(|e| e.to_string().contains("did you mean velocity_r?")));
    }
}
