"""Second method: Cagniard-de Hoop line-load responses, averaged over direction and over the chord of the disc.

Same units and fields as contours.py, which this file does not use.

The axisymmetric field is the mean over the horizontal direction phi of plane-strain fields (Smirnov-Sobolev),

    w, szz:  < W >, < Szz >        u, srz:  < U cos phi >, < Sxz cos phi >
    srr, stt:  < Sxx cos^2 phi + Syy sin^2 phi >, < Sxx sin^2 phi + Syy cos^2 phi >

each loaded by the chord transform of the disc: with x = r cos(phi) - s and C = 3/(8 pi),

    displacement = C int_{-1}^{1} (1-s^2) Re|Im [p n dp/dt] ds        stress = C int_{-1}^{1} Re|Im [2 i s n dp/dt] ds

(Re for W, Sxx, Syy, Szz, which are even in x, Im for U, Sxz; the stress is integrated by parts once).
n(p) are the numerators of the Laplace-Hankel solution at k = s p over the Rayleigh function.
Cagniard's p solves gamma z - i p x = t and is explicit,

    p = (t^2 - z^2/v^2)/(z sigma - i x t),   sigma = sqrt(t^2 - (x^2+z^2)/v^2),   dp/dt = gamma/sigma,
    sigma = -(i/v) sqrt(x-X) sqrt(x+X),  X = sqrt(v^2 t^2 - z^2),   v = 1 (P) or kappa (S), nothing for t < z/v.

This is analytic in Im x > 0, where Re p > 0, so the chord is replaced by the lower half-circle of s; head waves, the Rayleigh
pole at z = 0 and the delta functions of the surface response need no special care.  The phi integral is split where an end
of the chord meets a front: r cos phi -+ 1 = +-X_P, +-X_S, +-(t - z sqrt(1/kappa^2-1)), +-c_R t, 0.
"""

import math
from functools import lru_cache

from flint import acb, arb, ctx

from quadrature import I, PI, exact, integrate, mid, tanh_sinh


@lru_cache(None)
def half_circle(steps):
    """Rows s, (1-s^2) ds, 2 i s ds on s = exp(-i phi), from -1 to 1, with 1-s and 1+s."""
    rows = []
    for x, y, wt in tanh_sinh(arb(1) / steps, cut=100.0):
        half = -PI * y / 2
        e = (I * half).exp()
        minus, plus = -2 * I * half.sin() * e, 2 * (PI * x / 2).sin() * e
        ds = I * PI * e * e * wt
        rows.append(tuple(map(mid, (minus, plus, minus * plus * ds, 2 * I * (1 - minus) * ds))))
    return rows


def line_load(k2, lam, v2, x_minus, x_plus, x, z, t, shear):
    """p and (n dp/dt) of W, U, Szz, Sxz, Sxx, Syy; x_minus = x-X, x_plus = x+X."""
    sigma = -I * x_minus.sqrt() * x_plus.sqrt()
    if shear:
        sigma = sigma / k2.sqrt()
    p = (t * t - z * z / v2) / (z * sigma - I * x * t)
    p2 = p * p
    a, b = (1 + p2).sqrt(), (1 / k2 + p2).sqrt()
    g = 2 * p2 + 1 / k2
    ab = a * b
    f = 1 / ((g * g - 4 * ab * p2) * sigma)
    if shear:
        f = f * b
        m = 4 * ab * p2 * f
        return p, (-2 * p2 * a * f, -2 * ab * p * f, m, 2 * a * g * p * f, -m, acb(0))
    f = f * a
    gf = g * f
    return p, (a * gf, p * gf, -g * gf, -2 * a * p * gf, (2 * p2 - lam) * gf, -lam * gf)


def step_response(nu, r, z, t, tol=1e-11, steps=64):
    """The six fields (u, w, srr, stt, szz, srz); the error is about the square of tol.

    Near the surface p reaches 1e40 under the load, where P and S cancel: more digits there.
    """
    with ctx.workprec(512 if z < 1e-2 else 160):
        return _step_response(nu, r, z, t, tol, steps)


def _step_response(nu, r, z, t, tol, steps):
    nu, r, z, t = map(exact, (nu, r, z, t))
    k2 = (1 - 2 * nu) / (2 - 2 * nu)
    lam = 2 * nu / (1 - 2 * nu)
    waves = [(v2, X2.sqrt(), sh) for v2, sh in ((arb(1), False), (k2, True)) if (X2 := v2 * t * t - z * z) > 0]
    if not waves:
        return [arb(0)] * 6
    chord = half_circle(steps)

    def at_angle(cos, sin, shift):
        """Integrand of phi; shift(e) = r cos(phi) - e without cancellation."""
        even, odd = [acb(0)] * 4, [acb(0)] * 2  # W, Szz, Sxx, Syy and U, Sxz
        for v2, X, sh in waves:
            ends = [(shift(1 + X), shift(1 - X)), (shift(X - 1), shift(-1 - X)), shift(arb(1)), shift(arb(-1))]
            for minus, plus, w_disp, w_stress in chord:
                if abs(float(minus.imag)) + abs(float(minus.real)) < 1:
                    xm, xp, x = ends[0][0] + minus, ends[0][1] + minus, ends[2] + minus
                else:
                    xm, xp, x = ends[1][0] - plus, ends[1][1] - plus, ends[3] - plus
                p, n = line_load(k2, lam, v2, xm, xp, x, z, t, sh)
                pw = p * w_disp
                even = [e + q for e, q in zip(even, (n[0] * pw, n[2] * w_stress, n[4] * w_stress, n[5] * w_stress))]
                odd = [e + q for e, q in zip(odd, (n[1] * pw, n[3] * w_stress))]
        w, szz, sxx, syy = [e.real for e in even]
        u, srz = [e.imag for e in odd]
        c2, s2 = cos * cos, sin * sin
        return [u * cos, w, sxx * c2 + syy * s2, sxx * s2 + syy * c2, szz, srz * cos]

    marks = [arb(0)] + [X for _, X, _ in waves]
    if waves[-1][2]:
        marks += [t - z * (1 / k2 - 1).sqrt(), t * rayleigh_speed(k2)]
    cosines = {0.0: arb(0), 1.0: arb(1)}
    if r > 0:
        for m in marks:
            for cut in (m + 1, m - 1, 1 - m, -1 - m):
                if 0 < cut / r and cut / r < 1:
                    cosines[float(cut / r)] = (cut / r).mid()
    cuts = [c for _, c in sorted(cosines.items())]
    total = [arb(0)] * 6
    for c0, c1 in zip(cuts, cuts[1:]):
        p0, p1 = c0.acos(), c1.acos()  # p0 > p1
        d = p0 - p1

        def f(x, y):  # phi = p0 - d x = p1 + d y
            if float(x) < 0.5:
                base, h, c = p0, -d * x, c0
            else:
                base, h, c = p1, d * y, c1
            cos, sin = (base + h).cos(), (base + h).sin()
            # cos(base+h) - cos(base) = -2 sin(base+h/2) sin(h/2)
            step = -2 * (base + h / 2).sin() * (h / 2).sin() * r

            def shift(e):
                return step + (r * c - e)

            return [acb(v * d) for v in at_angle(cos, sin, shift)]

        total = [a + b.real for a, b in zip(total, integrate(f, tol))]
    scale = 2 / PI * 3 / (8 * PI)
    return [v * scale for v in total]


def rayleigh_speed(k2):
    f = lambda x: ((x - 8) * x + 24 - 16 * k2) * x - 16 * (1 - k2)
    lo, hi = arb(0.05), arb(1)
    for _ in range(100):
        m = ((lo + hi) / 2).mid()
        lo, hi = (m, hi) if f(m) < 0 else (lo, m)
    return (k2 * lo).sqrt()
