//! Slownesses between one and 1/kappa: longitudinal waves bound to the surface, shear waves that travel.
//!
//! Theory: `docs/theory.md` (T16).

use crate::field::Six;
use crate::integral::fronts;
use crate::integral::setting::Setting;
use crate::integral::singularities::Singularities;
use crate::integral::spectrum::{self, Wave};
use crate::integral::sum::Sum;
use crate::point::Point;
use crate::potentials::Potentials;
use crate::potentials::closed_form::potentials;
use crate::potentials::order::Order;
use crate::potentials::shallow;
use num_complex::Complex64;

/// One slowness with the vertical slownesses that belong to it and 1/R = re + i im.
#[derive(Debug, Clone, Copy)]
struct Slowness {
    x: f64,
    p_abs: f64,
    y: f64,
    re: f64,
    im: f64,
}

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

    /// dx/ds and the integrand at the stretched half-angle s.
    #[inline]
    pub(crate) fn slow_term<const N: i32>(
        &self,
        at: Point,
        wave: Wave,
        s: f64,
        shallow: bool,
    ) -> (f64, Six) {
        let (q, dq) = self.fixed.stretch.half_angle(s);
        let inverse = 1.0 / (1.0 + q * q);
        let p_abs = self.span * 2.0 * q * inverse;
        let y = self.span * (1.0 - q) * (1.0 + q) * inverse;
        let x = (1.0 + p_abs * p_abs).sqrt();
        // dx = p^ dp^/x, dp^ = 2 y/(1 + q^2) dq
        let jacobian = p_abs * 2.0 * y * inverse / x * dq;
        let (re, im) = spectrum::inverse_rayleigh(self.k, x, p_abs, y);
        let slowness = Slowness {
            x,
            p_abs,
            y,
            re,
            im,
        };
        let psi = match wave {
            Wave::P => self.longitudinal::<N>(at, slowness),
            Wave::S => self.shear::<N>(at, slowness),
        };
        let amplitudes = spectrum::slow(wave, self.k, x, p_abs, y);
        let mut term = amplitudes.fields(&psi, at.r);
        if shallow {
            let (a, g) = match wave {
                Wave::P => longitudinal_difference(at, slowness),
                Wave::S => shear_difference(at, slowness),
            };
            amplitudes.set_traction(&mut term, a, g, at.r);
        }
        (jacobian, term)
    }

    /// Re of -i/R times the sum of both senses, or times i x their difference for the time integral.
    ///
    /// xi+ is the conjugate of xi-, so the potentials combine to real numbers.
    #[inline]
    fn longitudinal<const N: i32>(&self, at: Point, n: Slowness) -> Potentials<f64> {
        let inverse = 1.0 / n.x;
        let xi = Complex64::new(at.z * n.p_abs * inverse, -at.t * inverse);
        let factor = 2.0 * n.im;
        potentials::<N>(self.profile, xi, at.r).map(|v| match Order::of(N) {
            Order::Impulse => -factor * inverse * v.im,
            Order::Step => factor * v.re,
            Order::StepIntegral => factor * n.x * v.im,
        })
    }

    /// The same for the shear wave, whose arguments are imaginary; u and the normal stresses take 1/R.
    #[inline]
    fn shear<const N: i32>(&self, at: Point, n: Slowness) -> Potentials<f64> {
        let inverse = 1.0 / n.x;
        let argument = |t: f64| Complex64::new(0.0, (at.z * n.y + t) * inverse);
        let minus = potentials::<N>(self.profile, argument(-at.t), at.r);
        let plus = potentials::<N>(self.profile, argument(at.t), at.r);
        // the factors +-i/x of d/dt and -+i x of int dt for the two senses
        let both = |m: Complex64, p: Complex64| match Order::of(N) {
            Order::Impulse => Complex64::new(inverse * (p.im - m.im), inverse * (m.re - p.re)),
            Order::Step => m + p,
            Order::StepIntegral => Complex64::new(n.x * (m.im - p.im), n.x * (p.re - m.re)),
        };
        // Re[(re + i im) v] and Re[-i (re + i im) v]
        let over_r = |v: Complex64| n.re * v.re - n.im * v.im;
        let over_ir = |v: Complex64| n.im * v.re + n.re * v.im;
        Potentials {
            a_upper: over_ir(both(minus.a_upper, plus.a_upper)),
            a_lower: over_r(both(minus.a_lower, plus.a_lower)),
            g_upper: over_r(both(minus.g_upper, plus.g_upper)),
            g_lower: over_ir(both(minus.g_lower, plus.g_lower)),
        }
    }
}

/// The longitudinal potentials of the tractions less their values at the surface.
fn longitudinal_difference(at: Point, n: Slowness) -> (f64, f64) {
    let surface = Complex64::new(0.0, -at.t / n.x);
    let step = Complex64::new(at.z * n.p_abs / n.x, 0.0);
    let (a, g) = shallow::difference(surface, step, at.r);
    let factor = 2.0 * n.im;
    (factor * a.re, factor * g.re)
}

/// The same of the shear wave.
fn shear_difference(at: Point, n: Slowness) -> (f64, f64) {
    let step = Complex64::new(0.0, at.z * n.y / n.x);
    let [minus, plus] =
        [-at.t, at.t].map(|t| shallow::difference(Complex64::new(0.0, t / n.x), step, at.r));
    let (a, g) = (minus.0 + plus.0, minus.1 + plus.1);
    (n.re * a.re - n.im * a.im, n.im * g.re + n.re * g.im)
}
