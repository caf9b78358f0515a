"""Section 1 of docs/theory.md: the transformed problem."""

import mpmath as mp
import numpy as np
from scipy.special import j0

from . import halfspace as hs
from .halfspace import Medium
from .report import relative


class Mode:
    """u J1(kr), w J0(kr) of (T6), and derivatives by numerical differentiation in 40 digits."""

    def __init__(self, nu, k, s):
        self.lame = mp.mpf(2) * nu / (1 - 2 * mp.mpf(nu))
        self.K = (2 - 2 * mp.mpf(nu)) / (1 - 2 * mp.mpf(nu))
        self.k, self.s = mp.mpf(k), mp.mpf(s)
        self.alpha = mp.sqrt(self.k**2 + self.s**2)
        self.beta = mp.sqrt(self.k**2 + self.K * self.s**2)
        self.gamma = 2 * self.k**2 + self.K * self.s**2
        self.D = self.gamma**2 - 4 * self.alpha * self.beta * self.k**2

    def u(self, r, z):
        al, be, k = self.alpha, self.beta, self.k
        size = k * (self.gamma * mp.exp(-al * z) - 2 * al * be * mp.exp(-be * z)) / self.D
        return size * mp.besselj(1, k * r)

    def w(self, r, z):
        al, be, k = self.alpha, self.beta, self.k
        size = al * (self.gamma * mp.exp(-al * z) - 2 * k**2 * mp.exp(-be * z)) / self.D
        return size * mp.besselj(0, k * r)

    def equations(self, r, z, misprint=False):
        """Residuals of (T2); mu = 1, rho = K, so that c1 = 1."""
        at, u, w = (r, z), self.u, self.w
        d = lambda f, i, j: mp.diff(f, at, (i, j))  # noqa: E731
        l2, lm = self.lame + 2, self.lame + 1
        first = l2 * (d(u, 2, 0) + d(u, 1, 0) / r - u(*at) / r**2) + d(u, 0, 2) + lm * d(w, 1, 1)
        mixed = d(u, 1, 0) if misprint else d(u, 0, 1)
        second = lm * (d(u, 1, 1) + mixed / r) + d(w, 2, 0) + d(w, 1, 0) / r + l2 * d(w, 0, 2)
        inertia = self.K * self.s**2
        size = abs(inertia * w(*at)) + abs(inertia * u(*at))
        return [(first - inertia * u(*at)) / size, (second - inertia * w(*at)) / size]

    def hooke(self, r, z):
        """srr, stt, szz, srz from the slopes of u and w."""
        at = (r, z)
        ur, uz = mp.diff(self.u, at, (1, 0)), mp.diff(self.u, at, (0, 1))
        wr, wz = mp.diff(self.w, at, (1, 0)), mp.diff(self.w, at, (0, 1))
        ring = self.u(*at) / r
        volume = self.lame * (ur + ring + wz)
        return [volume + 2 * ur, volume + 2 * ring, volume + 2 * wz, uz + wr]

    def table(self, r, z):
        """The six fields from (T7), k and s as q = s/k."""
        q2 = (self.s / self.k) ** 2
        a, b = mp.sqrt(1 + q2), mp.sqrt(1 + self.K * q2)
        medium = type("m", (), {"K": self.K, "lame": self.lame})
        d = hs.rayleigh_denominator(medium, q2, a, b)
        k, total = self.k, [mp.mpf(0)] * 6
        zero, one = mp.besselj(0, k * r), mp.besselj(1, k * r)
        for (w, u, zz, rz, rr, tt), decay in zip(hs.amplitudes(medium, q2, a, b), (a, b)):
            e = mp.exp(-k * decay * z) / d
            terms = (
                u * one / k,
                w * zero / k,
                rr * zero - 2 * u * one / (k * r),
                tt * zero + 2 * u * one / (k * r),
                zz * zero,
                rz * one,
            )
            total = [x + e * y for x, y in zip(total, terms)]
        return total


def check(report):
    """All of section 1."""
    steel = Medium(0.3)
    speeds = [(209e9 * 0.7 / (1.3 * 0.4) / 7830) ** 0.5, (209e9 / 2.6 / 7830) ** 0.5]
    report.row(
        "T1", "c1, c2 of the paper's steel from E, nu, rho against its Table 1", relative(speeds, [5994, 3204]), 5e-4
    )
    report.row("T1", "kappa(0.3) against the ratio of these speeds", abs(steel.kappa - speeds[1] / speeds[0]), 1e-12)
    mp.mp.dps = 40
    modes = [Mode(mp.mpf(nu) / 100, k, s) for nu, k, s in ((30, 1.3, 0.7), (-20, 0.4, 2.1), (45, 2.2, 0.3))]
    place = (mp.mpf("0.8"), mp.mpf("0.35"))
    residual = max(abs(v) for m in modes for v in m.equations(*place))
    error = 0
    for m in modes:
        # the two conditions (T3) as a linear system for the potentials
        k, phi_psi = (
            m.k,
            mp.lu_solve(mp.matrix([[m.gamma, -2 * m.k * m.beta], [2 * m.k * m.alpha, -m.gamma]]), mp.matrix([-1, 0])),
        )
        r, z = place
        p, s = phi_psi[0] * mp.exp(-m.alpha * z), phi_psi[1] * mp.exp(-m.beta * z)
        u = (-k * p + m.beta * s) * mp.besselj(1, k * r)
        w = (-m.alpha * p + k * s) * mp.besselj(0, k * r)
        error = max(error, abs(u - m.u(*place)), abs(w - m.w(*place)))
    report.row("T5", "displacements of the potentials that solve (T3) against (T6), 3 (nu, k, s)", error, 1e-30)
    report.row("T2", "Lame equations at (T6), derivatives by differences, 3 (nu, k, s)", residual, 1e-12)
    wrong = max(abs(m.equations(*place, misprint=True)[1]) for m in modes)
    report.fails("T2", "the same with the paper's (1/r) du/dr in the second equation of (1)", wrong, 1e-2)
    surface = 0
    for m in modes:
        at = m.hooke(place[0], mp.mpf(0))
        surface = max(surface, abs(at[2] + mp.besselj(0, m.k * place[0])), abs(at[3]))
    report.row("T3", "szz = -Z_H J0 and srz = 0 on z = 0, by Hooke's law from slopes of (T6)", surface, 1e-12)
    wrong = max(abs((m.gamma**2 - 2 * m.alpha * m.beta * m.k**2) / m.D - 1) for m in modes)
    report.fails("T6", "the same with the paper's coefficient 2 in (24): szz on z = 0 off by", wrong, 1e-2)
    error = 0
    for m in modes:
        table, hooke = m.table(*place), m.hooke(*place)
        exact = [m.u(*place), m.w(*place), *hooke]
        error = max(error, max(abs(x - y) for x, y in zip(table, exact)) / max(abs(y) for y in exact))
    report.row("T6, T7", "six fields from the table of amplitudes against Hooke's law, 3 (nu, k, s)", error, 1e-12)
    m, s = Mode(mp.mpf("0.3"), 1, mp.mpf(10) ** 6), mp.mpf(10) ** 6
    start = m.alpha * (m.gamma - 2) / m.D * s * m.K
    report.row("T8", "s w^LH(z = 0) at s = 1e6 against kappa^2", abs(start - 1), 1e-11)
    mp.mp.dps = 15
    error = 0
    for profile in hs.CHORD:
        for k in (0.3, 2.0, 7.0):
            # r = sin(angle) takes the root at the edge away
            angle, weight = hs.on_panels([0, np.pi / 2])
            r = np.sin(angle)
            inside = np.cos(angle)
            z = 1.5 / np.pi * inside if profile == "hertz" else 0.5 / np.pi / inside
            direct = np.sum(weight * z * r * inside * j0(k * r))
            sigma, weight = hs.on_panels([-1, 0, 1])
            chord = np.sum(weight * hs.CHORD[profile](sigma) * np.cos(k * sigma))
            closed = hs.HANKEL[profile](k)
            error = max(error, abs(direct - closed), abs(chord - closed))
    report.row("T4", "Z_H against int Z r J0 dr and int h cos(k sigma) d sigma, Hertz and punch", error, 1e-12)
