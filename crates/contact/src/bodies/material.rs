//! Elastic materials, and errors of bodies.

use halfspace::{DomainError, check};
use thiserror::Error;

/// An isotropic elastic material in SI units.
///
/// ```
/// use contact::Material;
/// let mut alloy = Material::elastic(71e9, 0.33, 2780.0)?;
/// alloy.yield_strength_pa = Some(3.2e8);
/// # Ok::<(), contact::BodyError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Material {
    /// Its name in the library, or "given" when a scene spells out the numbers.
    pub name: String,
    /// Young's modulus E in Pa.
    pub youngs_modulus_pa: f64,
    /// Poisson's ratio nu.
    pub poisson_ratio: f64,
    /// Density in kg/m^3, where it is known.
    pub density_kg_m3: Option<f64>,
    /// Yield strength in Pa, where it is known.
    pub yield_strength_pa: Option<f64>,
    /// Tensile strength in Pa, where it is known.
    pub tensile_strength_pa: Option<f64>,
    /// Fracture toughness in Pa m^(1/2) of a brittle material, where it is known.
    pub fracture_toughness_pa_sqrt_m: Option<f64>,
    /// Group in the library: metal, ceramic, glass, polymer, rock, concrete, soil.
    pub group: String,
    /// Where the numbers come from.
    pub source: String,
}

impl Material {
    /// Of Young's modulus in Pa, Poisson's ratio and a density in kg/m^3; strengths can be set afterwards.
    ///
    /// # Errors
    /// [`BodyError::OutOfRange`].
    pub fn elastic(
        youngs_modulus_pa: f64,
        poisson_ratio: f64,
        density_kg_m3: f64,
    ) -> Result<Self, BodyError> {
        let made = Self {
            density_kg_m3: Some(density_kg_m3),
            ..Self::given(youngs_modulus_pa, poisson_ratio)
        };
        made.check().map(|()| made)
    }

    /// Of Young's modulus in Pa and Poisson's ratio alone, as enough for a contact without waves and [`check`](Self::check)ed
    /// by nobody.
    pub fn given(youngs_modulus_pa: f64, poisson_ratio: f64) -> Self {
        Self {
            name: "given".to_owned(),
            youngs_modulus_pa,
            poisson_ratio,
            density_kg_m3: None,
            yield_strength_pa: None,
            tensile_strength_pa: None,
            fracture_toughness_pa_sqrt_m: None,
            group: String::new(),
            source: String::new(),
        }
    }

    /// Whether the numbers are in their ranges.
    ///
    /// # Errors
    /// [`BodyError::OutOfRange`].
    pub fn check(&self) -> Result<(), BodyError> {
        positive("youngs_modulus_pa", self.youngs_modulus_pa)?;
        if let Some(density) = self.density_kg_m3 {
            positive("density_kg_m3", density)?;
        }
        let nu = self.poisson_ratio;
        check(nu > -1.0 && nu < 0.5, "poisson_ratio", nu, "(-1, 0.5)")?;
        Ok(())
    }

    /// The density in kg/m^3, or the error with the purpose that requires it.
    pub(crate) fn density_for(&self, purpose: &'static str) -> Result<f64, BodyError> {
        self.density_kg_m3.ok_or_else(|| BodyError::NoDensity {
            material: self.name.clone(),
            purpose,
        })
    }

    /// Shear modulus mu = E/(2 (1 + nu)) in Pa.
    pub fn shear_modulus_pa(&self) -> f64 {
        0.5 * self.youngs_modulus_pa / (1.0 + self.poisson_ratio)
    }

    /// Plane modulus E/(1 - nu^2) in Pa.
    pub fn plane_modulus_pa(&self) -> f64 {
        self.youngs_modulus_pa / ((1.0 - self.poisson_ratio) * (1.0 + self.poisson_ratio))
    }

    /// Modulus of longitudinal waves rho c1^2 = mu (2 - 2 nu)/(1 - 2 nu) in Pa.
    pub fn longitudinal_modulus_pa(&self) -> f64 {
        let nu = self.poisson_ratio;
        self.shear_modulus_pa() * (2.0 - 2.0 * nu) / (1.0 - 2.0 * nu)
    }

    /// Longitudinal wave speed in m/s; needs the density.
    pub fn longitudinal_speed_m_s(&self) -> Option<f64> {
        let modulus = self.longitudinal_modulus_pa();
        self.density_kg_m3.map(|density| (modulus / density).sqrt())
    }

    /// Shear wave speed in m/s; needs the density.
    pub fn shear_speed_m_s(&self) -> Option<f64> {
        let modulus = self.shear_modulus_pa();
        self.density_kg_m3.map(|density| (modulus / density).sqrt())
    }
}

/// Young's modulus in Pa and Poisson's ratio from both wave speeds in m/s and the density in kg/m^3.
///
/// ```text
/// nu = (1 - 2 k)/(2 - 2 k),   k = (c2/c1)^2,   E = 2 rho c2^2 (1 + nu)
/// ```
///
/// nu lies in (-1, 1/2) for c2/c1 below sqrt(3)/2.
pub fn from_wave_speeds(longitudinal_m_s: f64, shear_m_s: f64, density_kg_m3: f64) -> (f64, f64) {
    let k = (shear_m_s / longitudinal_m_s).powi(2);
    let nu = (1.0 - 2.0 * k) / (2.0 - 2.0 * k);
    (2.0 * density_kg_m3 * shear_m_s * shear_m_s * (1.0 + nu), nu)
}

/// A body that cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BodyError {
    /// A material without a density where waves or a mass need one.
    #[error("the material {material} has no density, which {purpose} requires")]
    NoDensity {
        /// Name of the material.
        material: String,
        /// Quantity that needs it.
        purpose: &'static str,
    },
    /// A number outside its range.
    #[error(transparent)]
    OutOfRange(#[from] DomainError),
}

/// A positive finite number, or the error that names it.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<f64, DomainError> {
    let holds = value > 0.0 && value < f64::INFINITY;
    check(holds, quantity, value, "(0, inf)").map(|()| value)
}
