//! A point in kernel units, and why its fields could not be computed.

use halfspace::DomainError;
use lookup::LookupError;
use thiserror::Error;

/// A field that could not be computed.
#[derive(Debug, Error)]
pub enum FieldError {
    /// The point is outside the table.
    #[error("probe r = {r_m} m, z = {z_m} m with disc radius {disc_radius_m} m: {source}")]
    Table {
        /// Distance from the axis in m.
        r_m: f64,
        /// Depth in m.
        z_m: f64,
        /// Unit of length in m.
        disc_radius_m: f64,
        /// What the table says.
        source: LookupError,
    },
    /// The point is outside the half-space.
    #[error("probe r = {r_m} m, z = {z_m} m: {source}")]
    Domain {
        /// Distance from the axis in m.
        r_m: f64,
        /// Depth in m.
        z_m: f64,
        /// What the kernel says.
        source: DomainError,
    },
}

/// A point in kernel units, with its unit for messages.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    /// Distance from the axis in disc radii.
    pub r: f64,
    /// Depth in disc radii.
    pub z: f64,
    /// Unit of length in m.
    pub disc_radius_m: f64,
}

impl Place {
    pub(crate) fn outside(self, source: LookupError) -> FieldError {
        FieldError::Table {
            r_m: self.r * self.disc_radius_m,
            z_m: self.z * self.disc_radius_m,
            disc_radius_m: self.disc_radius_m,
            source,
        }
    }

    pub(crate) fn domain(self, source: DomainError) -> FieldError {
        FieldError::Domain {
            r_m: self.r * self.disc_radius_m,
            z_m: self.z * self.disc_radius_m,
            source,
        }
    }
}
