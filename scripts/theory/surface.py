"""Section 3 of docs/theory.md: the response of the loaded surface."""

import csv

import numpy as np

from . import halfspace as hs
from .fields import REFERENCE
from .halfspace import Medium

RATIOS = (-0.3, 0.0, 0.1, 0.25, 0.3, 0.45)

# chord functions phi of (T27), their supports, and static deflections over (1 - nu)
CENTRE = (lambda e: np.where(e < 1, 1 - e * e, 0.0), 1.0, 3 / 8)
MEAN = (lambda e: np.where(e < 2, (2 - e) ** 3 * (e * e + 6 * e + 4) / 32, 0.0), 2.0, 3 / 10)
PUNCH = (lambda e: np.where(e < 2, 1 - e / 2, 0.0), 2.0, 1 / 4)

# the table of (T32)
J_VALUES = {
    0.0: 0.21396398,
    0.2: 0.15986440,
    0.25: 0.14813388,
    0.3: 0.13722707,
    1 / 3: 0.13045234,
    0.4: 0.11824355,
    0.45: 0.11047434,
}


PANELS = [np.pi / 2 * f for f in (0.03, 0.12, 0.25, 0.5, 0.75, 0.88, 0.94, 0.97, 0.99)]


def measure(medium, breaks=()):
    """Nodes and weights of dmu, (T25); the last node is the Rayleigh wave."""
    K, c = medium.K, medium.c
    scale = 2 * K / (np.pi * (1 - medium.nu))
    # panels that shrink toward slowness one, near which the Rayleigh function is small
    ends = sorted({0.0, *PANELS, *(np.arcsin(b) for b in breaks if 0 < b < 1), np.pi / 2})
    angle, weight = hs.on_panels(ends)
    x, p = np.sin(angle), np.cos(angle)
    R = (2 * x * x - K) ** 2 + 4 * x * x * p * np.sqrt(K - x * x)
    fast = x, scale * weight * p * p / R
    cuts = (np.arcsin(((b * b - 1) / (K - 1)) ** 0.5) for b in breaks if 1 < b < K**0.5)
    ends = sorted({0.0, *PANELS, *cuts, np.pi / 2})
    angle, weight = hs.on_panels(ends)
    x = np.sqrt(1 + (K - 1) * np.sin(angle) ** 2)
    p, y = -1j * np.sqrt(K - 1) * np.sin(angle), np.sqrt(K - 1) * np.cos(angle)
    R = (2 * x * x - K) ** 2 + 4 * x * x * p * y
    slow = x, scale * weight * (p / R).real * (K - 1) * np.sin(angle) * np.cos(angle) / x
    mass = 2 * (1 - c * c) ** 0.5 * c * K / ((1 - medium.nu) * medium.slope())
    return np.concatenate([fast[0], slow[0], [1 / c]]), np.concatenate([fast[1], slow[1], [mass]])


def step(medium, chord, t):
    """W(t) of (T27)."""
    phi, support, _ = chord
    x, weight = measure(medium, [t / support])
    return 1 - np.sum(weight * phi(t / x))


def mean_slowness(medium):
    """<x> of (T32)."""
    x, weight = measure(medium)
    return np.sum(weight * x)


def lag(medium):
    """J of (T32)."""
    return medium.kappa * (1 - medium.nu) * mean_slowness(medium) / 4


# ------------------------------------------------------------------ Kausel


def poles(medium):
    """x_j and A_j of (T29)."""
    a2, x = 1 / medium.K, np.array(medium.roots, dtype=complex)
    factors = []
    for j in range(3):
        others = [x[i] for i in range(3) if i != j]
        root = np.sqrt(a2 - x[j]) if j < 2 else np.sqrt(x[j] - a2)
        factors.append((x[j] - 0.5) ** 2 * root / ((x[j] - others[0]) * (x[j] - others[1])))
    return x, factors


def point_step(medium, tau):
    """U(tau) of (T29)."""
    x, A = poles(medium)
    if tau <= medium.kappa:
        return 0.0
    if tau * tau >= x[2].real:
        return 1.0
    surface = 1 - (A[2] / np.sqrt(x[2] - tau * tau)).real
    if tau > 1:
        return surface
    return 0.5 * (surface - sum(A[j] / np.sqrt(tau * tau - x[j]) for j in (0, 1)).real)


def closed_centre(medium, T):
    """W(T) of (T30)."""
    x, A = poles(medium)
    if T >= x[2].real ** 0.5:
        return 1.0

    def zero(s):
        return 0.5 * (s * np.sqrt(1 - s * s) + np.arcsin(s))

    def third(s):
        # zero at X_R, where rounding would leave its root
        square = x[2].real * s * s - T * T
        q, p = np.sqrt(square) if square > 1e-14 else 0.0, np.sqrt(1 - s * s)
        far = x[2].real - T * T
        angle = np.arctan2(q, x[2].real ** 0.5 * p)
        return A[2].real * (q * p / (2 * x[2].real) + far / (2 * x[2].real ** 1.5) * angle)

    def leaky(s, j):
        q, p, root = np.sqrt(T * T - x[j] * s * s), np.sqrt(1 - s * s), np.sqrt(x[j])
        return (A[j] * (-q * p / (2 * x[j]) + (T * T - x[j]) / (2 * x[j] * root) * np.log(root * p + q))).real

    r, s, p = min(1, T / x[2].real ** 0.5), min(1, T), min(1, T / medium.kappa)
    surface = [zero(v) - third(v) for v in (r, s, p)]
    rest = sum(leaky(p, j) - leaky(s, j) for j in (0, 1))
    return 4 / np.pi * (zero(r) + surface[1] - surface[0] + 0.5 * (surface[2] - surface[1] - rest))


def kausel(report):
    """(T29) and (T30)."""
    error = 0
    for nu in (0.1, 0.25, 0.3, 0.45):
        medium = Medium(nu)
        for tau in (medium.kappa * 1.2, 0.9, 1.02):
            # r = 1, t = tau/kappa: an inverse root at x = t
            t = tau / medium.kappa
            x, weight = measure(medium, [t])
            keep = x > t * (1 + 1e-15)
            found = 1 - np.sum(weight[keep] / np.sqrt((1 - t / x[keep]) * (1 + t / x[keep])))
            error = max(error, abs(found - point_step(medium, tau)))
    report.row("T29", "point force: Kausel's U against the measure, 4 ratios", error, 1e-6)
    error = 0
    for nu in RATIOS:
        medium = Medium(nu)
        if nu == 0:
            continue
        for T in (0.1, 0.5, 0.9, 1.0, 1.03):
            error = max(error, abs(closed_centre(medium, T) - step(medium, CENTRE, T / medium.kappa)))
    report.row("T30", "W in closed form against the measure, 5 ratios, 5 times", error, 1e-11)
    medium, error = Medium(0.25), 0
    for T in (0.3, 0.8, 1.05):
        breaks = sorted({0.0, 1.0, *(v for v in (T / medium.x3**0.5, T, T / medium.kappa) if v < 1)})
        s, weight = hs.on_panels(breaks)
        U = np.array([point_step(medium, T / v) for v in s])
        error = max(error, abs(4 / np.pi * np.sum(weight * np.sqrt(1 - s * s) * U) - closed_centre(medium, T)))
    report.row("T30", "W against 4/pi int sqrt(1 - s^2) U(T/s) ds", error, 1e-6)


# ------------------------------------------------------------------ the measure


def measure_checks(report):
    """(T25) to (T28)."""
    medium, error = Medium(0.3), 0
    for r, t in ((0.4, 0.9), (0.4, 2.5), (1.7, 2.0), (1.7, 4.0)):
        full = hs.remainder(medium, "hertz", r, 0.0, t)[1]
        at_rest = hs.potential(hs.chain_e, 3, "hertz", 0j, r).real * 0.7
        edges = [abs(e) for e in (1 + r, 1 - r)]
        x, weight = measure(medium, [t / e for e in edges])
        a3 = np.array([hs.potential(hs.chain_e, 3, "hertz", 1j * t / v, r).real if t / v < 1 + r else 0.0 for v in x])
        error = max(error, abs(full + 0.7 * np.sum(weight * a3)) / at_rest)
    report.row("T25", "w(r,0,t), measure against the single integral (T10), r = 0.4 and 1.7", error, 1e-8)
    error = count = 0
    with REFERENCE.open() as file:
        for row in csv.DictReader(file):
            if row["kind"] != "surface" or not 0.01 < float(row["nu"]) < 0.46:
                continue
            nu, r, t, exact = (float(row[name]) for name in ("nu", "r", "t", "w"))
            medium = Medium(nu)
            x, weight = measure(medium, [t / (1 + r), t / max(abs(1 - r), 1e-9)])
            a3 = np.array(
                [hs.potential(hs.chain_e, 3, "hertz", 1j * t / v, r).real if t / v < 1 + r else 0.0 for v in x]
            )
            rest = hs.potential(hs.chain_e, 3, "hertz", 0j, r).real
            found = (1 - nu) * (rest - np.sum(weight * a3))
            error, count = max(error, abs(found - exact) / ((1 - nu) * rest)), count + 1
    report.row(
        "T25", f"w(r,0,t) at the {count} rows of tests/reference on the surface", error if count else np.inf, 1e-8
    )
    masses = [np.sum(measure(Medium(nu))[1]) for nu in RATIOS]
    report.row("T26", "mass of the measure against 1, 6 ratios", max(abs(m - 1) for m in masses), 1e-10)
    least = min(np.min(measure(Medium(nu))[1]) for nu in RATIOS)
    report.row("T26", "how far the measure is below zero anywhere", max(0.0, -least), 0)
    eta, error = np.array([0.0, 0.3, 1.1, 1.9]), 0
    for profile, chord in (("hertz", MEAN), ("punch", PUNCH)):
        for e in eta:
            s, weight = hs.on_panels([e - 1, 1])
            overlap = np.sum(weight * hs.CHORD[profile](s) * hs.CHORD[profile](e - s))
            error = max(error, abs(2 * np.pi**2 * overlap / chord[2] - chord[0](e)))
    report.row("T27", "phi of the means and their static values against 2 pi^2 h * h", error, 1e-12)
    angle, weight = hs.on_panels([0, np.pi / 2])
    rest = np.array([0.7 * hs.potential(hs.chain_e, 3, "hertz", 0j, np.sin(a)).real for a in angle])
    mean = np.sum(weight * 3 * np.cos(angle) ** 2 * np.sin(angle) * rest)
    report.row(
        "T27",
        "mean of Huber's surface under its own pressure over the centre's against 4/5",
        abs(mean / (0.7 * 3 / 8) - 0.8),
        1e-8,
    )
    medium, error = Medium(0.3), 0
    for r in (0.3, 0.9, 2.0):
        error = max(error, abs(hs.remainder(medium, "hertz", r, 0.0, (1 + r) / medium.c * 1.0001)[1]))
    report.row("T28", "w(r,0,t) - static just after c_R t = 1 + r, r = 0.3, 0.9, 2", error, 1e-9)
    laplace_mean(report)


def laplace_mean(report):
    """(T27) against the transform: 2 pi int Z_H^2 w^LH dk at real s."""
    medium, error = Medium(0.3), 0
    node, rule = np.polynomial.legendre.leggauss(16)
    starts = np.arange(0, 3000.0)
    k = (starts[:, None] + 0.5 * (1 + node)).ravel()
    weight = np.tile(0.5 * rule, len(starts))
    for profile, chord in (("hertz", MEAN), ("hertz", CENTRE)):
        for s in (0.3, 1.0, 4.0):
            q2 = (s / k) ** 2
            a, b = np.sqrt(1 + q2), np.sqrt(1 + medium.K * q2)
            d = hs.rayleigh_denominator(medium, q2, a, b)
            # the static limit 1 - nu is integrated in closed form
            kernel = np.where(q2 > 1e-9, a * q2 * medium.K / d, 1 - medium.nu) - (1 - medium.nu)
            z = hs.HANKEL[profile](k)
            z = 2 * np.pi * z * z if chord is MEAN else z
            direct = chord[2] * (1 - medium.nu) + np.sum(weight * z * kernel)
            x, mass = measure(medium)
            eta, w = hs.on_panels([0, chord[1]])
            # s int exp(-s t) phi(t/x) dt
            lag_part = np.sum(mass * s * x * (np.exp(-s * np.outer(x, eta)) @ (w * chord[0](eta))))
            error = max(error, abs(chord[2] * (1 - medium.nu) * (1 - lag_part) - direct) / direct)
    report.row("T27", "Laplace transform of W, mean and centre, against Hankel quadrature at real s", error, 1e-6)


# ------------------------------------------------------------------ first order


def relaxation(report):
    """(T31) to (T35)."""
    medium, error = Medium(0.3), 0
    for t in (0.2, 1.0, 2.5, 3.6):
        y, memory = t / 2, 1 / medium.c
        u, weight = hs.on_panels([y, *(v for v in (1.0, medium.K**0.5) if v > y), memory])
        V = np.array([1 - step(medium, CENTRE, v) for v in u])
        found = 0.5 * (1 - step(medium, CENTRE, y)) + 0.5 * y * np.sum(weight * V / u**2)
        error = max(error, abs(found - (1 - step(medium, PUNCH, t))))
    report.row("T31", "memory of the punch from that of the centre against its own chord function", error, 1e-9)
    error = 0
    for profile in ("hertz", "punch"):
        for r in (0.2, 0.8, 1.6, 4.0):
            eta, weight = hs.on_panels(sorted({0.0, abs(1 - r), 1 + r}))
            a3 = np.array([hs.potential(hs.chain_e, 3, profile, 1j * e, r).real for e in eta])
            error = max(error, abs(np.sum(weight * a3) - 0.25))
    report.row("T32", "int Re A3(i eta; r) d eta against 1/4, two profiles, r = 0.2 .. 4", error, 1e-6)
    for chord, name in ((CENTRE, "centre"), (MEAN, "mean"), (PUNCH, "punch")):
        eta, weight = hs.on_panels([0, chord[1]])
        report.row(
            "T32",
            f"static value times area of phi against 1/4, {name}",
            abs(chord[2] * np.sum(weight * chord[0](eta)) - 0.25),
            1e-14,
        )
    error = max(abs(lag(Medium(nu)) / J - 1) for nu, J in J_VALUES.items())
    report.row("T32", "J = kappa (1 - nu) <x>/4 against the 7 values of its table", error, 1e-7)
    error = 0
    for nu in (0.25, 0.3):
        medium = Medium(nu)
        T, weight = hs.on_panels([0, medium.kappa, 1, medium.x3**0.5])
        W = np.array([closed_centre(medium, v) for v in T])
        error = max(error, abs(0.375 * (1 - nu) * np.sum(weight * (1 - W)) / lag(medium) - 1))
    report.row("T32", "J against S0 int (1 - W) dT of Kausel's closed form", error, 1e-10)
    medium = Medium(0.25)
    share = measure(medium)[1][-1] / medium.c / mean_slowness(medium)
    report.row(
        "T32",
        f"Rayleigh wave's part of J, {share:.4f} at nu = 1/4, against 0.67 of Miller and Pursey",
        abs(share - 0.67),
        5e-3,
    )
    expansion(report)
    error = 0
    for nu in (0.0, 0.25, 0.4):
        medium, t = Medium(nu), 1e-5
        for chord, start in ((CENTRE, 1.5 / np.pi), (MEAN, 9 / (8 * np.pi))):
            error = max(error, abs(chord[2] * (1 - nu) * step(medium, chord, t) / t / (medium.kappa**2 * start) - 1))
    report.row("T34", "S0 W'(0) against kappa^2 Z(0), and kappa^2 9/(8 pi) of the mean", error, 1e-4)
    omega = np.linspace(0.01, 60, 4000)
    eta, weight = hs.on_panels([0, 0.5, 1, 1.5, 2])
    transform = {
        name: np.cos(np.outer(omega, eta)) @ (weight * chord[0](eta))
        for name, chord in (("mean", MEAN), ("punch", PUNCH), ("centre", CENTRE))
    }
    report.row(
        "T35",
        "how far the cosine transforms of the means' phi are below zero",
        max(0, -min(transform["mean"].min(), transform["punch"].min())),
        1e-12,
    )
    report.fails("T35", "the same of the centre's phi: it is not positive", -transform["centre"].min(), 1e-2)


def expansion(report):
    """(T33): response to a slow force sin^2(t/T), mean and centre, against three terms."""
    medium = Medium(0.3)
    for chord, name in ((CENTRE, "centre"), (MEAN, "mean")):
        S = chord[2] * 0.7
        x, mass = measure(medium)
        eta, weight = hs.on_panels([0, chord[1]])
        moments = [np.sum(weight * chord[0](eta) * eta**n) * np.sum(mass * x ** (n + 1)) for n in range(3)]
        errors = []
        for length in (40.0, 80.0):
            t = 0.4 * length
            ages = np.outer(x, eta)
            rate = np.sin(2 * (t - ages) / length) / length
            delayed = np.sum(mass * x * (rate @ (weight * chord[0](eta))))
            exact = S * (np.sin(t / length) ** 2 - delayed)
            rates = [np.sin(2 * t / length) / length, 2 * np.cos(2 * t / length) / length**2]
            found = S * (np.sin(t / length) ** 2 - moments[0] * rates[0] + moments[1] * rates[1])
            errors.append(abs(found - exact))
        report.row(
            "T33",
            f"three terms of the expansion in slowness, {name}: order of the error against 3",
            abs(np.log2(errors[0] / errors[1]) - 3),
            0.1,
        )


# ------------------------------------------------------------------ numerical inversion where it fails (section 7)


def inversions(report):
    """Fixed Talbot and Stehfest on W of the centre."""
    medium = Medium(0.3)
    x, mass = measure(medium)
    order = 24

    def transform(s):
        """Of W: 1 - phi = (t/x)^2 up to x, then 1."""
        sx = s * x
        small = abs(sx) < 1e-3
        y = np.where(small, 1.0, sx)
        rest = np.where(small, 0.5 - sx / 3, (1 - np.exp(-y) * (1 + y)) / (y * y))
        return np.sum(mass * 2 * rest) / s

    def talbot(t):
        r = 2 * order / (5 * t)
        total = 0.5 * np.exp(r * t) * transform(r)
        for j in range(1, order):
            angle = j * np.pi / order
            cot = 1 / np.tan(angle)
            s = r * angle * (cot + 1j)
            total += (np.exp(t * s) * transform(s) * (1 + 1j * (angle + (angle * cot - 1) * cot))).real
        return r / order * total

    def stehfest(t):
        n, total = 14, 0.0
        from math import factorial as f

        for k in range(1, n + 1):
            v = sum(
                j ** (n // 2) * f(2 * j) / (f(n // 2 - j) * f(j) * f(j - 1) * f(k - j) * f(2 * j - k))
                for j in range((k + 1) // 2, min(k, n // 2) + 1)
            )
            total += (-1) ** (k + n // 2) * v * transform(k * np.log(2) / t).real
        return np.log(2) / t * total

    early = [abs(talbot(T / medium.kappa) - closed_centre(medium, T)) for T in (0.57, 0.7, 0.8)]
    report.fails("section 7", "fixed Talbot (24 nodes) on W at T = 0.57, 0.7, 0.8: least error", min(early), 10)
    report.row("section 7", "the same at T = 3, after the last wave", abs(talbot(3 / medium.kappa) - 1), 1e-6)
    late = [abs(stehfest(T / medium.kappa) - closed_centre(medium, T)) for T in (0.6, 0.8, 1.0, 1.08)]
    report.fails("section 7", "Stehfest (14) on W at T = 0.6 .. 1.08: largest error", max(late), 2e-3)


def check(report):
    """All of section 3."""
    measure_checks(report)
    kausel(report)
    relaxation(report)
    inversions(report)
