//! Complex functions of the closed forms, with the branches and limits that they need.

use crate::numeric::scalar::Real;
use num_complex::Complex64;
use std::f64::consts::FRAC_PI_2;

/// Principal square root.
pub(crate) fn root(v: Complex64) -> Complex64 {
    let modulus = v.norm_sqr().sqrt();
    if v.re >= 0.0 {
        let a = (0.5 * (modulus + v.re)).sqrt();
        Complex64::new(a, if a > 0.0 { 0.5 * v.im / a } else { 0.0 })
    } else {
        let b = (0.5 * (modulus - v.re)).sqrt();
        Complex64::new(0.5 * v.im.abs() / b, b.copysign(v.im))
    }
}

/// 1/v.
#[inline]
pub(crate) fn reciprocal(v: Complex64) -> Complex64 {
    let scale = 1.0 / v.norm_sqr();
    Complex64::new(v.re * scale, -v.im * scale)
}

/// i v.
pub(crate) fn times_i(v: Complex64) -> Complex64 {
    Complex64::new(-v.im, v.re)
}

/// -i v.
pub(crate) fn times_minus_i(v: Complex64) -> Complex64 {
    Complex64::new(v.im, -v.re)
}

/// Principal logarithm; of zero it is finite.
#[inline]
pub(crate) fn logarithm(v: Complex64) -> Complex64 {
    let modulus = v.norm_sqr().max(f64::MIN_POSITIVE);
    let angle = if v.re == 0.0 {
        FRAC_PI_2.copysign(v.im)
    } else {
        v.im.atan2(v.re)
    };
    Complex64::new(0.5 * modulus.ln(), angle)
}

/// sqrt(zeta + ir) sqrt(zeta - ir), the branch that is zeta at r = 0, for Re zeta >= 0.
#[inline]
pub(crate) fn root_with_circle(zeta: Complex64, r: f64) -> Complex64 {
    root_inside(zeta, (r - zeta.im) * (r + zeta.im))
}

/// sqrt(d^2 + inside + 2 i d s) for zeta = d + i s.
#[inline]
pub(crate) fn root_inside(zeta: Complex64, inside: f64) -> Complex64 {
    let (d, s) = (zeta.re, zeta.im);
    if d == 0.0 {
        return if inside >= 0.0 {
            Complex64::new(inside.sqrt(), 0.0)
        } else {
            Complex64::new(0.0, (-inside).sqrt().copysign(s))
        };
    }
    let square = Complex64::new(d * d + inside, 2.0 * d * s);
    root(square)
}

/// (r - s)(r + s) at the ends s = eta -+ 1 of the chord, exact at the edge of the disc.
#[inline(always)]
pub(crate) fn inside<T: Real>(eta: T, r: f64) -> [T; 2] {
    let (inner, outer) = (r - 1.0, r + 1.0);
    [
        (-eta + outer) * (eta + inner),
        (-eta + inner) * (eta + outer),
    ]
}
