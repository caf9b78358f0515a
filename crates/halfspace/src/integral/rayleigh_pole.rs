//! The residue of the Rayleigh pole: the wave bound to the surface.
//!
//! ```text
//! 2/(c D'(c)) Re sum_{P,S} N Psi(gamma z - i c t)
//! ```

use crate::field::Point;
use crate::integral::panels::{SingularityStrength, TERM_ROUNDING};
use crate::integral::rayleigh_front::Front;
use crate::integral::setting::Setting;
use crate::integral::sum::Sum;
use crate::numeric::lanes::{Lanes, Pair, dispatch};
use crate::potentials::closed_form::{of_one, potentials};
use crate::potentials::far_front::ROUNDING_DIGITS;
use crate::potentials::{Order, Potentials, STEP, shallow};
use crate::profile::Profile;
use num_complex::Complex64;
use pulp::{Simd, WithSimd};
use std::f64::consts::PI;

impl Setting {
    /// Adds pi times the Rayleigh wave at a point: the residues of P and S.
    pub(crate) fn rayleigh_wave<const N: i32>(&self, at: Point, sum: &mut Sum) {
        let c = self.medium.rayleigh_speed();
        let shallow = shallow::applies::<N>(self.profile, at);
        let front = Front::near::<N>(&self.medium, self.profile, at);
        let arguments = (self.poles).map(|pole| Complex64::new(pole.decay * at.z, -c * at.t));
        let both = match &front {
            Some(front) => arguments.map(|xi| front.potentials(xi)),
            None if N == STEP => dispatch(Two {
                profile: self.profile,
                xi: arguments,
                r: at.r,
            }),
            None => arguments.map(|xi| of_one::<N>(self.profile, xi, at.r)),
        };
        for ((pole, xi), mut psi) in self.poles.iter().zip(arguments).zip(both) {
            // d/dt of order n + 1 is i c times order n
            match Order::of(N) {
                Order::Impulse => psi = psi.map(|v| v * Complex64::new(0.0, c)),
                Order::Step => {}
                Order::StepIntegral => psi = psi.map(|v| v * Complex64::new(0.0, -1.0 / c)),
            }
            let mut term = pole.amplitudes.fields(&psi.map(|v| v.re), at.r);
            if shallow {
                let surface = Complex64::new(0.0, xi.im);
                let (a, g) = match &front {
                    Some(front) => front.difference(surface, xi.re),
                    None => shallow::difference(surface, xi.re.into(), at.r),
                };
                pole.amplitudes.set_traction(&mut term, a.re, g.re, at.r);
            }
            sum.add(PI, self.error_at_front::<N>(at, xi, shallow), term);
        }
    }

    /// Relative errors of displacements and stresses of the Rayleigh wave, from the rounding of its distance to the
    /// edges of the disc.
    fn error_at_front<const N: i32>(&self, at: Point, xi: Complex64, shallow: bool) -> [f64; 2] {
        let strength = SingularityStrength::of::<N>(self.profile);
        let radius = self.profile.radius();
        let height = xi.im.abs();
        let gap = [at.r + radius, (at.r - radius).abs()]
            .map(|edge| ((height - edge).powi(2) + xi.re * xi.re).sqrt())
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        let size = height + at.r + radius;
        let front = TERM_ROUNDING * size / gap.max(f64::EPSILON * size);
        match strength {
            // the two waves cancel
            SingularityStrength::Bounded if shallow => [TERM_ROUNDING + front; 2],
            // stresses have a square root at the front
            SingularityStrength::Bounded => [
                TERM_ROUNDING * (1.0 + size),
                TERM_ROUNDING * (1.0 + size / gap.max(f64::EPSILON * size).sqrt()),
            ],
            SingularityStrength::InverseRoot => [
                TERM_ROUNDING + TERM_ROUNDING.sqrt() * front.sqrt(),
                TERM_ROUNDING + front,
            ],
            SingularityStrength::FinitePart => [TERM_ROUNDING + front, TERM_ROUNDING + 3.0 * front],
        }
    }
}

/// The potentials at two places.
struct Two {
    profile: Profile,
    xi: [Complex64; 2],
    r: f64,
}

impl WithSimd for Two {
    type Output = [Potentials<Complex64>; 2];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let parts = self.xi.map(|xi| [xi.re, xi.im]);
        let [re, im] = [0, 1].map(|i| Lanes::two(simd, parts.map(|xi| xi[i])));
        let xi = Pair { re, im };
        let psi = potentials::<STEP, Pair<S>>(self.profile, xi, (self.r, ROUNDING_DIGITS), false);
        let [first, second] = [0, 1].map(|i| psi.map(|v| Complex64::new(v.re.get(i), v.im.get(i))));
        [first, second]
    }
}
