//! Quantities that follow from displacements and stresses, with their errors.
//!
//! Strains are those of Hooke's law, principal stresses the eigenvalues of the stress tensor, equivalent stresses those of
//! von Mises and Tresca.
//! Their errors are bounds: the largest change that the errors of the four stresses can cause, whatever their signs.

/// Derivative in time of the fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Derivative {
    /// The six fields.
    Field,
    /// Velocities.
    First,
    /// Accelerations, as means over one step.
    Second,
}

impl Derivative {
    /// Power of the load in the time since a contact began; accelerations are differences of velocities.
    pub(crate) fn power(self) -> f64 {
        match self {
            Self::Field => 1.5,
            Self::First | Self::Second => 0.5,
        }
    }
}

contact::choice! {
    /// A quantity in addition to the six fields that every result has.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Quantity {
        /// Radial velocity of the particles.
        VelocityR = "velocity_r",
        /// Axial velocity of the particles.
        VelocityZ = "velocity_z",
        /// Radial acceleration, as a mean over one step of the output.
        AccelerationR = "acceleration_r",
        /// Axial acceleration, as a mean over one step of the output.
        AccelerationZ = "acceleration_z",
        /// Radial strain.
        StrainRr = "strain_rr",
        /// Hoop strain.
        StrainTt = "strain_tt",
        /// Axial strain.
        StrainZz = "strain_zz",
        /// Shear strain of the tensor, half of the change of angle.
        StrainRz = "strain_rz",
        /// Von Mises' equivalent stress.
        VonMises = "von_mises",
        /// Tresca's equivalent stress.
        Tresca = "tresca",
        /// Largest shear stress.
        MaxShear = "max_shear",
        /// Largest principal stress.
        Principal1 = "principal_1",
        /// Middle principal stress.
        Principal2 = "principal_2",
        /// Smallest principal stress, the largest compression.
        Principal3 = "principal_3",
    }
}

impl Quantity {
    /// Derivative and component of a velocity or an acceleration; none for quantities that follow from the stresses at
    /// the same time.
    pub(crate) fn rate(self) -> Option<(Derivative, usize)> {
        match self {
            Self::VelocityR => Some((Derivative::First, 0)),
            Self::VelocityZ => Some((Derivative::First, 1)),
            Self::AccelerationR => Some((Derivative::Second, 0)),
            Self::AccelerationZ => Some((Derivative::Second, 1)),
            _ => None,
        }
    }

    /// Its value under some stresses, with Young's modulus in Pa and Poisson's ratio; NaN for a velocity or an
    /// acceleration, which do not follow from them.
    ///
    /// ```
    /// use impact::Quantity;
    /// // uniaxial compression
    /// let stresses = [0.0, 0.0, -4e6, 0.0];
    /// assert_eq!(Quantity::VonMises.of(stresses, [2e11, 0.3]), 4e6);
    /// assert_eq!(Quantity::StrainRr.of(stresses, [2e11, 0.3]), 6e-6);
    /// ```
    pub fn of(self, [rr, tt, zz, rz]: [f64; 4], [modulus, ratio]: [f64; 2]) -> f64 {
        let strain = |own: f64, others: f64| (own - ratio * others) / modulus;
        match self {
            Self::VelocityR | Self::VelocityZ | Self::AccelerationR | Self::AccelerationZ => {
                f64::NAN
            }
            Self::StrainRr => strain(rr, tt + zz),
            Self::StrainTt => strain(tt, rr + zz),
            Self::StrainZz => strain(zz, rr + tt),
            Self::StrainRz => (1.0 + ratio) * rz / modulus,
            Self::VonMises => von_mises([rr - tt, tt - zz, zz - rr, rz]),
            Self::Tresca => {
                let [first, _, third] = principal([rr, tt, zz, rz]);
                first - third
            }
            Self::MaxShear => 0.5 * Self::Tresca.of([rr, tt, zz, rz], [modulus, ratio]),
            Self::Principal1 => principal([rr, tt, zz, rz])[0],
            Self::Principal2 => principal([rr, tt, zz, rz])[1],
            Self::Principal3 => principal([rr, tt, zz, rz])[2],
        }
    }

    /// The most that errors of the stresses move it by, with the same constants.
    ///
    /// ```text
    /// strain      (e_rr + |nu| (e_tt + e_zz))/E,  ...
    /// von Mises   a norm of the deviator: its value for the errors with the worst signs
    /// principal   Weyl: the spectral norm of the errors, max(e_tt, (e_rr + e_zz)/2 + sqrt((e_rr - e_zz)^2/4 + e_rz^2))
    /// Tresca      twice that
    /// ```
    pub fn error(self, [rr, tt, zz, rz]: [f64; 4], [modulus, ratio]: [f64; 2]) -> f64 {
        let worst = -ratio.abs();
        match self {
            Self::StrainRr | Self::StrainTt | Self::StrainZz | Self::StrainRz => {
                let shear = if self == Self::StrainRz { ratio } else { worst };
                self.of([rr, tt, zz, rz], [modulus, shear])
            }
            Self::VonMises => von_mises([rr + tt, tt + zz, zz + rr, rz]),
            Self::MaxShear | Self::Principal1 | Self::Principal2 | Self::Principal3 => {
                principal([rr, tt, zz, rz])[0]
            }
            Self::Tresca => 2.0 * principal([rr, tt, zz, rz])[0],
            Self::VelocityR | Self::VelocityZ | Self::AccelerationR | Self::AccelerationZ => {
                f64::NAN
            }
        }
    }
}

/// sqrt((a^2 + b^2 + c^2)/2 + 3 srz^2) of the differences of the normal stresses.
fn von_mises([a, b, c, rz]: [f64; 4]) -> f64 {
    (0.5 * (a * a + b * b + c * c) + 3.0 * rz * rz).sqrt()
}

/// Principal stresses, descending.
fn principal([rr, tt, zz, rz]: [f64; 4]) -> [f64; 3] {
    let (middle, radius) = (0.5 * (rr + zz), (0.5 * (rr - zz)).hypot(rz));
    let mut all = [middle + radius, middle - radius, tt];
    all.sort_by(|a, b| b.total_cmp(a));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use contact::Choice;

    const STEEL: [f64; 2] = [209e9, 0.3];

    #[test]
    fn equivalent_and_principal_stresses_are_those_of_textbooks() {
        let of = |quantity: Quantity, stresses| quantity.of(stresses, STEEL);
        // pure shear
        let shear = [0.0, 0.0, 0.0, 2.0];
        assert!((of(Quantity::VonMises, shear) - 2.0 * 3_f64.sqrt()).abs() < 1e-15);
        assert_eq!(of(Quantity::MaxShear, shear), 2.0);
        assert_eq!(of(Quantity::Principal3, shear), -2.0);
        // pressure from all sides
        let pressure = [-3.0, -3.0, -3.0, 0.0];
        assert_eq!(of(Quantity::VonMises, pressure), 0.0);
        assert_eq!(of(Quantity::Tresca, pressure), 0.0);
        // the hoop stress may be the largest: 4, 1, -2 of an in-plane circle of radius 3 around 1 beside it
        let three = [1.0, 7.0, 1.0, 3.0];
        let all = [
            Quantity::Principal1,
            Quantity::Principal2,
            Quantity::Principal3,
        ];
        assert_eq!(all.map(|q| of(q, three)), [7.0, 4.0, -2.0]);
        assert_eq!(of(Quantity::Tresca, three), 9.0);
    }

    /// Invariants of the tensor, and Hooke's law backwards: sigma = 2 mu eps + lambda tr(eps).
    #[test]
    fn identities_hold_for_any_stress() {
        for seed in 0..200_u32 {
            let x = |k: u32| (f64::from(seed * 7 + k) * 12.9898).sin() * 1e8;
            let [rr, tt, zz, rz] = [x(1), x(2), x(3), x(4)];
            let of = |quantity: Quantity| quantity.of([rr, tt, zz, rz], STEEL);
            let [a, b, c] = [
                Quantity::Principal1,
                Quantity::Principal2,
                Quantity::Principal3,
            ]
            .map(of);
            assert!(a >= b && b >= c);
            let close = |found: f64, wanted: f64, size: f64| {
                assert!((found - wanted).abs() <= 1e-13 * size, "{found} {wanted}");
            };
            close(a + b + c, rr + tt + zz, 1e9);
            close(a * b * c, tt * (rr * zz - rz * rz), 1e25);
            let square = |x: f64| x * x;
            let mises = (0.5 * (square(a - b) + square(b - c) + square(c - a))).sqrt();
            close(of(Quantity::VonMises), mises, 1e9);
            let (mu, nu) = (STEEL[0] / (2.0 * (1.0 + STEEL[1])), STEEL[1]);
            let strains = [Quantity::StrainRr, Quantity::StrainTt, Quantity::StrainZz].map(of);
            let trace: f64 = strains.iter().sum();
            for (strain, stress) in strains.into_iter().zip([rr, tt, zz]) {
                close(
                    2.0 * mu * (strain + nu / (1.0 - 2.0 * nu) * trace),
                    stress,
                    1e9,
                );
            }
            close(2.0 * mu * of(Quantity::StrainRz), rz, 1e9);
        }
    }

    /// No signs of the errors move a quantity by more than its bound, and some come near it.
    #[test]
    fn errors_are_bounds() {
        let errors = [3e5, 1e5, 4e5, 2e5];
        for &quantity in Quantity::ALL {
            if quantity.rate().is_some() {
                continue;
            }
            let bound = quantity.error(errors, STEEL);
            let mut most = 0.0_f64;
            for seed in 0..2000_u32 {
                let x = |k: u32| (f64::from(seed * 5 + k) * 78.233).sin();
                let stresses = [x(1), x(2), x(3), x(4)].map(|s| 1e7 * s);
                for signs in 0..16_u32 {
                    let moved = std::array::from_fn(|i| {
                        let sign = if signs >> i & 1 == 0 { 1.0 } else { -1.0 };
                        stresses[i] + sign * errors[i]
                    });
                    let change = quantity.of(moved, STEEL) - quantity.of(stresses, STEEL);
                    most = most.max(change.abs());
                }
            }
            assert!(
                most <= bound * (1.0 + 1e-12),
                "{} {most} {bound}",
                quantity.name()
            );
            assert!(most > 0.6 * bound, "{} {most} {bound}", quantity.name());
        }
    }
}
