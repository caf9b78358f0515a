//! The integrands of the step responses of the Hertz load and of the punch for several nodes at once.
//!
//! The same formulas as in [`fast`](crate::fast) and [`slow`](crate::slow), in vector registers, where most points lie:
//! off the axis, off the shallow layer, and not so far out that the closed forms lose digits.

use crate::chord_integral::chord_primitives;
use crate::closed_form::SMALL_RADIUS;
use crate::compact::AXIS;
use crate::far_front::{self, C, Chord, FAR};
use crate::lanes::{Lanes, Pair, WIDTH, dispatch};
use crate::multipole;
use crate::order::{Order, Step, TimeOrder};
use crate::panels::Node;
use crate::point::{Point, Sense};
use crate::potentials::Potentials;
use crate::profile::Profile;
use crate::scalar::{Real, Scalar};
use crate::setting::Setting;
use crate::spectrum::{self, Wave, half_angle};
use crate::sum::Sum;
use pulp::{Simd, WithSimd};
use std::f64::consts::PI;

/// Whether the integrands at a point may be taken here.
pub(crate) fn applies<O: TimeOrder>(profile: Profile, at: Point, shallow: bool) -> bool {
    O::ORDER == Order::Step
        && match profile {
            Profile::Hertz => !shallow,
            Profile::Punch => at.r > 0.0,
            Profile::Point => false,
        }
}

/// Adds the nodes of one panel; a wave below slowness one has one sense, above it both.
pub(crate) fn add(
    setting: &Setting,
    at: Point,
    wave: Wave,
    sense: Option<Sense>,
    nodes: &[Node],
    sum: &mut Sum,
) {
    dispatch(Panel {
        setting,
        at,
        wave,
        sense,
        nodes,
        sum,
    });
}

struct Panel<'a> {
    setting: &'a Setting,
    at: Point,
    wave: Wave,
    sense: Option<Sense>,
    nodes: &'a [Node],
    sum: &'a mut Sum,
}

impl WithSimd for Panel<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Some(last) = self.nodes.last() else {
            return;
        };
        let zero = Lanes::all(simd, 0.0);
        let (mut value, mut square) = ([zero; 6], [zero; 6]);
        for chunk in self.nodes.chunks(WIDTH) {
            let node = |i: usize| chunk.get(i).unwrap_or(last);
            let place = Lanes::new(simd, std::array::from_fn(|i| node(i).place));
            let weight = Lanes::new(
                simd,
                std::array::from_fn(|i| chunk.get(i).map_or(0.0, |node| node.weight)),
            );
            let (jacobian, term) = match self.sense {
                Some(sense) => fast(self.setting, self.at, (self.wave, sense), place),
                None => slow(self.setting, self.at, self.wave, place),
            };
            let weight = weight * jacobian;
            let displacement =
                Lanes::new(simd, std::array::from_fn(|i| node(i).error.displacement));
            let stress = Lanes::new(simd, std::array::from_fn(|i| node(i).error.stress));
            for f in 0..6 {
                let x = weight * term[f];
                let error = if f < 2 { displacement } else { stress } * x;
                value[f] = value[f] + x;
                square[f] = square[f] + error * error;
            }
        }
        for f in 0..6 {
            self.sum
                .add_lanes(f, value[f].into_array(), square[f].into_array());
        }
    }
}

/// dx/du and the integrand at the half-angle u.
#[inline(always)]
fn fast<S: Simd>(
    setting: &Setting,
    at: Point,
    (wave, sense): (Wave, Sense),
    u: Lanes<S>,
) -> (Lanes<S>, [Lanes<S>; 6]) {
    let (x, p, jacobian) = half_angle(u);
    let eta = setting.eta(at, wave, sense, x, p);
    let psi = compact(setting.profile, eta, at.r);
    let amplitudes = spectrum::fast(wave, setting.k, x, p);
    (jacobian, amplitudes.fields(&psi, at.r))
}

/// dx/ds and the integrand at the stretched half-angle s.
#[inline(always)]
fn slow<S: Simd>(
    setting: &Setting,
    at: Point,
    wave: Wave,
    s: Lanes<S>,
) -> (Lanes<S>, [Lanes<S>; 6]) {
    let (k, profile) = (setting.k, setting.profile);
    let span = (k - 1.0).sqrt();
    let (q, dq) = setting.fixed.stretch.half_angle(s);
    let one = s.constant(1.0);
    let inverse = one / (q * q + 1.0);
    let p_abs = q * inverse * (2.0 * span);
    let y = (one - q) * (one + q) * inverse * span;
    let x = (p_abs * p_abs + 1.0).sqrt();
    let over_x = one / x;
    let (re, im) = spectrum::inverse_rayleigh(k, x, p_abs, y);
    let psi = match wave {
        Wave::P => {
            let xi = Pair {
                re: p_abs * over_x * at.z,
                im: over_x * -at.t,
            };
            let psi = if at.z == 0.0 {
                on_imaginary_axis(profile, xi.im, at.r)
            } else {
                potentials(profile, xi, at.r)
            };
            let factor = im * 2.0;
            Potentials {
                a_upper: factor * psi.a_upper.re,
                a_lower: factor * psi.a_lower.re,
                g_upper: factor * psi.g_upper.re,
                g_lower: factor * psi.g_lower.re,
            }
        }
        Wave::S => {
            let minus = on_imaginary_axis(profile, (y * at.z - at.t) * over_x, at.r);
            let plus = on_imaginary_axis(profile, (y * at.z + at.t) * over_x, at.r);
            // the upper ones of A and the lower ones of B over i R, the others over R
            let inverse = Pair { re, im };
            Potentials {
                a_upper: ((minus.a_upper + plus.a_upper) * inverse).im,
                a_lower: ((minus.a_lower + plus.a_lower) * inverse).re,
                g_upper: ((minus.g_upper + plus.g_upper) * inverse).re,
                g_lower: ((minus.g_lower + plus.g_lower) * inverse).im,
            }
        }
    };
    let amplitudes = spectrum::slow(wave, k, x, p_abs, y);
    // dx = p^ dp^/x, dp^ = 2 y/(1 + q^2) dq
    let jacobian = p_abs * y * inverse * over_x * dq * 2.0;
    (jacobian, amplitudes.fields(&psi, at.r))
}

/// (r - s)(r + s) at the ends s = eta -+ 1 of the chord, exact at the edge of the disc.
#[inline(always)]
fn inside<S: Simd>(eta: Lanes<S>, r: f64) -> [Lanes<S>; 2] {
    let (inner, outer) = (r - 1.0, r + 1.0);
    [
        (-eta + outer) * (eta + inner),
        (-eta + inner) * (eta + outer),
    ]
}

/// The chord primitives with phi and q held beyond the circle.
#[inline(always)]
fn held_primitives<S: Simd>(eta: Lanes<S>, r: f64, inside: [Lanes<S>; 2]) -> Potentials<Lanes<S>> {
    let zero = eta.constant(0.0);
    let s = [eta - 1.0, eta + 1.0];
    let q = [inside[0].max(zero).sqrt(), inside[1].max(zero).sqrt()];
    chord_primitives::<Step, Lanes<S>>(eta, r, [zero, angle_between(s, q)], q)
}

/// The difference of the angles of the vectors (q, s).
#[inline(always)]
fn angle_between<S: Simd>(s: [Lanes<S>; 2], q: [Lanes<S>; 2]) -> Lanes<S> {
    (s[1] * q[0] - s[0] * q[1]).angle_over(q[0] * q[1] + s[0] * s[1])
}

/// The limit r = 0, where the circle shrinks to a point of the chord.
#[inline(always)]
fn compact_on_axis<S: Simd>(eta: Lanes<S>) -> Potentials<Lanes<S>> {
    let (zero, one) = (eta.constant(0.0), eta.constant(1.0));
    let within = eta.abs();
    let eta = within.where_below(one, eta, zero);
    Potentials {
        a_upper: within.where_below(one, (one - eta * eta) * 0.375, zero),
        a_lower: eta * -0.75,
        g_upper: eta * -0.375,
        g_lower: within.where_below(one, one * 0.375, zero),
    }
}

/// The potentials near the axis, of both ends of the chord, E_1 to E_3 and F_1 to F_3.
#[inline(always)]
fn by_parts<S: Simd>(xi: Pair<S>, r: f64) -> Potentials<Pair<S>> {
    let Ends { zeta, rho, sum, .. } = Ends::new(xi, r);
    let [upper, lower] = [
        end(zeta[0], rho[0], sum[0], r),
        end(zeta[1], rho[1], sum[1], r),
    ];
    Potentials {
        a_upper: chord_of_ends([upper.e[2], lower.e[2]], [upper.e[1], lower.e[1]]),
        a_lower: chord_of_ends([upper.e[1], lower.e[1]], [upper.e[0], lower.e[0]]),
        g_upper: chord_of_ends([upper.f[2], lower.f[2]], [upper.f[1], lower.f[1]]),
        g_lower: chord_of_ends([upper.f[1], lower.f[1]], [upper.f[0], lower.f[0]]),
    }
}

/// The chord function of the Hertz load times a potential of a point force, of the antiderivatives at both ends.
#[inline(always)]
fn chord_of_ends<S: Simd>(outer: [Pair<S>; 2], inner: [Pair<S>; 2]) -> Pair<S> {
    ((outer[0] - outer[1]).times_minus_i() - (inner[0] + inner[1])) * (0.75 / PI)
}

/// E_1 to E_3 and F_1/r to F_3/r at one end of the chord.
struct End<S: Simd> {
    e: [Pair<S>; 3],
    f: [Pair<S>; 3],
}

#[inline(always)]
fn end<S: Simd>(zeta: Pair<S>, rho: Pair<S>, sum: Pair<S>, r: f64) -> End<S> {
    let log = Pair {
        re: sum.norm_sqr().at_least(f64::MIN_POSITIVE).ln() * 0.5,
        im: sum.im.angle_over(sum.re),
    };
    let least = sum.re.constant(f64::MIN_POSITIVE);
    // at the very singularity on the axis any finite value will do
    let held = Pair::where_below(sum.norm_sqr(), least, sum.constant(1e-100), sum);
    let over = held.reciprocal();
    let square = zeta * zeta;
    End {
        e: [
            log * -1.0,
            zeta * log - rho,
            zeta * rho * 0.75 + (square * -0.5 + 0.25 * r * r) * log,
        ],
        f: [
            over,
            (zeta * over + log) * -0.5,
            ((rho * sum + square) * over * (1.0 / 3.0) + zeta * log - rho) * 0.5,
        ],
    }
}

/// The compact parts of a punch.
#[inline(always)]
fn compact_punch<S: Simd>(eta: Lanes<S>, r: f64) -> Potentials<Lanes<S>> {
    let scale = 0.25 / PI;
    let ring = scale / (r * r);
    let (zero, one) = (eta.constant(0.0), eta.constant(1.0));
    let s = [eta - 1.0, eta + 1.0];
    let inside = inside(eta, r);
    let q = [inside[0].max(zero).sqrt(), inside[1].max(zero).sqrt()];
    let inverse = [
        zero.where_below(q[0], one / q[0], zero),
        zero.where_below(q[1], one / q[1], zero),
    ];
    Potentials {
        a_upper: angle_between(s, q) * scale,
        a_lower: (inverse[1] - inverse[0]) * scale,
        g_upper: (q[1] - q[0]) * ring,
        g_lower: (s[1] * inverse[1] - s[0] * inverse[0]) * ring,
    }
}

/// The potentials of a punch.
#[inline(always)]
fn punch<S: Simd>(xi: Pair<S>, r: f64) -> Potentials<Pair<S>> {
    let Ends { rho, sum, log, .. } = Ends::new(xi, r);
    // a node that rounds to the very front: as near as rounding lets it be
    let least = xi.re.constant(f64::MIN_POSITIVE);
    let held = xi.constant(f64::EPSILON.sqrt() * r);
    let rho = [
        Pair::where_below(rho[0].norm_sqr(), least, held, rho[0]),
        Pair::where_below(rho[1].norm_sqr(), least, held, rho[1]),
    ];
    let inverse = [rho[0].reciprocal(), rho[1].reciprocal()];
    let over = [sum[0].reciprocal(), sum[1].reciprocal()];
    let scale = 0.25 / PI;
    Potentials {
        a_upper: log.times_minus_i() * scale,
        a_lower: (inverse[0] - inverse[1]).times_minus_i() * scale,
        g_upper: (over[0] - over[1]).times_minus_i() * scale,
        g_lower: (inverse[0] * over[0] - inverse[1] * over[1]).times_minus_i() * scale,
    }
}

/// The ends of the chord: rho, zeta + rho, and the logarithm of the ratio of the sums.
struct Ends<S: Simd> {
    zeta: [Pair<S>; 2],
    rho: [Pair<S>; 2],
    sum: [Pair<S>; 2],
    log: Pair<S>,
}

impl<S: Simd> Ends<S> {
    #[inline(always)]
    fn new(xi: Pair<S>, r: f64) -> Self {
        let zeta = [
            Pair {
                im: xi.im - 1.0,
                ..xi
            },
            Pair {
                im: xi.im + 1.0,
                ..xi
            },
        ];
        let inside = inside(xi.im, r);
        let rho = [
            root_inside(zeta[0], inside[0]),
            root_inside(zeta[1], inside[1]),
        ];
        let sum = [zeta[0] + rho[0], zeta[1] + rho[1]];
        let ratio = sum[1] * sum[0].conj();
        let log = Pair {
            re: (sum[1].norm_sqr() / sum[0].norm_sqr()).ln() * 0.5,
            im: ratio.im.angle_over(ratio.re),
        };
        Self {
            zeta,
            rho,
            sum,
            log,
        }
    }
}

/// Where the closed forms hold and where the multipole series takes over.
struct Reach<S: Simd> {
    distance: Lanes<S>,
    /// Terms that the series needs; none where no lane is far.
    terms: usize,
    some_near: bool,
}

impl<S: Simd> Reach<S> {
    #[inline(always)]
    fn new(xi: Pair<S>, r: f64) -> Self {
        let nearest = multipole::nearest::<Step>(r);
        let gap = (xi.im.abs() - r).abs();
        let mut reach = Self {
            distance: gap,
            terms: 0,
            some_near: true,
        };
        if (gap + xi.re).largest() + 1.0 < nearest {
            return reach;
        }
        let square = xi.re * xi.re;
        let (inner, outer) = (gap - 1.0, gap + 1.0);
        reach.distance = ((inner * inner + square).sqrt() + (outer * outer + square).sqrt()) * 0.5;
        let mut least = f64::INFINITY;
        reach.some_near = false;
        for d in reach.distance.into_array() {
            if d >= nearest {
                least = least.min(d);
            } else {
                reach.some_near = true;
            }
        }
        if least.is_finite() {
            reach.terms = multipole::terms_at(least);
        }
        reach
    }

    #[inline(always)]
    fn pick(
        &self,
        near: Potentials<Pair<S>>,
        far: Potentials<Pair<S>>,
        r: f64,
    ) -> Potentials<Pair<S>> {
        let (distance, limit) = (
            self.distance,
            self.distance.constant(multipole::nearest::<Step>(r)),
        );
        Potentials {
            a_upper: Pair::where_below(distance, limit, near.a_upper, far.a_upper),
            a_lower: Pair::where_below(distance, limit, near.a_lower, far.a_lower),
            g_upper: Pair::where_below(distance, limit, near.g_upper, far.g_upper),
            g_lower: Pair::where_below(distance, limit, near.g_lower, far.g_lower),
        }
    }
}

/// The potentials at xi off the imaginary axis.
#[inline(always)]
fn potentials<S: Simd>(profile: Profile, xi: Pair<S>, r: f64) -> Potentials<Pair<S>> {
    let reach = Reach::new(xi, r);
    let nothing = Potentials::all(xi.constant(0.0));
    let near = match profile {
        _ if !reach.some_near => nothing,
        Profile::Hertz if r > FAR => at_far_front(xi, r),
        Profile::Hertz if r <= SMALL_RADIUS => by_parts(xi, r),
        Profile::Hertz => by_primitives(xi, r),
        Profile::Punch | Profile::Point => punch(xi, r),
    };
    if reach.terms == 0 {
        return near;
    }
    reach.pick(near, by_series(profile, xi, r, reach.terms), r)
}

/// The potentials on the imaginary axis, where real and imaginary part are apart.
#[inline(always)]
fn on_imaginary_axis<S: Simd>(profile: Profile, eta: Lanes<S>, r: f64) -> Potentials<Pair<S>> {
    let zero = eta.constant(0.0);
    let xi = Pair { re: zero, im: eta };
    let reach = Reach::new(xi, r);
    let nothing = Potentials::all(xi.constant(0.0));
    let near = match profile {
        _ if !reach.some_near => nothing,
        Profile::Hertz if r > FAR => at_far_front(xi, r),
        Profile::Hertz if r <= SMALL_RADIUS => by_parts(xi, r),
        Profile::Hertz => primitives_on_imaginary_axis(eta, r),
        Profile::Punch | Profile::Point => punch(xi, r),
    };
    if reach.terms == 0 {
        return near;
    }
    reach.pick(
        near,
        series_on_imaginary_axis(profile, eta, r, reach.terms),
        r,
    )
}

/// The compact parts.
#[inline(always)]
fn compact<S: Simd>(profile: Profile, eta: Lanes<S>, r: f64) -> Potentials<Lanes<S>> {
    if profile != Profile::Hertz {
        return compact_punch(eta, r);
    }
    if r < AXIS {
        return compact_on_axis(eta);
    }
    if r <= FAR {
        return held_primitives(eta, r, inside(eta, r));
    }
    let zero = eta.constant(0.0);
    let pair = |re, im| Pair { re, im };
    let distance = eta.abs();
    let reach = Reach::new(pair(zero, distance), r);
    let mut psi = Potentials::all(pair(zero, zero));
    if reach.some_near {
        let (delta, terms) = far_delta(eta, r);
        let root = [delta[0].max(zero).sqrt(), delta[1].max(zero).sqrt()];
        let near = far_front::compact_of(far_front::chord(delta, root, terms, r), r);
        psi = Potentials {
            a_upper: pair(near.a_upper, zero),
            a_lower: pair(zero, near.a_lower),
            g_upper: pair(zero, near.g_upper),
            g_lower: pair(near.g_lower, zero),
        };
    }
    if reach.terms > 0 {
        psi = reach.pick(
            psi,
            series_on_imaginary_axis(Profile::Hertz, distance, r, reach.terms),
            r,
        );
    }
    // a2 and b3 are odd
    Potentials {
        a_upper: psi.a_upper.re,
        a_lower: eta.where_below(zero, -psi.a_lower.im, psi.a_lower.im),
        g_upper: eta.where_below(zero, -psi.g_upper.im, psi.g_upper.im),
        g_lower: psi.g_lower.re,
    }
}

/// The multipole series.
#[inline(always)]
fn by_series<S: Simd>(profile: Profile, xi: Pair<S>, r: f64, terms: usize) -> Potentials<Pair<S>> {
    let inside = (-xi.im + r) * (xi.im + r);
    let rho = root_inside(xi, inside);
    let inverse = rho.reciprocal();
    let square = inverse * inverse;
    let sum = (rho + xi).reciprocal();
    let mut psi =
        multipole::sums::<Step, Pair<S>>(profile, terms, -1.0, xi * square, square, inverse);
    let mass = multipole::moment(profile, 0);
    psi.g_upper = psi.g_upper + inverse * sum * mass;
    psi
}

/// The multipole series at zeta = i s, where Q_k is i^k/rho and V_k is i^{k-1}/rho times a real number.
#[inline(always)]
fn series_on_imaginary_axis<S: Simd>(
    profile: Profile,
    s: Lanes<S>,
    r: f64,
    terms: usize,
) -> Potentials<Pair<S>> {
    let zero = s.constant(0.0);
    let xi = Pair { re: zero, im: s };
    let square = (-s + r) * (s + r);
    let rho = root_inside(xi, square);
    let (inverse, inverse2) = (rho.reciprocal(), s.constant(1.0) / square);
    let sum = multipole::sums::<Step, Lanes<S>>(
        profile,
        terms,
        1.0,
        s * inverse2,
        -inverse2,
        s.constant(1.0),
    );
    let mass = multipole::moment(profile, 0);
    Potentials {
        a_upper: inverse.times(sum.a_upper),
        a_lower: inverse.times(sum.a_lower).times_i(),
        g_upper: inverse.times(sum.g_upper).times_i() + inverse * (rho + xi).reciprocal() * mass,
        g_lower: inverse.times(-sum.g_lower),
    }
}

/// sqrt(d^2 + inside + 2 i d s) for zeta = d + i s, d >= 0.
#[inline(always)]
fn root_inside<S: Simd>(zeta: Pair<S>, inside: Lanes<S>) -> Pair<S> {
    let Pair { re: d, im: s } = zeta;
    let root = Pair {
        re: d * d + inside,
        im: d * s * 2.0,
    }
    .root();
    // on the axis the side is that of s
    Pair {
        im: root.im.abs().copysign(s),
        ..root
    }
}

/// The chord primitives at complex xi, phi = -i L and q = rho in the variable eta = -i xi.
#[inline(always)]
fn by_primitives<S: Simd>(xi: Pair<S>, r: f64) -> Potentials<Pair<S>> {
    let Ends { rho, log, .. } = Ends::new(xi, r);
    let phi = [log.constant(0.0), log.times_minus_i()];
    let psi = chord_primitives::<Step, Pair<S>>(xi.times_minus_i(), r, phi, rho);
    from_primitives(psi, r)
}

/// The same on the imaginary axis.
#[inline(always)]
fn primitives_on_imaginary_axis<S: Simd>(eta: Lanes<S>, r: f64) -> Potentials<Pair<S>> {
    let zero = eta.constant(0.0);
    let s = [eta - 1.0, eta + 1.0];
    let inside = inside(eta, r);
    let re = held_primitives(eta, r, inside);
    let w = [(-inside[0]).max(zero).sqrt(), (-inside[1]).max(zero).sqrt()];
    let modulus = [s[0].abs().at_least(r) + w[0], s[1].abs().at_least(r) + w[1]];
    let log = [zero, (modulus[0] / modulus[1]).ln()];
    let w = [w[0].copysign(s[0]), w[1].copysign(s[1])];
    let im = chord_primitives::<Step, Lanes<S>>(eta, r, log, w);
    let pair = |re, im| Pair { re, im };
    from_primitives(
        Potentials {
            a_upper: pair(re.a_upper, im.a_upper),
            a_lower: pair(re.a_lower, im.a_lower),
            g_upper: pair(re.g_upper, im.g_upper),
            g_lower: pair(re.g_lower, im.g_lower),
        },
        r,
    )
}

/// delta = r - |eta| -+ 1 of a distant point, and the number of terms that the lanes next to the front need.
#[inline(always)]
fn far_delta<S: Simd>(eta: Lanes<S>, r: f64) -> ([Lanes<S>; 2], usize) {
    /// Farther from the front the multipole series is taken.
    const LARGEST: f64 = 12.0;
    let distance = eta.abs();
    let delta = [-distance + (r - 1.0), -distance + (r + 1.0)];
    let size = delta[0].abs().max(delta[1].abs()).largest();
    (delta, far_front::terms(size.min(LARGEST), r))
}

/// The potentials of a distant point.
#[inline(always)]
fn at_far_front<S: Simd>(xi: Pair<S>, r: f64) -> Potentials<Pair<S>> {
    let zero = xi.re.constant(0.0);
    let (real, terms) = far_delta(xi.im, r);
    let delta = [
        Pair {
            re: real[0],
            im: xi.re,
        },
        Pair {
            re: real[1],
            im: xi.re,
        },
    ];
    let root = [delta[0].root(), delta[1].root()];
    let Chord { i, k } = far_front::chord(delta, root, terms, r);
    let ring = C / (r * r);
    let psi = Potentials {
        a_upper: i[0] * C,
        a_lower: k[0].times_minus_i() * (2.0 * C),
        g_upper: ((i[0] * r - i[1]).times_minus_i() + 4.0 / 3.0) * ring,
        g_lower: (k[0] * r - k[1]) * (-2.0 * ring),
    };
    // the conjugate where xi is below the real axis
    Potentials {
        a_upper: Pair::where_below(xi.im, zero, psi.a_upper.conj(), psi.a_upper),
        a_lower: Pair::where_below(xi.im, zero, psi.a_lower.conj(), psi.a_lower),
        g_upper: Pair::where_below(xi.im, zero, psi.g_upper.conj(), psi.g_upper),
        g_lower: Pair::where_below(xi.im, zero, psi.g_lower.conj(), psi.g_lower),
    }
}

/// Powers of i from the change of variable, and the part that is free of roots.
#[inline(always)]
fn from_primitives<S: Simd>(psi: Potentials<Pair<S>>, r: f64) -> Potentials<Pair<S>> {
    let force = 0.5 / (PI * r * r);
    Potentials {
        a_upper: psi.a_upper,
        a_lower: psi.a_lower.times_i(),
        g_upper: psi.g_upper.times_i() + force,
        g_lower: psi.g_lower,
    }
}
