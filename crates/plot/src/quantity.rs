//! What can be shown of a field: what a file holds, and what follows from it.

use crate::difference::{weights, window};
use crate::error::PlotError;
use contact::nearest;
use figure::ColourMap;
use formats::stored::{ReadError, StoredQuantity};
use std::path::Path;

/// A quantity with the way to it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Quantity {
    /// Name, as users give it.
    pub(crate) name: String,
    /// What it is, for an axis.
    pub(crate) words: String,
    /// Unit without a prefix.
    pub(crate) unit: String,
    recipe: Recipe,
}

/// How a quantity follows from what is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Recipe {
    /// It is stored.
    Stored,
    /// Rate of change of a stored one, by differences.
    Rate(&'static str),
    /// Length of the displacement.
    Displacement,
    /// Length of the velocity, by differences.
    Speed,
    /// Length of the velocity where it is stored.
    StoredSpeed,
    /// Von Mises' stress.
    VonMises,
    /// Largest shear stress, half of Tresca's.
    MaximumShear,
}

/// Names, words, units and recipes of what follows from displacements and stresses.
const DERIVED: [(&str, &str, &str, Recipe); 6] = [
    (
        "velocity_r",
        "radial particle velocity",
        "m/s",
        Recipe::Rate("displacement_r"),
    ),
    (
        "velocity_z",
        "axial particle velocity",
        "m/s",
        Recipe::Rate("displacement_z"),
    ),
    ("speed", "particle speed", "m/s", Recipe::Speed),
    (
        "displacement",
        "length of the displacement",
        "m",
        Recipe::Displacement,
    ),
    ("von_mises", "von Mises stress", "Pa", Recipe::VonMises),
    (
        "max_shear",
        "largest shear stress",
        "Pa",
        Recipe::MaximumShear,
    ),
];

/// Stored quantities without a sign.
const UNSIGNED: [&str; 3] = ["von_mises", "tresca", "max_shear"];

/// Samples that a rate is taken from.
const SAMPLES: usize = 5;

/// A field at several instants: what an instant holds of a stored quantity.
pub(crate) trait Instants {
    /// Times in s, ascending.
    fn time_s(&self) -> &[f64];

    /// A stored quantity at an instant.
    fn at(&mut self, quantity: &str, instant: usize) -> Result<Vec<f64>, ReadError>;
}

impl Quantity {
    /// The quantity of a name, stored or not.
    pub(crate) fn named(
        name: &str,
        stored: &[StoredQuantity],
        path: &Path,
    ) -> Result<Self, PlotError> {
        if let Some(found) = stored.iter().find(|quantity| quantity.name == name) {
            return Ok(Self {
                name: name.to_owned(),
                words: words(name),
                unit: found.unit.clone(),
                recipe: Recipe::Stored,
            });
        }
        let velocities = ["velocity_r", "velocity_z"];
        let stored_both = velocities
            .iter()
            .all(|v| stored.iter().any(|q| q.name == *v));
        if name == "speed" && stored_both {
            return Ok(Self {
                name: name.to_owned(),
                words: "particle speed".to_owned(),
                unit: "m/s".to_owned(),
                recipe: Recipe::StoredSpeed,
            });
        }
        if let Some((_, words, unit, recipe)) = DERIVED.iter().find(|row| row.0 == name) {
            return Ok(Self {
                name: name.to_owned(),
                words: (*words).to_owned(),
                unit: (*unit).to_owned(),
                recipe: *recipe,
            });
        }
        let derived = DERIVED.iter().map(|row| row.0);
        let all: Vec<&str> = stored
            .iter()
            .map(|q| q.name.as_str())
            .chain(derived)
            .collect();
        Err(PlotError::Quantity {
            path: path.to_owned(),
            quantity: name.to_owned(),
            suggestion: nearest(name, all.iter().copied()),
            allowed: all.join(", "),
        })
    }

    /// Whether it is taken by differences in time.
    pub(crate) fn is_rate(&self) -> bool {
        match self.recipe {
            Recipe::Rate(_) | Recipe::Speed => true,
            Recipe::Stored
            | Recipe::StoredSpeed
            | Recipe::Displacement
            | Recipe::VonMises
            | Recipe::MaximumShear => false,
        }
    }

    /// Whether it has a sign.
    pub(crate) fn has_sign(&self) -> bool {
        match self.recipe {
            Recipe::Stored => !UNSIGNED.contains(&self.name.as_str()),
            Recipe::Rate(_) => true,
            Recipe::Displacement
            | Recipe::Speed
            | Recipe::StoredSpeed
            | Recipe::VonMises
            | Recipe::MaximumShear => false,
        }
    }

    /// Colours that suit it.
    pub(crate) fn colours(&self) -> ColourMap {
        if self.has_sign() {
            ColourMap::Diverging
        } else {
            ColourMap::Sequential
        }
    }

    /// Its values at an instant.
    pub(crate) fn at(
        &self,
        field: &mut dyn Instants,
        instant: usize,
    ) -> Result<Vec<f64>, PlotError> {
        self.of_samples(field, instant, SAMPLES)
    }

    /// The same from fewer samples in time, which says how much the distance of the samples matters.
    pub(crate) fn coarser(
        &self,
        field: &mut dyn Instants,
        instant: usize,
    ) -> Result<Vec<f64>, PlotError> {
        self.of_samples(field, instant, SAMPLES - 2)
    }

    fn of_samples(
        &self,
        field: &mut dyn Instants,
        instant: usize,
        samples: usize,
    ) -> Result<Vec<f64>, PlotError> {
        let length = |a: Vec<f64>, b: Vec<f64>| -> Vec<f64> {
            a.into_iter().zip(b).map(|(a, b)| a.hypot(b)).collect()
        };
        Ok(match self.recipe {
            Recipe::Stored => field.at(&self.name, instant)?,
            Recipe::Rate(of) => rate(field, of, instant, samples)?,
            Recipe::Displacement => length(
                field.at("displacement_r", instant)?,
                field.at("displacement_z", instant)?,
            ),
            Recipe::Speed => length(
                rate(field, "displacement_r", instant, samples)?,
                rate(field, "displacement_z", instant, samples)?,
            ),
            Recipe::StoredSpeed => length(
                field.at("velocity_r", instant)?,
                field.at("velocity_z", instant)?,
            ),
            Recipe::VonMises => stresses(field, instant, von_mises)?,
            Recipe::MaximumShear => stresses(field, instant, maximum_shear)?,
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

/// A number from the four stresses, at each place.
fn stresses(
    field: &mut dyn Instants,
    instant: usize,
    of: fn([f64; 4]) -> f64,
) -> Result<Vec<f64>, ReadError> {
    let names = ["stress_rr", "stress_tt", "stress_zz", "stress_rz"];
    let mut parts = Vec::new();
    for name in names {
        parts.push(field.at(name, instant)?);
    }
    let places = 0..parts[0].len();
    Ok(places
        .map(|i| of(std::array::from_fn(|k| parts[k][i])))
        .collect())
}

/// sqrt([(srr - stt)^2 + (stt - szz)^2 + (szz - srr)^2]/2 + 3 srz^2)
fn von_mises([rr, tt, zz, rz]: [f64; 4]) -> f64 {
    let square = |x: f64| x * x;
    (0.5 * (square(rr - tt) + square(tt - zz) + square(zz - rr)) + 3.0 * rz * rz).sqrt()
}

/// Half of the difference between the largest and the smallest principal stress.
fn maximum_shear([rr, tt, zz, rz]: [f64; 4]) -> f64 {
    let (middle, radius) = (0.5 * (rr + zz), (0.5 * (rr - zz)).hypot(rz));
    let principal = [middle + radius, middle - radius, tt];
    let largest = principal.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let smallest = principal.iter().copied().fold(f64::INFINITY, f64::min);
    0.5 * (largest - smallest)
}

/// A velocity or an acceleration is that of the particles, not of a wave.
fn particle(kind: &str) -> String {
    match kind {
        "velocity" | "acceleration" => format!("particle {kind}"),
        other => other.to_owned(),
    }
}

/// Name of a stored quantity in words: `displacement_z` is "axial displacement".
pub(crate) fn words(name: &str) -> String {
    let (kind, component) = name.rsplit_once('_').unwrap_or((name, ""));
    match component {
        "r" | "rr" => format!("radial {}", particle(kind)),
        "z" | "zz" => format!("axial {}", particle(kind)),
        "tt" => format!("hoop {kind}"),
        "rz" => format!("shear {kind}"),
        _ => match name {
            "von_mises" => "von Mises stress".to_owned(),
            "tresca" => "Tresca stress".to_owned(),
            "max_shear" => "largest shear stress".to_owned(),
            "principal_1" => "largest principal stress".to_owned(),
            "principal_2" => "middle principal stress".to_owned(),
            "principal_3" => "smallest principal stress".to_owned(),
            other => other.replace('_', " "),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equivalent_stresses_are_those_of_textbooks() {
        // uniaxial, pure shear, and pressure from all sides
        assert!((von_mises([0.0, 0.0, -5.0, 0.0]) - 5.0).abs() < 1e-15);
        assert!((von_mises([0.0, 0.0, 0.0, 2.0]) - 2.0 * 3_f64.sqrt()).abs() < 1e-15);
        assert_eq!(von_mises([-3.0, -3.0, -3.0, 0.0]), 0.0);
        assert_eq!(maximum_shear([0.0, 0.0, -5.0, 0.0]), 2.5);
        assert_eq!(maximum_shear([0.0, 0.0, 0.0, 2.0]), 2.0);
        // the hoop stress may be one of the two
        assert_eq!(maximum_shear([1.0, 7.0, -1.0, 0.0]), 4.0);
    }

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
            let found = velocity.at(&mut field, instant).unwrap_or_default();
            assert!(
                (found[0] - (3.0 * t * t - 1.0)).abs() < 1e-12 && (found[1] - 4.0).abs() < 1e-12
            );
        }
        assert!(velocity.is_rate() && velocity.has_sign());
        let unknown = Quantity::named("velocity_x", &[], Path::new("a.h5"));
        assert!(unknown.is_err_and(|e| e.to_string().contains("did you mean velocity_r?")));
    }
}
