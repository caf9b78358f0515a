//! Singularities of the amplitudes: zeros of the Rayleigh function on neighbouring sheets, branch points, infinity.
//!
//! They depend on the medium alone and are given in the half-angle variables of [`fronts`](crate::integral::fronts), those of the
//! slow interval in a stretched one.

use crate::integral::panels::smallest_ellipse;
use crate::integral::singularities::Singularities;
use crate::medium::Medium;
use crate::numeric::complex::{logarithm, root};
use crate::numeric::lanes::{Map, Pair};
use crate::numeric::scalar::{Real, Scalar};
use num_complex::Complex64;
use pulp::Simd;

/// Singularities of the amplitudes, fixed for a medium.
#[derive(Debug, Clone)]
pub(crate) struct FixedSingularities {
    /// In u, with the pole at slowness zero, where the argument of the potentials is infinite.
    pub(crate) fast: Singularities,
    /// In the stretched variable of the slow interval, with the pole at infinite slowness.
    pub(crate) slow: Singularities,
    pub(crate) stretch: Stretch,
}

/// A stretched variable s of the slow interval, q = centre + width sinh(rate s - shift), 0 <= s <= 1.
///
/// A zero of the Rayleigh function on the neighbouring sheet lies near the slow interval; the stretch
/// moves it away as far as the Rayleigh pole beyond the other end allows.
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

    /// The stretch that keeps the given points farthest from the interval.
    fn farthest(points: &[Complex64]) -> Self {
        let nearest = points
            .iter()
            .filter(|v| v.re < 0.5)
            .min_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
        let centre = nearest.map_or(0.0, |v| v.re.clamp(0.0, 0.5));
        let ellipse = |stretch: &Self| {
            let images: Vec<Complex64> = points.iter().map(|&q| stretch.variable(q)).collect();
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

    /// s of a real or complex q.
    pub(crate) fn variable(&self, q: Complex64) -> Complex64 {
        let w = (q - self.centre) / self.width;
        let (right, sign) = if w.re < 0.0 { (-w, -1.0) } else { (w, 1.0) };
        let sinh = logarithm(right + root(right * right + 1.0));
        (sign * sinh + self.shift) / self.rate
    }
}

impl Map for Stretch {
    /// As [`Self::variable`].
    #[inline(always)]
    fn at<S: Simd>(&self, q: Pair<S>) -> Pair<S> {
        let w = (q - self.centre) * (1.0 / self.width);
        let zero = w.re.constant(0.0);
        let right = Pair::new(w.re.abs(), w.re.where_below(zero, -w.im, w.im));
        let sum = right + (right * right + 1.0).root();
        let sinh = sum.logarithm();
        let signed = Pair::where_below(w.re, zero, Pair::new(-sinh.re, -sinh.im), sinh);
        (signed + self.shift) * (1.0 / self.rate)
    }
}

impl FixedSingularities {
    pub(crate) fn new(medium: &Medium) -> Self {
        /// A zero this close to slowness one has a residue as small and is removable in the limit (nu = 0).
        const REMOVABLE: f64 = 1e-9;
        let k = medium.shear_slowness_squared();
        let span = k - 1.0;
        let i = Complex64::i();
        let both = |v: Complex64| [v, -v];
        // x is infinite at u = i, p and y vanish together with a square root at the branch points
        let mut fast = vec![i, k.sqrt() / (1.0 - i * span.sqrt())];
        let mut slow = vec![i];
        for s in both(i / span.sqrt()) {
            for c in both(root(1.0 - s * s)) {
                slow.push(s / (1.0 + c));
            }
        }
        for zero in medium.rayleigh_cubic_roots {
            let x2 = zero * k;
            let square = (2.0 * x2 - k) * (2.0 * x2 - k);
            let is_zero = |rest: Complex64| (square + rest).norm() < 1e-6 * k * k;
            for x in both(root(x2)) {
                for p in both(root(1.0 - x2)) {
                    let u = x / (1.0 + p);
                    if is_zero(4.0 * x2 * p * root(k - x2)) && (u - 1.0).norm() > REMOVABLE {
                        fast.push(u);
                    }
                }
            }
            for p_abs in both(root(x2 - 1.0)) {
                for y in both(root(k - x2)) {
                    let q = p_abs / (span.sqrt() + y);
                    if is_zero(-4.0 * i * x2 * p_abs * y) && q.norm() > REMOVABLE {
                        slow.push(q);
                    }
                }
            }
        }
        // Far ones cost no node, and only the distance from the real axis counts.
        for points in [&mut fast, &mut slow] {
            points.retain(|v| v.re > -1.0 && v.norm() < 2.5);
            points.iter_mut().for_each(|v| v.im = v.im.abs());
            points.sort_by(|a, b| a.re.total_cmp(&b.re));
            points.dedup_by(|b, a| (*b - *a).norm() < 1e-9);
        }
        let stretch = Stretch::farthest(&slow);
        let slow = slow.into_iter().map(|q| stretch.variable(q));
        Self {
            fast: Singularities::new(fast, Complex64::ZERO, &[1.0]),
            slow: Singularities::new(slow, stretch.variable(i), &[0.0, 1.0]),
            stretch,
        }
    }
}
