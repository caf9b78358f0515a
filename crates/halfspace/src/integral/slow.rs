//! Slownesses between one and 1/kappa: longitudinal waves bound to the surface, and travelling shear waves.
//!
//! Theory: `docs/theory.md` (T16).

use crate::field::{Point, Six};
use crate::integral::fronts;
use crate::integral::setting::Setting;
use crate::integral::singularities::Singularities;
use crate::integral::spectrum::{self, Wave};
use crate::integral::sum::Sum;
use crate::numeric::scalar::{Complex, Real};
use crate::potentials::closed_form::potentials;
use crate::potentials::{Order, Potentials, shallow};
use crate::profile::Profile;
use num_complex::Complex64;

impl Setting {
    /// Adds both senses of one wave over 1 < x < 1/kappa.
    pub(crate) fn slow<const N: i32>(
        &self,
        at: Point,
        wave: Wave,
        singularities: &mut Singularities,
        sum: &mut Sum,
    ) {
        let shallow = shallow::applies::<N>(self.profile, at);
        fronts::singular::<N>(self, at, wave, None, singularities);
        for interval in singularities.intervals() {
            singularities.visit(interval, self.digits(at, shallow), &mut |nodes| {
                self.add_nodes::<N>(at, wave, None, nodes, shallow, sum);
            });
        }
    }

    /// x, p^, y and dx/ds at the stretched half-angle s.
    #[inline(always)]
    fn slow_place<T: Real>(&self, s: T) -> [T; 4] {
        let (q, dq) = self.fixed.stretch.half_angle(s);
        let one = s.constant(1.0);
        let inverse = one / (q * q + 1.0);
        let p_abs = q * inverse * (2.0 * self.span);
        let y = (one - q) * (one + q) * inverse * self.span;
        let x = (p_abs * p_abs + 1.0).sqrt();
        // dx = p^ dp^/x, dp^ = 2 y/(1 + q^2) dq
        [x, p_abs, y, p_abs * y * inverse * (one / x) * dq * 2.0]
    }

    /// dx/ds and the integrand at the stretched half-angle s.
    #[inline(always)]
    pub(crate) fn slow_term<const N: i32, T: Real>(
        &self,
        (at, digits): (Point, f64),
        wave: Wave,
        s: T,
    ) -> (T, [T; 6]) {
        let [x, p_abs, y, jacobian] = self.slow_place(s);
        let over_x = s.constant(1.0) / x;
        let (re, im) = spectrum::inverse_rayleigh(self.k, x, p_abs, y);
        let load = (self.profile, (at.r, digits));
        let psi = match wave {
            Wave::P => {
                let xi = T::Complex::new(p_abs * over_x * at.z, over_x * -at.t);
                longitudinal::<N, T>(load, xi, im * 2.0, (x, over_x), at.z == 0.0)
            }
            Wave::S => {
                let heights = [(y * at.z - at.t) * over_x, (y * at.z + at.t) * over_x];
                shear::<N, T>(load, heights, T::Complex::new(re, im), (x, over_x))
            }
        };
        let amplitudes = spectrum::slow(wave, self.k, x, p_abs, y);
        (jacobian, amplitudes.fields(&psi, at.r))
    }

    /// Replaces the tractions by their differences from the surface.
    pub(crate) fn set_slow_traction(&self, at: Point, wave: Wave, s: f64, term: &mut Six) {
        let [x, p_abs, y, _] = self.slow_place(s);
        let (re, im) = spectrum::inverse_rayleigh(self.k, x, p_abs, y);
        let over_r = Complex64::new(re, im);
        let surface = |t: f64| Complex64::new(0.0, t / x);
        let (a, g) = match wave {
            Wave::P => {
                let step = Complex64::from(at.z * p_abs / x);
                let (a, g) = shallow::difference(surface(-at.t), step, at.r);
                (2.0 * im * a.re, 2.0 * im * g.re)
            }
            Wave::S => {
                let step = Complex64::new(0.0, at.z * y / x);
                let [minus, plus] =
                    [-at.t, at.t].map(|t| shallow::difference(surface(t), step, at.r));
                (
                    ((minus.0 + plus.0) * over_r).re,
                    ((minus.1 + plus.1) * over_r).im,
                )
            }
        };
        spectrum::slow(wave, self.k, x, p_abs, y).set_traction(term, a, g, at.r);
    }
}

/// Re of -i/R times the sum of both senses, or times i x their difference for the time integral.
///
/// xi+ is the conjugate of xi-, so the potentials combine to real numbers.
#[inline(always)]
fn longitudinal<const N: i32, T: Real>(
    (profile, place): (Profile, (f64, f64)),
    xi: T::Complex,
    factor: T,
    (x, over_x): (T, T),
    on_axis: bool,
) -> Potentials<T> {
    let psi = potentials::<N, T::Complex>(profile, xi, place, on_axis);
    match Order::of(N) {
        Order::Impulse => psi.map(|v| -factor * over_x * v.im()),
        Order::Step => psi.map(|v| factor * v.re()),
        Order::StepIntegral => psi.map(|v| factor * x * v.im()),
    }
}

/// As [`longitudinal`] for the shear wave, whose arguments are imaginary; u and the normal stresses have the factor
/// 1/R.
#[inline(always)]
fn shear<const N: i32, T: Real>(
    (profile, place): (Profile, (f64, f64)),
    [minus, plus]: [T; 2],
    over_r: T::Complex,
    (x, over_x): (T, T),
) -> Potentials<T> {
    let at = |height: T| T::Complex::new(height.constant(0.0), height);
    let minus = potentials::<N, T::Complex>(profile, at(minus), place, true);
    let plus = potentials::<N, T::Complex>(profile, at(plus), place, true);
    // the factors +-i/x of d/dt and -+i x of int dt for the two senses
    let both = match Order::of(N) {
        Order::Impulse => minus.zip(plus, |m, p| (m - p).times_i().times(over_x)),
        Order::Step => minus.zip(plus, |m, p| m + p),
        Order::StepIntegral => minus.zip(plus, |m, p| (m - p).times_minus_i().times(x)),
    };
    // the upper ones of A and the lower ones of B over i R, the others over R
    Potentials {
        a_upper: (both.a_upper * over_r).im(),
        a_lower: (both.a_lower * over_r).re(),
        g_upper: (both.g_upper * over_r).re(),
        g_lower: (both.g_lower * over_r).im(),
    }
}
