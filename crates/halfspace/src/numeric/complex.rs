//! Complex numbers, one or several side by side, with the functions, branches and limits that the closed forms need.

use crate::numeric::scalar::{Real, Scalar};
use num_complex::Complex64;

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

    /// Principal logarithm; of zero it is finite.
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

    /// `yes` where `value` is below `limit`, else `no`.
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
