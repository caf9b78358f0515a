//! The two systems of reduced units and the way back to SI.
//!
//! Inside the crate nothing carries an SI unit: a contact is marched in [`CollisionUnits`],
//! fields are convolved in [`KernelUnits`].
//!
//! Theory: `docs/theory.md` (T37).

/// Units of a collision: the largest approach and force of Hertz's closed form.
///
/// ```text
/// length  alpha = (5 m V0^2/(4 K))^(2/5)      largest approach (45)
/// time    alpha/V0
/// force   K alpha^(3/2)                       largest force (46)
/// ```
///
/// In these units the striker obeys v' = -(5/4) p, v(0) = 1, and Hertz's law is u = p^(2/3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CollisionUnits {
    /// Unit of length in m.
    pub length_m: f64,
    /// Unit of time in s.
    pub time_s: f64,
    /// Unit of force in N.
    pub force_n: f64,
}

/// Force over mass in [`CollisionUnits`]: v' = -INVERSE_MASS p.
pub(crate) const INVERSE_MASS: f64 = 1.25;

impl CollisionUnits {
    /// Units of a striker of mass `mass_kg` that meets a Hertz spring P = K h^(3/2) at `velocity_m_s`.
    ///
    /// All three arguments must be positive.
    pub fn new(stiffness_n_m32: f64, mass_kg: f64, velocity_m_s: f64) -> Self {
        let energy = mass_kg * velocity_m_s * velocity_m_s;
        let length_m = (1.25 * energy / stiffness_n_m32).powf(0.4);
        Self {
            length_m,
            time_s: length_m / velocity_m_s,
            force_n: stiffness_n_m32 * length_m * length_m.sqrt(),
        }
    }

    /// Unit of velocity in m/s: the velocity of approach.
    pub fn velocity_m_s(&self) -> f64 {
        self.length_m / self.time_s
    }
}

/// Units of the half-space kernels: disc radius, longitudinal wave speed, shear modulus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KernelUnits {
    /// Radius r0 of the loaded disc in m.
    pub disc_radius_m: f64,
    /// Longitudinal wave speed c1 in m/s.
    pub longitudinal_speed_m_s: f64,
    /// Shear modulus mu in Pa.
    pub shear_modulus_pa: f64,
}

impl KernelUnits {
    /// Unit of time r0/c1 in s.
    pub fn time_s(&self) -> f64 {
        self.disc_radius_m / self.longitudinal_speed_m_s
    }

    /// Displacement in m for a force of 1 N: 1/(mu r0).
    pub fn displacement_m_per_n(&self) -> f64 {
        1.0 / (self.shear_modulus_pa * self.disc_radius_m)
    }

    /// Stress in Pa for a force of 1 N: 1/r0^2.
    pub fn stress_pa_per_n(&self) -> f64 {
        1.0 / (self.disc_radius_m * self.disc_radius_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_the_paper() {
        // (45) and (46) for the copper rod with E = 129 GPa
        let e_star = 1.0 / ((1.0 - 0.34_f64.powi(2)) / 129e9 + (1.0 - 0.09) / 209e9);
        let k = 4.0 / 3.0 * e_star * 0.004_f64.sqrt();
        let units = CollisionUnits::new(k, 0.0122, 100.0);
        assert!((units.force_n - 182_183.5).abs() < 0.1, "{units:?}");
        assert!((units.velocity_m_s() - 100.0).abs() < 1e-10);
    }

    #[test]
    fn the_unit_of_energy_is_the_kinetic_one_times_five_halves() {
        let units = CollisionUnits::new(3.0e9, 0.25, 7.0);
        let kinetic = 0.5 * 0.25 * 49.0;
        assert!((units.force_n * units.length_m / kinetic - 2.5).abs() < 1e-12);
    }
}
