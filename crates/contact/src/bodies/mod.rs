//! The two bodies of an impact, and how fast one falls.
//!
//! `material` and `library` describe their materials, `shape` determines mass and tip, `strength` has the strengths,
//! and `wave_speeds` the arrival times of waves and echoes.

pub(crate) mod library;
pub(crate) mod material;
pub(crate) mod shape;
pub(crate) mod strength;
pub(crate) mod wave_speeds;

use crate::bodies::material::{BodyError, Material, positive};
use crate::bodies::shape::Shape;
use halfspace::{Attenuation, Plate, check};

/// How far the waves of a block are followed between its upper and lower face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Echoes {
    /// Waves that have run the thickness up to so many times.
    Legs(usize),
    /// All waves that arrive until a time in s after the load begins.
    Until(f64),
}

/// An elastic half-space: a material with a density, and the block's thickness where it is known.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfSpace {
    material: Material,
    density_kg_m3: f64,
    /// Thickness of the block in m, where it ends below.
    pub thickness_m: Option<f64>,
    /// Distance in m from the axis to the nearest side of the block, where it ends there.
    pub radius_m: Option<f64>,
    /// Waves between the faces of a plate of the thickness, if they are asked for.
    pub echoes: Option<Echoes>,
    /// Attenuation of the waves in the block, with its reference frequency in Hz; contacts are those of an elastic block.
    pub attenuation: Option<Attenuation>,
}

/// A plate whose echoes are asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Echoing {
    /// Thickness in m.
    pub thickness_m: f64,
    /// How often its waves run the thickness at most.
    pub legs: usize,
    /// When the last of them can be computed, in s after the load begins.
    pub latest_s: f64,
}

impl HalfSpace {
    /// Of a material.
    ///
    /// # Errors
    /// [`BodyError`] without a density, or for elastic constants outside their ranges.
    pub fn new(material: Material) -> Result<Self, BodyError> {
        material.check()?;
        Ok(Self {
            density_kg_m3: material.density_for("the half-space")?,
            material,
            thickness_m: None,
            radius_m: None,
            echoes: None,
            attenuation: None,
        })
    }

    /// The plate whose echoes are asked for; none for a block that counts as a half-space.
    pub fn echoing(&self) -> Option<Echoing> {
        let (thickness_m, echoes) = (self.thickness_m?, self.echoes?);
        let transit_s = thickness_m / self.longitudinal_speed_m_s();
        let legs = match echoes {
            Echoes::Legs(legs) => legs,
            Echoes::Until(time_s) => (time_s / transit_s) as usize,
        };
        Some(Echoing {
            thickness_m,
            legs: legs.min(Plate::MOST_LEGS),
            latest_s: Plate::MOST_LEGS as f64 * transit_s,
        })
    }

    /// Material.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Changes numbers of the material.
    ///
    /// # Errors
    /// [`BodyError`] when the changed material makes no half-space; it is not to be used then.
    pub fn change(&mut self, change: impl FnOnce(&mut Material)) -> Result<(), BodyError> {
        change(&mut self.material);
        self.material.check()?;
        self.density_kg_m3 = self.material.density_for("the half-space")?;
        Ok(())
    }

    /// Density in kg/m^3.
    pub fn density_kg_m3(&self) -> f64 {
        self.density_kg_m3
    }

    /// Longitudinal wave speed c1 in m/s.
    pub fn longitudinal_speed_m_s(&self) -> f64 {
        (self.material.longitudinal_modulus_pa() / self.density_kg_m3).sqrt()
    }
}

/// The body that strikes: a rigid mass with a spherical elastic tip.
#[derive(Debug, Clone, PartialEq)]
pub struct Striker {
    /// Material.
    pub material: Material,
    /// Mass in kg.
    pub mass_kg: f64,
    /// Radius of its tip in m.
    pub tip_radius_m: f64,
    /// Length in m of a rod, for the check of its free oscillations.
    pub length_m: Option<f64>,
    /// Shape from which mass, tip and length follow, if there is one: see [`Striker::change_shape`].
    pub shape: Option<Shape>,
}

impl Striker {
    /// A mass with a tip of a radius.
    ///
    /// # Errors
    /// [`BodyError::OutOfRange`] for a mass or a radius that is not positive.
    pub fn new(material: Material, mass_kg: f64, tip_radius_m: f64) -> Result<Self, BodyError> {
        material.check()?;
        Ok(Self {
            mass_kg: positive("mass_kg", mass_kg)?,
            tip_radius_m: positive("tip_radius_m", tip_radius_m)?,
            material,
            length_m: None,
            shape: None,
        })
    }

    /// A body of a shape: its mass follows from the density of its material.
    ///
    /// # Errors
    /// [`BodyError`] without a density, or for lengths that make no such body.
    pub fn of_shape(material: Material, shape: Shape) -> Result<Self, BodyError> {
        let density = material.density_for("the mass of the striker")?;
        let (Shape::Ball { diameter_m } | Shape::Rod { diameter_m, .. }) = shape;
        positive("diameter_m", diameter_m)?;
        if let Shape::Rod { length_m, .. } = shape {
            let tip_radius_m = positive("tip_radius_m", shape.tip_radius_m())?;
            let wide = tip_radius_m >= 0.5 * diameter_m;
            check(wide, "tip_radius_m", tip_radius_m, "[diameter_m/2, inf)")?;
            let long = length_m >= shape.cap_m() && length_m < f64::INFINITY;
            check(long, "length_m", length_m, "[height of the tip's cap, inf)")?;
        }
        let mass_kg = density * shape.volume_m3();
        let (quantity, size_m) = match shape {
            Shape::Rod { length_m, .. } if mass_kg > 1.0 => ("length_m", length_m),
            Shape::Ball { .. } | Shape::Rod { .. } => ("diameter_m", diameter_m),
        };
        let has_mass = mass_kg > 0.0 && mass_kg < f64::INFINITY;
        let range = "the range of sizes with a mass in [1e-30, 1e30] kg";
        check(has_mass, quantity, size_m, range)?;
        let mut striker = Self::new(material, mass_kg, shape.tip_radius_m())?;
        striker.length_m = shape.length_m();
        striker.shape = Some(shape);
        Ok(striker)
    }

    /// Changes the shape from which mass and tip follow; without a shape only the material.
    ///
    /// # Errors
    /// [`BodyError`] when the change makes no body; it is not to be used then.
    pub fn change_shape(
        &mut self,
        change: impl FnOnce(&mut Material, Option<&mut Shape>),
    ) -> Result<(), BodyError> {
        let mut shape = self.shape;
        change(&mut self.material, shape.as_mut());
        if let Some(shape) = shape {
            *self = Self::of_shape(self.material.clone(), shape)?;
        }
        Ok(())
    }

    /// A ball of a radius: its mass follows from the density of its material.
    ///
    /// ```
    /// use contact::{Material, Striker};
    /// let ball = Striker::ball(Material::named("bearing-steel")?, 0.005)?;
    /// assert!((ball.mass_kg - 7800.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.005_f64.powi(3)).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`BodyError`] without a density or for a radius that is not positive.
    pub fn ball(material: Material, radius_m: f64) -> Result<Self, BodyError> {
        let diameter_m = 2.0 * positive("radius_m", radius_m)?;
        Self::of_shape(material, Shape::Ball { diameter_m })
    }
}

/// Standard gravity in m/s^2.
pub const GRAVITY_M_S2: f64 = 9.80665;

/// Velocity in m/s after a free fall from rest.
///
/// ```text
/// v = sqrt(2 g h),   g = 9.80665 m/s^2
/// ```
///
/// The drag of air is left out: with a drag coefficient of 0.5 it takes 0.1 % of the velocity of a steel ball of 3 mm after 0.1 m, and 1 % after 1 m.
///
/// ```
/// assert!((contact::fall_velocity_m_s(0.2) - 1.980571).abs() < 1e-6);
/// ```
pub fn fall_velocity_m_s(height_m: f64) -> f64 {
    (2.0 * GRAVITY_M_S2 * height_m).sqrt()
}
