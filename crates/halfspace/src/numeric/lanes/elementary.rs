//! Functions of the real numbers in a register; angle, logarithm and exponential are implemented here.
//!
//! The polynomials are those of fdlibm (Sun Microsystems, 1993); errors are below two units in the last place.

use super::{Lanes, Pair};
use crate::numeric::scalar::{Real, Scalar};
use pulp::{Simd, cast};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, LOG2_E, PI};

/// ln 2 in two parts, the first of few digits.
const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

impl<S: Simd> Real for Lanes<S> {
    type Complex = Pair<S>;

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.with(self.simd.sqrt_f64s(self.register))
    }

    /// The exponential of numbers between -700 and 700.
    #[inline(always)]
    fn exp(self) -> Self {
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
        let power = simd.wrapping_dyn_shl_u32s(cast(biased.register), simd.splat_u32s(20));
        y * self.with(cast(power))
    }

    /// The natural logarithm of positive numbers that are not subnormal.
    #[inline(always)]
    fn ln(self) -> Self {
        // of 2^52 the last bit counts one
        const LAST_BIT_IS_ONE: f64 = 4_503_599_627_370_496.0;
        let simd = self.simd;
        let bits = simd.add_u64s(
            simd.transmute_u64s_f64s(self.register),
            simd.splat_u64s((0x3ff0_0000 - 0x3fe6_a09e) << 32),
        );
        let fraction = simd.add_u64s(
            simd.and_u64s(bits, simd.splat_u64s(0x000f_ffff_ffff_ffff)),
            simd.splat_u64s(0x3fe6_a09e << 32),
        );
        let shifted = simd.wrapping_dyn_shr_u32s(cast(bits), simd.splat_u32s(20));
        let exponent = simd.or_u64s(
            simd.and_u64s(cast(shifted), simd.splat_u64s(0xfff << 32)),
            simd.splat_u64s(LAST_BIT_IS_ONE.to_bits()),
        );
        let k = (self.with(simd.transmute_f64s_u64s(exponent)) - LAST_BIT_IS_ONE)
            * 0.5_f64.powi(32)
            - 1023.0;
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

    #[inline(always)]
    fn abs(self) -> Self {
        // pulp's own inverts the bits of -0.0 in a function that the development profile does not inline
        let all_but_sign = self.simd.splat_f64s(f64::from_bits(u64::MAX >> 1));
        self.with(self.simd.and_f64s(all_but_sign, self.register))
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        let Self { simd, .. } = self;
        let sign = simd.and_f64s(sign.register, simd.splat_f64s(-0.0));
        self.with(simd.or_f64s(self.abs().register, sign))
    }

    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        self.max(self.constant(least))
    }

    /// The angle of the vector (`x`, self), in [-pi, pi]; zero for the zero vector.
    #[inline(always)]
    fn angle_over(self, x: Self) -> Self {
        const TAN_PI_8: f64 = 0.414_213_562_373_095_03;
        const FRAC_PI_4_LOW: f64 = 3.061_616_997_868_383e-17;
        let zero = self.constant(0.0);
        let (across, along) = (self.abs(), x.abs());
        let small = across.min(along);
        let large = across.max(along).at_least(f64::MIN_POSITIVE);
        // atan(small/large), or pi/4 minus atan of the remainder
        let limit = large * TAN_PI_8;
        let t = small.where_below(limit, small, small - large)
            / small.where_below(limit, large, small + large);
        let low = small.where_below(limit, zero, self.constant(FRAC_PI_4_LOW));
        let high = small.where_below(limit, zero, self.constant(FRAC_PI_4));
        let z = t * t;
        let w = z * z;
        let even = z * w.polynomial([
            1.628_582_011_536_578_2e-2,
            4.976_877_994_615_932e-2,
            6.661_073_137_387_531e-2,
            9.090_887_133_436_507e-2,
            1.428_571_427_250_346_6e-1,
            3.333_333_333_333_293e-1,
        ]);
        let odd = w * w.polynomial([
            -3.653_157_274_421_691_6e-2,
            -5.833_570_133_790_573e-2,
            -7.691_876_205_044_83e-2,
            -1.111_111_040_546_235_6e-1,
            -1.999_999_999_987_648_3e-1,
        ]);
        let first = high + (t - (t * (even + odd) - low));
        let octant = along.where_below(across, -first + FRAC_PI_2, first);
        x.where_below(zero, -octant + PI, octant).copysign(self)
    }

    #[inline(always)]
    fn where_below(self, limit: Self, yes: Self, no: Self) -> Self {
        let mask = self.simd.less_than_f64s(self.register, limit.register);
        self.with(self.simd.select_f64s(mask, yes.register, no.register))
    }

    #[inline(always)]
    fn largest(self) -> f64 {
        self.simd.reduce_max_f64s(self.register)
    }

    #[inline(always)]
    fn smallest(self) -> f64 {
        self.simd.reduce_min_f64s(self.register)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::lanes::dispatch;
    use pulp::WithSimd;

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
                    let found = Lanes::all(simd, y)
                        .angle_over(Lanes::all(simd, x))
                        .largest();
                    worst[0] = worst[0].max(units(found, y.atan2(x)));
                    let value = size * (1.0 + f64::from(i) / 1000.0);
                    let found = Lanes::all(simd, value).ln().largest();
                    worst[1] = worst[1].max((found - value.ln()).abs() / f64::EPSILON);
                    let value = angle * f64::from(exponent);
                    let found = Lanes::all(simd, value).exp().largest();
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
