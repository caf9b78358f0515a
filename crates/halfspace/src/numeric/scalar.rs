//! Real and complex numbers, single or several in a register, with the functions, branches and limits of the closed
//! forms.

use num_complex::Complex64;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real or complex number.
pub(crate) trait Scalar:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// A constant of the same kind.
    fn constant(self, value: f64) -> Self;
}

/// A real number.
pub(crate) trait Real: Scalar + Div<Output = Self> + Neg<Output = Self> {
    /// Complex numbers with such parts.
    type Complex: Complex<Part = Self>;

    fn sqrt(self) -> Self;
    fn exp(self) -> Self;
    fn ln(self) -> Self;
    fn abs(self) -> Self;
    fn copysign(self, sign: Self) -> Self;
    fn at_least(self, least: f64) -> Self;

    /// The square root of a positive number, zero for others.
    #[inline(always)]
    fn held_root(self) -> Self {
        self.at_least(0.0).sqrt()
    }

    /// The angle of the vector (`x`, self), in [-pi, pi]; zero for the zero vector.
    fn angle_over(self, x: Self) -> Self;

    /// `yes` where this number is below `limit`, otherwise `no`.
    fn where_below(self, limit: Self, yes: Self, no: Self) -> Self;

    /// The largest number in a register.
    fn largest(self) -> f64;

    /// The smallest number in a register.
    fn smallest(self) -> f64;
}

impl Scalar for f64 {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value
    }
}

impl Real for f64 {
    type Complex = Complex64;

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn exp(self) -> Self {
        f64::exp(self)
    }

    #[inline(always)]
    fn ln(self) -> Self {
        f64::ln(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        f64::copysign(self, sign)
    }

    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        self.max(least)
    }

    #[inline(always)]
    fn angle_over(self, x: Self) -> Self {
        self.atan2(x)
    }

    #[inline(always)]
    fn where_below(self, limit: Self, yes: Self, no: Self) -> Self {
        if self < limit { yes } else { no }
    }

    #[inline(always)]
    fn largest(self) -> f64 {
        self
    }

    #[inline(always)]
    fn smallest(self) -> f64 {
        self
    }
}

/// A complex number.
pub(crate) trait Complex: Scalar {
    /// Real and imaginary part.
    type Part: Real<Complex = Self>;

    fn new(re: Self::Part, im: Self::Part) -> Self;
    fn re(self) -> Self::Part;
    fn im(self) -> Self::Part;

    #[inline(always)]
    fn times(self, real: Self::Part) -> Self {
        Self::new(self.re() * real, self.im() * real)
    }

    #[inline(always)]
    fn norm_sqr(self) -> Self::Part {
        self.re() * self.re() + self.im() * self.im()
    }

    #[inline(always)]
    fn conj(self) -> Self {
        Self::new(self.re(), -self.im())
    }

    /// i times this.
    #[inline(always)]
    fn times_i(self) -> Self {
        Self::new(-self.im(), self.re())
    }

    /// -i times this.
    #[inline(always)]
    fn times_minus_i(self) -> Self {
        Self::new(self.im(), -self.re())
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        let scale = self.re().constant(1.0) / self.norm_sqr();
        Self::new(self.re() * scale, -self.im() * scale)
    }

    /// Principal square root.
    #[inline(always)]
    fn root(self) -> Self {
        let (re, im) = (self.re(), self.im());
        let modulus = self.norm_sqr().sqrt();
        let large = ((modulus + re.abs()) * 0.5).sqrt();
        let small = im.abs() * 0.5 / large.at_least(f64::MIN_POSITIVE);
        let zero = re.constant(0.0);
        Self::new(
            re.where_below(zero, small, large),
            re.where_below(zero, large, small).copysign(im),
        )
    }

    /// Principal logarithm; finite for zero.
    #[inline(always)]
    fn logarithm(self) -> Self {
        let square = self.norm_sqr().at_least(f64::MIN_POSITIVE);
        Self::new(square.ln() * 0.5, self.im().angle_over(self.re()))
    }

    /// sqrt(d^2 + inside + 2 i d s) for this = d + i s, d >= 0; on the imaginary axis the side is that of s.
    #[inline(always)]
    fn root_inside(self, inside: Self::Part) -> Self {
        let (d, s) = (self.re(), self.im());
        let root = Self::new(d * d + inside, d * s * 2.0).root();
        Self::new(root.re(), root.im().abs().copysign(s))
    }

    /// sqrt(zeta + ir) sqrt(zeta - ir), the branch that is zeta at r = 0, for Re zeta >= 0.
    #[inline(always)]
    fn root_with_circle(self, r: f64) -> Self {
        let s = self.im();
        self.root_inside((-s + r) * (s + r))
    }

    /// `yes` where `value` is below `limit`, otherwise `no`.
    #[inline(always)]
    fn where_below(value: Self::Part, limit: Self::Part, yes: Self, no: Self) -> Self {
        Self::new(
            value.where_below(limit, yes.re(), no.re()),
            value.where_below(limit, yes.im(), no.im()),
        )
    }
}

impl Scalar for Complex64 {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value.into()
    }
}

impl Complex for Complex64 {
    type Part = f64;

    #[inline(always)]
    fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    #[inline(always)]
    fn re(self) -> f64 {
        self.re
    }

    #[inline(always)]
    fn im(self) -> f64 {
        self.im
    }
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
