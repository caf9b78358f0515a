//! The potentials far from the disc: the multipole series.
//!
//! Expanding the chord integral about its centre,
//!
//! ```text
//! A_3 = sum_j (-1)^j M_2j Q_2j                 Q_k = P_k(zeta/rho)/rho^{k+1} = E_{-k}/k!
//! B_3/r = M_0/(rho (rho + zeta)) + sum_{j>0} (-1)^j M_2j V_2j/(2j)      V_k = P_k'(zeta/rho)/rho^{k+2}
//! ```
//!
//! with zeta = xi, the even moments M_2j of the chord function and the Legendre polynomials P_k. The series replaces
//! the closed form where that is a difference of large numbers.
//!
//! Theory: `docs/theory.md` (T20).

use crate::numeric::scalar::{Complex, Real, Scalar};
use crate::potentials::{IMPULSE, Order, Potentials, STEP};
use crate::profile::Profile;
use std::f64::consts::PI;

/// Largest number of terms of the series.
const MOST_TERMS: usize = 8;

/// Distance from which the series is used; farther out the closed forms lose digits, those of the time integral at
/// smaller distances.
#[inline(always)]
fn nearest<const N: i32>(r: f64) -> f64 {
    match Order::of(N) {
        Order::Step if r > 0.3 => 10.0,
        Order::Impulse | Order::Step | Order::StepIntegral => 7.0,
    }
}

/// Regions of the closed forms and of the multipole series.
pub(crate) struct Reach<C: Complex> {
    distance: C::Part,
    nearest: C::Part,
    pub(crate) some_near: bool,
    pub(crate) some_far: bool,
}

impl<C: Complex> Reach<C> {
    #[inline(always)]
    pub(crate) fn new<const N: i32>(xi: C, r: f64) -> Self {
        let nearest = nearest::<N>(r);
        let gap = (xi.im().abs() - r).abs();
        let square = xi.re() * xi.re();
        if (gap + xi.re()).largest() + 1.0 < nearest {
            return Self {
                distance: gap,
                nearest: gap.constant(nearest),
                some_near: true,
                some_far: false,
            };
        }
        let (inner, outer) = (gap - 1.0, gap + 1.0);
        let distance = ((inner * inner + square).sqrt() + (outer * outer + square).sqrt()) * 0.5;
        Self {
            distance,
            nearest: gap.constant(nearest),
            some_near: distance.smallest() < nearest,
            some_far: distance.largest() >= nearest,
        }
    }

    #[inline(always)]
    pub(crate) fn pick(&self, near: Potentials<C>, far: Potentials<C>) -> Potentials<C> {
        near.zip(far, |near, far| {
            C::where_below(self.distance, self.nearest, near, far)
        })
    }
}

/// Number of terms for an error of exp(-`digits`) at the smallest distance at which the series is used.
#[inline(always)]
fn terms(digits: f64) -> usize {
    /// 1 over twice the logarithm of the smallest distance.
    const A_DIGIT: f64 = 0.257;
    ((A_DIGIT * digits).ceil() as usize).clamp(2, MOST_TERMS)
}

/// Even moments M_2j of the chord function.
#[inline(always)]
const fn moment(profile: Profile, j: usize) -> f64 {
    let odd = (2 * j + 1) as f64;
    match profile {
        Profile::Hertz => 1.5 / (PI * odd * (odd + 2.0)),
        Profile::Punch => 0.5 / (PI * odd),
        Profile::Point if j == 0 => 0.5 / PI,
        Profile::Point => 0.0,
    }
}

/// Factors of one term of the series of a profile.
struct Term {
    /// M_2j, and M_2j over k = 2j.
    moment: f64,
    moment_over_k: f64,
    /// 1/(k + 1) and 1/(k + 2).
    inverse: [f64; 2],
}

const fn terms_of(profile: Profile) -> [Term; MOST_TERMS] {
    const NONE: Term = Term {
        moment: 0.0,
        moment_over_k: 0.0,
        inverse: [0.0; 2],
    };
    let mut terms = [NONE; MOST_TERMS];
    let mut j = 0;
    while j < MOST_TERMS {
        let (moment, k) = (moment(profile, j), 2.0 * j as f64);
        terms[j] = Term {
            moment,
            moment_over_k: moment / k,
            inverse: [1.0 / (k + 1.0), 1.0 / (k + 2.0)],
        };
        j += 1;
    }
    terms
}

/// Terms of each profile, in the order of their declaration.
static TERMS: [[Term; MOST_TERMS]; 3] = [
    terms_of(Profile::Hertz),
    terms_of(Profile::Punch),
    terms_of(Profile::Point),
];

/// The series of the two orders without the terms in M_0 that are not Q_0, Q_1 or V_1.
///
/// `alternate` is the factor from one j to the next, `over` is zeta/rho^2, `inverse2` 1/rho^2, `q0` 1/rho.
#[inline(always)]
fn sums<const N: i32, T: Scalar>(
    profile: Profile,
    terms: usize,
    alternate: f64,
    over: T,
    inverse2: T,
    q0: T,
) -> Potentials<T> {
    let zero = q0.constant(0.0);
    let mut sum = Potentials::all(zero);
    // Q_{2j-1}, Q_{2j}, V_{2j-1}, V_{2j}
    let (mut q_odd, mut q_even) = (zero, q0);
    let (mut v_odd, mut v_even) = (zero, zero);
    let mut sign = 1.0;
    for (j, term) in TERMS[profile as usize].iter().take(terms).enumerate() {
        let k = 2.0 * j as f64;
        let m = sign * term.moment;
        let q_next = (over * q_even * (2.0 * k + 1.0) - inverse2 * q_odd * k) * term.inverse[0];
        let v_next = (v_odd + q_even * (2.0 * k + 1.0)) * inverse2;
        match Order::of(N) {
            Order::Impulse => {
                sum.a_upper = sum.a_upper + q_next * (m * (k + 1.0));
                sum.g_upper = sum.g_upper + v_next * m;
            }
            Order::Step => {
                sum.a_upper = sum.a_upper + q_even * m;
                sum.a_lower = sum.a_lower + q_next * (m * (k + 1.0));
                sum.g_lower = sum.g_lower + v_next * m;
                if j > 0 {
                    sum.g_upper = sum.g_upper + v_even * (sign * term.moment_over_k);
                }
            }
            Order::StepIntegral => {
                sum.a_lower = sum.a_lower + q_even * m;
                if j > 0 {
                    sum.a_upper = sum.a_upper + q_odd * (sign * term.moment_over_k);
                    sum.g_upper = sum.g_upper + v_odd * (m / (k * (k - 1.0)));
                    sum.g_lower = sum.g_lower + v_even * (sign * term.moment_over_k);
                }
            }
        }
        q_even =
            (over * q_next * (2.0 * k + 3.0) - inverse2 * q_even * (k + 1.0)) * term.inverse[1];
        q_odd = q_next;
        v_even = (v_even + q_next * (2.0 * k + 3.0)) * inverse2;
        v_odd = v_next;
        if N == IMPULSE {
            sum.a_lower = sum.a_lower + q_even * (m * (k + 1.0) * (k + 2.0));
            sum.g_lower = sum.g_lower + v_even * (m * (k + 1.0));
        }
        sign *= alternate;
    }
    sum
}

/// The potentials by the series.
#[inline(always)]
pub(crate) fn potentials<const N: i32, C: Complex>(
    profile: Profile,
    xi: C,
    (r, digits): (f64, f64),
) -> Potentials<C> {
    let rho = xi.root_with_circle(r);
    let inverse = rho.reciprocal();
    let square = inverse * inverse;
    let sum = (rho + xi).reciprocal();
    let mut psi = sums::<N, C>(profile, terms(digits), -1.0, xi * square, square, inverse);
    let mass = moment(profile, 0);
    match Order::of(N) {
        Order::Impulse => {}
        Order::Step => psi.g_upper = psi.g_upper + inverse * sum * mass,
        Order::StepIntegral => {
            psi.a_upper = psi.a_upper - (rho + xi).logarithm() * mass;
            psi.g_upper = psi.g_upper + sum * mass;
            psi.g_lower = psi.g_lower + inverse * sum * mass;
        }
    }
    psi
}

/// The potentials of the step response at zeta = i s, where Q_k is i^k/rho and V_k is i^{k-1}/rho times a real number.
#[inline(always)]
pub(crate) fn on_imaginary_axis<T: Real>(
    profile: Profile,
    s: T,
    (r, digits): (f64, f64),
) -> Potentials<T::Complex> {
    let xi = T::Complex::new(s.constant(0.0), s);
    let square = (-s + r) * (s + r);
    let rho = xi.root_inside(square);
    let (inverse, inverse2) = (rho.reciprocal(), s.constant(1.0) / square);
    let one = s.constant(1.0);
    let sum = sums::<STEP, T>(profile, terms(digits), 1.0, s * inverse2, -inverse2, one);
    let mass = moment(profile, 0);
    Potentials {
        a_upper: inverse.times(sum.a_upper),
        a_lower: inverse.times(sum.a_lower).times_i(),
        g_upper: inverse.times(sum.g_upper).times_i() + inverse * (rho + xi).reciprocal() * mass,
        g_lower: inverse.times(-sum.g_lower),
    }
}
