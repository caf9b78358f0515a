//! The integrands of the step responses of the Hertz load and of the punch at several nodes at once.
//!
//! The same formulas as in [`fast`](crate::integral::fast) and [`slow`](crate::integral::slow), in vector registers, but for the layer just below
//! the surface.

mod choice;
mod far;
mod near;

use crate::integral::panels::Node;
use crate::integral::setting::Setting;
use crate::integral::spectrum::{self, Wave, half_angle};
use crate::integral::sum::Sum;
use crate::numeric::lanes::{Lanes, Pair, WIDTH, dispatch};
use crate::numeric::scalar::{Real, Scalar};
use crate::point::{Point, Sense};
use crate::potentials::Potentials;
use crate::potentials::order::{Order, TimeOrder};
use crate::profile::Profile;
use choice::{compact, potentials};
use pulp::{Simd, WithSimd};

/// Whether the integrands at a point may be taken here.
pub(crate) fn applies<O: TimeOrder>(profile: Profile, at: Point, shallow: bool) -> bool {
    O::ORDER == Order::Step
        && match profile {
            Profile::Hertz => !shallow,
            Profile::Punch => at.r > 0.0,
            Profile::Point => false,
        }
}

/// Adds the nodes of one panel; a wave below slowness one has one sense, above it both.
pub(crate) fn add(
    setting: &Setting,
    at: Point,
    wave: Wave,
    sense: Option<Sense>,
    nodes: &[Node],
    sum: &mut Sum,
) {
    dispatch(Panel {
        setting,
        at,
        wave,
        sense,
        nodes,
        sum,
    });
}

struct Panel<'a> {
    setting: &'a Setting,
    at: Point,
    wave: Wave,
    sense: Option<Sense>,
    nodes: &'a [Node],
    sum: &'a mut Sum,
}

impl WithSimd for Panel<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Some(last) = self.nodes.last() else {
            return;
        };
        let zero = Lanes::all(simd, 0.0);
        let (mut value, mut square) = ([zero; 6], [zero; 6]);
        for chunk in self.nodes.chunks(WIDTH) {
            let node = |i: usize| chunk.get(i).unwrap_or(last);
            let place = Lanes::new(simd, std::array::from_fn(|i| node(i).place));
            let weight = Lanes::new(
                simd,
                std::array::from_fn(|i| chunk.get(i).map_or(0.0, |node| node.weight)),
            );
            let (jacobian, term) = match self.sense {
                Some(sense) => fast(self.setting, self.at, (self.wave, sense), place),
                None => slow(self.setting, self.at, self.wave, place),
            };
            let weight = weight * jacobian;
            let displacement =
                Lanes::new(simd, std::array::from_fn(|i| node(i).error.displacement));
            let stress = Lanes::new(simd, std::array::from_fn(|i| node(i).error.stress));
            for f in 0..6 {
                let x = weight * term[f];
                let error = if f < 2 { displacement } else { stress } * x;
                value[f] = value[f] + x;
                square[f] = square[f] + error * error;
            }
        }
        for f in 0..6 {
            self.sum
                .add_lanes(f, value[f].into_array(), square[f].into_array());
        }
    }
}

/// dx/du and the integrand at the half-angle u.
#[inline(always)]
fn fast<S: Simd>(
    setting: &Setting,
    at: Point,
    (wave, sense): (Wave, Sense),
    u: Lanes<S>,
) -> (Lanes<S>, [Lanes<S>; 6]) {
    let (x, p, jacobian) = half_angle(u);
    let eta = setting.eta(at, wave, sense, x, p);
    let psi = compact(setting.profile, eta, at.r);
    let amplitudes = spectrum::fast(wave, setting.k, x, p);
    (jacobian, amplitudes.fields(&psi, at.r))
}

/// dx/ds and the integrand at the stretched half-angle s.
#[inline(always)]
fn slow<S: Simd>(
    setting: &Setting,
    at: Point,
    wave: Wave,
    s: Lanes<S>,
) -> (Lanes<S>, [Lanes<S>; 6]) {
    let (k, profile) = (setting.k, setting.profile);
    let span = (k - 1.0).sqrt();
    let (q, dq) = setting.fixed.stretch.half_angle(s);
    let one = s.constant(1.0);
    let inverse = one / (q * q + 1.0);
    let p_abs = q * inverse * (2.0 * span);
    let y = (one - q) * (one + q) * inverse * span;
    let x = (p_abs * p_abs + 1.0).sqrt();
    let over_x = one / x;
    let (re, im) = spectrum::inverse_rayleigh(k, x, p_abs, y);
    let psi = match wave {
        Wave::P => {
            let xi = Pair {
                re: p_abs * over_x * at.z,
                im: over_x * -at.t,
            };
            let psi = potentials(profile, xi, at.r, at.z == 0.0);
            let factor = im * 2.0;
            Potentials {
                a_upper: factor * psi.a_upper.re,
                a_lower: factor * psi.a_lower.re,
                g_upper: factor * psi.g_upper.re,
                g_lower: factor * psi.g_lower.re,
            }
        }
        Wave::S => {
            let re_xi = s.constant(0.0);
            let minus = Pair {
                re: re_xi,
                im: (y * at.z - at.t) * over_x,
            };
            let plus = Pair {
                re: re_xi,
                im: (y * at.z + at.t) * over_x,
            };
            let minus = potentials(profile, minus, at.r, true);
            let plus = potentials(profile, plus, at.r, true);
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
