//! Solids that no library has.

use contact::Material;

/// Of a modulus in Pa, a Poisson's ratio and a density in kg/m^3.
pub(crate) fn material(youngs_modulus_pa: f64, poisson_ratio: f64, density_kg_m3: f64) -> Material {
    Material::elastic(youngs_modulus_pa, poisson_ratio, density_kg_m3).unwrap()
}
