//! Singularities of the amplitudes: zeros of the Rayleigh function on neighbouring sheets, branch points, infinity.
//!
//! They depend on the medium only, and are given in the half-angle variables of [`fronts`](crate::integral::fronts); in
//! the slow interval the variable is stretched.

use crate::integral::panels::smallest_ellipse;
use crate::integral::singularities::Singularities;
use crate::medium::Medium;
use crate::numeric::lanes::ComplexMap;
use crate::numeric::scalar::{Complex, Real, Scalar};
use num_complex::Complex64;

/// Singularities of the amplitudes, which depend on the medium only.
#[derive(Debug, Clone)]
pub(crate) struct FixedSingularities {
    /// Singularities in u, with the pole at slowness zero, where the argument of the potentials is infinite.
    pub(crate) fast: Singularities,
    /// Singularities in the stretched variable of the slow interval, with the pole at infinite slowness.
    pub(crate) slow: Singularities,
    pub(crate) stretch: Stretch,
}

/// A stretched variable s of the slow interval, q = centre + width sinh(rate s - shift), 0 <= s <= 1.
///
/// A zero of the Rayleigh function on the neighbouring sheet lies near the slow interval; the stretch moves it away, as
/// far as the Rayleigh pole beyond the other end allows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretch {
    centre: f64,
    width: f64,
    rate: f64,
    shift: f64,
}

impl Stretch {
    fn new(centre: f64, width: f64) -> Self {
        let shift = (centre / width).asinh();
        Self {
            centre,
            width,
            rate: ((1.0 - centre) / width).asinh() + shift,
            shift,
        }
    }

    /// The stretch with the largest distance of the given points from the interval.
    fn farthest(points: &[Complex64]) -> Self {
        let nearest = points
            .iter()
            .filter(|v| v.re < 0.5)
            .min_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
        let centre = nearest.map_or(0.0, |v| v.re.clamp(0.0, 0.5));
        let ellipse = |stretch: &Self| {
            let images: Vec<Complex64> = points.iter().map(|&q| stretch.at(q)).collect();
            smallest_ellipse(&images, [0.0, 1.0])
        };
        (-14..=4)
            .map(|i| Self::new(centre, 2.0_f64.powf(0.5 * f64::from(i))))
            .max_by(|a, b| ellipse(a).total_cmp(&ellipse(b)))
            .unwrap_or(Self::new(0.0, 1.0))
    }

    /// q and dq/ds at s.
    #[inline(always)]
    pub(crate) fn half_angle<T: Real>(&self, s: T) -> (T, T) {
        let e = (s * self.rate - self.shift).exp();
        let half = 0.5 * self.width;
        let inverse = e.constant(1.0) / e;
        (
            (e - inverse) * half + self.centre,
            (e + inverse) * (half * self.rate),
        )
    }
}

impl ComplexMap for Stretch {
    /// s of a real or complex q.
    #[inline(always)]
    fn at<C: Complex>(&self, q: C) -> C {
        let w = (q - self.centre) * (1.0 / self.width);
        let (re, im) = (w.re(), w.im());
        let zero = re.constant(0.0);
        let right = C::new(re.abs(), re.where_below(zero, -im, im));
        let sinh = (right + (right * right + 1.0).root()).logarithm();
        let signed = C::where_below(re, zero, sinh * -1.0, sinh);
        (signed + self.shift) * (1.0 / self.rate)
    }
}

impl FixedSingularities {
    pub(crate) fn new(medium: &Medium) -> Self {
        /// Distance of a zero from slowness one below which it is skipped: its residue is as small, and it is removable
        /// at nu = 0.
        const REMOVABLE: f64 = 1e-9;
        let k = medium.shear_slowness_squared();
        let span = k - 1.0;
        let i = Complex64::i();
        let both = |v: Complex64| [v, -v];
        // x is infinite at u = i; p and y vanish like a square root at the branch points
        let mut fast = vec![i, k.sqrt() / (1.0 - i * span.sqrt())];
        let mut slow = vec![i];
        for s in both(i / span.sqrt()) {
            for c in both((1.0 - s * s).root()) {
                slow.push(s / (1.0 + c));
            }
        }
        for zero in medium.rayleigh_cubic_roots {
            let x2 = zero * k;
            let square = (2.0 * x2 - k) * (2.0 * x2 - k);
            let is_zero = |rest: Complex64| (square + rest).norm() < 1e-6 * k * k;
            for x in both(x2.root()) {
                for p in both((1.0 - x2).root()) {
                    let u = x / (1.0 + p);
                    if is_zero(4.0 * x2 * p * (k - x2).root()) && (u - 1.0).norm() > REMOVABLE {
                        fast.push(u);
                    }
                }
            }
            for p_abs in both((x2 - 1.0).root()) {
                for y in both((k - x2).root()) {
                    let q = p_abs / (span.sqrt() + y);
                    if is_zero(-4.0 * i * x2 * p_abs * y) && q.norm() > REMOVABLE {
                        slow.push(q);
                    }
                }
            }
        }
        // distant singularities need no additional node, and only the distance from the real axis counts
        for points in [&mut fast, &mut slow] {
            points.retain(|v| v.re > -1.0 && v.norm() < 2.5);
            points.iter_mut().for_each(|v| v.im = v.im.abs());
            points.sort_by(|a, b| a.re.total_cmp(&b.re));
            points.dedup_by(|b, a| (*b - *a).norm() < 1e-9);
        }
        let stretch = Stretch::farthest(&slow);
        let slow = slow.into_iter().map(|q| stretch.at(q));
        Self {
            fast: Singularities::new(fast, Complex64::ZERO, &[1.0]),
            slow: Singularities::new(slow, stretch.at(i), &[0.0, 1.0]),
            stretch,
        }
    }
}
