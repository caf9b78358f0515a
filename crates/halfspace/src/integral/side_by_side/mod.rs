//! The integrands of the step responses of the Hertz load and of the punch at several nodes at once.
//!
//! The same formulas as in [`fast`](crate::integral::fast) and [`slow`](crate::integral::slow), in vector registers, but for the layer just below
//! the surface.

mod choice;
mod far;
mod near;

use crate::integral::panels::Nodes;
use crate::integral::setting::Setting;
use crate::integral::spectrum::{self, Wave, half_angle};
use crate::integral::sum::Sum;
use crate::numeric::lanes::{Lanes, Pair, WIDTH};
use crate::numeric::scalar::{Real, Scalar};
use crate::point::{Point, Sense};
use crate::potentials::Potentials;
use crate::potentials::far_front::ALL;
use crate::potentials::order::STEP;
use crate::profile::Profile;
use choice::compact;
use num_complex::Complex64;
use pulp::{Simd, WithSimd};

/// Whether the integrands at a point may be taken here.
pub(crate) fn applies<const N: i32>(profile: Profile, at: Point, shallow: bool) -> bool {
    N == STEP
        && match profile {
            Profile::Hertz => !shallow,
            Profile::Punch => at.r > 0.0,
            Profile::Point => false,
        }
}

/// The potentials at two places.
pub(crate) struct Two {
    pub(crate) profile: Profile,
    pub(crate) xi: [Complex64; 2],
    pub(crate) r: f64,
}

impl WithSimd for Two {
    type Output = [Potentials<Complex64>; 2];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let parts = self.xi.map(|xi| [xi.re, xi.im]);
        let [re, im] = [0, 1].map(|i| Lanes::two(simd, parts.map(|xi| xi[i])));
        let psi = choice::potentials(self.profile, Pair { re, im }, (self.r, ALL), false);
        let [first, second] = [0, 1].map(|i| psi.map(|v| Complex64::new(v.re.get(i), v.im.get(i))));
        [first, second]
    }
}

/// The nodes of one panel, to be added to a sum; a wave below slowness one has one sense, above it both.
pub(crate) struct Panel<'a> {
    pub(crate) setting: &'a Setting,
    pub(crate) at: Point,
    pub(crate) wave: Wave,
    pub(crate) sense: Option<Sense>,
    pub(crate) nodes: &'a Nodes,
    pub(crate) sum: &'a mut Sum,
}

impl<'a> WithSimd for Panel<'a> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (nodes, sum) = (self.nodes, self.sum);
        let digits = self.setting.deep_digits;
        let [rule, weights] = nodes
            .rule
            .in_registers(S::F64_LANES)
            .map(|list| Lanes::registers(simd, list));
        for (i, (node, weight)) in rule.zip(weights).enumerate() {
            let (place, weight, error) = nodes.at(node, weight);
            let (jacobian, term) = match self.sense {
                Some(sense) => fast(self.setting, (self.at, digits), (self.wave, sense), place),
                None => slow(self.setting, (self.at, digits), self.wave, place),
            };
            let weight = weight * jacobian;
            // of the block
            let i = i % (WIDTH / S::F64_LANES);
            for f in 0..6 {
                let x = weight * term[f];
                let error = error[usize::from(f >= 2)] * x;
                let value = &mut S::as_mut_simd_f64s(&mut sum.values[f]).0[i];
                *value = (Lanes::of(simd, *value) + x).register;
                let square = &mut S::as_mut_simd_f64s(&mut sum.squares[f]).0[i];
                *square = (Lanes::of(simd, *square) + error * error).register;
            }
        }
    }
}

/// dx/du and the integrand at the half-angle u.
#[inline(always)]
fn fast<S: Simd>(
    setting: &Setting,
    (at, digits): (Point, f64),
    (wave, sense): (Wave, Sense),
    u: Lanes<S>,
) -> (Lanes<S>, [Lanes<S>; 6]) {
    let (x, p, jacobian) = half_angle(u);
    let eta = setting.eta(at, wave, sense, x, p);
    let psi = compact(setting.profile, eta, (at.r, digits));
    let amplitudes = spectrum::fast(wave, setting.k, x, p);
    (jacobian, amplitudes.fields(&psi, at.r))
}

/// dx/ds and the integrand at the stretched half-angle s.
#[inline(always)]
fn slow<S: Simd>(
    setting: &Setting,
    (at, digits): (Point, f64),
    wave: Wave,
    s: Lanes<S>,
) -> (Lanes<S>, [Lanes<S>; 6]) {
    let (k, profile) = (setting.k, setting.profile);
    let (q, dq) = setting.fixed.stretch.half_angle(s);
    let one = s.constant(1.0);
    let inverse = one / (q * q + 1.0);
    let p_abs = q * inverse * (2.0 * setting.span);
    let y = (one - q) * (one + q) * inverse * setting.span;
    let x = (p_abs * p_abs + 1.0).sqrt();
    let over_x = one / x;
    let (re, im) = spectrum::inverse_rayleigh(k, x, p_abs, y);
    let psi = match wave {
        Wave::P => {
            let xi = Pair::new(p_abs * over_x * at.z, over_x * -at.t);
            let psi = choice::potentials(profile, xi, (at.r, digits), at.z == 0.0);
            let factor = im * 2.0;
            psi.map(|v| factor * v.re)
        }
        Wave::S => {
            let zero = s.constant(0.0);
            let minus = Pair::new(zero, (y * at.z - at.t) * over_x);
            let plus = Pair::new(zero, (y * at.z + at.t) * over_x);
            let minus = choice::potentials(profile, minus, (at.r, digits), true);
            let plus = choice::potentials(profile, plus, (at.r, digits), true);
            // the upper ones of A and the lower ones of B over i R, the others over R
            let inverse = Pair { re, im };
            Potentials {
                a_upper: ((minus.a_upper + plus.a_upper) * inverse).im,
                a_lower: ((minus.a_lower + plus.a_lower) * inverse).re,
                g_upper: ((minus.g_upper + plus.g_upper) * inverse).re,
                g_lower: ((minus.g_lower + plus.g_lower) * inverse).im,
            }
        }
    };
    let amplitudes = spectrum::slow(wave, k, x, p_abs, y);
    // dx = p^ dp^/x, dp^ = 2 y/(1 + q^2) dq
    let jacobian = p_abs * y * inverse * over_x * dq * 2.0;
    (jacobian, amplitudes.fields(&psi, at.r))
}
