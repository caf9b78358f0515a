//! The potentials far from the chord: the multipole series, and the front of a distant point.

use super::near::root_inside;
use crate::numeric::lanes::{Lanes, Pair};
use crate::numeric::scalar::{Real, Scalar};
use crate::potentials::Potentials;
use crate::potentials::far_front;
use crate::potentials::multipole;
use crate::potentials::order::STEP;
use crate::profile::Profile;
use pulp::Simd;

/// Largest distance behind a front for which the multipole series is not taken, whatever is beside it in a register.
pub(super) const LARGEST: f64 = 12.0;

/// The multipole series.
#[inline(always)]
pub(super) fn by_series<S: Simd>(
    profile: Profile,
    xi: Pair<S>,
    (r, digits): (f64, f64),
) -> Potentials<Pair<S>> {
    let inside = (-xi.im + r) * (xi.im + r);
    let rho = root_inside(xi, inside);
    let inverse = rho.reciprocal();
    let square = inverse * inverse;
    let sum = (rho + xi).reciprocal();
    let over = xi * square;
    let mut psi = multipole::sums::<STEP, Pair<S>>(
        profile,
        multipole::terms_to(digits),
        -1.0,
        over,
        square,
        inverse,
    );
    let mass = multipole::moment(profile, 0);
    psi.g_upper = psi.g_upper + inverse * sum * mass;
    psi
}

/// The multipole series at zeta = i s, where Q_k is i^k/rho and V_k is i^{k-1}/rho times a real number.
#[inline(always)]
pub(super) fn series_on_imaginary_axis<S: Simd>(
    profile: Profile,
    s: Lanes<S>,
    (r, digits): (f64, f64),
) -> Potentials<Pair<S>> {
    let zero = s.constant(0.0);
    let xi = Pair { re: zero, im: s };
    let square = (-s + r) * (s + r);
    let rho = root_inside(xi, square);
    let (inverse, inverse2) = (rho.reciprocal(), s.constant(1.0) / square);
    let sum = multipole::sums::<STEP, Lanes<S>>(
        profile,
        multipole::terms_to(digits),
        1.0,
        s * inverse2,
        -inverse2,
        s.constant(1.0),
    );
    let mass = multipole::moment(profile, 0);
    Potentials {
        a_upper: inverse * sum.a_upper,
        a_lower: (inverse * sum.a_lower).times_i(),
        g_upper: (inverse * sum.g_upper).times_i() + inverse * (rho + xi).reciprocal() * mass,
        g_lower: inverse * -sum.g_lower,
    }
}

#[inline(always)]
fn root_of_real<S: Simd>(value: Lanes<S>) -> Pair<S> {
    let zero = value.constant(0.0);
    Pair::new(value.max(zero).sqrt(), (-value).max(zero).sqrt())
}

/// The potentials of a distant point, on the imaginary axis or off it.
#[inline(always)]
pub(super) fn at_far_front<S: Simd>(
    xi: Pair<S>,
    (r, digits): (f64, f64),
    on_axis: bool,
) -> Potentials<Pair<S>> {
    let zero = xi.re.constant(0.0);
    let delta = far_front::delta(xi.im, r);
    let terms = far_front::terms(LARGEST, r, digits);
    let chord = if on_axis {
        let root = [root_of_real(delta[0]), root_of_real(delta[1])];
        far_front::chord(delta, root, terms, r)
    } else {
        let delta = [Pair::new(delta[0], xi.re), Pair::new(delta[1], xi.re)];
        far_front::chord(delta, [delta[0].root(), delta[1].root()], terms, r)
    };
    let psi = far_front::of_chord(chord, r, Pair::times_minus_i);
    // the conjugate where xi is below the real axis
    psi.map(|v| Pair::where_below(xi.im, zero, v.conj(), v))
}
