"""Step response of the half-space under a Hertz disc by steepest-descent contours in the slowness plane.

Units: r0 = c1 = mu = 1, unit force.  With s = k q the Laplace-Hankel solution of a step load is

    H(r,z,t) = 1/(2 pi i) int dq/q  sum_{P,S} N(q)/D(q)  A_n(gamma z - q t; r),      gamma = a or b,
    a = sqrt(1+q^2),  b = sqrt(1+q^2/kappa^2),  g = 2+q^2/kappa^2,  D = g^2-4ab,

where A_n(xi; r) = int_0^inf Z_H(k) k^(3-n) J(kr) exp(-k xi) dk is the potential of the loaded disc.

1.  A_n is not taken in closed form.  Z_H(k) = (3/(8 pi)) int_{-1}^{1} (1-s^2) cos(ks) ds (the chord, or Radon,
    transform of the disc) gives, with zeta = xi - i s, R = sqrt(zeta^2+r^2), Q = 1/(R (R+zeta)),

        A3 =  C int (1-s^2)/R ds      A2 = -2 i C int s/R ds
        B3 = rC int (1-s^2) Q ds      B2 = -2 i rC int s Q ds          C = 3/(8 pi),

    the response of a point source at a complex position; all singularities of the integrand lie in Im s <= 0
    when Re xi >= 0.  The chord integral is done by Gauss-Legendre on the straight chord when the singularities are
    far, and by the tanh-sinh rule on the upper unit half-circle when they are near.

2.  The Bromwich line Re q > 0 is bent, separately for P and S, into a path on which Re(xi) >= 0 everywhere, so that
    the k-integral behind A_n converges on the whole path.  In the plane of theta,

        P: q = sinh(theta), a = cosh(theta)      S: q = kappa sinh(theta), b = cosh(theta)
        xi = gamma z - q t = -T sinh(theta - theta0),   T = sqrt(v^2 t^2 - z^2),  tanh(theta0) = z/(v t),

    the saddle sits at theta0 + i pi/2, the half strip left of and below it and the one right of and above it are the
    two valleys (v = 1 or kappa; a wave with t < z/v gives nothing).  The path is a polyline through the saddle and
    through the branch point of the other root (the head wave), so every front is an end point of a segment.

3.  The path runs to the left of the poles at q = 0 and q = +-ic, whose residues are the static field and the Rayleigh
    wave.  `poles=False` selects a path on the right of all poles instead; it exists when z > 0 and must give the same number.

4.  Every segment is integrated with the tanh-sinh rule, halving the step until two steps agree, and split if they do not.

Arithmetic: python-flint balls, 160 bits.
"""

import math
from functools import lru_cache

from flint import acb, acb_mat, arb

from quadrature import I, PI, exact, integrate, mid, tanh_sinh

TOL = 1e-17  # two successive tanh-sinh steps agree to this; the error of the finer one is about its square
C = 3 / (8 * PI)


# ------------------------------------------------------------------ rules


class ChordRule:
    """Nodes of the chord with their two weights (1-s^2) ds and s ds."""

    def __init__(self, rows):
        self.i_minus = [mid(I * m) for m, _, _ in rows]  # i (1-s)
        self.i_plus = [mid(I * p) for _, p, _ in rows]  # i (1+s)
        self.w = acb_mat(len(rows), 2, [v for m, p, d in rows for v in (mid(d * m * p), mid(d * (1 - m)))])
        self.w0 = acb_mat(len(rows), 1, [mid(d) for _, _, d in rows])

    def sums(self, xi, r):
        """[int (1-s^2)/R, int s/R, int (1-s^2) Q, int s Q]."""
        inv, q = self.kernels(xi, r)
        n = len(inv)
        x = acb_mat(2, n, inv + q) * self.w
        return x[0, 0], x[0, 1], x[1, 0], x[1, 1]

    def kernels(self, xi, r):
        up = xi + I * (r - 1)  # zeta + i r = up + i(1-s)
        dn = xi - I * (r - 1)  # zeta - i r = dn - i(1+s)
        zeta0 = xi - I
        inv, q = [], []
        for m, p in zip(self.i_minus, self.i_plus):
            zp = up + m
            zm = dn - p
            v = zp.rsqrt() * zm.rsqrt()
            inv.append(v)
            q.append(v / (zp * zm * v + (zeta0 + m)))
        return inv, q


@lru_cache(None)
def arc_rule(steps):
    """Upper half-circle s = exp(i phi); step 1/steps."""
    rows = []
    for x, y, wt in tanh_sinh(arb(1) / steps, cut=150.0):  # inverse square roots at the ends
        half = PI * y / 2
        e = (I * half).exp()
        rows.append((-2 * I * half.sin() * e, 2 * (PI * x / 2).sin() * e, -I * PI * e * e * wt))
    return ChordRule(rows)


@lru_cache(None)
def gauss_rule(n):
    rows = []
    for k in range(n):
        s, wt = arb.legendre_p_root(n, k, weight=True)
        rows.append((acb(1 - s), acb(1 + s), acb(wt)))
    return ChordRule(rows)


def chord_rule(xi, r):
    """The cheapest rule that is good for about 28 digits, from the distance of the singular points s = -i xi +- r."""
    x, y, rr = float(xi.real), float(xi.imag), float(r)
    rho = math.inf
    for sgn in (1, -1):
        s = complex(y + sgn * rr, -x)
        root = (s - 1) ** 0.5 * (s + 1) ** 0.5
        rho = min(rho, max(abs(s + root), abs(s - root)))
    if rho > 1.45:
        need = 66.0 / (2 * math.log(rho)) + 2
        for n in (12, 16, 24, 32, 48, 64, 96):
            if n >= need:
                return gauss_rule(n)
    delta = min(math.hypot(x, y - e) for e in (rr - 1, rr + 1, 1 - rr, -1 - rr))
    for steps, lim in ((20, 0.3), (32, 0.03), (48, 1e-3), (64, 1e-5), (96, 1e-8)):
        if delta > lim:
            return arc_rule(steps)
    return arc_rule(128)


def potentials(xi, r, rule=None):
    """A3, A2, B3/r, B2/r."""
    a, b, c, d = (rule or chord_rule(xi, r)).sums(xi, r)
    return C * a, -2 * I * C * b, C * c, -2 * I * C * d


def potentials_1(xi, r):
    """A1, B1/r = -d/dxi of A2, B2/r, by parts; Re xi > 0."""
    rule = chord_rule(xi, r)
    f, q = rule.kernels(xi, r)
    out = []
    ends = []
    for zeta in (xi - I, xi + I):
        R = (zeta + I * r).sqrt() * (zeta - I * r).sqrt()
        ends.append((1 / R, 1 / (R * (R + zeta))))
    for i, vals in enumerate((f, q)):
        total = (acb_mat(1, len(vals), vals) * rule.w0)[0, 0]
        out.append(-2 * C * (ends[0][i] + ends[1][i] - total))
    return out


# ------------------------------------------------------------------ half-space


class Solid:
    def __init__(self, nu):
        nu = exact(nu)
        self.nu = nu
        self.k2 = (1 - 2 * nu) / (2 - 2 * nu)
        self.kappa = self.k2.sqrt()
        self.lam = 2 * nu / (1 - 2 * nu)
        self.c = self._rayleigh()

    def _rayleigh(self):
        """Root of the Rayleigh cubic in (c_R/c2)^2 below 1, by Newton steps from a bisected start."""
        f = lambda x: ((x - 8) * x + 24 - 16 * self.k2) * x - 16 * (1 - self.k2)
        lo, hi = 0.05, 1.0
        for _ in range(50):
            m = (lo + hi) / 2
            lo, hi = (m, hi) if float(f(arb(m))) < 0 else (lo, m)
        x = arb(lo)
        for _ in range(8):
            x = (x - f(x) / ((3 * x - 16) * x + 24 - 16 * self.k2)).mid()
        return self.kappa * x.sqrt()


def numer_p(q, a, b, g, s):
    """(w, u, szz, srz, srr_A, srr_B, stt_A, stt_B) numerators of P: w A3, u B3, szz A2, srz B2, A2 and B3/r."""
    l2 = s.lam * q * q
    return a * g, g, -g * g, -2 * a * g, g * (2 - l2), -2 * g, -l2 * g, 2 * g


def numer_s(q, a, b, g, s):
    ab = a * b
    return -2 * a, -2 * ab, 4 * ab, 2 * a * g, -4 * ab, 4 * ab, acb(0), -4 * ab


def combine(num, factor, xi, r):
    """The six fields (order FIELDS) of one wave at one slowness."""
    a3, a2, b3, b2 = potentials(xi, r)
    w, u, szz, srz, ra, rb, ta, tb = num
    return [
        factor * u * b3 * r,
        factor * w * a3,
        factor * (ra * a2 + rb * b3),
        factor * (ta * a2 + tb * b3),
        factor * szz * a2,
        factor * srz * b2 * r,
    ]


def static_field(s, r, z):
    """Boussinesq-Huber field of the disc."""
    a3, a2, b3, b2 = [v.real for v in potentials(acb(z), r)]
    a1 = b1 = arb(0)
    if not z == 0:
        a1, b1 = [v.real for v in potentials_1(acb(z), r)]
    u = (z * b2 - (1 - 2 * s.nu) * b3) / 2  # over r
    return [u * r, (2 * (1 - s.nu) * a3 + z * a2) / 2, z * a1 - a2 - 2 * u, 2 * u - 2 * s.nu * a2, -(a2 + z * a1), -z * b1 * r]


def rayleigh_residue(s, r, z, t, with_s):
    """Residues at +-ic; the one of S only if its path passes on the left of the pole."""
    c = s.c
    q = acb(0, c)
    a, b = acb((1 - c * c).sqrt()), acb((1 - c * c / s.k2).sqrt())
    g = 2 - c * c / s.k2
    d_prime = q * (4 * g / s.k2 - 4 * b / a - 4 * a / (s.k2 * b))
    f = 2 / (q * d_prime)
    p = combine(numer_p(q, a, b, acb(g), s), f, a * z - q * t, r)
    if not with_s:
        return [x.real for x in p]
    h = combine(numer_s(q, a, b, acb(g), s), f, b * z - q * t, r)
    return [(x + y).real for x, y in zip(p, h)]


class Wave:
    """One wave (P or S) at one point: its plane of theta, its path and its integrand."""

    def __init__(self, solid, r, z, t, shear):
        self.s, self.r, self.z, self.t, self.shear = solid, r, z, t, shear
        self.v = solid.kappa if shear else arb(1)
        self.t2 = self.v * self.v * t * t - z * z
        if not self.t2 > 0:
            return
        self.T = self.t2.sqrt()
        self.th0 = (z / (self.v * t)).atanh()
        self.saddle = acb(self.th0, PI / 2)

    # integrand at theta, times d theta
    def at(self, theta, other):
        s = self.s
        sh, ch = theta.sinh_cosh()
        q = self.v * sh
        if self.shear:
            a, b = other(q), ch
        else:
            a, b = ch, other(q)
        g = 2 + q * q / s.k2
        factor = ch / (sh * (g * g - 4 * a * b))
        num = (numer_s if self.shear else numer_p)(q, a, b, g, s)
        return combine(num, factor, -self.T * (theta - self.th0).sinh(), self.r)

    def segment(self, start, end, other):
        d = end - start

        def f(x, y):
            th = start + d * x if float(x) < 0.5 else end - d * y
            return [v * d for v in self.at(th, other)]

        return integrate(f, TOL)

    def ray(self, start, sign, other):
        """Horizontal ray from start to +-infinity, theta = start - sign log(rho); direction start -> infinity."""

        def f(x, y):
            return [v * sign / x for v in self.at(start - sign * x.log(), other)]

        return integrate(f, TOL)


def p_wave(wv, poles):
    """Upper half of the path of P; returns the sum of its integrals."""
    s, k = wv.s, wv.s.kappa

    def b_right(q):  # cut from i kappa to the left
        return (q - I * k).sqrt() * (q + I * k).sqrt() / k

    parts = []
    quarter = PI / 4
    th0 = float(wv.th0)
    if poles:
        branch = acb(0, k.asin())

        def below(x, y):  # q = i kappa - kappa y/x, y/x from infinity to 0
            e = k * y / x
            q = I * k - e
            a = (1 + q * q).sqrt()
            b = acb(e).sqrt() * (e - 2 * I * k).sqrt() / k
            g = 2 + q * q / s.k2
            factor = k / (x * x * q * (g * g - 4 * a * b))
            return combine(numer_p(q, a, b, g, s), factor, a * wv.z - q * wv.t, wv.r)

        parts.append(integrate(below, TOL))
        if th0 > 1.0:
            corner = wv.saddle - acb(quarter, quarter)
        else:
            length = float(abs(wv.saddle - branch))
            corner = (branch + wv.saddle) / 2 - 0.13 * length
        parts.append(wv.segment(branch, corner, b_right))
        parts.append(wv.segment(corner, wv.saddle, b_right))
    else:
        x0 = wv.th0 / 2 if th0 < 2 else arb(1)
        start = acb(x0)
        if th0 > 2:
            corner = wv.saddle - acb(quarter, quarter)
        else:
            corner = acb(x0, quarter)
        parts.append(wv.segment(start, corner, b_right))
        parts.append(wv.segment(corner, wv.saddle, b_right))
    top = wv.saddle + acb(quarter, quarter)
    parts.append(wv.segment(wv.saddle, top, b_right))
    parts.append(wv.ray(top, 1, b_right))
    return parts


def s_wave(wv, poles):
    """Upper half of the path of S; returns its integrals and whether the Rayleigh pole was passed on its left."""
    s, k = wv.s, wv.s.kappa
    root = lambda q: (1 + q * q).sqrt()
    minus = lambda q: -(1 + q * q).sqrt()
    quarter = PI / 4
    th0 = float(wv.th0)
    xh = (1 / k).acosh()
    parts = []
    if poles:
        if th0 < 0.2:  # crosses the imaginary axis between the Rayleigh pole and the saddle
            turn = wv.saddle - acb(1.0, 0.6)
            parts.append(wv.segment(turn, wv.saddle, root))
            rayleigh = True
        else:
            d = wv.th0 / 2 if th0 < 2 * 0.78 else quarter
            turn = wv.saddle - acb(d, quarter)
            parts.append(wv.segment(turn, wv.saddle, root))
            rayleigh = False
        # the ray runs from -infinity to turn: minus the ray from turn to -infinity
        parts.append([-v for v in wv.ray(turn, -1, root)])
    else:
        rayleigh = False
        x0 = wv.th0 / 2 if th0 < 2 else arb(1)
        corner = wv.saddle - acb(quarter, quarter) if th0 > 2 else acb(x0, quarter)
        parts += [wv.segment(acb(x0), corner, root), wv.segment(corner, wv.saddle, root)]
    if xh > wv.th0:
        head = acb(xh, PI / 2)
        length = float(xh) - th0
        if length < 0.8:
            nodes = [wv.saddle, (wv.saddle + head) / 2 + I * (0.15 * length), head]
        else:
            nodes = [wv.saddle, wv.saddle + acb(0.4, 0.12)]
            span = length - 0.8
            pieces = max(1, round(span / 1.2)) if span > 0.05 else 1
            for i in range(1, pieces + 1):
                nodes.append(acb(wv.th0 + 0.4 + (xh - wv.th0 - 0.8) * i / pieces, PI / 2 + 0.12))
            nodes.append(head)
        parts += [wv.segment(p, q, root) for p, q in zip(nodes, nodes[1:])]
        last = head
    else:
        last = wv.saddle
    top = last + acb(quarter, quarter)
    parts.append(wv.segment(last, top, minus))
    parts.append(wv.ray(top, 1, minus))
    return parts, rayleigh


def step_response(nu, r, z, t, poles=True, solid=None):
    """The six fields (order FIELDS) as real balls."""
    s = solid or Solid(nu)
    r, z, t = exact(r), exact(z), exact(t)
    zero = [arb(0)] * 6
    p = Wave(s, r, z, t, False)
    h = Wave(s, r, z, t, True)
    if not p.t2 > 0:
        return zero
    poles = poles and h.t2 > 0
    parts = p_wave(p, poles)
    total = zero
    rayleigh = True
    if h.t2 > 0:
        more, rayleigh = s_wave(h, poles)
        parts += more
    for part in parts:
        total = [x + y.imag for x, y in zip(total, part)]
    total = [x / PI for x in total]
    if poles:
        total = [x + y for x, y in zip(total, static_field(s, r, z))]
        total = [x + y for x, y in zip(total, rayleigh_residue(s, r, z, t, rayleigh))]
    return total
