//! Table 1: wave speeds and Lame's constants from Young's modulus, Poisson's ratio and density.

use crate::error::PaperError;
use crate::row::Row;
use contact::Material;

pub(super) fn rows() -> Result<Vec<Row>, PaperError> {
    let printed = [
        ("copper", [4597.0, 2263.0, 97.53, 45.9], NAMES_COPPER),
        ("steel", [5994.0, 3204.0, 120.6, 80.4], NAMES_STEEL),
    ];
    let mut rows = Vec::new();
    for (name, paper, names) in printed {
        let material = Material::named(name)?;
        let (mu, modulus) = (
            material.shear_modulus_pa(),
            material.longitudinal_modulus_pa(),
        );
        let here = [
            material.longitudinal_speed_m_s().unwrap_or(f64::NAN),
            material.shear_speed_m_s().unwrap_or(f64::NAN),
            (modulus - 2.0 * mu) / 1e9,
            mu / 1e9,
        ];
        for (i, what) in names.into_iter().enumerate() {
            let (unit, digits) = [("m/s", 0), ("m/s", 0), ("GPa", 2), ("GPa", 1)][i];
            rows.push(Row::new("Tab. 1", what, [paper[i], here[i]]).unit(unit, digits));
        }
    }
    Ok(rows)
}

const NAMES_COPPER: [&str; 4] = [
    "copper, longitudinal speed c1",
    "copper, shear speed c2",
    "copper, lambda",
    "copper, shear modulus mu",
];

const NAMES_STEEL: [&str; 4] = [
    "steel, longitudinal speed c1",
    "steel, shear speed c2",
    "steel, lambda",
    "steel, shear modulus mu",
];
