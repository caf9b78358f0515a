//! Where the integrands of the kernels are singular, in closed form.
//!
//! A wave is felt at slowness x when its plane front from an edge of the disc passes:
//!
//! ```text
//! z gamma^ + sense t = e x,     e = +-1 +- r
//! ```
//!
//! With x = 2u/(1 + u^2) and gamma^ = (1 - u^2)/(1 + u^2), scaled by the slowness of the wave, this is a
//! quadratic in u. The integrals run over such half-angle variables, in which every square root of the
//! problem is rational or analytic:
//!
//! ```text
//! fast  0 < x < 1           x = 2u/(1 + u^2)      p = (1 - u^2)/(1 + u^2)
//! slow  1 < x < sqrt(K)     sqrt(x^2 - 1) = sqrt(K - 1) 2q/(1 + q^2)     y = sqrt(K - 1) (1 - q^2)/(1 + q^2)
//! ```
//!
//! Other singularities are fixed: zeros of the Rayleigh function on neighbouring sheets and branch points.

use crate::complex::{logarithm, root};
use crate::landscape::Landscape;
use crate::medium::Medium;
use crate::panels::smallest_ellipse;
use crate::spectrum::Wave;
use num_complex::Complex64;

/// One evaluation point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Point {
    pub(crate) r: f64,
    pub(crate) z: f64,
    pub(crate) t: f64,
}

/// Direction of travel of a wave past the observer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sense {
    /// xi- = i (z gamma^ - t)/x: the wave that comes down from the load.
    Outgoing,
    /// xi+ = i (z gamma^ + t)/x: its image in time, which makes the sum causal.
    Image,
}

impl Sense {
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Outgoing => -1.0,
            Self::Image => 1.0,
        }
    }
}

/// Singularities of the amplitudes, fixed for a medium.
#[derive(Debug, Clone)]
pub(crate) struct FixedSingularities {
    /// In u, of the amplitudes alone.
    pub(crate) fast: Vec<Complex64>,
    /// In the stretched variable of the slow interval.
    pub(crate) slow: Vec<Complex64>,
    /// In the same variable, infinite slowness.
    pub(crate) slow_pole: Complex64,
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
            smallest_ellipse(&images, 0.0, 1.0)
        };
        (-14..=4)
            .map(|i| Self::new(centre, 2.0_f64.powf(0.5 * f64::from(i))))
            .max_by(|a, b| ellipse(a).total_cmp(&ellipse(b)))
            .unwrap_or(Self::new(0.0, 1.0))
    }

    /// q and dq/ds at s.
    #[inline]
    pub(crate) fn half_angle(&self, s: f64) -> (f64, f64) {
        let e = (self.rate * s - self.shift).exp();
        let half = 0.5 * self.width;
        let inverse = 1.0 / e;
        (
            self.centre + half * (e - inverse),
            half * self.rate * (e + inverse),
        )
    }

    /// s of a real or complex q.
    fn variable(&self, q: Complex64) -> Complex64 {
        let w = (q - self.centre) / self.width;
        let (right, sign) = if w.re < 0.0 { (-w, -1.0) } else { (w, 1.0) };
        let sinh = logarithm(right + root(right * right + 1.0));
        (sign * sinh + self.shift) / self.rate
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
        let mut fast = vec![i];
        fast.push(k.sqrt() / (1.0 - i * span.sqrt()));
        let mut slow = vec![i];
        for s in both(i / span.sqrt()) {
            for c in both(root(1.0 - s * s)) {
                slow.push(s / (1.0 + c));
            }
        }
        for zero in medium.rayleigh_cubic_roots() {
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
        Self {
            fast,
            slow_pole: stretch.variable(i),
            slow: slow.into_iter().map(|q| stretch.variable(q)).collect(),
            stretch,
        }
    }
}

/// Adds the fronts of one wave in one sense to a landscape of the fast interval.
pub(crate) fn add_fast(
    landscape: &mut Landscape,
    at: Point,
    radius: f64,
    k: f64,
    wave: Wave,
    sense: Sense,
) {
    for_each_front(at, radius, k, wave, sense, |v| match wave {
        Wave::P => with_mirror(v, |u| landscape.add(u)),
        Wave::S => {
            let (x, y) = (k.sqrt() * sine(v), cosine(v));
            if y.re > 0.0 {
                let u = x / (1.0 + root(1.0 - x * x));
                with_mirror(u, |u| landscape.add(u));
                with_reciprocal(u, |u| landscape.add(u));
            }
        }
    });
}

/// Adds the fronts of one wave in both senses to a landscape of the slow interval.
///
/// Reversing time turns q into its reciprocal, and the other sheet of the root that a wave does not
/// contain turns it into its negative.
pub(crate) fn add_slow(
    landscape: &mut Landscape,
    at: Point,
    radius: f64,
    k: f64,
    stretch: &Stretch,
    wave: Wave,
) {
    let span = (k - 1.0).sqrt();
    let mut add = |q: Complex64| {
        with_mirror(q, |q| landscape.add(stretch.variable(q)));
        with_reciprocal(q, |q| landscape.add(stretch.variable(q)));
    };
    // On the surface the roots of a pair are reciprocal and stand for the same two fronts.
    let twin = |v: Complex64| at.z == 0.0 && v.norm_sqr() > 1.0 && v.im == 0.0;
    for_each_front(at, radius, k, wave, Sense::Outgoing, |v| match wave {
        Wave::P | Wave::S if twin(v) => {}
        Wave::P => {
            let s = Complex64::i() * cosine(v) / span;
            add(s / (1.0 + root(1.0 - s * s)));
        }
        Wave::S => {
            let c = cosine(v) * (k.sqrt() / span);
            add(root(1.0 - c * c) / (1.0 + c));
        }
    });
}

/// Passes on a point and its negative: the one on the right, and the other where it is near enough to matter.
fn with_mirror(point: Complex64, mut add: impl FnMut(Complex64)) {
    const NEAR_ZERO: f64 = 0.3;
    /// Beyond this a half-angle costs no node.
    const FAR: f64 = 2.5;
    let right = if point.re < 0.0 { -point } else { point };
    if right.norm_sqr() > FAR * FAR {
        return;
    }
    add(right);
    if right.norm_sqr() < NEAR_ZERO * NEAR_ZERO {
        add(-right);
    }
}

/// Passes on the reciprocal of a point, or its negative, where it is near enough to matter.
fn with_reciprocal(point: Complex64, mut add: impl FnMut(Complex64)) {
    const NEAR_ONE: f64 = 0.4;
    if point.norm_sqr() > NEAR_ONE * NEAR_ONE {
        let reciprocal = 1.0 / point;
        add(if reciprocal.re < 0.0 {
            -reciprocal
        } else {
            reciprocal
        });
    }
}

fn sine(u: Complex64) -> Complex64 {
    2.0 * u / (1.0 + u * u)
}

fn cosine(u: Complex64) -> Complex64 {
    let square = u * u;
    (1.0 - square) / (1.0 + square)
}

/// The distances |e| of the front equation: two, or one for a point force.
fn edges(r: f64, radius: f64) -> impl Iterator<Item = f64> {
    let nearest = (radius > 0.0).then_some((radius - r).abs());
    [radius + r].into_iter().chain(nearest)
}

/// Roots u of (sense t - z) u^2 - 2 e u + (z + sense t) = 0, t in units of the slowness of the wave, for
/// both e > 0; those for -e are their negatives. Of a conjugate pair one is given.
fn for_each_front(
    at: Point,
    radius: f64,
    k: f64,
    wave: Wave,
    sense: Sense,
    mut f: impl FnMut(Complex64),
) {
    let slowness = match wave {
        Wave::P => 1.0,
        Wave::S => k.sqrt(),
    };
    let (z, t) = (at.z, sense.sign() * at.t / slowness);
    let mut emit = |u: Complex64| {
        if u.is_finite() {
            f(u);
        }
    };
    for e in edges(at.r, radius) {
        let reach = z.hypot(e);
        let discriminant = (reach - t) * (reach + t);
        if discriminant >= 0.0 {
            let w = e + discriminant.sqrt();
            emit((w / (t - z)).into());
            emit(((z + t) / w).into());
        } else {
            emit(Complex64::new(e, (-discriminant).sqrt()) / (t - z));
        }
    }
}
