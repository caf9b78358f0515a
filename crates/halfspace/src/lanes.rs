//! Four real or complex numbers side by side in vector registers, with the functions of the closed forms.
//!
//! No operation is fused and the width is fixed, so that a machine without vector registers finds the same bits.
//!
//! The polynomials are those of fdlibm (logarithm, exponential; Sun Microsystems, 1993) and of Cephes (arc tangent; Moshier,
//! 1989): within two units in the last place.

use crate::scalar::{Real, Scalar};
use pulp::{Simd, WithSimd, cast};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, LOG2_E, PI};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// How many numbers go side by side.
pub(crate) const WIDTH: usize = 4;

/// Runs `work` with the machine's vector registers, or without any.
#[inline]
pub(crate) fn dispatch<W: WithSimd>(work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    if let Some(simd) = pulp::x86::V3::try_new() {
        return Simd::vectorize(simd, work);
    }
    Simd::vectorize(pulp::Scalar256b, work)
}

/// Four real numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lanes<S: Simd> {
    simd: S,
    four: S::f64s,
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, four: [f64; WIDTH]) -> Self {
        Self {
            simd,
            four: cast(four),
        }
    }

    #[inline(always)]
    pub(crate) fn all(simd: S, value: f64) -> Self {
        Self {
            simd,
            four: simd.splat_f64s(value),
        }
    }

    #[inline(always)]
    pub(crate) fn into_array(self) -> [f64; WIDTH] {
        cast(self.four)
    }

    #[inline(always)]
    fn with(self, four: S::f64s) -> Self {
        Self { four, ..self }
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        self.with(self.simd.abs_f64s(self.four))
    }

    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.with(self.simd.max_f64s(self.four, other.four))
    }

    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        self.with(self.simd.min_f64s(self.four, other.four))
    }

    #[inline(always)]
    pub(crate) fn copysign(self, other: Self) -> Self {
        let Self { simd, .. } = self;
        let sign = simd.and_f64s(other.four, simd.splat_f64s(-0.0));
        self.with(simd.or_f64s(self.abs().four, sign))
    }

    /// The largest of the four.
    #[inline(always)]
    pub(crate) fn largest(self) -> f64 {
        self.simd.reduce_max_f64s(self.four)
    }

    /// `yes` where this is below `limit`, else `no`.
    #[inline(always)]
    pub(crate) fn where_below(self, limit: Self, yes: Self, no: Self) -> Self {
        let mask = self.simd.less_than_f64s(self.four, limit.four);
        self.with(self.simd.select_f64s(mask, yes.four, no.four))
    }

    /// Horner's rule, the highest coefficient first.
    #[inline(always)]
    fn polynomial<const N: usize>(self, coefficients: [f64; N]) -> Self {
        let mut sum = self.constant(coefficients[0]);
        for c in &coefficients[1..] {
            sum = sum * self + *c;
        }
        sum
    }

    /// The angle of the vector (`x`, self), in [-pi, pi]; of nothing it is zero.
    #[inline(always)]
    pub(crate) fn angle_over(self, x: Self) -> Self {
        const TAN_PI_8: f64 = 0.414_213_562_373_095_03;
        const FRAC_PI_4_LOW: f64 = 3.061_616_997_868_383e-17;
        let zero = self.constant(0.0);
        let (across, along) = (self.abs(), x.abs());
        let small = across.min(along);
        let large = across.max(along).at_least(f64::MIN_POSITIVE);
        // atan(small/large), or pi/4 less atan of the rest
        let limit = large * TAN_PI_8;
        let t = small.where_below(limit, small, small - large)
            / small.where_below(limit, large, small + large);
        let low = small.where_below(limit, zero, self.constant(FRAC_PI_4_LOW));
        let high = small.where_below(limit, zero, self.constant(FRAC_PI_4));
        let z = t * t;
        let upper = z.polynomial([
            -8.750_608_600_031_904e-1,
            -1.615_753_718_733_365e1,
            -7.500_855_792_314_705e1,
            -1.228_866_684_490_136_1e2,
            -6.485_021_904_942_025e1,
        ]);
        let lower = z.polynomial([
            1.0,
            2.485_846_490_142_306_3e1,
            1.650_270_098_316_988_5e2,
            4.328_810_604_912_903e2,
            4.853_903_996_359_137e2,
            1.945_506_571_482_614e2,
        ]);
        let first = high + (t + (t * z * (upper / lower) + low));
        let octant = along.where_below(across, -first + FRAC_PI_2, first);
        x.where_below(zero, -octant + PI, octant).copysign(self)
    }

    /// The natural logarithm of positive numbers that are not subnormal.
    #[inline(always)]
    pub(crate) fn ln(self) -> Self {
        const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
        const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;
        // of 2^52 the last bit counts one
        const MAGIC: f64 = 4_503_599_627_370_496.0;
        let simd = self.simd;
        let bits = simd.add_u64s(
            simd.transmute_u64s_f64s(self.four),
            simd.splat_u64s((0x3ff0_0000 - 0x3fe6_a09e) << 32),
        );
        let fraction = simd.add_u64s(
            simd.and_u64s(bits, simd.splat_u64s(0x000f_ffff_ffff_ffff)),
            simd.splat_u64s(0x3fe6_a09e << 32),
        );
        let shifted = simd.wrapping_dyn_shr_u32s(cast(bits), simd.splat_u32s(20));
        let exponent = simd.or_u64s(
            simd.and_u64s(cast(shifted), simd.splat_u64s(0xfff << 32)),
            simd.splat_u64s(MAGIC.to_bits()),
        );
        let k = (self.with(simd.transmute_f64s_u64s(exponent)) - MAGIC) * 0.5_f64.powi(32) - 1023.0;
        let f = self.with(simd.transmute_f64s_u64s(fraction)) - 1.0;
        let s = f / (f + 2.0);
        let z = s * s;
        let w = z * z;
        let even = w * w.polynomial([
            0.153_138_376_992_093_73,
            0.222_221_984_321_497_84,
            0.399_999_999_994_094_2,
        ]);
        let odd = z * w.polynomial([
            0.147_981_986_051_165_86,
            0.181_835_721_616_180_5,
            0.285_714_287_436_623_9,
            0.666_666_666_666_673_5,
        ]);
        let half_square = f * f * 0.5;
        s * (half_square + (odd + even)) + k * LN_2_LOW - half_square + f + k * LN_2_HIGH
    }
}

macro_rules! operators {
    ($($operation:ident, $method:ident, $vector:ident;)*) => {$(
        impl<S: Simd> $operation for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.with(self.simd.$vector(self.four, other.four))
            }
        }

        impl<S: Simd> $operation<f64> for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self.$method(self.constant(other))
            }
        }
    )*};
}

operators! {
    Add, add, add_f64s;
    Sub, sub, sub_f64s;
    Mul, mul, mul_f64s;
    Div, div, div_f64s;
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self.simd.neg_f64s(self.four))
    }
}

impl<S: Simd> Scalar for Lanes<S> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::all(self.simd, value)
    }
}

impl<S: Simd> Real for Lanes<S> {
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.with(self.simd.sqrt_f64s(self.four))
    }

    /// The exponential of numbers between -700 and 700.
    #[inline(always)]
    fn exp(self) -> Self {
        const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
        const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;
        // to this the nearest integer is added in the last bits
        const ROUND: f64 = 6_755_399_441_055_744.0;
        let simd = self.simd;
        let k = (self * LOG2_E + ROUND) - ROUND;
        let low = k * LN_2_LOW;
        let high = self - k * LN_2_HIGH;
        let x = high - low;
        let z = x * x;
        let c = x - z * z.polynomial([
            4.138_136_797_057_238_5e-8,
            -1.653_390_220_546_525_2e-6,
            6.613_756_321_437_934e-5,
            -2.777_777_777_701_559_3e-3,
            0.166_666_666_666_666_02,
        ]);
        let y = (x * c / (-c + 2.0) - low) + high + 1.0;
        // the exponent of 2^k, shifted out of the last bits of 2^52 + (k + 1023) 2^32
        let biased = (k + 1023.0) * 2.0_f64.powi(32) + 2.0_f64.powi(52);
        let power = simd.wrapping_dyn_shl_u32s(cast(biased.four), simd.splat_u32s(20));
        y * self.with(cast(power))
    }

    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        self.max(self.constant(least))
    }
}

/// Four complex numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair<S: Simd> {
    pub(crate) re: Lanes<S>,
    pub(crate) im: Lanes<S>,
}

impl<S: Simd> Pair<S> {
    #[inline(always)]
    pub(crate) fn norm_sqr(self) -> Lanes<S> {
        self.re * self.re + self.im * self.im
    }

    #[inline(always)]
    pub(crate) fn conj(self) -> Self {
        Self {
            im: -self.im,
            ..self
        }
    }

    #[inline(always)]
    pub(crate) fn times(self, real: Lanes<S>) -> Self {
        Self {
            re: self.re * real,
            im: self.im * real,
        }
    }

    /// i times this.
    #[inline(always)]
    pub(crate) fn times_i(self) -> Self {
        Self {
            re: -self.im,
            im: self.re,
        }
    }

    /// -i times this.
    #[inline(always)]
    pub(crate) fn times_minus_i(self) -> Self {
        Self {
            re: self.im,
            im: -self.re,
        }
    }

    #[inline(always)]
    pub(crate) fn reciprocal(self) -> Self {
        let scale = self.re.constant(1.0) / self.norm_sqr();
        Self {
            re: self.re * scale,
            im: -self.im * scale,
        }
    }

    /// Principal square root.
    #[inline(always)]
    pub(crate) fn root(self) -> Self {
        let modulus = self.norm_sqr().sqrt();
        let large = ((modulus + self.re.abs()) * 0.5).sqrt();
        let small = self.im.abs() * 0.5 / large.at_least(f64::MIN_POSITIVE);
        let zero = self.re.constant(0.0);
        Self {
            re: self.re.where_below(zero, small, large),
            im: self.re.where_below(zero, large, small).copysign(self.im),
        }
    }

    /// `yes` where `value` is below `limit`, else `no`.
    #[inline(always)]
    pub(crate) fn where_below(value: Lanes<S>, limit: Lanes<S>, yes: Self, no: Self) -> Self {
        Self {
            re: value.where_below(limit, yes.re, no.re),
            im: value.where_below(limit, yes.im, no.im),
        }
    }
}

impl<S: Simd> Add for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            re: self.re + other.re,
            im: self.im + other.im,
        }
    }
}

impl<S: Simd> Sub for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            re: self.re - other.re,
            im: self.im - other.im,
        }
    }
}

impl<S: Simd> Mul for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

impl<S: Simd> Add<f64> for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self {
            re: self.re + other,
            ..self
        }
    }
}

impl<S: Simd> Sub<f64> for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        Self {
            re: self.re - other,
            ..self
        }
    }
}

impl<S: Simd> Mul<f64> for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        Self {
            re: self.re * other,
            im: self.im * other,
        }
    }
}

impl<S: Simd> Scalar for Pair<S> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self {
            re: self.re.constant(value),
            im: self.re.constant(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest difference of the four functions from those of the standard library, in units of the last place.
    struct Differences;

    fn units(found: f64, exact: f64) -> f64 {
        (found - exact).abs() / (f64::EPSILON * exact.abs().max(f64::MIN_POSITIVE))
    }

    impl WithSimd for Differences {
        type Output = [f64; 3];

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> [f64; 3] {
            let mut worst = [0.0_f64; 3];
            for i in 0..4000 {
                let angle = -3.2 + 6.4 * f64::from(i) / 3999.0;
                for exponent in [-8, -1, 0, 3] {
                    let size = 10.0_f64.powi(exponent) * 1.7;
                    let (y, x) = (size * angle.sin(), size * angle.cos());
                    let [found, ..] = Lanes::all(simd, y)
                        .angle_over(Lanes::all(simd, x))
                        .into_array();
                    worst[0] = worst[0].max(units(found, y.atan2(x)));
                    let value = size * (1.0 + f64::from(i) / 1000.0);
                    let [found, ..] = Lanes::all(simd, value).ln().into_array();
                    worst[1] = worst[1].max((found - value.ln()).abs() / f64::EPSILON);
                    let value = angle * f64::from(exponent);
                    let [found, ..] = Lanes::all(simd, value).exp().into_array();
                    worst[2] = worst[2].max(units(found, value.exp()));
                }
            }
            worst
        }
    }

    #[test]
    fn functions_are_those_of_the_standard_library() {
        let [angle, logarithm, exponential] = dispatch(Differences);
        assert!(angle < 2.5, "{angle}");
        // near one the logarithm is small: absolute, and 20 is the largest
        assert!(logarithm < 25.0, "{logarithm}");
        assert!(exponential < 2.5, "{exponential}");
    }

    #[test]
    fn bits_do_not_depend_on_the_machine() {
        assert_eq!(
            dispatch(Differences),
            Simd::vectorize(pulp::Scalar256b, Differences)
        );
    }
}
