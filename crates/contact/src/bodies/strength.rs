//! Loading of a contact over the strengths of its bodies: yield and cone cracks.

use crate::bodies::material::Material;
use std::f64::consts::PI;

/// Strengths of one body; by default none of them is known.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Strength {
    poisson_ratio: f64,
    pub(crate) yield_strength_pa: Option<f64>,
    pub(crate) tensile_strength_pa: Option<f64>,
    pub(crate) fracture_toughness_pa_sqrt_m: Option<f64>,
    /// Mean pressure of the contact in Pa at which the body begins to yield; none without a yield strength.
    pub yield_pressure_pa: Option<f64>,
}

impl Strength {
    pub(crate) fn new(material: &Material) -> Self {
        Self {
            poisson_ratio: material.poisson_ratio,
            yield_strength_pa: material.yield_strength_pa,
            tensile_strength_pa: material.tensile_strength_pa,
            fracture_toughness_pa_sqrt_m: material.fracture_toughness_pa_sqrt_m,
            yield_pressure_pa: (material.yield_strength_pa)
                .map(|strength| 2.0 / 3.0 * strength / largest_mises(material.poisson_ratio)),
        }
    }

    /// Yield strength in Pa and Poisson's ratio, where the strength is known.
    pub(crate) fn yields(&self) -> Option<(f64, f64)> {
        Some((self.yield_strength_pa?, self.poisson_ratio))
    }

    /// Force in N at which a sphere of a radius in m is expected to make a cone crack, with E* in Pa; none without a fracture
    /// toughness.
    ///
    /// ```text
    /// P = A R K^2/E*,   A = 8600
    /// ```
    ///
    /// Auerbach's law, with the constant for soda-lime glass as it is quoted after Lawn (1998), J. Am. Ceram. Soc. 81,
    /// 1977; neither the paper nor another source of the number could be opened, so that no more than the order and the
    /// first digit is to be trusted.
    /// Onsets scatter by a factor of two and more with the flaws of a surface; a polished one bears more, and in a rock
    /// with grains larger than the contact the law is a hint.
    pub(crate) fn cone_crack_force_n(&self, [radius_m, modulus_pa]: [f64; 2]) -> Option<f64> {
        const AUERBACH: f64 = 8600.0;
        let toughness = self.fracture_toughness_pa_sqrt_m?;
        let force_n = AUERBACH * radius_m * toughness * toughness / modulus_pa;
        // a toughness whose square is no number bears nothing that could be compared
        Some(force_n).filter(|&force_n| force_n > 0.0)
    }
}

/// Largest von Mises stress in a half-space under Hertz's pressure, over the largest pressure.
///
/// ```text
/// on the axis, s = z/a   |(1 + nu) (1 - s atan(1/s)) - (3/2)/(1 + s^2)|
/// at the edge of contact (1 - 2 nu)/sqrt(3)
/// ```
///
/// 0.620 at nu = 0.3, reached in a depth of 0.48 contact radii.
/// For -1 < nu < 1/2; good to 1e-10.
/// Johnson, Contact Mechanics, (3.45).
pub fn largest_mises(poisson_ratio: f64) -> f64 {
    let nu = poisson_ratio;
    // near the one maximum, from where what is missing is of second order in the slope
    let near = [0.382, 0.3303, -0.0096, 0.0217, -0.0007, 0.0196];
    let s = near.iter().rev().fold(0.0, |sum, c| sum * nu + c);
    let r = 1.0 / (1.0 + s * s);
    let turn = PI / 2.0 - s.atan();
    let slope = (1.0 + nu) * (turn - s * r) - 3.0 * s * r * r;
    let bend = r * r * (2.0 * (1.0 + nu) + 3.0 * r * (1.0 - 3.0 * s * s));
    let largest = 1.5 * r - (1.0 + nu) * (1.0 - s * turn) + 0.5 * slope * slope / bend;
    largest.max((1.0 - 2.0 * nu) / 3.0_f64.sqrt())
}

/// Loading of a contact over the strengths of its bodies; none if the strength is not known.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Loading {
    /// Largest force over the area of the loaded disc, in Pa.
    pub mean_pressure_pa: f64,
    /// That over the pressure at which the first body begins to yield.
    pub yield_onset: Option<f64>,
    /// The mean pressure over the lower of both yield strengths.
    pub pressure_over_yield: Option<f64>,
    /// The mean pressure over the lower of both tensile strengths, the paper's Kmax.
    pub pressure_over_tensile: Option<f64>,
    /// Largest force over that at which a cone crack is expected in the first body.
    pub cone_crack_onset: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn yield_begins_where_textbooks_say() {
        // Johnson, Contact Mechanics, section 6.1: p0 = 1.60 Y, mean pressure 1.07 Y by von Mises at nu = 0.3 (Tresca's
        // 0.62 p0 in 0.48 a is the same difference of principal stresses on the axis)
        assert!((largest_mises(0.3) - 0.62).abs() < 5e-3);
        assert!((2.0 / 3.0 / largest_mises(0.3) - 1.07).abs() < 0.01);
        // a fine search agrees
        for nu in [-0.9, -0.3, 0.0, 0.17, 0.22, 0.34, 0.4995_f64] {
            let at = |s: f64| {
                let sigma_z = -1.0 / (1.0 + s * s);
                let sigma_r = -(1.0 + nu) * (1.0 - s * (1.0 / s).atan()) + 0.5 / (1.0 + s * s);
                (sigma_r - sigma_z).abs()
            };
            let axis = (1..200_000)
                .map(|i| at(1e-5 * f64::from(i)))
                .fold(0.0, f64::max);
            let most = axis.max((1.0 - 2.0 * nu) / 3.0_f64.sqrt());
            assert!((largest_mises(nu) / most - 1.0).abs() < 2e-5, "{nu}");
        }
    }

    #[test]
    fn glass_cracks_where_experiments_have_it() {
        // steel balls on soda-lime glass: about 1e5 N for each metre of radius, with the scatter of the law; no published
        // number that could be opened is nearer, so physics sees a factor of two here and no more
        let glass = Material::named("soda-lime-glass").unwrap_or_else(|error| panic!("{error}"));
        let force = Strength::new(&glass)
            .cone_crack_force_n([1.0, 56e9])
            .unwrap_or(0.0);
        assert!((5e4..2e5).contains(&force), "{force}");
        // a slip of the pen is seen all the same: data-schema/results.md tells users 8600 R K^2/E*
        assert!((force / (8600.0 * 0.75e6 * 0.75e6 / 56e9) - 1.0).abs() < 1e-12);
    }
}
