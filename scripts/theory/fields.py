"""Section 2 of docs/theory.md: the single integral, the potentials, the static field, time cells."""

import csv
from pathlib import Path

import mpmath as mp
import numpy as np
from scipy.optimize import brentq
from scipy.special import j0, j1

from . import halfspace as hs
from .halfspace import Medium
from .report import relative

RATIOS = (-0.3, 0.1, 0.25, 0.3, 0.45)
REFERENCE = Path(__file__).resolve().parents[2] / "tests" / "reference" / "step_response.csv"


# ------------------------------------------------------------------ from transforms to one integral


def laplace_hankel(medium, r, z, s, panels=60, nodes=24):
    """Transforms of the step response, times s: (T6) by quadrature over k at real s."""
    x, weight = np.polynomial.legendre.leggauss(nodes)
    ends = np.linspace(0, 40 / z, panels + 1)
    half = 0.5 * np.diff(ends)
    k = (0.5 * (ends[1:] + ends[:-1])[:, None] + half[:, None] * x).ravel()
    weight = (half[:, None] * weight).ravel() * hs.HANKEL["hertz"](k)
    q2 = (s / k) ** 2
    a, b = np.sqrt(1 + q2), np.sqrt(1 + medium.K * q2)
    d = hs.rayleigh_denominator(medium, q2, a, b)
    total = np.zeros(6)
    for n, decay in zip(hs.amplitudes(medium, q2, a, b), (a, b)):
        e = weight * np.exp(-k * decay * z) / d
        zero, one = j0(k * r), j1(k * r) / r
        total += (hs.combine(n, (zero, k * zero, one, k * one), r) * e).sum(axis=1)
    return total


def laplace_of_step(medium, r, z, s):
    """s int exp(-s t) H dt by quadrature in time between the fronts."""
    breaks = hs.arrivals(medium, r, z)
    breaks = [breaks[0], *(b for a, b in zip(breaks, breaks[1:]) if b - a > 1e-9)]
    breaks += [breaks[-1] + d for d in (1, 3, 8, 18, 36 / s + 18)]
    t, weight = hs.on_panels(breaks, hs.double_exponential(24, 3.0))
    values = np.stack([hs.step(medium, "hertz", r, z, float(v)) for v in t], axis=1)
    return values @ (weight * s * np.exp(-s * t))


def inversion_at_fixed_k(medium, k, z, t):
    """w of one wave number: (T9) and a numerical Laplace inversion (Talbot, 40 digits)."""
    mp.mp.dps = 40
    K = mp.mpf(medium.K)

    def transform(q):
        # cuts to the left, where the path of the inversion does not meet them
        a = mp.sqrt(q + 1j) * mp.sqrt(q - 1j)
        b = mp.sqrt(K) * mp.sqrt(q + 1j * mp.sqrt(1 / K)) * mp.sqrt(q - 1j * mp.sqrt(1 / K))
        g = 2 + K * q * q
        return (a * g * mp.exp(-k * a * z) - 2 * a * mp.exp(-k * b * z)) / (k * (g * g - 4 * a * b))

    exact = mp.invertlaplace(lambda s: transform(s / k) / s, t, method="talbot", degree=60)
    # static field of one wave number: (T15) before the integration over k
    rest = ((1 - mp.mpf(medium.nu)) + k * z / 2) * mp.exp(-k * z) / k
    mp.mp.dps = 15
    k, z, t, K, c = (float(v) for v in (k, z, t, medium.K, medium.c))
    a, b = (1 - c * c) ** 0.5, (1 - K * c * c) ** 0.5
    g = 2 - K * c * c
    shape = a * g * np.exp(-k * a * z) - 2 * a * np.exp(-k * b * z)
    pole = 2 / (c * medium.slope()) * shape * np.cos(k * c * t) / k
    # the cut, with the roots at kappa and 1 taken away; it falls as w^-2 and oscillates
    w, weight = hs.on_panels([medium.kappa, 1.0, 2.0])
    node, rule = np.polynomial.legendre.leggauss(20)
    starts = np.arange(2.0, 4000.0)
    w = np.concatenate([w, (starts[:, None] + 0.5 * (1 + node)).ravel()])
    weight = np.concatenate([weight, np.tile(0.5 * rule, len(starts))])
    a, b = np.sqrt(1 - w * w + 0j), 1j * np.sqrt(np.maximum(K * w * w - 1, 0))
    g = 2 - K * w * w
    shape = a * g * np.exp(-k * a * z) - 2 * a * np.exp(-k * b * z)
    cut = (shape / (1j * w * (g * g - 4 * a * b)) * 2 * np.cos(k * w * t)).real / k
    return float(rest) + pole + np.sum(weight * cut) / np.pi, float(mp.re(exact))


def reference_rows(limit):
    """Rows of tests/reference/step_response.csv at which the plain formulas lose no digits."""
    with REFERENCE.open() as file:
        for row in csv.DictReader(file):
            nu, r, z, t = (float(row[name]) for name in ("nu", "r", "z", "t"))
            if (
                row["kind"] in ("random", "edge", "nu_special")
                and t < 20
                and z > 0.01
                and r > 0.05
                and 0 < abs(nu) < 0.46
            ):
                exact = np.array([float(row[f]) for f in hs.FIELDS])
                if not exact.any():
                    continue
                limit -= 1
                if limit < 0:
                    return
                yield nu, r, z, t, exact


def single_integral(report):
    """(T9) to (T11), (T16), (T18), (T19), (T21)."""
    found, exact = inversion_at_fixed_k(Medium(0.3), mp.mpf("1.3"), mp.mpf("0.7"), mp.mpf(4))
    report.row(
        "T9",
        "w at one wave number, static + pole + cut, against Talbot's inversion in 40 digits",
        abs(found - exact),
        1e-8,
    )
    error = 0
    for nu, r, z, s in ((0.3, 0.5, 0.6, 1.0), (0.25, 1.6, 0.9, 2.0), (0.1, 0.2, 1.5, 0.7)):
        medium = Medium(nu)
        error = max(error, relative(laplace_of_step(medium, r, z, s), laplace_hankel(medium, r, z, s)))
    report.row(
        "T10", "six fields: Laplace transform of the single integral against Hankel quadrature of (T6)", error, 1e-8
    )
    errors = [relative(hs.step(Medium(nu), "hertz", r, z, t), exact) for nu, r, z, t, exact in reference_rows(150)]
    report.row(
        "T10, T16",
        "six fields at 150 rows of tests/reference (steepest descents, 20 digits), largest",
        max(errors),
        3e-8,
    )
    error = max(
        relative(hs.step(Medium(nu), p, 0.7, 0.9, 0.88) + 1, np.ones(6))
        for nu in (0.25, 0.4)
        for p in ("hertz", "punch")
    )
    report.row("T10", "static field + remainder before the first arrival against 0, Hertz and punch", error, 1e-9)
    speed = slope = 0
    for nu in RATIOS:
        medium, h = Medium(nu), 1e-5
        zero = brentq(medium.rayleigh, 0.5 * medium.kappa, 0.99999 * medium.kappa, xtol=1e-16)
        speed = max(speed, abs(zero - medium.c))
        difference = (medium.rayleigh(zero + h) - medium.rayleigh(zero - h)) / (2 * h)
        slope = max(slope, abs(difference / medium.slope() - 1))
    report.row("T11", "Rayleigh speed from the cubic against the zero of D, 5 ratios", speed, 1e-14)
    report.row("T11", "D'(c) against differences of D, 5 ratios", slope, 1e-7)
    amplitude_table(report)
    front_places(report)
    medium = Medium(0.3)
    early, late = (hs.remainder(medium, "hertz", 0.6, 0.8, t, split=4) for t in (40.0, 80.0))
    powers = np.log2(abs(early / late))
    report.row("T21", "decay from t = 40 to 80: powers 2 of u, w, srr, stt", max(abs(powers[:4] - 2)), 0.05)
    report.row("T21", "the same, powers 4 of szz, srz", max(abs(powers[4:] - 4)), 0.15)


def amplitude_table(report):
    """(T16) and (T19) at random slownesses."""
    error = surface = 0
    for nu in RATIOS:
        medium = Medium(nu)
        K = medium.K
        for x in (0.13, 0.7, 0.97, 1 + 0.3 * (K**0.5 - 1), 1 + 0.9 * (K**0.5 - 1)):
            p = np.sqrt(1 - x * x) if x < 1 else -1j * np.sqrt(x * x - 1)
            y = np.sqrt(K - x * x)
            g, R = 2 * x * x - K, (2 * x * x - K) ** 2 + 4 * x * x * p * y
            held_p = np.array(
                [
                    p * g,
                    -1j * x * g,
                    1j * g * g / x,
                    -2 * p * g,
                    -1j * g * (2 * x * x + K - 2) / x,
                    -1j * g * (K - 2) / x,
                ]
            )
            held_s = np.array([-2 * p * x * x, -2j * x * p * y, 4j * x * p * y, 2 * p * g, -4j * x * p * y, 0])
            q2, a, b = -1 / x**2, 1j * p / x, 1j * y / x
            d = hs.rayleigh_denominator(medium, q2, a, b)
            for held, n in zip((held_p, held_s), hs.amplitudes(medium, q2, a, b)):
                error = max(error, relative(held / R, np.array(n) / (1j * x * d)))
            total = (held_p + held_s) / R
            surface = max(surface, abs(total[2] - 1j / x) * x, abs(total[3]), abs(total[0] + K * p / R))
    report.row("T16", "amplitudes over slowness x against N/(i x D), 5 ratios, both sides of x = 1", error, 1e-12)
    report.row("T19", "sums of P and S at the surface: szz i/x, srz 0, w -K p/R", surface, 1e-11)


def front_places(report):
    """(T18): at a front one end of the chord has rho = 0."""
    medium, r, z, t = Medium(0.3), 0.6, 0.5, 1.4
    error = count = 0
    for x in hs.fronts(medium, r, z, t, 1.0):
        if not 0 < x < medium.K**0.5:
            continue
        best = np.inf
        for root in (1 - x * x, medium.K - x * x):
            for sense in (-1, 1):
                eta = (z * np.sqrt(complex(root)) + sense * t) / x
                best = min(best, *(abs(eta - e) for e in (1 + r, 1 - r, -1 - r, -1 + r)))
        error, count = max(error, best), count + 1
    report.row("T18", f"front equation at the {count} roots of its quadratic", error if count > 3 else np.inf, 1e-10)


# ------------------------------------------------------------------ potentials and static field


def direct_potential(n, bessel, profile, xi, r):
    """int Z_H k^(3-n) J(kr) exp(-k xi) dk."""
    xi = complex(xi)
    x, weight = np.polynomial.legendre.leggauss(24)
    ends = np.linspace(0, 45 / xi.real, 400)
    half = 0.5 * np.diff(ends)
    k = (0.5 * (ends[1:] + ends[:-1])[:, None] + half[:, None] * x).ravel()
    weight = (half[:, None] * weight).ravel()
    return np.sum(weight * hs.HANKEL[profile](k) * k ** (3 - n) * bessel(k * r) * np.exp(-k * xi))


def potential_forms(report):
    """(T12) to (T15), (T17), (T20)."""
    error = {"hertz": 0.0, "punch": 0.0, "point": 0.0}
    for profile in error:
        for xi in (0.4 + 0.3j, 0.9 - 1.7j, 0.3 + 2.5j):
            for r in (0.3, 1.0, 2.2):
                for n in (1, 2, 3):
                    a = hs.potential(hs.chain_e, n, profile, xi, r) if (profile, n) != ("point", 1) else 0
                    g = hs.potential(hs.chain_f, n, profile, xi, r) if (profile, n) != ("point", 1) else 0
                    if (profile, n) == ("point", 1):
                        continue
                    exact_a, exact_g = (direct_potential(n, j, profile, xi, r) for j in (j0, j1))
                    error[profile] = max(error[profile], abs(a - exact_a), abs(r * g - exact_g))
    for profile, largest in error.items():
        report.row(
            "T13, T14", f"A_n, B_n in closed form against quadrature over k, n = 1..3, {profile}", largest, 1e-11
        )
    error = 0
    for xi in (0.4 + 0.3j, 0.3 + 2.5j):
        sigma, weight = hs.on_panels([-1, 0, 1])
        chord = np.sum(weight * hs.CHORD["hertz"](sigma) * hs.chain_e(0, xi - 1j * sigma, 0.7))
        error = max(error, abs(chord - hs.potential(hs.chain_e, 3, "hertz", xi, 0.7)))
    report.row("T12", "A_3 against its integral over the chord", error, 1e-12)
    h, error = 1e-3, 0
    for n in (0, 1, 2, 3):
        for f in (hs.chain_e, hs.chain_f):
            z, r = 0.7 + 0.4j, 0.9
            values = [f(n, z + j * h, r) for j in (-2, -1, 1, 2)]
            slope = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * h)
            error = max(error, abs(slope + f(n - 1, z, r)))
    report.row("T13", "E_n' = -E_(n-1), F_n' = -F_(n-1), n = 0..3, by differences", error, 1e-9)
    error = 0
    for eta in (2.31, -3.7, 5.2):
        a3, a2, g3, g2 = hs.potentials("hertz", 1j * eta + 0, 1.3)
        error = max(error, abs(a3.real), abs(a2.imag), abs(g3.imag), abs(g2.real))
    report.row("T17", "Re A3, Im A2, Im B3, Re B2 at i eta beyond 1 + r against 0", error, 1e-14)
    xi, r, series = 9 + 4j, 1.1, 0
    rho = np.sqrt(xi * xi + r * r)
    for j in range(9):
        legendre = np.polynomial.legendre.legval(xi / rho, [0] * (2 * j) + [1])
        series += (-1) ** j * 1.5 / (np.pi * (2 * j + 1) * (2 * j + 3)) * legendre / rho ** (2 * j + 1)
    report.row(
        "T20",
        "multipole series of A_3, 9 terms, against quadrature over k",
        abs(series - direct_potential(3, j0, "hertz", xi, r)),
        1e-13,
    )
    static_limit(report)


def static_limit(report):
    """(T15) against (T6) at s -> 0."""
    error = 0
    for nu, r, z in ((0.3, 0.5, 0.6), (-0.2, 1.7, 0.4), (0.45, 1.0, 1.5)):
        medium = Medium(nu)
        coarse, fine = (laplace_hankel_static(medium, r, z, e) for e in (2e-3, 1e-3))
        error = max(error, relative((4 * fine - coarse) / 3, hs.static(medium, "hertz", r, z)))
    report.row("T15", "Huber's field against Hankel quadrature of (T7) at q -> 0, 3 places", error, 1e-7)
    centre = hs.static(Medium(0.3), "hertz", 1e-9, 1e-12)[1]
    report.row("T15", "static deflection of the centre against 3 (1 - nu)/8", abs(centre - 3 * 0.7 / 8), 1e-9)


def laplace_hankel_static(medium, r, z, q):
    """The same integral at s = q k: every wave number at the same small q."""
    x, weight = np.polynomial.legendre.leggauss(24)
    ends = np.linspace(0, 40 / z, 61)
    half = 0.5 * np.diff(ends)
    k = (0.5 * (ends[1:] + ends[:-1])[:, None] + half[:, None] * x).ravel()
    weight = (half[:, None] * weight).ravel() * hs.HANKEL["hertz"](k)
    a, b = np.sqrt(1 + q * q), np.sqrt(1 + medium.K * q * q)
    d = hs.rayleigh_denominator(medium, q * q, a, b)
    total = np.zeros(6)
    for n, decay in zip(hs.amplitudes(medium, q * q, a, b), (a, b)):
        e = weight * np.exp(-k * decay * z) / d
        zero, one = j0(k * r), j1(k * r) / r
        total += (hs.combine(n, (zero, k * zero, one, k * one), r) * e).sum(axis=1)
    return total


# ------------------------------------------------------------------ time cells


def cells(report):
    """(T22) to (T24)."""
    medium, r, z, width = Medium(0.3), 0.5, 0.6, 0.4
    fronts = hs.arrivals(medium, r, z)

    def integral(low, high, f):
        """int f R dt, split at the fronts."""
        breaks = [low, *(t for t in fronts if low < t < high), high]
        t, weight = hs.on_panels(breaks, hs.double_exponential(16, 2.8))
        rest = hs.static(medium, "hertz", r, z)
        values = np.stack(
            [hs.remainder(medium, "hertz", r, z, float(v)) if v > fronts[0] else -rest for v in t], axis=1
        )
        return values @ (weight * f(t))

    count = 8
    middle = width * (np.arange(count) + 0.5)
    moment = np.zeros((3, count, 6))
    for j in range(count):
        low, high, mid = j * width, (j + 1) * width, middle[j]
        moment[0, j] = integral(low, high, lambda t: np.ones_like(t)) / width
        moment[1, j] = integral(low, high, lambda t: t - mid) / width**2
        moment[2, j] = integral(low, high, lambda t: (t - mid) ** 2 - width**2 / 12) / width**3
    end = count * width
    # a force with a cubic: its rate is a parabola over each cell; P(0) = 0
    force = lambda t: 0.4 * t + 0.7 * t**2 - 0.11 * t**3
    rate = lambda t: 0.4 + 1.4 * t - 0.33 * t**2
    samples = force(width * np.arange(count + 1))
    exact = integral(0, end, lambda t: rate(end - t))
    found = np.zeros(6)
    for j in range(count):
        rise = samples[count - j] - samples[count - j - 1]
        at = end - middle[j]
        found += rise * moment[0, j] - width**2 * (1.4 - 0.66 * at) * moment[1, j] + width**3 * (-0.33) * moment[2, j]
    report.row(
        "T24",
        "cubic force: averages, first and second moments against Duhamel's integral",
        relative(found, exact),
        1e-9,
    )
    # displacements as a sum of P over the steps of H itself, which knows neither R nor its cells
    linear = sum((samples[count - j] - samples[count - j - 1]) * moment[0, j] for j in range(count))
    linear += samples[count] * hs.static(medium, "hertz", r, z)
    fine = np.linspace(0, end, 1601)
    rise = [hs.step(medium, "hertz", r, z, float(t))[:2] if t > fronts[0] else np.zeros(2) for t in fine]
    middles = 0.5 * (fine[1:] + fine[:-1])
    exact = np.interp(end - middles, width * np.arange(count + 1), samples) @ np.diff(rise, axis=0)
    report.row(
        "T22",
        "u, w under a force linear between samples: cell averages against a sum of P dH",
        relative(linear[:2], exact),
        1e-5,
    )
    time_integral(report, medium, r, z)


def time_integral(report, medium, r, z):
    """(T23): potentials one order higher, after the last front, where slownesses below one are silent."""
    low, high = hs.arrivals(medium, r, z)[-1] + 0.5, hs.arrivals(medium, r, z)[-1] + 2.0

    def chain4(which, zeta):
        zz, rho, log = hs.end(zeta, r)
        if which == "e":
            return zz * (zz * zz / 6 - 0.25 * r * r) * log + (r * r / 9 - 11 / 36 * zz * zz) * rho
        total = rho + zz
        cubic = zz * (rho * total + zz * zz) / (12 * total)
        return 0.5 * (0.625 * zz * rho - cubic + (0.125 * r * r - 0.5 * zz * zz) * log)

    def raised(xi):
        """A4, A3, B4/r, B3/r."""
        out = []
        for which, f in (("e", hs.chain_e), ("f", hs.chain_f)):
            four = [chain4(which, xi - 1j), chain4(which, xi + 1j)]
            three = [f(3, xi - 1j, r), f(3, xi + 1j, r)]
            out.append(1.5 / np.pi * ((four[0] - four[1]) / 2j - 0.5 * (three[0] + three[1])))
            out.append(hs.potential(f, 3, "hertz", xi, r))
        return out

    def primitive(t):
        c, K = medium.c, medium.K
        a, b = (1 - c * c) ** 0.5, (1 - c * c * K) ** 0.5
        total = np.zeros(6)
        for n, decay in zip(hs.amplitudes(medium, -c * c, a, b), (a, b)):
            psi = [v / (1j * c) for v in raised(complex(decay * z, -c * t))]
            total += 2 / (c * medium.slope()) * hs.combine(n, psi, r).real
        breaks = sorted({1.0, K**0.5, *(x for x in hs.fronts(medium, r, z, t, 1.0) if 1 < x < K**0.5)})
        x, weight = hs.on_panels(breaks)
        a, b, q2 = np.sqrt(abs(1 - 1 / x**2)) + 0j, 1j * np.sqrt(abs(K / x**2 - 1)), -1 / x**2
        d = hs.rayleigh_denominator(medium, q2, a, b)
        for n, decay in zip(hs.amplitudes(medium, q2, a, b), (a, b)):
            amplitude = [v / (1j * x * d) for v in n]
            for sense in (-1, 1):
                psi = [1j * sense * x * v for v in raised(decay * z + sense * 1j * t / x)]
                total += hs.combine(amplitude, psi, r).real @ weight / np.pi
        return total

    t, weight = hs.on_panels([low, high], hs.double_exponential(16, 2.8))
    values = np.stack([hs.remainder(medium, "hertz", r, z, float(v)) for v in t], axis=1)
    error = relative(primitive(high) - primitive(low), values @ weight)
    report.row("T23", "int R dt from potentials one order higher against quadrature in time", error, 1e-9)


def check(report):
    """All of section 2."""
    potential_forms(report)
    single_integral(report)
    cells(report)
